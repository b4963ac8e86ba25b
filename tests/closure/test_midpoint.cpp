// SPDX-License-Identifier: MIT
#include "closure/sealing_checks.h"
#include "support/cancelling.h"

#include <lacuna/closure/shared/cut.h>
#include <lacuna/closure/shared/partition.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <string>

using namespace lacuna;
using namespace lacuna::topology;
using closure::StepPiece;

namespace {

/// The pieces of a volume without concave edges, whose blocks can be swept.
std::vector<StepPiece> divided(const OpenVolume& volume, const RunContext& context = {})
{
    std::vector<StepPiece> first;
    const auto take = [&](std::vector<StepPiece> pieces) {
        first = std::move(pieces);
        return true;
    };
    closure::partitions(
        volume, [](const OpenVolume&) { return true; }, 0, take, context);
    return first;
}

/// Blocks are watertight, have six faces with four sides each, fill the volume, keep its faces, and share
/// each new face with one other block.
void check_blocks(const OpenVolume& whole, const std::vector<StepPiece>& blocks, std::size_t vertices)
{
    REQUIRE(blocks.size() == vertices);
    double volume = 0;
    std::map<int, double> area;
    std::map<std::string, int> uses;
    for (const StepPiece& block : blocks) {
        const Model& model = block.volume.model;
        CHECK(closure::is_watertight(block.volume));
        CHECK(closure::has_ends(block.volume));
        CHECK(model.faces.size() == 6);
        CHECK(model.edges.size() == 12);
        const double own = closure::enclosed_volume(block.volume);
        CHECK(own > 0);
        volume += own;
        for (const FaceId face : all_faces(model)) {
            CHECK(border_loops(model, face).front().uses.size() == 4);
            if (model[face].origin == Origin::given)
                area[model[face].tag] += face_area(model, face);
            else
                ++uses[model[face].name];
        }
    }
    CHECK(volume == doctest::Approx(closure::enclosed_volume(whole)).epsilon(1e-9));
    for (const Face& face : whole.model.faces) {
        const FaceId id(static_cast<std::size_t>(&face - whole.model.faces.data()));
        CHECK(area[face.tag] == doctest::Approx(face_area(whole.model, id)).epsilon(1e-9));
    }
    CHECK(uses.size() == 3 * vertices / 2);
    for (const auto& [name, count] : uses) {
        CAPTURE(name);
        CHECK(count == 2);
    }
}

} // namespace

TEST_CASE("a volume whose vertices have three edges falls into one block for each")
{
    for (const int sides : {3, 4, 5, 8}) {
        for (const auto& options :
             {test::PrismOptions{.sides = sides}, test::PrismOptions{.sides = sides, .cuts = 3, .taper = 0.5},
              test::PrismOptions{.sides = sides, .levels = 8, .twist = 20},
              test::PrismOptions{.sides = sides, .levels = 8, .bend = 40, .belly = 1.2},
              test::PrismOptions{.sides = sides, .target = test::End::tilted},
              test::PrismOptions{.sides = sides, .cuts = 6, .target = test::End::bowed}}) {
            CAPTURE(sides);
            CAPTURE(options.twist);
            CAPTURE(options.bend);
            const OpenVolume volume = test::prism(options).open();
            check_blocks(volume, divided(volume), static_cast<std::size_t>(2 * sides));
        }
    }
}

TEST_CASE("a volume with other vertices, with holes, closed edges or folded blocks loses nothing")
{
    // Closed edges; holes; a wall of two pieces, whose common edge is flat; a corner that is nearly flat.
    // These are not divided at their middles, but some at the mean of their vertices.
    const std::vector<Vec2> flat{{-1, -1}, {1, -1}, {1.02, 0}, {1, 1}, {-1, 1}};
    for (const auto& options :
         {test::PrismOptions{.sides = 0}, test::PrismOptions{.sides = 4, .holes = 1, .hole_sides = 0},
          test::PrismOptions{.sides = 4, .pieces = 2},
          test::PrismOptions{.outline = flat, .feature_angle = 1}}) {
        const OpenVolume volume = test::prism(options).open();
        double filled = 0;
        for (const StepPiece& piece : divided(volume)) {
            CHECK(closure::is_watertight(piece.volume));
            filled += closure::enclosed_volume(piece.volume);
        }
        CHECK(filled == doctest::Approx(closure::enclosed_volume(volume)).epsilon(1e-9));
    }
}

TEST_CASE("partitions follow until one is taken, each fills the volume, and their first cuts differ")
{
    const std::vector<Vec2> stairs{{0, 0}, {4, 0}, {4, 1}, {2.5, 1}, {2.5, 2}, {1, 2}, {1, 4}, {0, 4}};
    const OpenVolume volume = test::prism({.outline = stairs}).open();
    const double whole = closure::enclosed_volume(volume);
    const closure::CanSweep is_block = [](const OpenVolume& piece) { return piece.model.faces.size() <= 6; };
    for (const std::size_t wanted : {1, 2, 100}) {
        std::set<std::vector<double>> seen; // the volumes of the pieces of each partition
        std::size_t calls = 0;
        const auto take = [&](const std::vector<StepPiece>& pieces) {
            std::vector<double> volumes;
            for (const StepPiece& piece : pieces) {
                CHECK(closure::is_watertight(piece.volume));
                volumes.push_back(closure::enclosed_volume(piece.volume));
            }
            CHECK(std::reduce(volumes.begin(), volumes.end()) == doctest::Approx(whole).epsilon(1e-9));
            std::ranges::sort(volumes);
            seen.insert(volumes);
            return ++calls == wanted;
        };
        closure::partitions(volume, is_block, 0, take);
        CHECK(calls == seen.size());
        if (wanted == 100)
            CHECK(calls > 1);
        else
            CHECK(calls == wanted);
    }
}

TEST_CASE("division at the middle heeds a cancel")
{
    const OpenVolume volume = test::prism({.sides = 5}).open();
    CHECK(test::heeds_cancel([&](const RunContext& context) { divided(volume, context); }));
}
