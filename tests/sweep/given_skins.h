// SPDX-License-Identifier: MIT
#pragma once

#include "support/blocks.h"
#include "support/check_valid.h"
#include "support/refusal.h"
#include "surface/sealed.h"

#include <lacuna/sweep/sweep.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <random>
#include <set>

/// Voids whose faces come with meshes: the skins of meshes, of which parts are given.
namespace lacuna::test {

using namespace topology;
using sweep::SweepOptions;
using sweep::Swept;

/// A quad or triangle as a set of places, whatever corner it starts from.
using Places = std::set<std::array<double, 3>>;

inline Places places(const std::vector<Vec3>& nodes, const Quad& quad)
{
    Places result;
    for (const Index n : quad) {
        const Vec3& p = nodes[static_cast<std::size_t>(n)];
        result.insert({p.x(), p.y(), p.z()});
    }
    return result;
}

/// What a mesh is taken apart into: quads of its skin, by the part they belong to.
struct GivenSkin {
    std::vector<Vec3> nodes;
    std::vector<Quad> quads;
    std::vector<int> part; ///< 0 source, 1 target, 2 a wall
};

inline GivenSkin skin_of(const mesh::HexMesh& mesh)
{
    GivenSkin skin{mesh.nodes, {}, {}};
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
        const mesh::SkinQuad quad = mesh::skin_quad(mesh, i);
        skin.quads.push_back(quad.nodes);
        skin.part.push_back(static_cast<int>(quad.patch));
    }
    return skin;
}

/// The same skin with its points and quads in any order, each quad from any corner.
inline GivenSkin shuffled(const GivenSkin& skin, unsigned seed)
{
    std::mt19937 random(seed);
    std::vector<Index> number(skin.nodes.size());
    std::iota(number.begin(), number.end(), 0);
    std::shuffle(number.begin(), number.end(), random);
    std::vector<std::size_t> order(skin.quads.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::shuffle(order.begin(), order.end(), random);
    GivenSkin result{std::vector<Vec3>(skin.nodes.size()), {}, {}};
    for (std::size_t n = 0; n < number.size(); ++n)
        result.nodes[static_cast<std::size_t>(number[n])] = skin.nodes[n];
    for (const std::size_t q : order) {
        Quad quad = skin.quads[q];
        for (Index& n : quad) n = number[static_cast<std::size_t>(n)];
        std::rotate(quad.begin(), quad.begin() + static_cast<std::ptrdiff_t>(random() % 4), quad.end());
        result.quads.push_back(quad);
        result.part.push_back(skin.part[q]);
    }
    return result;
}

/// Which quads are given, and how.
enum class Given { no, quads, triangles };

struct Opened {
    OpenVolume volume;
    std::set<Places> quads;     ///< that are given as quads
    std::set<Places> triangles; ///< those that are no halves of them
    std::vector<Vec3> nodes;    ///< of given quads and triangles, all
};

/// The volume whose faces are parts of a skin.
inline Opened open(const GivenSkin& skin, const std::function<Given(int part, const Vec3& centre)>& given)
{
    healing::FacetSoup soup;
    soup.points = skin.nodes;
    soup.label_name = {"source", "target", "wall"};
    soup.label_keeps_nodes = {1, 1, 1};
    Opened opened;
    for (std::size_t i = 0; i < skin.quads.size(); ++i) {
        const Quad& q = skin.quads[i];
        Vec3 centre = Vec3::Zero();
        for (const Index n : q) centre += skin.nodes[static_cast<std::size_t>(n)] / 4;
        const Given how = given(skin.part[i], centre);
        if (how == Given::no) continue;
        for (const Index n : q) opened.nodes.push_back(skin.nodes[static_cast<std::size_t>(n)]);
        if (how == Given::quads) {
            soup.quads.push_back(q);
            soup.quad_label.push_back(skin.part[i]);
            opened.quads.insert(places(skin.nodes, q));
        } else {
            soup.triangles.push_back({q[0], q[1], q[2]});
            soup.triangles.push_back({q[0], q[2], q[3]});
            opened.triangles.insert(places(skin.nodes, {q[0], q[1], q[2], q[2]}));
            opened.triangles.insert(places(skin.nodes, {q[0], q[2], q[3], q[3]}));
            soup.triangle_label.insert(soup.triangle_label.end(), 2, skin.part[i]);
        }
    }
    Model model = healing::split_facets(soup);
    orient_consistently(model);
    Roles roles;
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        const std::string& name = model.faces[f].name;
        (name == "source" ? roles.source : name == "target" ? roles.target : roles.walls).emplace_back(f);
    }
    opened.volume = open_volume(model, roles);
    return opened;
}

inline Swept filled(OpenVolume& volume, const SweepOptions& options)
{
    const bool ends = !volume.faces(Role::source).empty() && !volume.faces(Role::target).empty();
    volume = closure::close(volume, ends ? matching::match(volume) : matching::Match{}).volume;
    return sweep::sweep(volume, options);
}

/// How many of the given quads or triangles are those of the skin.
inline std::size_t kept(const mesh::HexMesh& mesh, const std::set<Places>& given)
{
    std::size_t count = 0;
    for (std::size_t i = 0; i < mesh.skin_count(); ++i)
        count += given.count(places(mesh.nodes, mesh::skin_quad(mesh, i).nodes));
    return count;
}

/// How many nodes of given faces that lie on the rim of the whole are none of the mesh.
inline std::size_t missing(const mesh::HexMesh& mesh, const std::vector<Vec3>& nodes)
{
    std::set<std::array<double, 3>> there;
    for (const Vec3& p : mesh.nodes) there.insert({p.x(), p.y(), p.z()});
    return static_cast<std::size_t>(std::count_if(nodes.begin(), nodes.end(), [&](const Vec3& p) {
        return !there.contains({p.x(), p.y(), p.z()});
    }));
}

/// Uneven in all directions, and not flat.
inline Vec3 uneven(const Vec3& p)
{
    const double x = p.x() + 0.12 * std::sin(3 * p.x() + 2 * p.y());
    const double y = p.y() * (1 + 0.3 * p.y()) + 0.05 * p.x();
    const double z = p.z() * (1 + 0.4 * p.z() + 0.2 * p.x() - 0.1 * p.y());
    return {x, y, z};
}

inline Vec3 twisted(const Vec3& p)
{
    const double angle = 0.5 * p.z();
    const double x = p.x() - 0.5, y = p.y() - 0.5;
    return {std::cos(angle) * x - std::sin(angle) * y, std::sin(angle) * x + std::cos(angle) * y,
            2 * p.z() * p.z() + p.z()};
}

inline Vec3 bent(const Vec3& p)
{
    const double angle = 1.2 * p.z(), radius = 2.5 - p.x();
    return {radius * std::cos(angle), p.y() * (1 + 0.2 * p.z()), radius * std::sin(angle)};
}

inline bool on_side(int part, const Vec3& before, int side)
{
    if (part != 2) return false;
    const double off[4] = {before.y(), 1 - before.x(), 1 - before.y(), before.x()};
    return off[side] < 1e-9;
}

/// Faces of a block that are left out, by class.
struct Missing {
    const char* value;
    std::function<bool(int part, const Vec3& before)> gone;
};

inline const std::vector<Missing> kMissing{
    {"I", [](int part, const Vec3&) { return part == 2; }},
    {"II", [](int part, const Vec3& p) { return on_side(part, p, 1) || on_side(part, p, 2); }},
    {"III", [](int part, const Vec3& p) { return on_side(part, p, 3); }},
    {"IV", [](int part, const Vec3&) { return part == 1; }},
    {"V", [](int part, const Vec3&) { return part < 2; }},
};

} // namespace lacuna::test
