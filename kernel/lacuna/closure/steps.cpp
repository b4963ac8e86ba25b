// SPDX-License-Identifier: MIT
#include <lacuna/closure/shared/steps.h>

#include <lacuna/closure/detail/end_holes.h>
#include <lacuna/closure/detail/outline.h>
#include <lacuna/closure/detail/pieces.h>
#include <lacuna/closure/detail/turns.h>
#include <lacuna/closure/detail/unless_refused.h>
#include <lacuna/closure/detail/void_entities.h>
#include <lacuna/closure/detail/void_faces.h>
#include <lacuna/closure/shared/cut.h>
#include <lacuna/closure/shared/round_rims.h>
#include <lacuna/core/error.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/geometry/shared/predicates.h>
#include <lacuna/topology/shared/face_facts.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/face_plane.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <optional>
#include <set>

namespace lacuna::closure {

using namespace topology;

namespace {

/// Each cut reduces the number of steps. More cuts in a row than this mean an error in the cutter.
constexpr int kRounds = 64;

/// A rim of an end where all walls lead away from the opposite end.
struct Hanging {
    std::size_t part = 0; ///< index of the part of the end
    Rim rim;
};

/// Steps at the rims of an end.
struct Steps {
    std::vector<std::vector<FaceId>> parts; ///< connected parts of the end
    std::vector<Hanging> closed;            ///< rims at which all walls lead away from the opposite end
    std::vector<FaceId> risers;             ///< walls at steps whose rim also has other walls
};

/// Whether the walls at an edge lead away from the opposite end.
/// @param out  direction away from the opposite end.
bool leads_away(const OpenVolume& volume, EdgeId edge, const Vec3& out)
{
    const Model& model = volume.model;
    const std::vector<Index>& line = model[edge].points;
    const std::set<Index> on(line.begin(), line.end());
    Vec3 way = Vec3::Zero();
    for (const FaceUse& user : model.uses_of_edge(edge)) {
        if (volume.role[user.face.index()] != Role::wall) continue;
        for (const Triangle& t : model[user.face].triangles) {
            const auto corner = std::ranges::find_if(t, [&](Index p) { return !on.contains(p); });
            if (std::ranges::count_if(t, [&](Index p) { return on.contains(p); }) != 2) continue;
            const std::size_t k = static_cast<std::size_t>(corner - t.begin());
            const Vec3 side = model.at(t[(k + 2) % 3]) - model.at(t[(k + 1) % 3]);
            const Vec3 up = model.at(*corner) - model.at(t[(k + 1) % 3]);
            way += (up - up.dot(side) / side.squaredNorm() * side).stableNormalized();
        }
    }
    return way.stableNormalized().dot(out) > std::sin(kCreaseAngle * kDegree);
}

Steps find_steps(const OpenVolume& volume, Role end, const std::vector<double>& turns)
{
    const Model& model = volume.model;
    Steps steps;
    const double corner = 180 - kCornerBelow;
    const std::vector<FaceId> faces = volume.faces(end);
    if (faces.empty()) return steps;
    steps.parts = connected_parts(model, faces);
    for (std::size_t p = 0; p < steps.parts.size(); ++p) {
        const Vec3 out = area_vector_of(model, steps.parts[p]).stableNormalized();
        for (Rim& rim : topology::rims(model, steps.parts[p])) {
            std::size_t away = 0, onward = 0;
            std::vector<FaceId> risers;
            for (const EdgeUse& use : rim.uses) {
                const double turn = turns[use.edge.index()];
                // The edge is at a step if the skin turns towards the void, or, on a divided round, if the
                // walls lead away from the opposite end.
                if (turn < corner && !(turn > -corner && leads_away(volume, use.edge, out))) {
                    if (model.uses_of_edge(use.edge).size() > 1) ++onward;
                    continue;
                }
                ++away;
                for (const FaceUse& user : model.uses_of_edge(use.edge))
                    if (volume.role[user.face.index()] == Role::wall) risers.push_back(user.face);
            }
            if (away == 0) continue;
            if (onward == 0)
                steps.closed.push_back({p, std::move(rim)});
            else
                steps.risers.insert(steps.risers.end(), risers.begin(), risers.end());
        }
    }
    return steps;
}

/// A rim projected onto the opposite end.
struct Imprinted {
    std::size_t part = 0;      ///< index of the part of the end whose rim was projected
    FaceId target;             ///< the face of the opposite end on which the projected rim lies
    std::vector<Index> points; ///< points of the model; the first is not repeated at the end
    std::vector<Vec2> flat;    ///< the same points, projected along the sweep
};

class StepCutter {
public:
    StepCutter(const OpenVolume& volume, Role stepped, Steps steps, const RunContext& context)
        : volume_(volume),
          parted_{.volume = volume, .stacked = true},
          builder_(volume.model),
          stepped_(stepped),
          other_(stepped == Role::source ? Role::target : Role::source),
          context_(context),
          steps_(std::move(steps))
    {
    }

    std::vector<StepPiece> run()
    {
        across_.normal = -area_vector_of(volume_.model, volume_.faces(stepped_)).normalized();
        across_.u = across_.normal.unitOrthogonal();
        across_.v = across_.normal.cross(across_.u);
        for (const Hanging& hanging : steps_.closed) hang(hanging);
        for (const FaceId face : volume_.faces(other_)) split(face);
        builder_.build_loops();
        parted_.volume.model = std::move(builder_).finish();
        return pieces_of(parted_, {"a face below the rim of a step"}, context_);
    }

private:
    const geometry::FacetTree& opposite_tree()
    {
        if (tree_) return *tree_;
        std::vector<Triangle> triangles;
        for (const FaceId face : volume_.faces(other_)) {
            for (std::size_t t = 0; t < volume_.model[face].triangles.size(); ++t) {
                triangles.push_back(volume_.model[face].triangles[t]);
                facet_.emplace_back(face, t);
            }
        }
        return tree_.emplace(volume_.model.points, triangles);
    }

    struct Hit {
        Vec3 place;
        FaceId face;
        Vec2 uv = Vec2::Zero();
    };
    /// The place where the line from a point along the sweep first meets the opposite end, or the face `only`
    /// of that end.
    std::optional<Hit> above(const Vec3& p, FaceId only = {})
    {
        geometry::FacetTree::RayHit hit;
        opposite_tree().all_along(p, across_.normal, [&](const geometry::FacetTree::RayHit& other) {
            if ((!only.valid() || facet_[index(other.triangle)].first == only) && other.t < hit.t)
                hit = other;
            return true;
        });
        if (hit.triangle < 0) return std::nullopt;
        const auto& [face, t] = facet_[index(hit.triangle)];
        Hit found{Vec3::Zero(), face};
        for (std::size_t k = 0; k < 3; ++k) {
            found.place += hit.barycentric[static_cast<int>(k)] *
                           volume_.model.at(volume_.model[face].triangles[t][k]);
            if (!volume_.model[face].uv.empty())
                found.uv += hit.barycentric[static_cast<int>(k)] * volume_.model[face].uv[t][k];
        }
        return found;
    }

    /// Extrude void faces from a rim to the opposite end.
    void hang(const Hanging& hanging)
    {
        const Rim& rim = hanging.rim;
        check_cancelled(context_);
        Imprinted image;
        image.part = hanging.part;
        std::map<Index, Index> above_of; // by point of the rim: its image on the opposite end
        const auto lift = [&](Index p) {
            const auto known = above_of.find(p);
            if (known != above_of.end()) return known->second;
            const Vec3 from = builder_.at(p);
            const std::optional<Hit> hit = above(from);
            if (!hit || (image.target.valid() && hit->face != image.target)) {
                const NamedEntity step = entity_of(builder_, steps_.parts[hanging.part].front());
                if (!hit)
                    throw NotSweepable(
                        Message(
                            "closure.steps",
                            "the rim of the step at {} is not everywhere opposite to a face of the other end",
                            step)
                            .remedy("cut the volume with cut{{ plane = … }}"));
                throw NotSweepable(
                    Message("closure.steps", "the rim of the step at {} is opposite to two faces, {} and {}",
                            step, entity_of(builder_, image.target), entity_of(builder_, hit->face))
                        .remedy("give the opposite end there as one face"));
            }
            image.target = hit->face;
            const auto made = static_cast<Index>(builder_.points.size());
            builder_.points.push_back(hit->place);
            uv_.emplace(made, hit->uv);
            above_of.emplace(p, made);
            return made;
        };
        std::map<VertexId, VertexId> vertex_above;
        std::set<VertexId> lined;
        const auto vertex = [&](VertexId v) {
            const auto known = vertex_above.find(v);
            if (known != vertex_above.end()) return known->second;
            return vertex_above.emplace(v, builder_.add_void_vertex(lift(builder_[v].point))).first->second;
        };
        const auto side_line = [&](VertexId v) {
            if (!lined.insert(v).second) return;
            const VertexId above = vertex(v);
            builder_.add_void_edge(v, above, {builder_[v].point, builder_[above].point});
        };
        for (const EdgeUse& use : rim.uses) {
            const std::vector<Index> low = use_points(builder_, use);
            std::vector<Index> high;
            for (const Index p : low) high.push_back(lift(p));
            const VertexId from = use_from(builder_, use), to = use_to(builder_, use);
            // From a rim that is one closed edge, a ring face with two loops is extruded; from any other rim,
            // one face per edge.
            const bool closed = rim.uses.size() == 1;
            const EdgeId top = builder_.add_void_edge(vertex(from), vertex(to), high);
            if (!closed) {
                side_line(from);
                side_line(to);
            }
            parted_.partitions.push_back({builder_.add_void_face(Geometry::transfinite), {use, {top, true}}});
            parted_.volume.role.push_back(Role::wall);
            Face& face = builder_.faces.back();
            for (std::size_t i = 0; i + 1 < low.size(); ++i) {
                face.triangles.push_back({low[i], low[i + 1], high[i + 1]});
                face.triangles.push_back({low[i], high[i + 1], high[i]});
            }
            image.points.insert(image.points.end(), high.begin(), high.end() - 1);
        }
        image.flat = flat_places(across_, places_at(builder_, image.points));
        images_.push_back(std::move(image));
    }

    /// Split a face of the opposite end along the rims projected onto it.
    void split(FaceId id)
    {
        std::vector<Imprinted*> own;
        for (Imprinted& image : images_)
            if (image.target == id) own.push_back(&image);
        if (own.empty()) return;
        // The loops of the face, then the projected rims. Each region lies inside one loop and outside the
        // loops directly within this loop.
        struct Ring {
            std::vector<Index> points;
            std::vector<Vec2> flat;
        };
        std::vector<Ring> rings;
        for (const Loop& loop : border_loops(builder_, id)) {
            std::vector<Index> points = loop_points(builder_, loop.uses);
            std::vector<Vec2> flat = flat_places(across_, places_at(builder_, points));
            rings.push_back({std::move(points), std::move(flat)});
        }
        const std::size_t given = rings.size();
        for (const Imprinted* image : own) rings.push_back({image->points, image->flat});
        const auto depth_in = [&](std::size_t inner, std::size_t outer) {
            return inner != outer && geometry::encloses(rings[outer].flat, rings[inner].flat);
        };
        std::vector<std::size_t> parents(rings.size(), rings.size());
        for (std::size_t i = 0; i < rings.size(); ++i) {
            std::size_t& best = parents[i];
            for (std::size_t o = 0; o < rings.size(); ++o)
                if (depth_in(i, o) && (best == rings.size() || depth_in(o, best))) best = o;
        }

        const Face before = builder_[id];
        const Vec3 area = face_area_vector(builder_, id);
        const bool turned = area.dot(across_.normal) < 0;
        bool first = true;
        for (std::size_t outer = 0; outer < rings.size(); ++outer) {
            // The inside of a hole of the face is no region.
            if (outer < given && parents[outer] != rings.size()) continue;
            Outline outline;
            outline.add_loop(rings[outer].flat, rings[outer].points);
            for (std::size_t i = 0; i < rings.size(); ++i)
                if (parents[i] == outer) outline.add_loop(rings[i].flat, rings[i].points);
            geometry::Triangulation made;
            try {
                made = geometry::triangulate(outline.flat, outline.loops,
                                             {.interior_points = before.kind != "plane"}, context_);
            } catch (const InvalidInput& error) { // the error names loops, not faces
                throw NotSweepable(Message("closure.steps",
                                           "{} cannot be split along the projected outlines of the steps",
                                           entity_of(builder_, id))
                                       .remedy("cut the volume with cut{{ plane = … }}")
                                       .attempt(error.message()));
            }
            Face face = before;
            face.triangles.clear();
            face.uv.clear();
            face.given_quads.clear();
            face.keeps_nodes = false;
            const auto first_made = static_cast<Index>(builder_.points.size());
            VoidFilling filling = filling_of(builder_, outline, made, [&](std::size_t p) {
                const std::optional<Hit> hit = above(geometry::from_plane(across_, made.points[p], lowest()),
                                                     id);
                if (!hit)
                    throw NotSweepable(Message("closure.steps",
                                               "{} folds back along the sweep direction and cannot be cut",
                                               entity_of(builder_, id))
                                           .remedy("cut the volume with cut{{ plane = … }}"));
                uv_.insert_or_assign(first_made + static_cast<Index>(p - outline.flat.size()), hit->uv);
                return hit->place;
            });
            builder_.points.insert(builder_.points.end(), filling.points.begin(), filling.points.end());
            face.triangles = std::move(filling.triangles);
            if (turned)
                for (Triangle& t : face.triangles) std::swap(t[1], t[2]);
            if (before.surface) set_uv(before, face);
            if (first) {
                builder_[id] = std::move(face);
            } else {
                builder_.faces.push_back(std::move(face));
                parted_.volume.role.push_back(other_);
            }
            first = false;
        }
        for (std::size_t i = 0; i < own.size(); ++i) {
            if (parents[given + i] == rings.size())
                throw NotSweepable(Message("closure.steps",
                                           "the rim of the step at {}, projected along the sweep, leaves {}",
                                           entity_of(builder_, steps_.parts[own[i]->part].front()),
                                           entity_of(builder_, id))
                                       .remedy("cut the volume with cut{{ plane = … }}"));
        }
    }

    /// A height along the sweep below the whole volume.
    [[nodiscard]] double lowest() const
    {
        double least = kInfinity;
        for (const Vec3& p : volume_.model.points) least = std::min(least, p.dot(across_.normal));
        return least - volume_.model.diagonal;
    }

    /// Set the surface parameters of the facets' corners. Projected points get the parameters found by
    /// projection; points of the face's loops keep those of the old facets.
    void set_uv(const Face& before, Face& face) const
    {
        std::map<Index, Vec2> known(uv_.begin(), uv_.end());
        for (std::size_t t = 0; t < before.triangles.size(); ++t) {
            for (std::size_t k = 0; k < 3; ++k) known.emplace(before.triangles[t][k], before.uv[t][k]);
        }
        for (const Triangle& t : face.triangles)
            face.uv.push_back({known.at(t[0]), known.at(t[1]), known.at(t[2])});
    }

    const OpenVolume& volume_;
    PartedVolume parted_; ///< holds the roles; its model is set from `builder_` at the end
    ModelBuilder builder_;
    Role stepped_, other_;
    const RunContext& context_;
    Steps steps_;            ///< steps of the stepped end
    geometry::Plane across_; ///< plane across the sweep; its normal is the direction to the other end
    std::vector<Imprinted> images_;
    /// Surface parameters of points projected onto the opposite end.
    std::map<Index, Vec2> uv_;
    std::optional<geometry::FacetTree> tree_;           ///< facets of the original opposite end
    std::vector<std::pair<FaceId, std::size_t>> facet_; ///< by triangle of the tree: its face, and its index
                                                        ///< among the face's triangles
};

/// Close a missing end opposite to steps by a face in the only open loop. The face is flat or bent like the
/// loop.
void cap_opposite(OpenVolume& volume, Role other, const Steps& steps, const RunContext& context)
{
    const std::vector<Rim> open = free_loops(volume);
    const NamedEntity step = entity_of(volume.model,
                                       volume.model.faces.empty() ? FaceId() : steps.parts.back().front());
    if (open.size() != 1)
        throw NotSweepable(Message("closure.steps",
                                   "the steps at {} need the opposite end, which is missing, and {} loops "
                                   "are open instead of one",
                                   step, found(open.size()))
                               .remedy("give that end, or the other missing faces"));
    add_void_face(volume,
                  fill(volume, {reversed(open.front())}, nullptr, {"the end opposite ", {step}}, context),
                  other);
    volume.model = with_loops(std::move(volume.model));
}

/// Cut a volume by the planes of some of its faces in turn. Each plane cuts all pieces that it crosses near
/// its face.
std::vector<StepPiece> cut_by_planes(const OpenVolume& volume, const std::vector<FaceId>& faces,
                                     const RunContext& context)
{
    std::vector<StepPiece> pieces{{volume, 0}};
    for (const FaceId face : faces) {
        const std::optional<geometry::Plane> plane = plane_of(volume.model, face);
        if (!plane)
            throw NotSweepable(Message("closure.steps",
                                       "the step at {} is not flat, so it has no plane to cut by, and its "
                                       "rim is not closed",
                                       entity_of(volume.model, face))
                                   .remedy("cut the volume with cut{{ plane = … }}"));
        // The plane of a face cuts only pieces near this face.
        const Eigen::AlignedBox3d reach = box_of(volume.model, face);
        const auto cut = [&](const OpenVolume& piece) {
            return cut_by_face(piece, volume.model, face, context);
        };
        pieces = cut_each(std::move(pieces), *plane, cut, &reach);
    }
    return pieces;
}

/// The steps of the two ends of a volume.
std::array<Steps, 2> steps_of(const OpenVolume& volume, const RunContext& context)
{
    const std::vector<double> turns = concave_turns(volume, context);
    return {find_steps(volume, Role::source, turns), find_steps(volume, Role::target, turns)};
}

/// The unit direction from source to target, from their faces.
Vec3 sweep_way(const OpenVolume& volume)
{
    Vec3 way = Vec3::Zero();
    for (const FaceId face : volume.faces(Role::target)) way += face_area_vector(volume.model, face);
    for (const FaceId face : volume.faces(Role::source)) way -= face_area_vector(volume.model, face);
    return way.stableNormalized();
}

/// Levels of pieces that lie side by side: the number of distinct lengths along the sweep that are greater
/// than the length of the piece; 0 for the longest.
std::vector<int> levels_by_length(const std::vector<StepPiece>& pieces, const Vec3& way)
{
    std::vector<double> length;
    double tolerance = 0;
    for (const StepPiece& piece : pieces) {
        const Model& model = piece.volume.model;
        double low = kInfinity, high = -low;
        for (const Face& face : model.faces) {
            for (const Index p : corners_of(face)) {
                low = std::min(low, model.at(p).dot(way));
                high = std::max(high, model.at(p).dot(way));
            }
        }
        length.push_back(high - low);
        tolerance = std::max(tolerance, 10 * model.tolerance);
    }
    std::vector<double> lengths = length;
    std::ranges::sort(lengths, std::greater<>());
    const auto same = [&](double a, double b) { return a - b <= tolerance; };
    lengths.erase(std::unique(lengths.begin(), lengths.end(), same), lengths.end());
    std::vector<int> levels;
    for (const double own : length) {
        levels.push_back(static_cast<int>(
            std::ranges::count_if(lengths, [&](double other) { return other - own > tolerance; })));
    }
    return levels;
}

/// If the only open loop is flat, lies across the sweep and is bounded by walls, close it as part of an end.
/// Example: the brim of a box around a floating board. Without this face, the columns beside the board would
/// have no end.
void close_brim(OpenVolume& volume, const RunContext& context)
{
    const std::vector<Rim> open = free_loops(volume);
    if (open.size() != 1 || volume.faces(Role::source).empty() || volume.faces(Role::target).empty()) return;
    const auto is_wall = [&](const FaceUse& use) { return volume.role[use.face.index()] == Role::wall; };
    for (const EdgeUse& use : open.front().uses)
        if (!std::ranges::all_of(volume.model.uses_of_edge(use.edge), is_wall)) return;
    const Vec3 way = sweep_way(volume);
    const std::vector<Vec3> places = places_at(volume.model, loop_points(volume.model, open.front().uses));
    const auto [low, high] = std::ranges::minmax(places, {}, [&](const Vec3& p) { return p.dot(way); });
    const double width = std::sqrt(geometry::newell_vector(places).norm());
    if (!((high - low).dot(way) <= kParallel * width)) return;
    const bool is_ahead = (low - centroid_of(volume.model, all_faces(volume.model))).dot(way) > 0;
    add_void_face(volume, fill(volume, {reversed(open.front())}, nullptr, {"the brim"}, context),
                  is_ahead ? Role::target : Role::source);
    volume.model = with_loops(std::move(volume.model));
}

/// Cover the holes without walls in the tops of steps, such as a bore in a boss that ends below the brim. If
/// the holes were extended to the other end, they would become pins in the void.
void cover_step_holes(OpenVolume& volume, const RunContext& context)
{
    std::set<FaceId> tops;
    for (const Steps& own : steps_of(volume, context))
        for (const Hanging& hanging : own.closed)
            tops.insert(own.parts[hanging.part].begin(), own.parts[hanging.part].end());
    std::vector<EndHole> holes = holes_without_walls(volume);
    std::erase_if(holes, [&](const EndHole& hole) { return !tops.contains(hole.face); });
    if (holes.empty()) return;
    for (const EndHole& hole : holes)
        log_line(context, formatted("note: a hole in {}, the top of a step, is covered by a flat face",
                                    entity_of(volume.model, hole.face)));
    cover_holes(volume, holes, context);
    volume.model = with_loops(std::move(volume.model));
}

std::vector<StepPiece> hang_all(OpenVolume volume, const RunContext& context, int round);

/// Cut a volume by the planes of walls at steps. Then extrude void faces from the rims of the remaining
/// steps, where all walls lead away from the opposite end.
std::vector<StepPiece> cut_at_risers(const OpenVolume& volume, const std::vector<FaceId>& risers,
                                     const RunContext& context, int round)
{
    std::vector<StepPiece> result;
    const std::vector<StepPiece> cut = cut_by_planes(volume, risers, context);
    const std::vector<int> levels = levels_by_length(cut, sweep_way(volume));
    for (std::size_t p = 0; p < cut.size(); ++p) {
        for (StepPiece& own : hang_all(cut[p].volume, context, round)) {
            own.level += levels[p];
            result.push_back(std::move(own));
        }
    }
    return result;
}

/// Extrude void faces from the rims in `Steps::closed`, one end after the other, until no piece has such a
/// rim.
std::vector<StepPiece> hang_all(OpenVolume volume, const RunContext& context, int round)
{
    face_away(volume, context);
    std::array<Steps, 2> steps = steps_of(volume, context);
    for (const Role end : {Role::source, Role::target}) {
        Steps& own = steps[end == Role::source ? 0 : 1];
        if (own.closed.empty()) continue;
        if (round == kRounds)
            throw NotSweepable(
                Message("closure.steps", "the volume has too many steps").remedy("cut it by planes first"));
        const Role other = end == Role::source ? Role::target : Role::source;
        if (volume.faces(other).empty()) cap_opposite(volume, other, own, context);
        std::vector<StepPiece> result;
        for (StepPiece& piece : StepCutter(volume, end, std::move(own), context).run()) {
            for (StepPiece& part : hang_all(std::move(piece.volume), context, round + 1)) {
                part.level += piece.level;
                result.push_back(std::move(part));
            }
        }
        return result;
    }
    for (const Role end : {Role::source, Role::target}) {
        const auto& [parts, closed, risers] = steps[end == Role::source ? 0 : 1];
        if (parts.size() < 2) continue;
        // A wall at a step may end in the plane of an earlier cut. Then the step's rim also has other walls,
        // and the planes of its walls must cut.
        if (!risers.empty() && round < kRounds) return cut_at_risers(volume, risers, context, round + 1);
        throw NotSweepable(
            Message("closure.steps",
                    "the {} has several separate parts, such as {} and {}, and no walls lead from one to the "
                    "other",
                    end == Role::source ? "source" : "target", entity_of(volume.model, parts[0].front()),
                    entity_of(volume.model, parts[1].front()))
                .remedy("make two volumes of it, or cut it with cut{{ plane = … }}"));
    }
    return {{std::move(volume), 0}};
}

bool is_stepped(const Steps& steps)
{
    return steps.parts.size() > 1 || !steps.closed.empty() || !steps.risers.empty();
}

bool is_stepped(const OpenVolume& volume, const RunContext& context)
{
    return std::ranges::any_of(steps_of(volume, context),
                               [](const Steps& steps) { return is_stepped(steps); });
}

/// Cut by the planes of all steps. Empty if a step is not flat, if a cut fails, or if a piece still has
/// steps.
std::vector<StepPiece> cut_in_layers(const OpenVolume& volume, const std::array<Steps, 2>& steps,
                                     const RunContext& context)
{
    std::vector<FaceId> faces;
    for (const Steps& own : steps) {
        for (const Hanging& hanging : own.closed) faces.push_back(own.parts[hanging.part].front());
    }
    auto pieces = unless_refused([&] { return cut_by_planes(volume, faces, context); });
    const auto stepped = [&](const StepPiece& piece) { return is_stepped(piece.volume, context); };
    if (!pieces || std::ranges::any_of(*pieces, stepped)) return {};
    return std::move(*pieces);
}

} // namespace

bool has_round_steps(const OpenVolume& volume, const RunContext& context)
{
    const auto has_cap = [&](Role end) {
        const std::vector<FaceId> faces = volume.faces(end);
        const Vec3 out = area_vector_of(volume.model, faces).stableNormalized();
        return std::ranges::any_of(faces,
                                   [&](FaceId face) { return is_smooth_cap(volume.model, face, out); });
    };
    if (!has_cap(Role::source) && !has_cap(Role::target)) return false;
    OpenVolume divided = volume;
    split_round_rims(divided, RoundsOf::ends_and_walls, context);
    return is_stepped(divided, context);
}

bool has_steps(const OpenVolume& volume, const RunContext& context)
{
    return is_stepped(volume, context) || has_round_steps(volume, context);
}

std::vector<StepPiece> cut_steps(const OpenVolume& whole, const RunContext& context)
{
    OpenVolume volume = whole;
    face_away(volume, context);
    if (!has_steps(volume, context)) return {{whole, 0}};
    close_brim(volume, context);
    cover_step_holes(volume, context);
    split_round_rims(volume, RoundsOf::ends_and_walls, context);
    const std::array<Steps, 2> steps = steps_of(volume, context);
    std::vector<FaceId> risers = steps[0].risers;
    risers.insert(risers.end(), steps[1].risers.begin(), steps[1].risers.end());
    std::vector<StepPiece> result;
    if (!risers.empty()) {
        result = cut_at_risers(volume, risers, context, 0);
    } else {
        try {
            result = hang_all(volume, context, 0);
        } catch (const Cancelled&) {
            throw;
        } catch (const Error&) {
            result = cut_in_layers(volume, steps, context);
            if (result.empty()) throw;
        }
    }
    std::ranges::stable_sort(result, {}, &StepPiece::level);
    return result;
}

} // namespace lacuna::closure
