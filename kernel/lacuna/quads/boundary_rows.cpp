// SPDX-License-Identifier: MIT
#include <lacuna/quads/shared/boundary_rows.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/quads/detail/pave_gaps.h>
#include <lacuna/quads/shared/measure_plane.h>

#include <algorithm>
#include <cmath>
#include <ranges>
#include <utility>

namespace lacuna::quads {

namespace {

using namespace paving;

/// A loop to which rows are being added.
struct Front {
    Cycle nodes;
    std::vector<int> table; ///< for each node, the table of the side from it to the next node
};

/// A run: consecutive sides of a front that have the same table and get their rows together.
struct Run {
    /// First position in the front, and number of sides. The run is closed if it contains all sides of the
    /// front.
    std::size_t first = 0, sides = 0;
    bool closed = false;
};

class RowLayer {
public:
    RowLayer(const PlanarRegion& region, const BoundaryRows& rows)
        : rows_(rows),
          partial_{region.points, {}, region.points.size(), {}},
          given_(region.loops),
          turn_(rows.turn),
          is_cut_(region.points.size(), false)
    {
        for (const auto& loop : region.loops) {
            Front front{loop, {}};
            for (const Index p : loop) front.table.push_back(rows.table[index(p)]);
            fronts_.push_back(std::move(front));
        }
    }

    /// Place the rows of all sides. @return false if they do not fit; `finding()` then has the reason
    bool lay()
    {
        for (std::size_t f = 0; f < fronts_.size(); ++f) {
            while (const std::optional<Run> run = next_run(fronts_[f])) {
                if (!lay_run(fronts_[f], *run)) return false;
            }
        }
        return true;
    }

    /// The region inside the rows.
    [[nodiscard]] RegionWithin core(const SizeField& size) const
    {
        std::vector<Cycle> loops;
        for (const Front& front : fronts_) loops.push_back(front.nodes);
        return region_within(partial_.points, loops, size);
    }

    /// The boundary node with the least room for its rows.
    [[nodiscard]] RowsFinding least_room() const
    {
        const GapFinder gaps(partial_, given_);
        double least = kInfinity;
        RowsFinding finding;
        for (const Cycle& loop : given_) {
            for (std::size_t i = 0, n = loop.size(); i < n; ++i) {
                const int table = rows_.table[index(loop[i])];
                if (table < 0) continue;
                const Index before = loop[(i + n - 1) % n], after = loop[(i + 1) % n];
                const Vec2 along = (partial_.at(after) - partial_.at(loop[i])).normalized();
                const double scale = scale_at(partial_.at(loop[i]));
                const double room =
                    gaps.ahead(before, loop[i], after, {-along.y(), along.x()}, gaps.diagonal()) / scale;
                const double asked = heights_of(table).back();
                if (room / asked >= least) continue;
                least = room / asked;
                finding = RowsFinding{RowsFinding::Why::no_room, loop[i], table, asked, room};
            }
        }
        return finding;
    }

    PartialMesh& partial() { return partial_; }
    [[nodiscard]] const std::optional<RowsFinding>& finding() const { return finding_; }

private:
    [[nodiscard]] const std::vector<double>& heights_of(int table) const
    {
        return rows_.heights[index(table)];
    }

    [[nodiscard]] double scale_at(const Vec2& p) const { return rows_.scale ? rows_.scale(p) : 1; }

    /// The boundary node below a node of a row, for messages.
    [[nodiscard]] Index foot_of(Index node) const
    {
        return partial_.is_fixed(node) ? node : foot_[index(node) - partial_.fixed];
    }

    /// How the front turns at a position. At a boundary node whose angle no row has used, it is the given
    /// turn. At any other node, it follows from the angle of the front.
    [[nodiscard]] RowTurn turn_at(const Front& front, std::size_t i) const
    {
        const Index node = front.nodes[i];
        if (partial_.is_fixed(node) && !is_cut_[index(node)]) return turn_[index(node)];
        return corner_angle(partial_.points, front.nodes, i) > kReversalAbove * kDegree ? RowTurn::outer
                                                                                        : RowTurn::smooth;
    }

    /// Whether rows continue past a position of the front.
    [[nodiscard]] bool goes_on(const Front& front, std::size_t i) const
    {
        const std::size_t n = front.nodes.size();
        return front.table[i] == front.table[(i + n - 1) % n] && turn_at(front, i) == RowTurn::smooth;
    }

    [[nodiscard]] std::optional<Run> next_run(const Front& front) const
    {
        const std::size_t n = front.nodes.size();
        std::size_t any = n;
        for (std::size_t i = 0; i < n; ++i) {
            if (front.table[i] < 0) continue;
            any = i;
            if (goes_on(front, i)) continue;
            Run run{i, 1, false};
            while (run.sides < n && goes_on(front, (i + run.sides) % n)) ++run.sides;
            return run;
        }
        if (any == n) return std::nullopt;
        return Run{0, n, true};
    }

    bool refuse(RowsFinding::Why why, Index node, int table, double asked, double found)
    {
        finding_ = RowsFinding{why, foot_of(node), table, asked, found};
        return false;
    }

    /// How the rows of a run end at one end of the run.
    struct RunEnd {
        /// Nodes on which the rows end, the lowest row first: existing nodes of the adjacent side, or new
        /// nodes.
        std::vector<Index> nodes;
        std::vector<double> lean; ///< for each row, how far its end node is offset along the run [length]
        std::vector<double> rise; ///< for each row, height of its end node above the row's height [length]
        /// Length from this end over which the rows of the adjacent side cross the rows of the run.
        double block = 0;
        bool own = false; ///< whether the rows end on a new side, which their end nodes form
    };

    /// The nodes of the run, each with a vector inward. A node that is moved by h times its vector is at
    /// height h above both of its sides.
    struct Base {
        std::vector<Index> nodes;
        std::vector<Vec2> normal, along;
        std::vector<double> at; ///< arc length at each node
    };

    [[nodiscard]] Base base_of(const Front& front, const Run& run) const
    {
        const std::size_t n = front.nodes.size();
        Base base;
        const std::size_t count = run.closed ? run.sides : run.sides + 1;
        for (std::size_t k = 0; k < count; ++k) base.nodes.push_back(front.nodes[(run.first + k) % n]);
        const auto unit = [&](std::size_t k) {
            return Vec2((point_of(partial_.points, front.nodes, run.first + k + 1) -
                         point_of(partial_.points, front.nodes, run.first + k))
                            .normalized());
        };
        double length = 0;
        for (std::size_t k = 0; k < count; ++k) {
            const bool first = !run.closed && k == 0, last = !run.closed && k + 1 == count;
            const Vec2 before = first ? unit(0) : unit(k + n - 1), after = last ? unit(k + n - 1) : unit(k);
            const Vec2 a(-before.y(), before.x()), b(-after.y(), after.x());
            base.normal.emplace_back((a + b) / (1 + a.dot(b)));
            base.along.emplace_back((before + after).normalized());
            base.at.push_back(length);
            if (k + 1 < count) length += (partial_.at(base.nodes[k + 1]) - partial_.at(base.nodes[k])).norm();
        }
        return base;
    }

    /// Find the nodes on which the rows end at one end of the run: existing nodes of the adjacent side, or
    /// new nodes if the rows end on a new side.
    bool make_end(const Front& front, const Run& run, const Base& base, int table, bool last, RunEnd& end)
    {
        const std::size_t n = front.nodes.size(), k = last ? base.nodes.size() - 1 : 0;
        const std::vector<double>& heights = heights_of(table);
        const Index corner = base.nodes[k];
        const Vec2 at = partial_.at(corner), normal = base.normal[k],
                   inward = last ? Vec2(-base.along[k]) : base.along[k];
        const double scale = scale_at(at);
        const std::size_t place = (run.first + (last ? run.sides : 0)) % n;
        const int beyond = front.table[last ? place : (place + n - 1) % n];
        const RowTurn turn = turn_at(front, place);
        if (turn == RowTurn::smooth && beyond >= 0 && beyond != table)
            return refuse(RowsFinding::Why::unlike, corner, table, heights.front(), 0);
        end.own = turn != RowTurn::inner;
        // If the adjacent side has rows too, its rows will continue along the new side. The new side
        // therefore extends the line of the adjacent side.
        Vec2 way = normal;
        if (turn == RowTurn::outer && beyond >= 0) {
            const Vec2 line = (at - partial_.at(front.nodes[(place + (last ? 1 : n - 1)) % n])).normalized();
            // Otherwise the new side is perpendicular to the run, because quads in a sharper corner are poor.
            if (line.dot(normal) >= kPoorQuad) way = line;
        }
        for (std::size_t r = 0; r < heights.size(); ++r) {
            const double height = heights[r] * scale;
            if (end.own) {
                const Vec2 off = way * (height / way.dot(normal));
                end.nodes.push_back(add(at + off, corner));
                end.lean.push_back(off.dot(inward));
                end.rise.push_back(0);
                continue;
            }
            if (r + 1 + base.nodes.size() >= n)
                return refuse(RowsFinding::Why::off_height, corner, table, heights[r], 0);
            const Index node = front.nodes[(place + (last ? r + 1 : n - r - 1)) % n];
            const Vec2 off = partial_.at(node) - at;
            const double rise = off.dot(normal) - height;
            if (rise > height || -rise > height / 2)
                return refuse(RowsFinding::Why::off_height, corner, table, heights[r],
                              off.dot(normal) / scale);
            end.nodes.push_back(node);
            end.lean.push_back(off.dot(inward));
            end.rise.push_back(rise);
        }
        if (!end.own && beyond >= 0) {
            const std::size_t rows = std::min(heights_of(beyond).size(), base.at.size() - 1);
            end.block = last ? base.at.back() - base.at[base.at.size() - 1 - rows] : base.at[rows];
        }
        return true;
    }

    Index add(const Vec2& p, Index foot)
    {
        foot_.push_back(foot_of(foot));
        return partial_.add(p);
    }

    /// The share of an end's offset (`lean`) that applies to a node at a distance from this end. Within the
    /// block it is 1. Beyond the block it decreases so slowly that the nodes keep their order.
    static double share_of(const RunEnd& end, double distance, double length)
    {
        // The share decreases to 0 over this multiple of the largest offset. Above 1, nodes keep their order;
        // the value was not measured.
        constexpr double kSlowly = 3;
        double most = 0;
        for (const std::vector<double>* off : {&end.lean, &end.rise})
            for (const double x : *off) most = std::max(most, std::abs(x));
        if (distance <= end.block) return 1;
        const double over = std::max(length - 2 * end.block, 0.0);
        const double reach = std::min(kSlowly * most, over);
        return reach > 0 ? std::max(0.0, 1 - (distance - end.block) / reach) : 0;
    }

    bool lay_run(Front& front, const Run& run)
    {
        const int table = front.table[run.first];
        const std::vector<double>& heights = heights_of(table);
        const std::size_t rows = heights.size();
        const Base base = base_of(front, run);
        RunEnd start, end;
        if (!run.closed && (!make_end(front, run, base, table, false, start) ||
                            !make_end(front, run, base, table, true, end)))
            return false;
        std::vector<std::vector<Index>> level{base.nodes};
        for (std::size_t r = 0; r < rows; ++r) {
            std::vector<Index>& row = level.emplace_back();
            for (std::size_t k = 0; k < base.nodes.size(); ++k) {
                if (!run.closed && k == 0) {
                    row.push_back(start.nodes[r]);
                    continue;
                }
                if (!run.closed && k + 1 == base.nodes.size()) {
                    row.push_back(end.nodes[r]);
                    continue;
                }
                const Vec2& foot = partial_.at(base.nodes[k]);
                Vec2 p = foot + base.normal[k] * (heights[r] * scale_at(foot));
                if (!run.closed) {
                    const double length = base.at.back(), here = base.at[k];
                    const double low = share_of(start, here, length),
                                 high = share_of(end, length - here, length);
                    p += base.along[k] * (start.lean[r] * low - end.lean[r] * high) +
                         base.normal[k] * (start.rise[r] * low + end.rise[r] * high);
                }
                row.push_back(add(p, base.nodes[k]));
            }
        }
        for (std::size_t r = 0; r < rows; ++r) {
            const std::size_t count = base.nodes.size();
            for (std::size_t k = 0; k < run.sides; ++k) {
                const std::size_t next = (k + 1) % count;
                const Quad quad{level[r][k], level[r][next], level[r + 1][next], level[r + 1][k]};
                if (!(least_sine(partial_, quad) > kFoldedQuad))
                    return refuse(RowsFinding::Why::sharp_bend, base.nodes[k], table, heights[r],
                                  r > 0 ? heights[r - 1] : 0);
                partial_.quads.push_back(quad);
            }
        }
        replace(front, run, level, start, end);
        return true;
    }

    /// Mark a boundary node at which rows end on a new side, formed by their end nodes (`RunEnd::own`). These
    /// rows use part of the node's angle, so the angle that is left, instead of the given turn, decides how
    /// the front turns there.
    void mark_cut(Index node)
    {
        if (partial_.is_fixed(node)) is_cut_[index(node)] = true;
    }

    /// Mark the boundary node between finished rows and the adjacent side. It is now an inner corner, and the
    /// rows of the adjacent side will end on the finished rows.
    void mark_inner(Index node)
    {
        if (partial_.is_fixed(node)) turn_[index(node)] = RowTurn::inner;
    }

    /// Replace the run in the front by the inner side of its rows.
    void replace(Front& front, const Run& run, const std::vector<std::vector<Index>>& level,
                 const RunEnd& start, const RunEnd& end)
    {
        Front next;
        const std::vector<Index>& top = level.back();
        if (run.closed) {
            next.nodes = top;
            next.table.assign(top.size(), -1);
            front = std::move(next);
            return;
        }
        const std::size_t rows = level.size() - 1, n = front.nodes.size();
        const std::size_t after = run.first + run.sides; // position of the last node
        const int before_table = front.table[(run.first + n - 1) % n], after_table = front.table[after % n];
        // Keep the rest of the front. It leads from the last node of the run, or from the node of the
        // adjacent side on which the last row ends, around to the first node of the run.
        std::size_t from = after, left = n - run.sides;
        if (end.own) {
            // The ends of these rows form a new side, along which the rows of the adjacent side continue.
            for (std::size_t r = rows; r > 0; --r) {
                next.nodes.push_back(level[r].back());
                next.table.push_back(after_table);
            }
            mark_cut(front.nodes[after % n]);
        } else {
            from += rows;
            left -= rows;
            mark_inner(front.nodes[from % n]);
        }
        if (start.own) {
            mark_cut(front.nodes[run.first]);
        } else {
            left -= rows;
            mark_inner(front.nodes[(run.first + n - rows) % n]);
        }
        for (std::size_t k = 0; k <= left; ++k) {
            next.nodes.push_back(front.nodes[(from + k) % n]);
            next.table.push_back(k < left ? front.table[(from + k) % n] : -1);
        }
        if (start.own) {
            next.table.back() = before_table;
            for (std::size_t r = 1; r <= rows; ++r) {
                next.nodes.push_back(level[r].front());
                next.table.push_back(r < rows ? before_table : -1);
            }
        }
        for (std::size_t k = 1; k + 1 < top.size(); ++k) {
            next.nodes.push_back(top[k]);
            next.table.push_back(-1);
        }
        front = std::move(next);
    }

    const BoundaryRows& rows_;
    PartialMesh partial_;
    std::vector<Cycle> given_;
    std::vector<RowTurn> turn_;
    std::vector<bool> is_cut_; ///< for each boundary node, whether rows use part of its angle (`mark_cut()`)
    std::vector<Front> fronts_;
    std::vector<Index> foot_; ///< for each added node, the boundary node below it
    std::optional<RowsFinding> finding_;
};

} // namespace

RowsFilling fill_with_rows(const PlanarRegion& region, const BoundaryRows& rows, const PlanarQuadMesher& core,
                           const RunContext& context)
{
    check(region);
    RowLayer layer(region, rows);
    if (!layer.lay()) return {{}, layer.finding()};
    const auto [inside, own] = layer.core(region.size);
    if (!attempt<InvalidInput>(
            [&] { check(inside); })) // rows that meet the opposite boundary leave no region
        return {{}, layer.least_room()};
    const PlanarQuads filling = core(inside, context);
    PartialMesh& laid = layer.partial();
    RowsFilling result;
    result.mesh = {std::move(laid.points), std::move(laid.quads), filling.how + " inside rows"};
    add_filling(result.mesh, own, filling);
    return result;
}

} // namespace lacuna::quads
