// SPDX-License-Identifier: MIT
//
// find_crossing() stores the segments as degenerate triangles in a tree of boxes with median cuts. A grid
// would not do, because spacings may differ by a factor of a million.
#include <lacuna/geometry/shared/triangulate.h>

#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/geometry/shared/predicates.h>

namespace lacuna::geometry {
namespace {

struct LoopSegment {
    Index from, to;
    std::size_t loop, segment;
};

bool within_box(const Vec2& p, const Vec2& a, const Vec2& b)
{
    return (p.array() >= a.cwiseMin(b).array()).all() && (p.array() <= a.cwiseMax(b).array()).all();
}

/// Whether two closed segments share a point, decided exactly.
bool segments_meet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d)
{
    const double abc = orient2d(a, b, c), abd = orient2d(a, b, d);
    const double cda = orient2d(c, d, a), cdb = orient2d(c, d, b);
    const auto apart = [](double x, double y) { return (x > 0 && y < 0) || (x < 0 && y > 0); };
    if (apart(abc, abd) && apart(cda, cdb)) return true;
    return (abc == 0 && within_box(c, a, b)) || (abd == 0 && within_box(d, a, b)) ||
           (cda == 0 && within_box(a, c, d)) || (cdb == 0 && within_box(b, c, d));
}

/// Neighbouring segments share the point `common`; they overlap if the second folds back onto the first.
bool folds_back(const Vec2& common, const Vec2& a, const Vec2& b)
{
    return (a - common).dot(b - common) > 0 && orient2d(common, a, b) == 0;
}

} // namespace

std::optional<LoopCrossing> find_crossing(std::span<const Vec2> points,
                                          std::span<const std::vector<Index>> loops)
{
    const auto at = [&](Index i) -> const Vec2& { return points[static_cast<std::size_t>(i)]; };
    std::vector<LoopSegment> segments;
    std::vector<Vec3> lifted;
    std::vector<Triangle> needles;
    for (std::size_t loop = 0; loop < loops.size(); ++loop) {
        const std::vector<Index>& walk = loops[loop];
        const auto first = static_cast<Index>(lifted.size()), count = static_cast<Index>(walk.size());
        for (Index k = 0; k < count; ++k) {
            const Index from = walk[index(k)], next = (k + 1) % count;
            segments.push_back({from, walk[index(next)], loop, index(k)});
            lifted.emplace_back(at(from).x(), at(from).y(), 0);
            needles.push_back({first + k, first + next, first + next});
        }
    }

    const auto bad = [&](const LoopSegment& s, const LoopSegment& r) {
        const std::size_t count = loops[s.loop].size();
        if (s.loop == r.loop && count > 2) {
            if ((s.segment + 1) % count == r.segment) return folds_back(at(s.to), at(s.from), at(r.to));
            if ((r.segment + 1) % count == s.segment) return folds_back(at(r.to), at(r.from), at(s.to));
        }
        return segments_meet(at(s.from), at(s.to), at(r.from), at(r.to));
    };
    std::optional<std::pair<Index, Index>> first;
    const FacetTree tree(lifted, needles);
    tree.overlaps(tree, [&](Index i, Index j) {
        if ((!first || std::pair(i, j) < *first) && bad(segments[index(i)], segments[index(j)]))
            first = {i, j};
        return true;
    });
    if (!first) return std::nullopt;
    const LoopSegment &a = segments[index(first->first)], &b = segments[index(first->second)];
    return LoopCrossing{a.loop, a.segment, b.loop, b.segment};
}

} // namespace lacuna::geometry
