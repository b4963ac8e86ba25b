// SPDX-License-Identifier: GPL-2.0-or-later
// The fallback to tetrahedra as a C++ host uses it, and each of its refusals.
#include "made_files.h"
#include "support/cancelling.h"
#include "support/refusal.h"

#include <lacuna/cad/load.h>
#include <lacuna/fill.h>
#include <lacuna/healing/split_facets.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

using namespace lacuna;
using test::refusal;

namespace {

/// A pyramid over a polygon of forty sides, which neither a sweep nor pieces fill.
topology::Model pyramid()
{
    constexpr Index kSides = 40;
    healing::FacetSoup soup;
    for (Index k = 0; k < kSides; ++k) {
        const double angle = 2 * std::numbers::pi * k / kSides;
        soup.points.emplace_back(std::cos(angle), std::sin(angle), 0);
        soup.triangles.push_back({k, (k + 1) % kSides, kSides});
        soup.triangle_label.push_back(k);
    }
    soup.points.emplace_back(0, 0, 1);
    for (Index k = 1; k + 1 < kSides; ++k) {
        soup.triangles.push_back({0, k + 1, k});
        soup.triangle_label.push_back(kSides);
    }
    return healing::split_facets(soup);
}

/// A cube with an arm to each side, whose arms no single sweep fills.
topology::Model star()
{
    healing::FacetSoup soup;
    std::vector<std::array<int, 3>> cubes{{0, 0, 0}};
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const int side : {-1, 1}) cubes.emplace_back()[axis] = side;
    for (const std::array<int, 3>& cube : cubes)
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (const int side : {0, 1}) {
                std::array<int, 3> beside = cube;
                beside[axis] += 2 * side - 1;
                if (std::ranges::find(cubes, beside) != cubes.end()) continue;
                const auto first = static_cast<Index>(soup.points.size());
                for (const auto& [u, v] :
                     {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)}) {
                    std::array<int, 3> at = cube;
                    at[axis] += side;
                    at[(axis + 1) % 3] += u;
                    at[(axis + 2) % 3] += v;
                    soup.points.emplace_back(at[0], at[1], at[2]);
                }
                const Index b = side == 1 ? 1 : 3, d = side == 1 ? 3 : 1;
                soup.triangles.push_back({first, first + b, first + 2});
                soup.triangles.push_back({first, first + 2, first + d});
                const int label = soup.triangle_label.empty() ? 0 : soup.triangle_label.back() + 1;
                soup.triangle_label.insert(soup.triangle_label.end(), 2, label);
            }
    return healing::split_facets(soup);
}

fill::Request mixed(double size, mesh::TetMesher mesher = cad::fill_skin)
{
    fill::Request request;
    request.sweep.options.size = [size](const Vec3&) { return size; };
    request.sweep.options.fallback = sweep::Fallback::mixed;
    request.sweep.options.tet_mesher = std::move(mesher);
    return request;
}

} // namespace

TEST_CASE(
    "a host fills with tetrahedra what no sweep fills, cuts what it can into pieces, and writes the deck")
{
    const fill::Filled tets = fill::fill(pyramid(), mixed(0.2));
    const auto& parts = std::get<fill::FilledParts>(tets.mesh);
    CHECK(fill::cell_count(parts, mesh::CellShape::tet4) > 50);
    CHECK(fill::cell_count(parts, mesh::CellShape::hex8) == 0);
    CHECK(fill::fidelity(parts).volume == doctest::Approx(20.0 / 3 * std::sin(2 * std::numbers::pi / 40)));
    CHECK(fill::measure(fill::whole_cells(parts)).uncertified == 0);
    const io::Deck deck = fill::whole_deck(parts, {});
    CHECK(deck.points.size() == parts.swept.nodes);

    const fill::Volume sealed = fill::open(star(), {});
    fill::Cut automatic;
    automatic.automatic = true;
    const std::vector<fill::Volume> pieces = fill::cut(sealed, automatic);
    CHECK(pieces.size() > 1);
    std::vector<fill::Member> members;
    for (const fill::Volume& piece : pieces)
        members.push_back({&piece, nullptr, nullptr, mixed(0.5).sweep.options});
    const fill::Filled whole = fill::sweep(members);
    CHECK(fill::cell_count(std::get<fill::FilledParts>(whole.mesh), mesh::CellShape::tet4) == 0);
    CHECK(fill::fidelity(std::get<fill::FilledParts>(whole.mesh)).volume == doctest::Approx(7));
}

TEST_CASE("a refused sweep ends with the option that allows tetrahedra, if the host has a mesher for them")
{
    fill::Request request = mixed(0.2);
    const std::string option = "sweep with fallback = \"mixed\"";
    for (const sweep::Fallback fallback : {sweep::Fallback::none, sweep::Fallback::wedges}) {
        request.sweep.options.fallback = fallback;
        CHECK(refusal([&] { (void)fill::fill(pyramid(), request); }, {option}) == "topology.no_roles");
        const fill::Volume volume = fill::open(pyramid(), {});
        const fill::Member member{&volume, nullptr, nullptr, request.sweep.options};
        CHECK(refusal([&] { (void)fill::sweep({&member, 1}); }, {option}) == "topology.no_roles");
    }
    request.sweep.options.tet_mesher = nullptr;
    try {
        (void)fill::fill(pyramid(), request);
        FAIL("nothing was refused");
    } catch (const Error& error) {
        CHECK_FALSE(test::has(error.what(), option));
    }
}

TEST_CASE("tetrahedra are refused by name: no mesher, no CAD process, a mesher that fails, another skin")
{
    CHECK(refusal([] { (void)fill::fill(pyramid(), mixed(0.2, nullptr)); }, {"cad::fill_skin"}) ==
          "fill.no_tets");

    const auto fails = [](const mesh::ClosedSkin&, const RunContext&) -> mesh::TetMesh {
        throw NotSweepable("cad.tets_failed", "no tetrahedra");
    };
    CHECK(refusal([&] { (void)fill::fill(pyramid(), mixed(0.2, fails)); }) == "cad.tets_failed");

    const auto loses_one = [](const mesh::ClosedSkin& skin, const RunContext& context) {
        mesh::TetMesh made = cad::fill_skin(skin, context);
        made.cells.pop_back();
        return made;
    };
    const std::string lost = refusal([&] { (void)fill::fill(pyramid(), mixed(0.2, loses_one)); });
    const bool is_refused = lost == "fill.skin_differs" || lost == "quality.open_skin"; // on the skin, inside
    CHECK(is_refused);

    const auto turns_one = [](const mesh::ClosedSkin& skin, const RunContext& context) {
        mesh::TetMesh made = cad::fill_skin(skin, context);
        std::swap(made.cells.back()[0], made.cells.back()[1]);
        return made;
    };
    CHECK(refusal([&] { (void)fill::fill(pyramid(), mixed(0.2, turns_one)); }) == "quality.inverted");

    const std::string program = std::getenv("LACUNA_CAD");
    test::kill_worker();
    ::setenv("LACUNA_CAD", "/nowhere/lacuna-cad", 1);
    CHECK(refusal([] { (void)fill::fill(pyramid(), mixed(0.2)); }, {"LACUNA_CAD"}) == "cad.no_worker");
    ::setenv("LACUNA_CAD", program.c_str(), 1);
    CHECK(refusal([] { (void)fill::fill(pyramid(), mixed(0.2)); }) == "done");
}

TEST_CASE("a fill with tetrahedra stops within half a second, whichever stage it is in")
{
    const topology::Model model = pyramid();
    fill::Request request = mixed(0.015);
    for (const int order : {1, 2}) {
        request.sweep.options.order = order;
        CHECK(test::heeds_cancel(
            [&](const RunContext& context) { (void)fill::fill(model, request, context); }));
    }
    for (const int wait : {20, 150, 600}) {
        CAPTURE(wait);
        const auto stopped = test::stops_within(
            std::chrono::milliseconds(wait),
            [&](const RunContext& context) { (void)fill::fill(model, request, context); });
        REQUIRE(stopped);
        CHECK(*stopped < 0.5);
    }
}
