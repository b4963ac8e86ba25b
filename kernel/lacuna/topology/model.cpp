// SPDX-License-Identifier: MIT
#include <lacuna/topology/model.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/edge_key.h>
#include <lacuna/core/shared/number_text.h>
#include <lacuna/core/shared/same_corners.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/topology/detail/directed_sides.h>
#include <lacuna/topology/open_volume.h>
#include <lacuna/topology/shared/facet_area.h>
#include <lacuna/topology/shared/names_of.h>
#include <lacuna/topology/shared/split_edge.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <numeric>
#include <string>
#include <unordered_map>
#include <utility>

namespace lacuna::topology {

namespace {

constexpr const char* kRepair =
    "repair or remesh the face, or load with a larger tolerance if its facets have gaps";

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
        if (!on_edge_[index(from)] || !on_edge_[index(to)]) return nullptr; // most facet sides leave here
        const auto found = at_.find(directed_key(from, to));
        return found != at_.end() ? &found->second : nullptr;
    }

private:
    std::unordered_map<std::uint64_t, SegmentOnEdge> at_;
    std::vector<bool> on_edge_; ///< for each model point, whether an edge contains it
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
                .remedy(
                    "repair or remesh the face, or load with a larger tolerance if its facets have gaps"));
    }

    [[nodiscard]] std::size_t size() const { return sides_.size(); }
    [[nodiscard]] Index from(std::size_t half) const { return sides_.from(half); }
    [[nodiscard]] Index to(std::size_t half) const { return sides_.to(half); }

    /// Whether a half-edge is on the face's border: it lies on an edge (also on a seam), or no facet is
    /// beyond it.
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
                                       .remedy("repair or remesh the face, or load with a larger tolerance "
                                               "if its facets have gaps"));
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

/// The parts that all empty models share.
const std::shared_ptr<const ModelParts>& nothing()
{
    static const auto parts = std::make_shared<const ModelParts>();
    return parts;
}

} // namespace

Model::Model(std::shared_ptr<const ModelParts> parts)
    : parts_(std::move(parts)),
      points(parts_->points),
      vertices(parts_->vertices),
      edges(parts_->edges),
      faces(parts_->faces),
      diagonal(parts_->diagonal),
      tolerance(parts_->tolerance),
      source(parts_->source),
      notes(parts_->notes)
{
}

Model::Model() : Model(nothing()) {}
Model::Model(Model&& other) noexcept : Model(std::as_const(other)) { other = Model(); }

Model& Model::operator=(Model other) noexcept
{
    std::destroy_at(this); // the members are references, which only a new object in its place can change
    return *std::construct_at(this, std::as_const(other));
}

ModelBuilder::ModelBuilder(Model from)
{
    const bool shared = from.parts_.use_count() != 1;
    std::atomic_thread_fence(std::memory_order_acquire); // after the last read by another thread
    ModelParts& parts = *this;
    if (shared)
        parts = *from.parts_;
    else
        parts = std::move(const_cast<ModelParts&>(*from.parts_)); // made as non-const by finish()
    uses_.clear();
    first_use_.clear();
}

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
    std::vector<Triangle> halves;
    halves.reserve(4 * face.given_quads.size());
    for (const Quad& q : face.given_quads) {
        for (std::size_t k = 0; k < 4; ++k)
            halves.push_back(rising(Triangle{q[k], q[(k + 1) % 4], q[(k + 2) % 4]}));
    }
    std::sort(halves.begin(), halves.end());
    std::vector<Triangle> loose;
    for (const Triangle& t : face.triangles) {
        if (!std::binary_search(halves.begin(), halves.end(), rising(t))) loose.push_back(t);
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

VertexId ModelBuilder::add_void_vertex(Index point)
{
    int tag = 0;
    for (const Vertex& vertex : vertices) tag = std::max(tag, vertex.tag);
    vertices.push_back({point, tag + 1, Origin::made_void});
    return VertexId(vertices.size() - 1);
}

EdgeId ModelBuilder::add_void_edge(VertexId from, VertexId to, std::vector<Index> chain)
{
    Edge edge;
    edge.tag = edge_tag_ = next_tag(edges, Origin::made_void, std::exchange(tagged_edges_, edges.size()),
                                    edge_tag_);
    edge.origin = Origin::made_void;
    edge.from = from;
    edge.to = to;
    edge.points = std::move(chain);
    edges.push_back(std::move(edge));
    return EdgeId(edges.size() - 1);
}

FaceId ModelBuilder::add_void_face(Geometry geometry)
{
    Face face;
    face.tag = face_tag_ = next_tag(faces, Origin::made_void, std::exchange(tagged_faces_, faces.size()),
                                    std::max(face_tag_, last_void_face + 1));
    face.origin = Origin::made_void;
    face.geometry = geometry;
    face.kind = "void";
    faces.push_back(std::move(face));
    return FaceId(faces.size() - 1);
}

void ModelBuilder::build_loops(const RunContext& context)
{
    const EdgeSegments segments(made_, context);
    DirectedSides sides(points.size());
    for (Face& face : faces) {
        check_cancelled(context);
        face.loops = loops_of(made_, face, segments, sides);
    }
}

void ModelBuilder::flip(FaceId id)
{
    Face& face = faces[id.index()];
    for (Triangle& t : face.triangles) std::swap(t[1], t[2]);
    for (std::array<Vec2, 3>& uv : face.uv) std::swap(uv[1], uv[2]);
    for (Quad& q : face.given_quads) std::swap(q[1], q[3]);
    for (Loop& loop : face.loops) {
        std::reverse(loop.uses.begin(), loop.uses.end());
        for (EdgeUse& use : loop.uses) use.reversed = !use.reversed;
    }
}

Model ModelBuilder::finish() &&
{
    first_use_.assign(edges.size() + 2, 0);
    for (const Face& face : faces)
        for (const EdgeUse& use : uses_of(face)) ++first_use_[use.edge.index() + 2];
    std::partial_sum(first_use_.begin(), first_use_.end(), first_use_.begin());
    uses_.resize(first_use_.back());
    // While uses are added, first_use_[e + 1] is the position of the next use of edge e. At the end it is the
    // start of the uses of edge e + 1.
    for (const FaceId face : all_faces(made_))
        for (const EdgeUse& use : uses_of(made_[face]))
            uses_[first_use_[use.edge.index() + 1]++] = {face, use.reversed};
    first_use_.pop_back();
    return Model(std::make_shared<ModelParts>(std::move(*this)));
}

Model with_loops(Model model, const RunContext& context)
{
    ModelBuilder builder(std::move(model));
    builder.build_loops(context);
    return std::move(builder).finish();
}

std::vector<std::vector<FaceId>> connected_parts(const Model& model, const std::vector<FaceId>& faces)
{
    std::vector<bool> wanted(model.faces.size(), false);
    for (const FaceId face : faces) wanted[face.index()] = true;
    std::vector<std::vector<FaceId>> parts;
    for (const FaceId start : faces) {
        if (!wanted[start.index()]) continue;
        wanted[start.index()] = false;
        std::vector<FaceId>& part = parts.emplace_back(std::vector{start});
        for (std::size_t i = 0; i < part.size(); ++i) {
            for (const EdgeUse& use : uses_of(model[part[i]])) {
                for (const FaceUse& other : model.uses_of_edge(use.edge)) {
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
    return faces.empty() ? 0
                         : volume_of_cones(model, faces, model.at(model[faces.front()].triangles.front()[0]));
}

double volume_of_cones(const Model& model, const std::vector<FaceId>& faces, const Vec3& apex)
{
    double sum = 0;
    for (const FaceId face : faces) {
        for (const Triangle& t : model[face].triangles) {
            sum += (model.at(t[0]) - apex).dot((model.at(t[1]) - apex).cross(model.at(t[2]) - apex));
        }
    }
    return sum / 6;
}

void flip_faces(Model& model, const std::vector<FaceId>& faces)
{
    if (faces.empty()) return;
    ModelBuilder builder(std::move(model));
    for (const FaceId face : faces) builder.flip(face);
    model = std::move(builder).finish();
}

namespace {

/// The faces beside a closed skin: those with a free edge, and then those to which their removal leaves one.
/// @param one  a face of the skin, or connected to it
/// @return  empty if no skin with two faces at each edge is left.
std::vector<FaceId> hanging_faces(const Model& model, FaceId one)
{
    std::vector<std::size_t> uses(model.edges.size());
    for (std::size_t e = 0; e < uses.size(); ++e) uses[e] = model.uses_of_edge(EdgeId(e)).size();
    const auto has_edge_of = [&](FaceId face, const auto& number_is) {
        return std::ranges::any_of(uses_of(model[face]),
                                   [&](const EdgeUse& use) { return number_is(uses[use.edge.index()]); });
    };
    std::vector<FaceId> hanging, rest;
    for (std::vector<FaceId>& part : connected_parts(model, all_faces(model)))
        if (std::ranges::count(part, one) > 0) rest = std::move(part);
    for (bool more = true; more;) {
        const auto loose = std::stable_partition(rest.begin(), rest.end(), [&](FaceId face) {
            return !has_edge_of(face, [](std::size_t number) { return number == 1; });
        });
        more = loose != rest.end();
        for (auto face = loose; face != rest.end(); ++face)
            for (const EdgeUse& use : uses_of(model[*face])) --uses[use.edge.index()];
        hanging.insert(hanging.end(), loose, rest.end());
        rest.erase(loose, rest.end());
    }
    const bool closed = !rest.empty() && std::ranges::none_of(rest, [&](FaceId face) {
        return has_edge_of(face, [](std::size_t number) { return number != 2; });
    });
    if (!closed) hanging.clear();
    return hanging;
}

} // namespace

void orient_consistently(Model& model)
{
    for (std::size_t e = 0; e < model.edges.size(); ++e) {
        const std::span<const FaceUse> uses = model.uses_of_edge(EdgeId(e));
        if (uses.size() <= 2) continue;
        std::vector<NamedEntity> faces;
        for (const FaceUse& use : uses) faces.push_back(entity_of(model, use.face));
        Message refusal("topology.not_manifold",
                        "{} is shared by {} faces ({}), but the skin of a volume has {} at each edge",
                        entity_of(model, EdgeId(e)), found(uses.size()), faces, needed(2));
        const std::vector<FaceId> hanging = hanging_faces(model, uses.front().face);
        if (hanging.empty())
            throw InvalidInput(
                std::move(refusal).remedy("name the faces round one space: open_volume{{ faces = … }}"));
        throw InvalidInput(std::move(refusal).remedy("leave out {}: without {}, the skin is closed",
                                                     entities_of(model, hanging),
                                                     hanging.size() == 1 ? "it" : "them"));
    }

    std::vector<bool> settled(model.faces.size(), false), flipped(model.faces.size(), false);
    std::vector<FaceId> against; // faces oriented against the first of their part
    std::vector<std::vector<FaceId>> closed;
    for (const std::vector<FaceId>& part : connected_parts(model, all_faces(model))) {
        bool open = false;
        settled[part.front().index()] = true;
        std::vector<FaceId> front{part.front()};
        for (std::size_t i = 0; i < front.size(); ++i) {
            const FaceId face = front[i];
            for (const Loop& loop : model[face].loops) {
                for (const EdgeUse& use : loop.uses) {
                    const std::span<const FaceUse> both = model.uses_of_edge(use.edge);
                    open = open || both.size() < 2;
                    if (both.size() < 2) continue;
                    const FaceUse& their = both[0].face == face ? both[1] : both[0];
                    const FaceId other = their.face;
                    if (other == face) continue;
                    const bool agrees = (their.reversed != flipped[other.index()]) !=
                                        (use.reversed != flipped[face.index()]);
                    if (settled[other.index()] && !agrees) {
                        throw InvalidInput(Message("topology.not_orientable",
                                                   "{} and {} cannot be oriented consistently across {}: the "
                                                   "faces form a one-sided band",
                                                   entity_of(model, face), entity_of(model, other),
                                                   entity_of(model, use.edge))
                                               .remedy("leave one of them out"));
                    }
                    if (settled[other.index()]) continue;
                    if (!agrees) against.push_back(other);
                    flipped[other.index()] = !agrees;
                    settled[other.index()] = true;
                    front.push_back(other);
                }
            }
        }
        if (!open) closed.push_back(part);
    }
    flip_faces(model, against);
    std::vector<FaceId> inward;
    for (const std::vector<FaceId>& part : closed)
        if (volume_integral(model, part) < 0) inward.insert(inward.end(), part.begin(), part.end());
    flip_faces(model, inward);
}

} // namespace lacuna::topology
