// SPDX-License-Identifier: MIT
//
// find_crossing(): segments are stored in a tree of boxes with median cuts, and each segment queries the tree
// for later segments. A tree and not a grid, as spacings may differ by a factor of a million.
#include <lacuna/geometry/shared/triangulate.h>

#include <lacuna/geometry/shared/predicates.h>

#include <algorithm>
#include <numeric>

namespace lacuna::geometry {
namespace {

struct LoopSegment {
    Index from, to;
    std::size_t loop, segment;
};

struct Box {
    Vec2 low, high;
};

/// Segments in a leaf of the tree: testing a box costs about as much as testing a segment.
constexpr std::size_t kLeafSize = 4;

class SegmentTree {
public:
    explicit SegmentTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size())
    {
        std::iota(order_.begin(), order_.end(), std::size_t{0});
        if (!order_.empty()) build(0, order_.size());
    }

    /// Call `visit(i)` for each box that intersects `query`.
    template <class Visit>
    void each_meeting(const Box& query, const Visit& visit) const
    {
        std::vector<std::size_t> pending;
        if (!nodes_.empty()) pending.push_back(0);
        while (!pending.empty()) {
            const Node& node = nodes_[pending.back()];
            const std::size_t left = pending.back() + 1;
            pending.pop_back();
            if (!meet(node.box, query)) continue;
            if (node.right == 0) {
                for (std::size_t k = node.begin; k < node.end; ++k) {
                    if (meet(boxes_[order_[k]], query)) visit(order_[k]);
                }
            } else {
                pending.push_back(node.right);
                pending.push_back(left);
            }
        }
    }

private:
    struct Node {
        Box box;
        std::size_t begin, end, right; ///< right == 0: a leaf; the left child follows its parent
    };

    static bool meet(const Box& a, const Box& b)
    {
        return (a.low.array() <= b.high.array()).all() && (b.low.array() <= a.high.array()).all();
    }

    void build(std::size_t begin, std::size_t end)
    {
        Box box = boxes_[order_[begin]];
        for (std::size_t k = begin; k < end; ++k) {
            box.low = box.low.cwiseMin(boxes_[order_[k]].low);
            box.high = box.high.cwiseMax(boxes_[order_[k]].high);
        }
        const std::size_t here = nodes_.size();
        nodes_.push_back({box, begin, end, 0});
        if (end - begin <= kLeafSize) return;
        const Vec2 extent = box.high - box.low;
        const int axis = extent.x() >= extent.y() ? 0 : 1;
        const auto centre = [&](std::size_t i) { return boxes_[i].low[axis] + boxes_[i].high[axis]; };
        const std::size_t middle = (begin + end) / 2;
        const auto at = [&](std::size_t k) { return order_.begin() + static_cast<std::ptrdiff_t>(k); };
        std::nth_element(at(begin), at(middle), at(end), [&](std::size_t a, std::size_t b) {
            return std::pair(centre(a), a) < std::pair(centre(b), b);
        });
        build(begin, middle);
        nodes_[here].right = nodes_.size();
        build(middle, end);
    }

    std::vector<Box> boxes_;
    std::vector<std::size_t> order_;
    std::vector<Node> nodes_;
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
    std::vector<Box> boxes;
    for (std::size_t loop = 0; loop < loops.size(); ++loop) {
        const std::vector<Index>& walk = loops[loop];
        for (std::size_t k = 0; k < walk.size(); ++k) {
            const Index from = walk[k], to = walk[(k + 1) % walk.size()];
            segments.push_back({from, to, loop, k});
            boxes.push_back({at(from).cwiseMin(at(to)), at(from).cwiseMax(at(to))});
        }
    }
    const SegmentTree tree(boxes);

    const auto bad = [&](const LoopSegment& s, const LoopSegment& r) {
        const std::size_t count = loops[s.loop].size();
        if (s.loop == r.loop && count > 2) {
            if ((s.segment + 1) % count == r.segment) return folds_back(at(s.to), at(s.from), at(r.to));
            if ((r.segment + 1) % count == s.segment) return folds_back(at(r.to), at(r.from), at(s.to));
        }
        return segments_meet(at(s.from), at(s.to), at(r.from), at(r.to));
    };
    for (std::size_t i = 0; i < segments.size(); ++i) {
        std::size_t first = segments.size();
        tree.each_meeting(boxes[i], [&](std::size_t j) {
            if (j > i && j < first && bad(segments[i], segments[j])) first = j;
        });
        if (first == segments.size()) continue;
        return LoopCrossing{segments[i].loop, segments[i].segment, segments[first].loop,
                            segments[first].segment};
    }
    return std::nullopt;
}

} // namespace lacuna::geometry
