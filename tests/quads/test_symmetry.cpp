// SPDX-License-Identifier: MIT
#include <lacuna/quads/shared/symmetry.h>

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <vector>

using namespace lacuna;

namespace {

struct SymmetricOutline {
    std::vector<Vec2> corners;
    std::vector<std::size_t> alike; ///< of each side the least that it is mapped onto
};

/// Nodes at even shares of every side, turned and moved.
quads::PlanarRegion region_of(const SymmetricOutline& outline, int per_side, std::vector<int>& segment)
{
    quads::PlanarRegion region;
    region.loops.emplace_back();
    const std::size_t n = outline.corners.size();
    for (std::size_t s = 0; s < n; ++s) {
        const Vec2 &a = outline.corners[s], &b = outline.corners[(s + 1) % n];
        for (int k = 0; k < per_side; ++k) {
            const Vec2 p = a + (b - a) * (static_cast<double>(k) / per_side);
            region.loops[0].push_back(static_cast<Index>(region.points.size()));
            region.points.push_back(Eigen::Rotation2Dd(0.7) * (3.0 * p) + Vec2(5, -2));
            segment.push_back(static_cast<int>(s));
        }
    }
    return region;
}

} // namespace

TEST_CASE("sides of an outline are alike where its symmetries map them onto each other")
{
    const std::vector<SymmetricOutline> outlines{
        {{{0, 0}, {2, 0}, {2, 1}, {0, 1}}, {0, 1, 0, 1}},
        {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {0, 0, 0, 0}},
        {{{0, 0}, {3, 0}, {2, 1}, {1, 1}}, {0, 1, 2, 1}},
        {{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, {0, 1, 2, 2, 1, 0}},
        {{{0, 0}, {3, 0}, {4, 1}, {1, 1}}, {0, 1, 0, 1}}, // half a turn, no mirror
        {{{0, 0}, {2, 0}, {0, 1}}, {0, 1, 2}},
        {{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {0, 2}}, {0, 1, 2, 3, 4, 5}},
    };
    for (const SymmetricOutline& outline : outlines) {
        for (const int per_side : {1, 4}) {
            CAPTURE(outline.corners.size());
            CAPTURE(per_side);
            std::vector<int> segment;
            const quads::PlanarRegion region = region_of(outline, per_side, segment);
            CHECK(quads::segments_alike(region, segment) == outline.alike);
        }
    }
}

TEST_CASE("a symmetry that maps the end of a segment into another makes none alike")
{
    // A square of which one side is two segments.
    std::vector<int> segment;
    const SymmetricOutline square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {}};
    const quads::PlanarRegion region = region_of(square, 4, segment);
    for (std::size_t p = 3; p < segment.size(); ++p) ++segment[p];
    CHECK(quads::segments_alike(region, segment) == std::vector<std::size_t>{0, 1, 2, 3, 4});
}
