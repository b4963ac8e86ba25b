// SPDX-License-Identifier: MIT
#include "patch_outline.h"

#include <lacuna/quads/detail/patch_template.h>
#include <lacuna/quads/shared/measure_plane.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace lacuna;
using test::outline;

TEST_CASE("what can be filled without a cut has one quad at corners, two at other points of the loop")
{
    constexpr int kMost = 7;
    int filled = 0, folded = 0;
    for (const std::size_t count : {3U, 4U, 5U}) {
        std::vector<int> sides(count, 1);
        for (bool more = true; more;) {
            std::vector<std::size_t> corners;
            const std::vector<Vec2> loop = outline(sides, corners);
            if (quads::can_fill(quads::side_counts(loop.size(), corners))) {
                CAPTURE(sides[0]);
                CAPTURE(sides[1]);
                CAPTURE(sides[2]);
                const quads::TemplateMesh filling = quads::fill_template(loop, corners);
                quads::PlanarQuads mesh{loop, filling.quads};
                mesh.points.insert(mesh.points.end(), filling.inner.begin(), filling.inner.end());
                quads::PlanarRegion region{loop, {{}}, {}};
                std::vector<int> valence(mesh.points.size(), 0);
                for (std::size_t p = 0; p < loop.size(); ++p)
                    region.loops[0].push_back(static_cast<Index>(p));
                for (const Quad& quad : mesh.quads) {
                    for (const Index p : quad) ++valence[index(p)];
                }
                for (std::size_t p = 0; p < loop.size(); ++p)
                    CHECK(valence[p] == (std::count(corners.begin(), corners.end(), p) > 0 ? 1 : 2));
                CHECK(filling.irregular <= (count == 4 ? 4 : 1));
                // Before smoothing, a quad of sides that differ much may fold, and nothing else may be wrong.
                const std::string fault = quads::find_fault(mesh, region);
                const bool only_folded = fault.empty() || fault.find("not positive") != std::string::npos;
                CHECK_MESSAGE(only_folded, fault);
                ++filled;
                folded += fault.empty() ? 0 : 1;
            }
            std::size_t i = 0;
            while (i < count && sides[i] == kMost) sides[i++] = 1;
            more = i < count;
            if (more) ++sides[i];
        }
    }
    CHECK(filled > 1000);
    CHECK(20 * folded < filled);
}

TEST_CASE("sides that differ alike are filled with two irregular nodes, however they are numbered")
{
    for (int turn = 0; turn < 4; ++turn) {
        std::vector<int> sides{9, 8, 6, 5};
        std::rotate(sides.begin(), sides.begin() + turn, sides.end());
        std::vector<std::size_t> corners;
        const std::vector<Vec2> loop = outline(sides, corners);
        const quads::TemplateMesh filling = quads::fill_template(loop, corners);
        CHECK(filling.irregular == 2);
    }
}

TEST_CASE("four irregular nodes and the same number of quads, whichever sides differ more")
{
    std::vector<std::size_t> quads;
    for (int turn = 0; turn < 4; ++turn) {
        std::vector<int> sides{12, 7, 8, 7};
        std::rotate(sides.begin(), sides.begin() + turn, sides.end());
        std::vector<std::size_t> corners;
        const std::vector<Vec2> loop = outline(sides, corners);
        const quads::TemplateMesh filling = quads::fill_template(loop, corners);
        CHECK(filling.irregular == 4);
        quads.push_back(filling.quads.size());
    }
    CHECK(quads == std::vector<std::size_t>(4, quads.front()));
}
