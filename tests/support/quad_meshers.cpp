// SPDX-License-Identifier: MIT
#include "support/quad_meshers.h"

#include <lacuna/core/error.h>
#include <lacuna/geometry/shared/triangulate.h>

#include <algorithm>
#include <array>
#include <map>

namespace lacuna::test {

quads::PlanarQuads midpoint_quads(const quads::PlanarRegion& region, const RunContext&)
{
    std::vector<Vec2> coarse;
    std::vector<Index> number; // of each coarse boundary point in the region
    std::vector<std::vector<Index>> loops;
    std::map<std::pair<Index, Index>, Index> middle;
    for (const std::vector<Index>& loop : region.loops) {
        if (loop.size() % 2 != 0)
            throw NotSweepable("test.odd_loop", "the test's mesher needs loops of an even number of nodes");
        std::vector<Index>& chain = loops.emplace_back();
        const auto first = static_cast<Index>(coarse.size());
        const auto half = static_cast<Index>(loop.size() / 2);
        for (Index i = 0; i < half; ++i) {
            chain.push_back(first + i);
            number.push_back(loop[static_cast<std::size_t>(2 * i)]);
            coarse.push_back(region.points[static_cast<std::size_t>(number.back())]);
            const Index next = first + (i + 1) % half;
            middle[{std::min(first + i, next), std::max(first + i, next)}] =
                loop[static_cast<std::size_t>(2 * i + 1)];
        }
    }
    geometry::TriangulateOptions options;
    options.grading = 0.4;
    const auto cells = geometry::triangulate(coarse, loops, options);
    quads::PlanarQuads result{region.points, {}};
    const auto add = [&](const Vec2& p) {
        result.points.push_back(p);
        return static_cast<Index>(result.points.size()) - 1;
    };
    for (std::size_t i = coarse.size(); i < cells.points.size(); ++i) number.push_back(add(cells.points[i]));
    const auto at = [&](Index p) {
        return result.points[static_cast<std::size_t>(number[static_cast<std::size_t>(p)])];
    };
    for (const Triangle& t : cells.triangles) {
        std::array<Index, 3> half{};
        for (std::size_t i = 0; i < 3; ++i) {
            const Index a = t[i], b = t[(i + 1) % 3];
            const auto [found, fresh] = middle.try_emplace({std::min(a, b), std::max(a, b)}, -1);
            if (fresh) found->second = add((at(a) + at(b)) / 2);
            half[i] = found->second;
        }
        const Index centre = add((at(t[0]) + at(t[1]) + at(t[2])) / 3);
        for (std::size_t i = 0; i < 3; ++i)
            result.quads.push_back(
                {number[static_cast<std::size_t>(t[i])], half[i], centre, half[(i + 2) % 3]});
    }
    return result;
}

} // namespace lacuna::test
