// SPDX-License-Identifier: MIT
#include <lacuna/closure/shared/cut.h>

#include <lacuna/closure/close.h>
#include <lacuna/closure/detail/class_five.h>
#include <lacuna/closure/detail/flat_fill.h>
#include <lacuna/closure/detail/outline.h>
#include <lacuna/closure/detail/pieces.h>
#include <lacuna/closure/detail/void_entities.h>
#include <lacuna/closure/shared/straighten_lines.h>
#include <lacuna/core/error.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/edge_key.h>
#include <lacuna/core/shared/number_text.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/geometry/shared/plane.h>
#include <lacuna/geometry/shared/point_tree.h>
#include <lacuna/geometry/shared/predicates.h>
#include <lacuna/geometry/shared/signed_area.h>
#include <lacuna/matching/match.h>
#include <lacuna/topology/shared/face_facts.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/face_plane.h>
#include <lacuna/topology/shared/names_of.h>
#include <lacuna/topology/shared/section.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <numeric>
#include <optional>
#include <unordered_map>

namespace lacuna::closure {

using namespace topology;

namespace {

/// Largest number of open section lines for which all ways to join them are tried (7! = 5,040); more lines
/// are not joined.
constexpr std::size_t kAllOrders = 7;

class PlaneCutter {
public:
    PlaneCutter(const OpenVolume& volume, const geometry::Plane& plane, const RunContext& context)
        : context_(context),
          plane_(plane),
          tolerance_(volume.model.tolerance),
          parted_{volume},
          model_(parted_.volume.model),
          walks_(section_walks(model_, all_faces(model_), plane_, tolerance_))
    {
    }

    [[nodiscard]] bool crosses_gaps() const { return !std::ranges::all_of(walks_, &SectionWalk::closed); }

    /// A region of the plane by its loops, in plane coordinates.
    using Region = std::vector<std::vector<Vec2>>;

    /// @param suits  whether to cut in a region of the plane inside the volume; empty: cut in all regions.
    /// @param least  the least distance between the cut and edges beside it; set if a search proposed the
    ///         cut. If it is set, the inner points of cut lines across flat faces are removed, see
    ///         `straighten_lines()`.
    std::vector<StepPiece> run(const std::function<bool(const Region&)>& suits, std::optional<double> least)
    {
        orient_walks();
        if (suits) choose(suits);
        if (least) refuse_thin(*least);
        const WalkImprint made = imprint(parted_.volume, walks_, plane_, context_);
        if (least) straighten_flat_faces(made);
        parted_.plane = plane_;
        add_partitions(made);
        if (parted_.partitions.empty()) refuse_miss();
        model_ = with_loops(std::move(model_));
        std::vector<StepPiece> pieces = pieces_of(parted_, {"the plane"}, context_);
        if (least) refuse_slivers(pieces, *least);
        return pieces;
    }

private:
    [[nodiscard]] std::vector<Vec2> outline(const SectionWalk& walk) const
    {
        std::vector<Vec2> line;
        for (const SectionPlace& place : walk.places)
            line.push_back(geometry::to_plane(plane_, place_at(model_, place, plane_)));
        return line;
    }

    void orient_walks()
    {
        double most = 0;
        for (const SectionWalk& walk : walks_) {
            const double area = geometry::signed_area(outline(walk));
            if (std::abs(area) > std::abs(most)) most = area;
        }
        // The largest walk is clockwise if the skin faces outward. If it is counterclockwise, flip the skin:
        // otherwise facets in the plane would be assigned to the wrong side.
        if (most > 0) {
            flip_faces(model_, all_faces(model_));
            walks_ = section_walks(model_, all_faces(model_), plane_, tolerance_);
        }
        if (walks_.empty()) refuse_miss();
    }

    [[noreturn]] void refuse_miss() const
    {
        double least = kInfinity, most = -least;
        std::vector<FaceId> touched;
        for (const FaceId face : all_faces(model_)) {
            bool touches = false;
            for (const Index p : corners_of(model_[face])) {
                const double h = geometry::height(plane_, model_.at(p));
                least = std::min(least, h);
                most = std::max(most, h);
                touches = touches || std::abs(h) <= tolerance_;
            }
            if (touches) touched.push_back(face);
        }
        if (!touched.empty())
            throw NotSweepable(Message("closure.cut_misses",
                                       "the plane only touches {} and cuts nothing: along its normal, "
                                       "measured from its point, the volume reaches from {:.4g} to {:.4g}",
                                       entities_of(model_, touched), found(least), found(most))
                                   .remedy("move its point along the normal to a place between the two"));
        if (least < 0 && most > 0)
            throw NotSweepable(
                Message("closure.cut_misses", "the plane passes between the faces without crossing any")
                    .remedy("close the volume first: volume:cut() then also cuts its void faces"));
        throw NotSweepable(Message("closure.cut_misses",
                                   "the plane misses the volume, which reaches from {:.4g} to {:.4g} along "
                                   "the normal, measured from the plane's point",
                                   found(least), found(most))
                               .remedy("move its point along the normal to a place between the two"));
    }

    /// Keep the section lines of the regions that `suits` accepts.
    void choose(const std::function<bool(const Region&)>& suits)
    {
        std::vector<std::vector<Vec2>> loops;
        for (const SectionWalk& walk : walks_) loops.push_back(outline(walk));
        std::vector<SectionWalk> kept;
        for (const std::vector<std::size_t>& region : regions_of(loops)) {
            Region own;
            for (const std::size_t l : region) own.push_back(loops[l]);
            if (!suits(own)) continue;
            for (const std::size_t l : region) kept.push_back(walks_[l]);
        }
        if (kept.empty())
            throw NotSweepable(
                Message("closure.cut_misses",
                        "the face lies outside the volume, and only the rest of its plane cuts the volume")
                    .remedy("cut by the plane instead"));
        walks_ = std::move(kept);
    }

    /// Refuse a cut that leaves a thin strip beside an edge.
    void refuse_thin(double least) const
    {
        // By vertex: whether it is the end of an edge that meets the plane.
        std::vector<char> joined(model_.vertices.size(), 0);
        // Edges near the plane, each with the midpoint of the segment that is nearest to the plane.
        std::vector<std::pair<EdgeId, Vec3>> near;
        for (std::size_t e = 0; e < model_.edges.size(); ++e) {
            const Edge& edge = model_.edges[e];
            double low = kInfinity, high = -kInfinity, next = least;
            Vec3 place;
            for (std::size_t i = 0; i + 1 < edge.points.size(); ++i) {
                const Vec3 &a = model_.at(edge.points[i]), &b = model_.at(edge.points[i + 1]);
                const double from = geometry::height(plane_, a), to = geometry::height(plane_, b);
                low = std::min({low, from, to});
                high = std::max({high, from, to});
                if (std::abs(from + to) / 2 >= next) continue;
                next = std::abs(from + to) / 2;
                place = (a + b) / 2;
            }
            if (low <= tolerance_ && high >= -tolerance_)
                joined[edge.from.index()] = joined[edge.to.index()] = 1;
            else if (next < least)
                near.emplace_back(e, place);
        }
        if (near.empty()) return;
        std::vector<std::vector<Vec2>> loops;
        for (const SectionWalk& walk : walks_) loops.push_back(outline(walk));
        for (const auto& [edge, place] : near) {
            if (joined[model_[edge].from.index()] != 0 || joined[model_[edge].to.index()] != 0) continue;
            const Vec2 foot = geometry::to_plane(plane_, place);
            const auto is_round = [&](const std::vector<Vec2>& loop) {
                return geometry::lies_inside(loop, foot);
            };
            if (std::ranges::count_if(loops, is_round) % 2 != 0)
                throw NotSweepable(
                    Message("closure.cut_thin", "the plane passes {} at a distance of only {:.2g}",
                            entity_of(model_, edge), found(std::abs(geometry::height(plane_, place))))
                        .remedy("move the plane away from this edge"));
        }
    }

    /// Refuse a cut that cuts off a piece thinner than `least`.
    void refuse_slivers(const std::vector<StepPiece>& pieces, double least) const
    {
        for (const StepPiece& piece : pieces) {
            const Model& model = piece.volume.model;
            double most = 0;
            for (const FaceId face : all_faces(model))
                for (const Index p : corners_of(model[face]))
                    most = std::max(most, std::abs(geometry::height(plane_, model.at(p))));
            if (most < least)
                throw NotSweepable(Message("closure.cut_thin",
                                           "the plane cuts off a piece that is only {:.2g} thick",
                                           found(most))
                                       .remedy("move the plane along its normal, into the volume"));
        }
    }

    /// Remove the inner points of cut lines across flat faces.
    void straighten_flat_faces(const WalkImprint& made)
    {
        std::map<FaceId, std::vector<FaceId>> parts;
        for (std::size_t f = 0; f < made.parent.size(); ++f) parts[made.parent[f]].emplace_back(f);
        for (const auto& [face, own] : parts) {
            const auto flat = own.size() > 1 ? plane_of(model_, face) : std::nullopt;
            if (!flat || !model_[face].given_quads.empty()) continue;
            const auto is_between = [&](const EdgeUse& use) {
                const std::span<const FaceUse> users = model_.uses_of_edge(use.edge);
                return users.size() == 2 && std::ranges::all_of(users, [&](const FaceUse& user) {
                           return made.parent[user.face.index()] == face;
                       });
            };
            std::vector<EdgeUse> line;
            for (const std::vector<EdgeUse>& all : made.lines)
                std::ranges::copy_if(all, std::back_inserter(line), is_between);
            if (!line.empty()) straighten_lines(model_, own, *flat, {line}, context_);
        }
    }

    [[nodiscard]] std::vector<Vec2> flat_line(const std::vector<EdgeUse>& uses) const
    {
        return flat_places(plane_, use_places(model_, uses));
    }

    /// Join open section lines to loops by straight connections, so that no lines cross and the total length
    /// of the connections is least.
    /// @return  for each line: the next line of its loop. Empty if all ways to join the lines cross, or if
    ///         there are more than `kAllOrders` lines.
    [[nodiscard]] std::vector<std::size_t> join(const std::vector<std::vector<Vec2>>& lines) const
    {
        std::vector<std::size_t> order(lines.size()), best;
        std::iota(order.begin(), order.end(), std::size_t{0});
        if (lines.size() > kAllOrders) return best;
        double least = kInfinity;
        do {
            double length = 0;
            for (std::size_t i = 0; i < lines.size(); ++i)
                length += (lines[order[i]].front() - lines[i].back()).norm();
            if (length < least && is_clean(lines, order)) {
                least = length;
                best = order;
            }
        } while (std::next_permutation(order.begin(), order.end()));
        return best;
    }

    [[nodiscard]] bool is_clean(const std::vector<std::vector<Vec2>>& lines,
                                const std::vector<std::size_t>& follower) const
    {
        Outline outline;
        std::vector<char> seen(lines.size(), 0);
        for (std::size_t i = 0; i < lines.size(); ++i) {
            if (seen[i] != 0) continue;
            std::vector<Vec2> loop;
            for (std::size_t k = i; seen[k] == 0; k = follower[k]) {
                seen[k] = 1;
                for (const Vec2& p : lines[k])
                    if (loop.empty() || (p - loop.back()).norm() > tolerance_) loop.push_back(p);
            }
            if ((loop.front() - loop.back()).norm() <= tolerance_) loop.pop_back();
            double length = 0;
            for (std::size_t k = 0; k < loop.size(); ++k)
                length += (loop[(k + 1) % loop.size()] - loop[k]).norm();
            if (loop.size() < 3 || std::abs(geometry::signed_area(loop)) < kFileAccuracy * length * length)
                return false;
            outline.add_loop(loop);
        }
        return !geometry::find_crossing(outline.flat, outline.loops);
    }

    void add_partitions(const WalkImprint& made)
    {
        std::vector<std::vector<EdgeUse>> loops, skin; // `skin`: the loops without the new edges across gaps
        std::vector<std::vector<EdgeUse>> open;
        for (std::size_t w = 0; w < walks_.size(); ++w) {
            if (walks_[w].closed) {
                loops.push_back(made.lines[w]);
                skin.push_back(made.lines[w]);
            } else {
                open.push_back(made.lines[w]);
            }
        }
        if (!open.empty()) {
            std::vector<std::vector<Vec2>> lines;
            for (const std::vector<EdgeUse>& line : open) lines.push_back(flat_line(line));
            const std::vector<std::size_t> follower = join(lines);
            if (follower.empty())
                throw NotSweepable(Message("closure.cut_gaps",
                                           "the plane crosses gaps between the walls, and no straight lines "
                                           "across these gaps close the section")
                                       .remedy("close the volume first: volume:cut() then also cuts its void "
                                               "faces"));
            std::vector<char> seen(open.size(), 0);
            for (std::size_t i = 0; i < open.size(); ++i) {
                if (seen[i] != 0) continue;
                std::vector<EdgeUse>&loop = loops.emplace_back(), &rim = skin.emplace_back();
                for (std::size_t k = i; seen[k] == 0; k = follower[k]) {
                    seen[k] = 1;
                    loop.insert(loop.end(), open[k].begin(), open[k].end());
                    rim.insert(rim.end(), open[k].begin(), open[k].end());
                    const VertexId from = use_to(model_, open[k].back()),
                                   to = use_from(model_, open[follower[k]].front());
                    if (from != to) loop.push_back({add_void_edge_through(model_, from, to), false});
                }
            }
        }
        std::vector<std::vector<Vec2>> flat;
        for (const std::vector<EdgeUse>& loop : loops) {
            flat.push_back(flat_line(loop));
            flat.back().pop_back();
        }
        for (const std::vector<std::size_t>& region : regions_of(flat)) {
            std::vector<std::vector<EdgeUse>> rings;
            Partition partition;
            for (const std::size_t l : region) {
                rings.push_back(loops[l]);
                partition.behind.insert(partition.behind.end(), skin[l].begin(), skin[l].end());
            }
            partition.face = add_partition(model_, rings, plane_, partition_name(model_), context_);
            parted_.partitions.push_back(std::move(partition));
            parted_.volume.role.push_back(Role::wall);
        }
    }

    const RunContext& context_;
    geometry::Plane plane_;
    double tolerance_;
    PartedVolume parted_;
    Model& model_;
    std::vector<SectionWalk> walks_;
};

/// A face of another model as a partition along edges of the volume.
class EdgePartition {
public:
    EdgePartition(const OpenVolume& volume, const Model& model, FaceId face)
        : volume_(volume), model_(model), face_(face), tolerance_(volume.model.tolerance)
    {
    }

    /// Whether the rim of the face runs along edges of the volume. If not, `off()` is the place where it
    /// leaves them.
    bool fits()
    {
        std::vector<Index> of_edges;
        const Model& whole = volume_.model;
        const Eigen::AlignedBox3d box = box_of(model_, face_);
        const auto is_near = [&](Index p) {
            return box.squaredExteriorDistance(whole.at(p)) <= tolerance_ * tolerance_;
        };
        for (const Edge& edge : whole.edges)
            std::ranges::copy_if(edge.points, std::back_inserter(of_edges), is_near);
        const geometry::FacetTree tree = geometry::point_tree(places_at(whole, of_edges));
        std::unordered_map<std::uint64_t, EdgeUse> use;
        for (std::size_t e = 0; e < whole.edges.size(); ++e) {
            const std::vector<Index>& points = whole.edges[e].points;
            for (std::size_t i = 0; i + 1 < points.size(); ++i) {
                if (!is_near(points[i])) continue;
                use.try_emplace(directed_key(points[i], points[i + 1]), EdgeUse{EdgeId(e), false});
                use.try_emplace(directed_key(points[i + 1], points[i]), EdgeUse{EdgeId(e), true});
            }
        }
        for (const Loop& loop : border_loops(model_, face_)) {
            for (const EdgeUse& own : loop.uses) {
                const std::vector<Index> points = use_points(model_, own);
                for (std::size_t i = 0; i < points.size(); ++i) {
                    const auto hit = tree.closest(model_.at(points[i]), tolerance_ * tolerance_);
                    off_ = model_.at(points[i]);
                    if (hit.triangle < 0) return false;
                    there_[points[i]] = of_edges[index(hit.triangle)];
                    if (i == 0) continue;
                    const auto found = use.find(directed_key(there_.at(points[i - 1]), there_.at(points[i])));
                    if (found == use.end()) return false;
                    const EdgeUse behind{found->second.edge, !found->second.reversed};
                    if (rim_.empty() || rim_.back() != behind) rim_.push_back(behind);
                }
            }
        }
        return true;
    }

    [[nodiscard]] const Vec3& off() const { return off_; }

    std::vector<StepPiece> run(const RunContext& context)
    {
        PartedVolume parted{volume_};
        ModelBuilder model(std::move(parted.volume.model));
        Face face = model_[face_];
        if (face.name.empty() && face.origin == Origin::made_void) face.name = partition_name(model);
        for (Index& p : face.triangles | std::views::join) p = point(p, model.points);
        for (Index& p : face.given_quads | std::views::join) p = point(p, model.points);
        parted.partitions.push_back({FaceId(model.faces.size()), rim_});
        parted.volume.role.push_back(Role::wall);
        model.faces.push_back(std::move(face));
        model.build_loops();
        parted.volume.model = std::move(model).finish();
        return pieces_of(parted, {"", {entity_of(model_, face_)}}, context);
    }

private:
    Index point(Index p, std::vector<Vec3>& points)
    {
        const auto [found, fresh] = there_.try_emplace(p, static_cast<Index>(points.size()));
        if (fresh) points.push_back(model_.at(p));
        return found->second;
    }

    const OpenVolume& volume_;
    const Model& model_;
    FaceId face_;
    double tolerance_;
    std::map<Index, Index> there_; ///< point of the volume for each point of the face
    std::vector<EdgeUse> rim_;
    Vec3 off_ = Vec3::Zero();
};

/// The closed volume; empty if it cannot be closed.
std::optional<OpenVolume> sealed(const OpenVolume& volume, const RunContext& context)
{
    if (classify(volume).value == VolumeClass::V && !no_tube(volume).empty()) {
        auto filled = fill_free_loops(volume.model, all_faces(volume.model), Missing::flat, context);
        if (!filled) return std::nullopt;
        return std::move(filled->volume);
    }
    return unless_refused([&] {
        matching::Match match;
        if (!volume.faces(Role::source).empty() && !volume.faces(Role::target).empty())
            match = matching::match(volume, {}, context);
        return close(volume, match, {}, context).volume;
    });
}

using Suits = std::function<bool(const std::vector<std::vector<Vec2>>&)>;

std::vector<StepPiece> cut_within(const OpenVolume& volume, const geometry::Plane& plane, const Suits& suits,
                                  const RunContext& context, std::optional<double> least = std::nullopt)
{
    PlaneCutter cutter(volume, plane, context);
    if (cutter.crosses_gaps()) {
        // Close the volume before it is cut, so that void faces of the pieces are parts of those of the
        // volume.
        if (const std::optional<OpenVolume> whole = sealed(volume, context))
            return PlaneCutter(*whole, plane, context).run(suits, least);
    }
    return cutter.run(suits, least);
}

/// Whether some facets lie in a region of the plane. The region is triangulated; the result is true if the
/// centre of a triangle lies on a facet.
bool contains_facets(const std::vector<std::vector<Vec2>>& region, const geometry::Plane& plane,
                     const geometry::FacetTree& facets, double tolerance, const RunContext& context)
{
    Outline outline;
    for (const std::vector<Vec2>& loop : region) outline.add_loop(loop);
    const std::vector<Vec2>& flat = outline.flat;
    const geometry::Triangulation own = geometry::triangulate(flat, outline.loops, {.interior_points = false},
                                                              context);
    return std::ranges::any_of(own.triangles, [&](const Triangle& t) {
        const Vec2 centre = (flat[index(t[0])] + flat[index(t[1])] + flat[index(t[2])]) / 3;
        return facets.closest(geometry::from_plane(plane, centre), tolerance * tolerance).triangle >= 0;
    });
}

/// Whether a face belongs to the volume, or to the volume before its faces were split.
bool is_own(const OpenVolume& volume, const Model& model, FaceId face)
{
    const geometry::FacetTree facets(model.points, model[face].triangles);
    const double near = volume.model.tolerance * volume.model.tolerance;
    return std::ranges::any_of(volume.model.faces, [&](const Face& own) {
        if (own.tag != model[face].tag || own.origin != model[face].origin) return false;
        return std::ranges::all_of(own.triangles.front(), [&](Index p) {
            return facets.closest(volume.model.at(p), near).triangle >= 0;
        });
    });
}

} // namespace

std::vector<StepPiece> cut_by_plane(const OpenVolume& volume, const geometry::Plane& plane,
                                    const RunContext& context)
{
    return cut_within(volume, plane, {}, context);
}

std::vector<StepPiece> cut_at_edges(const OpenVolume& volume, const geometry::Plane& plane,
                                    const std::vector<EdgeId>& edges, double least, const RunContext& context)
{
    std::vector<Vec2> middles;
    for (const EdgeId edge : edges) {
        const std::vector<Vec3> chain = use_places(volume.model, {edge, false});
        const std::size_t k = (chain.size() - 1) / 2;
        middles.push_back(geometry::to_plane(plane, (chain[k] + chain[k + 1]) / 2));
    }
    const double tolerance = volume.model.tolerance;
    const auto runs_along = [&](const std::vector<std::vector<Vec2>>& region) {
        return std::ranges::any_of(region, [&](const std::vector<Vec2>& loop) {
            for (std::size_t i = 0; i < loop.size(); ++i)
                for (const Vec2& middle : middles) {
                    const Vec2 &a = loop[i], &b = loop[(i + 1) % loop.size()];
                    const double t = std::clamp((middle - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
                    if ((a + t * (b - a) - middle).norm() <= tolerance) return true;
                }
            return false;
        });
    };
    return cut_within(volume, plane, edges.empty() ? Suits() : runs_along, context, least);
}

std::vector<StepPiece> cut_by_face(const OpenVolume& volume, const Model& model, FaceId face,
                                   const RunContext& context)
{
    const bool own = is_own(volume, model, face);
    EdgePartition partition(volume, model, face);
    if (!own && partition.fits()) return partition.run(context);
    const std::optional<geometry::Plane> plane = plane_of(model, face);
    if (!plane)
        throw NotSweepable(Message("closure.cut_face", "{} is curved{}", entity_of(model, face),
                                   own ? " and one of the volume's own"
                                       : formatted(", and its rim leaves the volume's edges at {}",
                                                   place_with_digits(partition.off(), 4)))
                               .remedy("use a flat face, which cuts by its plane, or a curved face whose "
                                       "whole rim is on edges of the volume"));
    if (own) return cut_by_plane(volume, *plane, context);
    const geometry::FacetTree facets(model.points, model[face].triangles);
    const double tolerance = volume.model.tolerance;
    const auto has_some = [&](const std::vector<std::vector<Vec2>>& region) {
        return contains_facets(region, *plane, facets, tolerance, context);
    };
    return cut_within(volume, *plane, has_some, context);
}

} // namespace lacuna::closure
