// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/moved_end.h>

#include <lacuna/closure/detail/climber.h>
#include <lacuna/closure/detail/close_trial.h>
#include <lacuna/closure/detail/end_holes.h>
#include <lacuna/closure/detail/guesses.h>
#include <lacuna/closure/detail/void_entities.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/shared/affine.h>
#include <lacuna/geometry/shared/minimal_frame.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/geometry/shared/segment.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/face_plane.h>
#include <lacuna/topology/shared/use_places.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <ranges>
#include <set>
#include <span>

namespace lacuna::closure {

using namespace topology;

namespace {

/// A part of an end's rim between two vertices from which wall edges lead to the other end. Either all of its
/// edges have walls, or none has.
struct Stretch {
    std::vector<EdgeUse> foot; ///< edges on the end's rim, as the end uses them
    std::vector<EdgeUse> top;  ///< edges at the other end of the walls, as the walls use them, from the start
                               ///< of `foot` to its end; empty: there is no wall here
};

double off_chain(const Vec3& p, const std::vector<Vec3>& chain)
{
    double least = kInfinity;
    for (std::size_t i = 0; i + 1 < chain.size(); ++i)
        least = std::min(least, geometry::distance_to_segment(p, chain[i], chain[i + 1]));
    return least;
}

/// The flat faces beside which some faces are given and others are missing, in the order of the model. Of
/// more than `kMostTrials` such faces, those with the most adjacent faces are kept.
std::vector<FaceId> possible_ends(const Model& model)
{
    std::vector<std::pair<std::size_t, FaceId>> found;
    for (const FaceId face : all_faces(model)) {
        const bool bare = std::ranges::any_of(uses_of(model[face]), [&](const EdgeUse& use) {
            return model.uses_of_edge(use.edge).size() == 1;
        });
        const std::size_t beside = faces_beside(model, face).size();
        if (bare && beside > 0 && plane_of(model, face)) found.emplace_back(beside, face);
    }
    std::ranges::stable_sort(found, std::greater{}, &std::pair<std::size_t, FaceId>::first);
    std::vector<FaceId> ends;
    for (std::size_t i = 0; i < std::min(kMostTrials, found.size()); ++i) ends.push_back(found[i].second);
    std::ranges::sort(ends);
    return ends;
}

/// Moves a given end to the missing end. A part of the missing end's rim is known: the tops of the given
/// walls.
class EndMover {
public:
    /// @pre  the volume's model is oriented, its source is the given end, and all other faces are walls
    explicit EndMover(OpenVolume volume)
        : volume_(std::move(volume)), end_(volume_.faces(Role::source)), climber_(volume_)
    {
    }
    EndMover(const EndMover&) = delete; // the climber references the volume
    EndMover& operator=(const EndMover&) = delete;

    [[nodiscard]] bool can_move()
    {
        const Model& model = volume_.model;
        for (const EdgeUse& use : rim_uses(model, end_)) on_end_.insert(use_from(model, use));
        for (const Rim& rim : rims(model, volume_.faces(Role::wall)))
            if (!index_rim(rim)) return false;
        for (const Rim& rim : rims(model, end_))
            if (!add_rim(rim)) return false;
        return accounts_for_all() && fit();
    }

    /// Add the moved end to the volume.
    void move(const RunContext& context)
    {
        std::vector<Loop> loops;
        for (const std::vector<Stretch>& rim : rims_) {
            Loop& loop = loops.emplace_back();
            for (const Stretch& stretch : rim | std::views::reverse) {
                if (stretch.top.empty()) {
                    for (const EdgeUse& use : stretch.foot | std::views::reverse)
                        loop.uses.push_back(moved(use));
                    continue;
                }
                for (const EdgeUse& use : stretch.top | std::views::reverse)
                    loop.uses.push_back({use.edge, !use.reversed});
            }
        }
        VoidFilling filling = fill(volume_, loops, nullptr, {"the moved end"}, context);
        made_ = add_void_face(volume_, std::move(filling), Role::target);
    }

    /// Points on the rim of the missing end and at mid-height of the missing walls.
    [[nodiscard]] std::vector<Vec3> missing_places() const
    {
        std::vector<Vec3> result;
        for (const Stretch& stretch : rims_ | std::views::join) {
            if (!stretch.top.empty()) continue;
            for (const EdgeUse& use : stretch.foot) {
                for (const Vec3& p : geometry::even_places(use_places(volume_.model, use), kChords)) {
                    result.push_back(motion_(p));
                    result.push_back((p + motion_(p)) / 2);
                }
            }
        }
        return result;
    }

    [[nodiscard]] const OpenVolume& volume() const { return volume_; }
    [[nodiscard]] FaceId made() const { return made_; }
    [[nodiscard]] bool has_bare_rim() const
    {
        return std::ranges::any_of(rims_, [](const std::vector<Stretch>& rim) {
            return std::ranges::all_of(rim, [](const Stretch& stretch) { return stretch.top.empty(); });
        });
    }
    [[nodiscard]] const std::vector<EdgeId>& made_edges() const { return made_edges_; }

private:
    [[nodiscard]] bool is_free(EdgeId edge) const { return volume_.model.uses_of_edge(edge).size() == 1; }

    /// Index the free edges of the walls, as used by the rim, by their start vertex. False if two of them
    /// start at the same vertex.
    bool index_rim(const Rim& rim)
    {
        const Model& model = volume_.model;
        const bool free = std::ranges::all_of(rim.uses, [&](const EdgeUse& u) { return is_free(u.edge); });
        for (const EdgeUse& use : rim.uses) {
            if (!is_free(use.edge)) continue;
            if (!leaving_.emplace(use_from(model, use), use).second) return false;
            ++free_count_;
        }
        if (free) free_rims_.push_back(rim);
        return true;
    }

    /// The chain of free wall edges from one vertex to another. Empty if there is none, or if it passes
    /// through a vertex of the given end.
    [[nodiscard]] std::vector<EdgeUse> top_between(VertexId from, VertexId to) const
    {
        std::vector<EdgeUse> top;
        for (VertexId at = from; top.empty() || at != to;) {
            const auto next = leaving_.find(at);
            if (next == leaving_.end() || top.size() > leaving_.size()) return {};
            top.push_back(next->second);
            at = use_to(volume_.model, next->second);
            if (on_end_.contains(at)) return {};
        }
        return top;
    }

    bool add_rim(const Rim& rim)
    {
        const Model& model = volume_.model;
        const std::size_t n = rim.uses.size();
        const auto bare = [&](std::size_t i) { return is_free(rim.uses[i % n].edge); };
        std::vector<std::optional<VertexId>> top(n);
        std::size_t start = n;
        bool any_walled = false;
        for (std::size_t i = 0; i < n; ++i) {
            any_walled = any_walled || !bare(i);
            if (bare(i) && bare(i + n - 1)) continue;
            const VertexId at = use_from(model, rim.uses[i]);
            const std::vector<EdgeUse> way = climber_.climb(at);
            if (bare(i) != bare(i + n - 1) && way.empty()) return false;
            if (way.empty()) continue;
            top[i] = use_to(model, way.back());
            if (on_end_.contains(*top[i]) || !leaving_.contains(*top[i])) return false;
            above_.emplace(at, *top[i]);
            for (const EdgeUse& use : way)
                if (is_free(use.edge)) accounted_.insert(use.edge);
            start = std::min(start, i);
        }
        std::vector<Stretch>& stretches = rims_.emplace_back();
        if (!any_walled) {
            stretches.push_back({rim.uses, {}});
            return true;
        }
        if (start == n) return add_tube(rim);
        for (std::size_t i = start; i < start + n;) {
            Stretch stretch;
            const std::size_t first = i;
            do stretch.foot.push_back(rim.uses[i++ % n]);
            while (i < start + n && !top[i % n]);
            if (!bare(first)) {
                stretch.top = top_between(*top[first % n], *top[i % n]);
                if (stretch.top.empty()) return false;
                add_samples(stretch);
            }
            stretches.push_back(std::move(stretch));
        }
        return true;
    }

    /// Add a rim whose walls form a ring without an edge from rim to rim. The top of these walls is the only
    /// free rim.
    bool add_tube(const Rim& rim)
    {
        const Model& model = volume_.model;
        // With several free rims, it is ambiguous which one is the top of the ring.
        if (free_rims_.size() != 1) return false;
        const std::vector<Vec3> low = use_places(model, rim.uses),
                                high = use_places(model, free_rims_[0].uses);
        rims_.back().push_back({rim.uses, free_rims_[0].uses});
        const Vec3 from = geometry::newell_vector(std::span(low).first(low.size() - 1)),
                   to = geometry::newell_vector(std::span(high).first(high.size() - 1));
        const std::vector<Vec3> feet = geometry::even_places(low, kChords);
        const Vec3 mean_low = geometry::mean_point(feet);
        const Vec3 mean_high = geometry::mean_point(geometry::even_places(high, kChords));
        const double scale = std::sqrt(to.norm() / from.norm());
        const Eigen::Matrix3d turn = geometry::least_turn(from, to);
        for (const Vec3& p : feet) {
            from_.push_back(p);
            to_.push_back(mean_high + scale * (turn * (p - mean_low)));
        }
        return true;
    }

    void add_samples(const Stretch& stretch)
    {
        std::ranges::copy(sampled(stretch.foot), std::back_inserter(from_));
        std::ranges::copy(sampled(stretch.top), std::back_inserter(to_));
    }

    [[nodiscard]] std::vector<Vec3> sampled(const std::vector<EdgeUse>& uses) const
    {
        return geometry::even_places(use_places(volume_.model, uses), kChords);
    }

    /// Whether every free edge of the walls belongs to the top of a wall or to a chain that leads up to a
    /// top.
    [[nodiscard]] bool accounts_for_all() const
    {
        std::set<EdgeId> known = accounted_;
        for (const Stretch& stretch : rims_ | std::views::join)
            for (const EdgeUse& use : stretch.top) known.insert(use.edge);
        return known.size() == free_count_;
    }

    /// Find the motion of the end, see `move_ends()`. False if there is none.
    bool fit()
    {
        if (from_.empty()) return false;
        double width = 0;
        for (const Vec3& p : from_) width = std::max(width, (p - from_.front()).norm());
        const auto fits = [&] {
            for (const Stretch& stretch : rims_ | std::views::join) {
                if (stretch.top.empty()) continue;
                const std::vector<Vec3> top = use_places(volume_.model, stretch.top);
                for (const Vec3& p : sampled(stretch.foot))
                    if (off_chain(motion_(p), top) > kAlikeSizes * width) return false;
            }
            for (const auto& [foot, top] : above_) {
                const Vec3 p = motion_(volume_.model.at(volume_.model[foot].point));
                if ((p - volume_.model.at(volume_.model[top].point)).norm() > kAlikeSizes * width)
                    return false;
            }
            return moves_all(width);
        };
        motion_ = [way = Vec3(geometry::mean_point(to_) - geometry::mean_point(from_))](const Vec3& p) {
            return Vec3(p + way);
        };
        if (on_line(width)) return false;
        if (fits()) return true;
        motion_ = geometry::fit_rigid(from_, to_, false);
        if (fits()) return true;
        if (!tells_scale()) return false;
        motion_ = geometry::fit_rigid(from_, to_, true);
        if (fits()) return true;
        motion_ = geometry::fit_affine(from_, to_);
        if (above_.size() > 3 && fits()) return true; // an affine map fits any three corners
        return goes_straight(width) && moves_all(width);
    }

    /// Whether straight lines between the tops of the given walls can complete the rim of the missing end.
    /// Conditions:
    /// - each side of the given end without a wall is straight;
    /// - no rim lacks all its walls;
    /// - a wall with a straight foot has a straight top;
    /// - all tops lie in one plane.
    [[nodiscard]] bool goes_straight(double width) const
    {
        const auto straight = [&](const std::vector<EdgeUse>& uses) {
            const std::vector<Vec3> chain = use_places(volume_.model, uses);
            return std::ranges::all_of(chain, [&](const Vec3& p) {
                return geometry::distance_to_segment(p, chain.front(), chain.back()) <= kAlikeSizes * width;
            });
        };
        std::vector<std::vector<Vec3>> tops;
        for (const std::vector<Stretch>& rim : rims_) {
            tops.emplace_back();
            for (const Stretch& stretch : rim) {
                if (stretch.top.empty() ? rim.size() == 1 || !straight(stretch.foot)
                                        : straight(stretch.foot) && !straight(stretch.top))
                    return false;
                if (stretch.top.empty()) continue;
                const std::vector<Vec3> top = use_places(volume_.model, stretch.top);
                tops.back().insert(tops.back().end(), top.begin(), top.end());
            }
        }
        const geometry::Plane plane = geometry::newell_plane(tops);
        return std::ranges::all_of(tops, [&](const std::vector<Vec3>& top) {
            return std::ranges::all_of(top, [&](const Vec3& p) {
                return std::abs(geometry::height(plane, p)) <= kAlikeSizes * width;
            });
        });
    }

    /// Whether the motion moves every point of the rim that has no wall. Where a point stays in place, both
    /// ends would coincide.
    [[nodiscard]] bool moves_all(double width) const
    {
        return std::ranges::all_of(rims_ | std::views::join, [&](const Stretch& stretch) {
            return !stretch.top.empty() || std::ranges::all_of(sampled(stretch.foot), [&](const Vec3& p) {
                return (motion_(p) - p).norm() > kAlikeSizes * width;
            });
        });
    }

    /// Whether enough of the end's outline (its longest loop) has walls to determine the scale of the moved
    /// end.
    [[nodiscard]] bool tells_scale() const
    {
        // Share of the outline's length that must have walls: two walls of a pentagon are enough, one wall of
        // a square is not.
        constexpr double kTold = 1.0 / 3;
        double longest = 0, told = 0;
        for (const std::vector<Stretch>& rim : rims_) {
            double walled = 0, whole = 0;
            for (const Stretch& stretch : rim) {
                const double length = geometry::arc_lengths(use_places(volume_.model, stretch.foot)).back();
                whole += length;
                if (!stretch.top.empty()) walled += length;
            }
            if (whole <= longest) continue;
            longest = whole;
            told = walled / whole;
        }
        return told >= kTold;
    }

    /// Whether the feet of all walls lie on one line. The rotation about that line would then be
    /// undetermined.
    [[nodiscard]] bool on_line(double width) const
    {
        Vec3 along = Vec3::Zero();
        for (const Vec3& p : from_)
            if ((p - from_.front()).norm() > along.norm()) along = p - from_.front();
        return std::ranges::all_of(from_, [&](const Vec3& p) {
            return (p - from_.front()).cross(along.stableNormalized()).norm() <= kAlikeSizes * width;
        });
    }

    VertexId moved(VertexId foot)
    {
        const auto known = above_.find(foot);
        if (known != above_.end()) return known->second;
        ModelBuilder model(std::move(volume_.model));
        model.points.push_back(motion_(model.at(model[foot].point)));
        const VertexId made = model.add_void_vertex(static_cast<Index>(model.points.size()) - 1);
        volume_.model = std::move(model).finish();
        above_.emplace(foot, made);
        return made;
    }

    /// Add the moved copy of an edge. @return the use by the moved end.
    EdgeUse moved(EdgeUse foot)
    {
        const VertexId from = moved(use_from(volume_.model, foot)), to = moved(use_to(volume_.model, foot));
        Model& model = volume_.model;
        const std::vector<Vec3> low = use_places(model, foot);
        const std::vector<double> arc = geometry::arc_lengths(low);
        const Vec3 off_from = model.at(model[from].point) - motion_(low.front());
        const Vec3 off_to = model.at(model[to].point) - motion_(low.back());
        std::vector<Vec3> between;
        for (std::size_t i = 1; i + 1 < low.size(); ++i) {
            const double f = arc[i] / arc.back();
            between.push_back(motion_(low[i]) + (1 - f) * off_from + f * off_to);
        }
        made_edges_.push_back(add_void_edge_through(model, from, to, between));
        return {made_edges_.back(), true};
    }

    OpenVolume volume_;
    std::vector<FaceId> end_;
    FaceId made_;
    Climber climber_;
    std::set<VertexId> on_end_;
    std::map<VertexId, EdgeUse> leaving_; ///< free uses of walls, by start vertex
    std::vector<Rim> free_rims_;          ///< free rims of walls
    std::size_t free_count_ = 0;          ///< number of free edges of walls
    std::map<VertexId, VertexId> above_;  ///< by vertex of the given end: the corresponding vertex of the
                                          ///< moved end
    std::set<EdgeId> accounted_;          ///< free wall edges on chains that lead up to the vertices of
                                          ///< `above_`
    std::vector<std::vector<Stretch>> rims_;
    std::vector<Vec3> from_, to_; ///< points on feet and on tops
    std::function<Vec3(const Vec3&)> motion_;
    std::vector<EdgeId> made_edges_;
};

using Known = std::function<bool(const std::vector<Vec3>&)>;

/// Close a volume by moving its source along the given walls. Empty if that is impossible.
/// @param known  as for `move_ends()`.
/// @param stop  output: whether `known` returned true; then nothing is closed.
std::optional<MovedEnd> move_end(const OpenVolume& open, const Known& known, bool& stop,
                                 const RunContext& context)
{
    const FaceId end = open.faces(Role::source).front();
    EndMover mover(open);
    if (!mover.can_move()) return std::nullopt;
    stop = known(mover.missing_places());
    if (stop) return std::nullopt;
    return unless_refused([&] {
        mover.move(context);
        const matching::Match match = matching::match(mover.volume(), {}, context);
        MovedEnd result{close_trial(mover.volume(), match, context), end};
        result.closure.void_faces.insert(result.closure.void_faces.begin(), mover.made());
        result.closure.void_edges.insert(result.closure.void_edges.begin(), mover.made_edges().begin(),
                                         mover.made_edges().end());
        result.enclosed = enclosed_volume(result.volume);
        result.through = mover.has_bare_rim();
        const std::vector<EndHole> holes = holes_without_walls(open);
        result.holes = !holes.empty();
        const auto without = std::ranges::count_if(shares_without_walls(open),
                                                   [](double share) { return share > 0; });
        if (without > std::ssize(holes))
            assume_walls(result.volume,
                         {"closure.end_moved",
                          "the target and walls next to it are missing; the target is assumed to have the "
                          "shape of the source {}, moved onto the tops of the given walls",
                          entity_of(open.model, end)},
                         result.closure);
        return result;
    });
}

} // namespace

std::optional<MovedEnd> move_source(const OpenVolume& open, const RunContext& context)
{
    const Model& model = open.model;
    const std::vector<FaceId> source = open.faces(Role::source);
    const auto plane = source.empty() ? std::nullopt : plane_of(model, source.front());
    if (!plane || connected_parts(model, all_faces(model)).size() != 1) return std::nullopt;
    if (!std::ranges::all_of(source, [&](FaceId face) { return lies_in_plane(model, face, *plane); }))
        return std::nullopt;
    bool stop = false;
    return move_end(
        open, [](const std::vector<Vec3>&) { return false; }, stop, context);
}

std::vector<MovedEnd> move_ends(const Model& model, const std::vector<FaceId>& faces, const Known& known,
                                const RunContext& context)
{
    OpenVolume open;
    open.model = extract(model, faces);
    orient_consistently(open.model);
    std::vector<MovedEnd> found;
    if (connected_parts(open.model, all_faces(open.model)).size() != 1) return found;
    for (const FaceId end : possible_ends(open.model)) {
        check_cancelled(context);
        open.role.assign(faces.size(), Role::wall);
        open.role[end.index()] = Role::source;
        bool stop = false;
        auto moved = move_end(open, known, stop, context);
        if (stop) return {};
        if (!moved) continue;
        moved->from = faces[end.index()];
        found.push_back(std::move(*moved));
    }
    return found;
}

} // namespace lacuna::closure
