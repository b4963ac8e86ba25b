// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/assembly_imprint.h>

#include <lacuna/closure/shared/straighten_lines.h>
#include <lacuna/core/error.h>
#include <lacuna/core/shared/edge_key.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/surface/shared/edge_nodes.h>
#include <lacuna/sweep/detail/rim_arcs.h>
#include <lacuna/sweep/shared/imprinted.h>
#include <lacuna/topology/shared/curve_place.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/face_plane.h>
#include <lacuna/topology/shared/section.h>
#include <lacuna/topology/shared/side_points.h>
#include <lacuna/topology/shared/split_edge.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace lacuna::sweep {

using namespace topology;

namespace {

constexpr const char* kPartOfFace = "assembly.part_of_face"; // error code

/// The midpoint of the shortest connection of two chords. Empty if the chords are farther apart than
/// `within`, or nearly parallel. The crossing of parallel chords would depend on rounding, and a vertex there
/// could make a side of zero length.
std::optional<Vec3> crossing(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, double within)
{
    const Vec3 u = b - a, v = d - c, w = c - a;
    const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v), whole = uu * vv - uv * uv;
    if (!(whole > 4 * within * within * std::max(uu, vv))) return std::nullopt;
    const double s = (vv * w.dot(u) - uv * w.dot(v)) / whole, t = (uv * w.dot(u) - uu * w.dot(v)) / whole;
    const double slack_s = within / std::sqrt(uu), slack_t = within / std::sqrt(vv);
    if (s < -slack_s || s > 1 + slack_s || t < -slack_t || t > 1 + slack_t) return std::nullopt;
    const Vec3 p = a + s * u, q = c + t * v;
    return (p - q).norm() <= within ? std::optional<Vec3>((p + q) / 2) : std::nullopt;
}

/// Whether the points of an edge's line lie on an exact curve, with their parameters.
bool has_curve(const Model& model, EdgeId id, const std::vector<Vec3>& line)
{
    const Edge& edge = model[id];
    return edge.curve && !edge.params.empty() && line.size() == edge.points.size();
}

/// A chord of an edge.
struct Chord {
    const Model* model;
    EdgeId edge;
    const std::vector<Vec3>* line; ///< the edge's points
    std::size_t start;             ///< the index of the chord's first point

    [[nodiscard]] Vec3 direction() const { return (*line)[start + 1] - (*line)[start]; }
    [[nodiscard]] bool is_curved() const { return has_curve(*model, edge, *line); }
    /// The point beside a fraction of the chord, on the exact curve if there is one.
    [[nodiscard]] Vec3 at(double fraction) const
    {
        if (is_curved()) return curve_beside(*model, (*model)[edge], start, fraction).place;
        return (*line)[start] + fraction * direction();
    }
    [[nodiscard]] double fraction_of(const Vec3& place) const
    {
        return direction().dot(place - (*line)[start]) / direction().squaredNorm();
    }
};

/// Where the curves of two chords cross. Chords around the crossing that get shorter and shorter replace the
/// given ones, until their crossing moves by less than the tolerance, or they are as short as the tolerance.
/// Empty as for the chords themselves.
std::optional<Vec3> crossing(const Chord& one, const Chord& other, double within)
{
    const std::vector<Vec3>&p = *one.line, &q = *other.line;
    std::optional<Vec3> at = crossing(p[one.start], p[one.start + 1], q[other.start], q[other.start + 1],
                                      within);
    double moved = at && (one.is_curved() || other.is_curved()) ? kInfinity : 0;
    const double tolerance = one.model->tolerance;
    const double longest = std::max(one.direction().norm(), other.direction().norm());
    for (double half = 1.0 / 8; moved > tolerance / 2 && half * longest > tolerance; half /= 4) {
        const auto ends = [&](const Chord& chord) {
            const double middle = chord.fraction_of(*at);
            return std::pair(chord.at(std::clamp(middle - half, 0.0, 1.0)),
                             chord.at(std::clamp(middle + half, 0.0, 1.0)));
        };
        const auto [a, b] = ends(one);
        const auto [c, d] = ends(other);
        const std::optional<Vec3> closer = crossing(a, b, c, d, within);
        if (!closer) break;
        moved = (*closer - *at).norm();
        at = closer;
    }
    return at;
}

/// The chords of a line that do not run along another line. @return  the index of the first point of each
/// chord
std::vector<std::size_t> chords_off(const std::vector<Vec3>& line, const std::vector<Vec3>& other,
                                    double within)
{
    const auto is_on = [&](const Vec3& p) { return closest_on(other, p).distance <= within; };
    std::vector<std::size_t> off;
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
        if (!is_on(line[i]) || !is_on((line[i] + line[i + 1]) / 2) || !is_on(line[i + 1])) off.push_back(i);
    return off;
}

/// A face of one volume that is cut along the rim of another.
class FaceCutter {
public:
    /// @param within  a vertex of the rim that is within this distance of a line's end replaces that end.
    FaceCutter(ModelBuilder& model, FaceId face, double within)
        : model_(model), face_(face), tolerance_(model.tolerance), within_(within)
    {
    }

    /// Cut the facets along a chain of points near the face. The facets of a bent face are only near its
    /// surface, so new points are moved to the chain.
    /// @return  the points of the cut; empty if the chain leaves the face
    std::vector<Index> lay(const std::vector<Vec3>& line, bool bent)
    {
        const auto given = static_cast<Index>(model_.points.size());
        std::vector<Index> stops;
        std::map<Index, Vec3> place; // of new points
        for (std::size_t i = 0; i < line.size(); ++i) {
            const bool is_end = i == 0 || i + 1 == line.size();
            Index stop = is_end ? rim_vertex_at(line[i]) : -1;
            if (stop < 0) stop = point_on_face(model_, face_, line[i]);
            if (stop < 0) return {};
            if (stop >= given) place.emplace(stop, line[i]);
            if (stops.empty() || stops.back() != stop) stops.push_back(stop);
        }
        std::vector<Index> chain{stops.front()};
        for (std::size_t i = 0; i + 1 < stops.size(); ++i)
            if (!cut_between(stops[i], stops[i + 1], chain)) return {};
        if (!bent) return chain;
        const std::vector<double> arc = geometry::arc_lengths(line);
        for (const Index p : chain)
            if (p >= given && !place.contains(p))
                place.emplace(p, geometry::point_at(line, arc, closest_on(line, model_.at(p)).at));
        for (const auto& [p, to] : place) model_.points[index(p)] = to;
        return chain;
    }

private:
    [[nodiscard]] Face& face() { return model_[face_]; }

    /// The vertex of the rim at a position; -1: none.
    [[nodiscard]] Index rim_vertex_at(const Vec3& place) const
    {
        Index nearest = -1;
        double least = within_;
        for (const EdgeUse& use : uses_of(model_[face_])) {
            const Index point = model_[use_from(model_, use)].point;
            const double off = (model_.at(point) - place).norm();
            if (off > least) continue;
            least = off;
            nearest = point;
        }
        return nearest;
    }

    /// Cut along a straight line from one point to another, along the facets.
    bool cut_between(Index from, Index to, std::vector<Index>& chain)
    {
        const Vec3 target = model_.at(to);
        const std::size_t most = 4 * face().triangles.size() + 16;
        Index before = -1;
        for (std::size_t step = 0; from != to; ++step) {
            if (step > most) return false;
            const Index next = step_towards(before, from, to, target);
            if (next < 0) return false;
            chain.push_back(next);
            before = std::exchange(from, next);
        }
        return true;
    }

    /// @param before  the point from which the way came; -1: none. The way leaves its facets, and it may lead
    ///                away from the target for a step, because facets beside another cut can be folded.
    Index step_towards(Index before, Index from, Index to, const Vec3& target)
    {
        const Vec3 start = model_.at(from), way = target - start;
        const auto is_ahead = [&](const Vec3& p) { return before >= 0 || (p - start).dot(way) > 0; };
        for (const Triangle& t : face().triangles) {
            if (std::ranges::find(t, from) != t.end() && std::ranges::find(t, to) != t.end()) return to;
        }
        for (const Triangle& t : face().triangles) {
            const auto k = static_cast<std::size_t>(std::ranges::find(t, from) - t.begin());
            if (k == 3 || (before >= 0 && std::ranges::find(t, before) != t.end())) continue;
            const Index a = t[(k + 1) % 3], b = t[(k + 2) % 3];
            const Vec3 normal = (model_.at(a) - start).cross(model_.at(b) - start);
            const Vec3 aside = way.cross(normal).stableNormalized();
            const double ha = (model_.at(a) - start).dot(aside), hb = (model_.at(b) - start).dot(aside);
            for (const auto& [corner, h] : {std::pair(a, ha), std::pair(b, hb)}) {
                if (std::abs(h) <= tolerance_ && is_ahead(model_.at(corner))) return corner;
            }
            if (ha * hb >= 0) continue;
            const double f = ha / (ha - hb);
            const Vec3 there = (1 - f) * model_.at(a) + f * model_.at(b);
            if (!is_ahead(there)) continue;
            return point_on_side(model_, face_, a, b, f);
        }
        return -1;
    }

    ModelBuilder& model_;
    FaceId face_;
    double tolerance_, within_;
};

/// One of the two faces of a pair.
struct SideOfPair {
    OpenVolume* volume;
    FaceId face;
    bool fixed = false;   ///< the skin of a given mesh, which is not changed
    NamedEntity whole{};  ///< the face before parts were split off
    std::string region{}; ///< region of the member
    /// For each face that the imprint has added to the volume, the face it is a part of.
    std::vector<FaceId>* parents = nullptr;

    [[nodiscard]] Model& model() const { return volume->model; }
};

/// Whether the exact curve of an edge passes through `p`, although the edge's chords are farther away.
bool curve_runs_through(const Model& model, EdgeId id, const std::vector<Vec3>& line, const OnLine& place,
                        const Vec3& p, double within)
{
    if (!has_curve(model, id, line)) return false;
    const geometry::PolylinePlace on = geometry::place_at(geometry::arc_lengths(line), place.at);
    // An arc of less than half a turn is not higher than half its chord.
    if (on.segment + 1 == line.size() ||
        place.distance > within + (line[on.segment + 1] - line[on.segment]).norm() / 2)
        return false;
    return (curve_beside(model, model[id], on.segment, on.fraction).place - p).norm() <= within;
}

/// Make the point of the given edges closest to `p` a vertex, if it is within the tolerance of `p`.
template <class Edges>
void ensure_vertex(Model& model, const Edges& edges, const Vec3& p, double within)
{
    for (const EdgeId edge : edges) {
        const std::vector<Vec3> line = surface::edge_line(model, edge);
        const OnLine place = closest_on(line, p);
        const double length = geometry::length(line);
        if (place.distance > within && !curve_runs_through(model, edge, line, place, p, within)) continue;
        const double slack = std::max(within, model.tolerance);
        if ((line.front() - p).norm() <= slack || (line.back() - p).norm() <= slack) return;
        if (place.at <= model.tolerance || length - place.at <= model.tolerance) return;
        split_edge(model, edge, place.at / length);
        return;
    }
}

/// Whether a closed edge runs along a closed edge of the other face's rim.
bool is_closed_on_rim(const SideOfPair& side, EdgeId edge, const SideOfPair& other, double within)
{
    if (side.model()[edge].from != side.model()[edge].to) return false;
    const std::vector<Vec3> line = surface::edge_line(side.model(), edge);
    return std::ranges::any_of(rim_edges(other.model(), other.face), [&](EdgeId there) {
        return other.model()[there].from == other.model()[there].to &&
               chords_off(line, surface::edge_line(other.model(), there), within).empty();
    });
}

/// Vertices of a face's rim, except those of closed edges that both faces have.
std::vector<Vec3> corners_of(const SideOfPair& side, const SideOfPair& other, double within)
{
    std::vector<Vec3> corners;
    for (const EdgeId edge : rim_edges(side.model(), side.face)) {
        if (is_closed_on_rim(side, edge, other, within)) continue;
        for (const VertexId v : {side.model()[edge].from, side.model()[edge].to})
            corners.push_back(side.model().at(side.model()[v].point));
    }
    return corners;
}

/// The edges of one face's rim that run across the other face, each as a chain of points.
std::vector<std::vector<Vec3>> lines_across(const SideOfPair& of, const SideOfPair& on, double limit)
{
    const geometry::FacetTree facets(on.model().points, on.model()[on.face].triangles);
    std::vector<std::vector<Vec3>> rim, lines;
    for (const EdgeId edge : rim_edges(on.model(), on.face))
        rim.push_back(surface::edge_line(on.model(), edge));
    const double near_rim = std::max(limit, on.model().tolerance);
    for (const EdgeId edge : rim_edges(of.model(), of.face)) {
        std::vector<Vec3> line = surface::edge_line(of.model(), edge);
        bool inside = true;
        for (std::size_t i = 0; i + 1 < line.size() && inside; ++i) {
            const Vec3 middle = (line[i] + line[i + 1]) / 2;
            inside = facets.closest(middle, limit * limit).triangle >= 0 &&
                     std::ranges::none_of(rim, [&](const std::vector<Vec3>& other) {
                         return closest_on(other, middle).distance <= near_rim;
                     });
        }
        if (inside) lines.push_back(std::move(line));
    }
    return lines;
}

/// Cut a face along chains. @return  its parts, starting with the face itself; empty if a chain leaves the
/// face
std::vector<FaceId> split_along(const SideOfPair& side, const std::vector<std::vector<Vec3>>& lines,
                                double within, const RunContext& context)
{
    if (lines.empty()) return {side.face};
    const std::optional<geometry::Plane> flat = plane_of(side.model(), side.face);
    ModelBuilder model(side.model());
    FaceCutter cutter(model, side.face, within);
    std::vector<SectionWalk> walks;
    for (const std::vector<Vec3>& line : lines) {
        const std::vector<Index> chain = cutter.lay(line, !flat);
        if (chain.size() < 2) return {};
        SectionWalk& walk = walks.emplace_back();
        for (const Index p : chain) walk.places.push_back({p, -1});
        walk.closed = chain.front() == chain.back();
        if (walk.closed) walk.places.pop_back();
    }
    const std::size_t edges = model.edges.size();
    const WalkImprint made = imprint_walks(model, walks, {}, model.tolerance, context);
    // The new edges are chains of points. Curves that were made as intersections of the surface with a plane
    // are wrong for them.
    for (std::size_t e = edges; e < model.edges.size(); ++e) {
        if (model.edges[e].origin != Origin::made_void) continue;
        model.edges[e].curve = nullptr;
        model.edges[e].params.clear();
    }
    side.model() = std::move(model).finish();
    std::vector<FaceId> parts{side.face};
    // A line may also lie on another face, if two faces overlap, and split that one.
    const std::size_t given = side.volume->role.size() - side.parents->size();
    for (std::size_t f = side.volume->role.size(); f < made.parent.size(); ++f) {
        const FaceId from = made.parent[f];
        side.volume->role.push_back(side.volume->role[from.index()]);
        side.parents->push_back(from.index() < given ? from : (*side.parents)[from.index() - given]);
        if (from == side.face) parts.emplace_back(f);
    }
    if (!flat) return parts;
    std::vector<std::vector<EdgeUse>> straight;
    for (std::size_t l = 0; l < lines.size(); ++l)
        if (geometry::length(lines[l]) - (lines[l].back() - lines[l].front()).norm() <=
            side.model().tolerance)
            straight.push_back(made.lines[l]);
    if (!straight.empty()) closure::straighten_lines(side.model(), parts, *flat, straight, context);
    return parts;
}

/// The parts of both faces of a pair.
struct Parts {
    std::vector<FaceId> a, b;
};

Parts imprint_pair(const SideOfPair& a, const SideOfPair& b, double limit, const RunContext& context)
{
    const double within = std::max({limit, a.model().tolerance, b.model().tolerance});
    const auto ensure_vertices = [&](const std::vector<Vec3>& stops) {
        for (const Vec3& stop : stops)
            for (const SideOfPair* side : {&a, &b})
                ensure_vertex(side->model(), rim_edges(side->model(), side->face), stop, within);
    };
    // Place the corners first. Where two curves meet in a corner, their chords may cross next to that corner.
    std::vector<Vec3> stops = corners_of(a, b, within);
    const std::vector<Vec3> others = corners_of(b, a, within);
    stops.insert(stops.end(), others.begin(), others.end());
    ensure_vertices(stops);
    stops.clear();
    for (const EdgeId e : rim_edges(a.model(), a.face)) {
        const std::vector<Vec3> p = surface::edge_line(a.model(), e);
        for (const EdgeId f : rim_edges(b.model(), b.face)) {
            const std::vector<Vec3> q = surface::edge_line(b.model(), f);
            // Rims that run along each other do not cross, although their chords may meet at every point.
            // Such chords are left out.
            const std::vector<std::size_t> of_q = chords_off(q, p, within);
            for (const std::size_t i : chords_off(p, q, within))
                for (const std::size_t j : of_q)
                    if (const auto at = crossing(Chord{&a.model(), e, &p, i}, Chord{&b.model(), f, &q, j},
                                                 within))
                        stops.push_back(*at);
        }
    }
    ensure_vertices(stops);
    const std::vector<std::vector<Vec3>> onto_a = lines_across(b, a, within),
                                         onto_b = lines_across(a, b, within);
    for (const auto& [side, lines] : {std::pair(&a, &onto_a), std::pair(&b, &onto_b)}) {
        if (lines->empty() || side->model()[side->face].given_quads.empty()) continue;
        throw InvalidInput(
            Message(kPartOfFace,
                    "{} of {} and {} of {}: {} {}, and cannot be split along the rim of the other", a.whole,
                    a.region, b.whole, b.region, entity_of(side->model(), side->face),
                    side->fixed ? "belongs to a mesh that must not change" : "keeps its given quads")
                .remedy("{}", side->fixed
                                  ? "use the unmeshed volume instead, or split the face before the volume "
                                    "is meshed"
                                  : "mesh both faces alike, or load meshes from files with "
                                    "keep_mesh = false"));
    }
    Parts parts{split_along(a, onto_a, within, context), split_along(b, onto_b, within, context)};
    if (parts.a.empty() || parts.b.empty())
        throw InvalidInput(
            Message(kPartOfFace,
                    "{} of {} and {} of {}: the rim of one face cannot be projected onto the facets "
                    "of the other",
                    a.whole, a.region, b.whole, b.region)
                .remedy("split the larger face along the rim of the smaller one in the CAD system"));
    return parts;
}

/// Add the points of a face's rim at which edges of other faces end.
void add_ends_on_rim(const Model& model, FaceId face, std::vector<Vec3>& places)
{
    const std::set<EdgeId> rim = rim_edges(model, face);
    std::set<VertexId> on_rim, of_others;
    for (std::size_t e = 0; e < model.edges.size(); ++e)
        (rim.contains(EdgeId(e)) ? on_rim : of_others).insert({model.edges[e].from, model.edges[e].to});
    for (const VertexId vertex : on_rim)
        if (of_others.contains(vertex)) places.push_back(model.at(model[vertex].point));
}

} // namespace

void add_vertices_beside(std::span<OpenVolume> volumes, std::span<const AssemblyMember> members,
                         std::span<const SharedFace> shared, const RunContext& context)
{
    std::vector<Vec3> places;
    for (const SharedFace& face : shared) {
        if (members[face.a].unswept == members[face.b].unswept) continue;
        const bool first = members[face.a].unswept;
        add_ends_on_rim(volumes[first ? face.a : face.b].model, first ? face.face_a : face.face_b, places);
    }
    for (std::size_t m = 0; m < members.size(); ++m) {
        if (members[m].unswept || members[m].fixed != nullptr) continue;
        Model& model = volumes[m].model;
        for (const Vec3& place : places) {
            check_cancelled(context);
            std::vector<EdgeId> edges;
            for (std::size_t e = 0; e < model.edges.size(); ++e) edges.emplace_back(e);
            ensure_vertex(model, edges, place, model.tolerance);
        }
    }
}

FaceImprint imprint_faces(std::span<OpenVolume> volumes, std::span<const AssemblyMember> members,
                          std::span<const PartlyShared> pairs, const RunContext& context)
{
    std::map<std::pair<std::size_t, FaceId>, std::vector<FaceId>> parts_of;
    const auto parts = [&](std::size_t m, FaceId face) -> std::vector<FaceId>& {
        return parts_of.try_emplace({m, face}, std::vector<FaceId>{face}).first->second;
    };
    FaceImprint imprint;
    imprint.parents.resize(volumes.size());
    for (const PartlyShared& pair : pairs) {
        check_cancelled(context);
        const SharedFace& faces = pair.faces;
        const AssemblyMember &a = members[faces.a], &b = members[faces.b];
        const NamedEntity face_a = entity_in(a, faces.face_a), face_b = entity_in(b, faces.face_b);
        const auto side = [&](std::size_t m, FaceId face) {
            return SideOfPair{&volumes[m],
                              face,
                              members[m].fixed != nullptr,
                              m == faces.a ? face_a : face_b,
                              members[m].region,
                              &imprint.parents[m]};
        };
        // Earlier pairs may have split both faces. Compare every part of one face with every part of the
        // other.
        std::vector<FaceId> all_a = parts(faces.a, faces.face_a);
        for (std::size_t i = 0; i < all_a.size(); ++i) {
            std::vector<FaceId> all_b = parts(faces.b, faces.face_b);
            for (std::size_t j = 0; j < all_b.size(); ++j) {
                const Parts made = imprint_pair(side(faces.a, all_a[i]), side(faces.b, all_b[j]), pair.limit,
                                                context);
                all_a.insert(all_a.end(), made.a.begin() + 1, made.a.end());
                all_b.insert(all_b.end(), made.b.begin() + 1, made.b.end());
            }
            parts(faces.b, faces.face_b) = all_b;
        }
        parts(faces.a, faces.face_a) = all_a;
        imprint.report.push_back(
            formatted("imprinted: {} of {} and {} of {} share a part, which is now a face of both", face_a,
                      a.region, face_b, b.region));
    }
    return imprint;
}

std::vector<std::vector<double>> with_sag_of_parts(std::vector<std::vector<double>> sag,
                                                   const FaceImprint& imprint)
{
    for (std::size_t m = 0; m < sag.size(); ++m)
        for (const FaceId whole : imprint.parents[m]) sag[m].push_back(sag[m][whole.index()]);
    return sag;
}

ImprintedVolumes imprinted(std::span<const AssemblyMember> members, const RunContext& context)
{
    FacesInCommon found = faces_in_common(members, context);
    ImprintedVolumes result;
    for (const AssemblyMember& member : members) result.volumes.push_back(*member.volume);
    if (found.partly.empty()) {
        result.shared = std::move(found.whole);
        return result;
    }
    std::vector<AssemblyMember> split(members.begin(), members.end());
    for (std::size_t m = 0; m < split.size(); ++m) split[m].volume = &result.volumes[m];
    const FaceImprint imprint = imprint_faces(result.volumes, members, found.partly, context);
    result.shared = faces_in_common(split, context, with_sag_of_parts(found.sag, imprint)).whole;
    return result;
}

ImprintedVolumes imprinted_parts(std::span<const AssemblyMember> members,
                                 const std::function<bool(const SharedFace&, bool)>& takes,
                                 const RunContext& context)
{
    ImprintedVolumes result;
    std::vector<AssemblyMember> split(members.begin(), members.end());
    for (const AssemblyMember& member : members) result.volumes.push_back(*member.volume);
    for (std::size_t m = 0; m < split.size(); ++m) split[m].volume = &result.volumes[m];
    result.parents.resize(members.size());
    const auto is_taken = [&](const FacesInCommon& found, const SharedFace& pair) {
        const auto parent = [&](std::size_t m, FaceId face) {
            const std::size_t given = members[m].volume->model.faces.size();
            return face.index() < given ? face : result.parents[m][face.index() - given];
        };
        return takes({pair.a, pair.b, parent(pair.a, pair.face_a), parent(pair.b, pair.face_b)},
                     found.same_side.contains({pair.a, pair.b}));
    };
    const auto keep_taken = [&](FacesInCommon& found) {
        std::erase_if(found.whole, [&](const SharedFace& pair) { return !is_taken(found, pair); });
        std::erase_if(found.partly, [&](const PartlyShared& pair) { return !is_taken(found, pair.faces); });
    };
    FacesInCommon found = faces_in_common(split, context, {}, MayOverlap::yes);
    keep_taken(found);
    if (!found.partly.empty()) {
        FaceImprint imprint = imprint_faces(result.volumes, split, found.partly, context);
        found = faces_in_common(split, context, with_sag_of_parts(std::move(found.sag), imprint),
                                MayOverlap::yes);
        result.parents = std::move(imprint.parents);
        keep_taken(found);
        refuse_partly_shared(found);
    }
    result.shared = std::move(found.whole);
    return result;
}

} // namespace lacuna::sweep
