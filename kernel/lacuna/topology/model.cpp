// SPDX-License-Identifier: MIT
#include <lacuna/topology/model.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/edge_key.h>
#include <lacuna/core/shared/number_text.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/topology/detail/directed_sides.h>
#include <lacuna/topology/open_volume.h>
#include <lacuna/topology/shared/facet_area.h>
#include <lacuna/topology/shared/split_edge.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <string>
#include <unordered_map>

namespace lacuna::topology {

namespace {

/// A directed mesh segment on an edge.
struct SegmentOnEdge {
    EdgeUse use;
    bool starts = false; ///< whether the use starts with it
};

/// The segments of a model's edges, looked up by their ends.
class EdgeSegments {
public:
    EdgeSegments(const Model& model, const RunContext& context) : on_edge_(model.points.size(), false)
    {
        for (std::size_t e = 0; e < model.edges.size(); ++e) {
            check_cancelled(context);
            const std::vector<Index>& points = model.edges[e].points;
            for (const Index p : points) on_edge_[index(p)] = true;
            for (std::size_t i = 0; i + 1 < points.size(); ++i) {
                at_.try_emplace(directed_key(points[i], points[i + 1]),
                                SegmentOnEdge{{EdgeId(e), false}, i == 0});
                at_.try_emplace(directed_key(points[i + 1], points[i]),
                                SegmentOnEdge{{EdgeId(e), true}, i + 2 == points.size()});
            }
        }
    }

    /// Null if no segment joins the two points.
    [[nodiscard]] const SegmentOnEdge* find(Index from, Index to) const
    {
        if (!on_edge_[index(from)] || !on_edge_[index(to)]) return nullptr; // true for most facet sides
        const auto found = at_.find(directed_key(from, to));
        return found != at_.end() ? &found->second : nullptr;
    }

private:
    std::unordered_map<std::uint64_t, SegmentOnEdge> at_;
    std::vector<bool> on_edge_; ///< by point of the model
};

/// The sides of one face's triangles, and which of them are its border.
class FaceHalves {
public:
    /// @param sides  is filled with this face's sides.
    FaceHalves(const Model& model, const Face& face, const EdgeSegments& segments, DirectedSides& sides)
        : model_(model), face_(face), segments_(segments), sides_(sides)
    {
        sides_.read(face.triangles);
        const Index twice = sides_.first_repeated();
        if (twice < 0) return;
        throw InvalidInput(
            Message("topology.not_manifold",
                    "the facets of {} overlap or are not consistently oriented at the point {}", entity(),
                    place(from(index(twice))))
                .remedy("repair or remesh the face"));
    }

    [[nodiscard]] std::size_t size() const { return sides_.size(); }
    [[nodiscard]] Index from(std::size_t half) const { return sides_.from(half); }
    [[nodiscard]] Index to(std::size_t half) const { return sides_.to(half); }

    /// A half-edge on the face's border: no facet beyond it, or a seam to cut along.
    [[nodiscard]] bool on_border(std::size_t half) const
    {
        return segments_.find(from(half), to(half)) != nullptr || sides_.across(half) < 0;
    }

    /// The next border half-edge, found by rotating through the fan of facets at its end.
    [[nodiscard]] std::size_t next_on_border(std::size_t half) const
    {
        std::size_t next = half - half % 3 + (half + 1) % 3;
        for (std::size_t turns = 0; !on_border(next); ++turns) {
            const std::size_t across = index(sides_.across(next));
            next = across - across % 3 + (across + 1) % 3;
            if (turns > size()) {
                throw InvalidInput(Message("topology.not_manifold",
                                           "the facets of {} do not form a surface at the point {}", entity(),
                                           place(to(half)))
                                       .remedy("repair or remesh the face"));
            }
        }
        return next;
    }

    [[nodiscard]] const SegmentOnEdge& on_edge(std::size_t half) const
    {
        const SegmentOnEdge* found = segments_.find(from(half), to(half));
        if (found == nullptr) {
            throw InvalidInput("topology.loose_border",
                               "the border of {} leaves its edges at the point {}; each boundary side must "
                               "lie on an edge",
                               entity(), place(from(half)));
        }
        return *found;
    }

private:
    [[nodiscard]] NamedEntity entity() const { return {"face", face_.tag, face_.name}; }
    [[nodiscard]] std::string place(Index point) const { return place_with_digits(model_.at(point), 6); }

    const Model& model_;
    const Face& face_;
    const EdgeSegments& segments_;
    DirectedSides& sides_;
};

std::vector<Loop> loops_of(const Model& model, const Face& face, const EdgeSegments& segments,
                           DirectedSides& sides)
{
    const FaceHalves halves(model, face, segments, sides);
    std::vector<bool> seen(halves.size(), false);
    std::vector<Loop> loops;
    for (std::size_t start = 0; start < halves.size(); ++start) {
        if (seen[start] || !halves.on_border(start) || !halves.on_edge(start).starts) continue;
        Loop loop;
        for (std::size_t half = start; !seen[half]; half = halves.next_on_border(half)) {
            seen[half] = true;
            const SegmentOnEdge& on = halves.on_edge(half);
            if (on.starts) loop.uses.push_back(on.use);
        }
        loops.push_back(std::move(loop));
    }
    std::stable_sort(loops.begin(), loops.end(), [&](const Loop& a, const Loop& b) {
        return length_of(model, a.uses) > length_of(model, b.uses);
    });
    return loops;
}

void flip(Face& face)
{
    for (Triangle& t : face.triangles) std::swap(t[1], t[2]);
    for (std::array<Vec2, 3>& uv : face.uv) std::swap(uv[1], uv[2]);
    for (Quad& q : face.given_quads) std::swap(q[1], q[3]);
    for (Loop& loop : face.loops) {
        std::reverse(loop.uses.begin(), loop.uses.end());
        for (EdgeUse& use : loop.uses) use.reversed = !use.reversed;
    }
}

} // namespace

VertexId use_from(const Model& model, EdgeUse use)
{
    const Edge& edge = model[use.edge];
    return use.reversed ? edge.to : edge.from;
}

VertexId use_to(const Model& model, EdgeUse use)
{
    const Edge& edge = model[use.edge];
    return use.reversed ? edge.from : edge.to;
}

std::vector<Index> use_points(const Model& model, EdgeUse use)
{
    std::vector<Index> points = model[use.edge].points;
    if (use.reversed) std::reverse(points.begin(), points.end());
    return points;
}

double edge_length(const Model& model, EdgeId edge)
{
    return geometry::length(places_at(model, model[edge].points));
}

double face_area(const Model& model, FaceId face)
{
    double sum = 0;
    for (const Triangle& t : model[face].triangles) sum += facet_area_vector(model, t).norm();
    return sum;
}

bool has_quads_all_over(const Face& face)
{
    return !face.given_quads.empty() && 2 * face.given_quads.size() == face.triangles.size();
}

std::vector<Triangle> loose_triangles(const Face& face)
{
    const auto key = [](Index a, Index b, Index c) {
        Triangle sorted{a, b, c};
        std::sort(sorted.begin(), sorted.end());
        return sorted;
    };
    std::vector<Triangle> halves;
    halves.reserve(4 * face.given_quads.size());
    for (const Quad& q : face.given_quads) {
        for (std::size_t k = 0; k < 4; ++k) halves.push_back(key(q[k], q[(k + 1) % 4], q[(k + 2) % 4]));
    }
    std::sort(halves.begin(), halves.end());
    std::vector<Triangle> loose;
    for (const Triangle& t : face.triangles) {
        if (!std::binary_search(halves.begin(), halves.end(), key(t[0], t[1], t[2]))) loose.push_back(t);
    }
    return loose;
}

bool has_cells_to_keep(const Face& face, bool wedges)
{
    return has_quads_all_over(face) || (wedges && face.keeps_nodes);
}

Vec3 face_area_vector(const Model& model, FaceId face)
{
    Vec3 sum = Vec3::Zero();
    for (const Triangle& t : model[face].triangles) sum += facet_area_vector(model, t);
    return sum;
}

std::vector<FaceId> all_faces(const Model& model)
{
    std::vector<FaceId> faces;
    for (std::size_t f = 0; f < model.faces.size(); ++f) faces.emplace_back(f);
    return faces;
}

Vec3 face_centroid(const Model& model, FaceId face)
{
    Vec3 sum = Vec3::Zero();
    double area = 0;
    for (const Triangle& t : model[face].triangles) {
        const double a = (model.at(t[1]) - model.at(t[0])).cross(model.at(t[2]) - model.at(t[0])).norm();
        sum += a * (model.at(t[0]) + model.at(t[1]) + model.at(t[2])) / 3;
        area += a;
    }
    return area > 0 ? Vec3(sum / area) : model.at(model[face].triangles.front()[0]);
}

VertexId add_void_vertex(Model& model, Index point)
{
    int tag = 0;
    for (const Vertex& vertex : model.vertices) tag = std::max(tag, vertex.tag);
    model.vertices.push_back({point, tag + 1, Origin::made_void});
    return VertexId(model.vertices.size() - 1);
}

EdgeId add_void_edge(Model& model, VertexId from, VertexId to, std::vector<Index> points)
{
    Edge edge;
    edge.tag = next_tag(model.edges, Origin::made_void);
    edge.origin = Origin::made_void;
    edge.from = from;
    edge.to = to;
    edge.points = std::move(points);
    model.edges.push_back(std::move(edge));
    return EdgeId(model.edges.size() - 1);
}

FaceId add_void_face(Model& model, Geometry geometry)
{
    Face face;
    face.tag = next_tag(model.faces, Origin::made_void);
    face.origin = Origin::made_void;
    face.geometry = geometry;
    face.kind = "void";
    model.faces.push_back(std::move(face));
    return FaceId(model.faces.size() - 1);
}

void build_loops(Model& model, const RunContext& context)
{
    const EdgeSegments segments(model, context);
    DirectedSides sides(model.points.size());
    for (Face& face : model.faces) {
        check_cancelled(context);
        face.loops = loops_of(model, face, segments, sides);
    }
}

std::vector<std::vector<FaceUse>> edge_uses(const Model& model)
{
    std::vector<std::vector<FaceUse>> uses(model.edges.size());
    for (const FaceId face : all_faces(model))
        for (const EdgeUse& use : uses_of(model[face]))
            uses[use.edge.index()].push_back({face, use.reversed});
    return uses;
}

std::vector<std::vector<FaceId>> connected_parts(const Model& model, const std::vector<FaceId>& faces)
{
    const auto uses = edge_uses(model);
    std::vector<bool> wanted(model.faces.size(), false);
    for (const FaceId face : faces) wanted[face.index()] = true;
    std::vector<std::vector<FaceId>> parts;
    for (const FaceId start : faces) {
        if (!wanted[start.index()]) continue;
        wanted[start.index()] = false;
        std::vector<FaceId>& part = parts.emplace_back(std::vector{start});
        for (std::size_t i = 0; i < part.size(); ++i) {
            for (const EdgeUse& use : uses_of(model[part[i]])) {
                for (const FaceUse& other : uses[use.edge.index()]) {
                    if (!wanted[other.face.index()]) continue;
                    wanted[other.face.index()] = false;
                    part.push_back(other.face);
                }
            }
        }
    }
    return parts;
}

double volume_integral(const Model& model, const std::vector<FaceId>& faces)
{
    if (faces.empty()) return 0;
    const Vec3 origin = model.at(model[faces.front()].triangles.front()[0]);
    double sum = 0;
    for (const FaceId face : faces) {
        for (const Triangle& t : model[face].triangles) {
            sum += (model.at(t[0]) - origin).dot((model.at(t[1]) - origin).cross(model.at(t[2]) - origin));
        }
    }
    return sum / 6;
}

void flip_faces(Model& model, const std::vector<FaceId>& faces)
{
    for (const FaceId face : faces) flip(model[face]);
}

void orient_consistently(Model& model)
{
    const auto uses = edge_uses(model);
    for (std::size_t e = 0; e < uses.size(); ++e) {
        if (uses[e].size() <= 2) continue;
        std::vector<NamedEntity> faces;
        for (const FaceUse& use : uses[e]) faces.push_back(entity_of(model, use.face));
        throw InvalidInput(Message("topology.not_manifold",
                                   "{} is shared by {} faces ({}); the skin of a volume has {} at each edge",
                                   entity_of(model, EdgeId(e)), found(uses[e].size()), faces, needed(2))
                               .remedy("leave out the others"));
    }

    std::vector<bool> settled(model.faces.size(), false), flipped(model.faces.size(), false);
    for (const std::vector<FaceId>& part : connected_parts(model, all_faces(model))) {
        bool open = false;
        settled[part.front().index()] = true;
        std::vector<FaceId> front{part.front()};
        for (std::size_t i = 0; i < front.size(); ++i) {
            const FaceId face = front[i];
            for (const EdgeUse& use : uses_of(model[face])) {
                const auto& both = uses[use.edge.index()];
                open = open || both.size() < 2;
                if (both.size() < 2) continue;
                // The uses were listed before any flip; `use` includes the flips.
                const FaceUse& their = both[0].face == face ? both[1] : both[0];
                const FaceId other = their.face;
                if (other == face) continue;
                const bool agrees = (their.reversed != flipped[other.index()]) != use.reversed;
                if (settled[other.index()] && !agrees) {
                    throw InvalidInput(Message("topology.not_orientable",
                                               "{} and {} cannot be oriented consistently across {}: the "
                                               "faces form a one-sided band",
                                               entity_of(model, face), entity_of(model, other),
                                               entity_of(model, use.edge))
                                           .remedy("leave one of them out"));
                }
                if (settled[other.index()]) continue;
                if (!agrees) flip(model[other]);
                flipped[other.index()] = !agrees;
                settled[other.index()] = true;
                front.push_back(other);
            }
        }
        if (!open && volume_integral(model, part) < 0) flip_faces(model, part);
    }
}

} // namespace lacuna::topology
