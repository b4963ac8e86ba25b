// SPDX-License-Identifier: MIT
#include <lacuna/fill/detail/touching_parts.h>

#include <lacuna/closure/shared/straighten_lines.h>
#include <lacuna/core/error.h>
#include <lacuna/geometry/shared/point_tree.h>
#include <lacuna/geometry/shared/union_find.h>
#include <lacuna/healing/shared/stitch.h>
#include <lacuna/sweep/shared/imprinted.h>
#include <lacuna/topology/open_volume.h>
#include <lacuna/topology/shared/bodies.h>
#include <lacuna/topology/shared/cone_shape.h>
#include <lacuna/topology/shared/face_facts.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/face_plane.h>
#include <lacuna/topology/shared/face_radius.h>
#include <lacuna/topology/shared/facet_area.h>
#include <lacuna/topology/shared/hollows.h>
#include <lacuna/topology/shared/names_of.h>
#include <lacuna/topology/shared/section.h>
#include <lacuna/topology/shared/split_edge.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace lacuna::fill {

using namespace topology;
using sweep::SharedFace;

namespace {

/// A connected part of the model.
struct TouchingBody {
    std::vector<FaceId> faces; ///< faces of the model
    Eigen::AlignedBox3d box;
    bool complete = false; ///< closed, and all its faces are named
};

/// The parts that contain named faces. An edge at which more than two faces meet does not connect parts:
/// solids touch along it.
std::vector<TouchingBody> bodies_named(const Model& model, const std::vector<char>& is_named)
{
    geometry::UnionFind sets(model.faces.size());
    std::vector<char> is_free(model.faces.size(), 0);
    for (std::size_t e = 0; e < model.edges.size(); ++e) {
        const std::span<const FaceUse> uses = model.uses_of_edge(EdgeId(e));
        if (uses.size() == 2)
            sets.unite_least(uses[0].face.index(), uses[1].face.index());
        else
            for (const FaceUse& use : uses) is_free[use.face.index()] = 1;
    }
    std::map<std::size_t, TouchingBody> by_root;
    for (const FaceId face : all_faces(model)) by_root[sets.find(face.index())].faces.push_back(face);
    std::vector<TouchingBody> bodies;
    for (auto& [root, body] : by_root) {
        if (std::ranges::none_of(body.faces, [&](FaceId f) { return is_named[f.index()] != 0; })) continue;
        body.complete = std::ranges::all_of(
            body.faces, [&](FaceId f) { return is_named[f.index()] != 0 && is_free[f.index()] == 0; });
        for (const FaceId face : body.faces) body.box.extend(box_of(model, face));
        body.box.min().array() -= model.tolerance;
        body.box.max().array() += model.tolerance;
        bodies.push_back(std::move(body));
    }
    return bodies;
}

/// Keep the bodies whose boxes meet the box of another body.
void keep_near(std::vector<TouchingBody>& bodies)
{
    std::vector<std::size_t> order(bodies.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t b) { return bodies[b].box.min().x(); });
    std::vector<char> meets(bodies.size(), 0);
    for (auto a = order.begin(); a != order.end(); ++a) {
        for (auto b = a + 1; b != order.end() && bodies[*b].box.min().x() <= bodies[*a].box.max().x(); ++b)
            if (bodies[*a].box.intersects(bodies[*b].box)) meets[*a] = meets[*b] = 1;
    }
    std::vector<TouchingBody> kept;
    for (std::size_t b = 0; b < bodies.size(); ++b)
        if (meets[b] != 0) kept.push_back(std::move(bodies[b]));
    bodies = std::move(kept);
}

/// An edge with an exact curve, and its points.
struct CurvedEdge {
    Edge edge;
    std::vector<Vec3> places;
};

/// Remove the exact curves of the edges along some points, because `stitch()` merges an exact edge with a
/// polyline only if the chords of the polyline lie on the curve.
std::vector<CurvedEdge> take_curves(ModelBuilder& model, const std::vector<Vec3>& along)
{
    const geometry::FacetTree tree = geometry::point_tree(along);
    std::vector<CurvedEdge> taken;
    for (Edge& edge : model.edges) {
        std::vector<Vec3> places = places_at(model, edge.points);
        if (!edge.curve || !std::ranges::all_of(places, [&](const Vec3& p) {
                return tree.closest(p, model.tolerance * model.tolerance).triangle >= 0;
            }))
            continue;
        taken.push_back({edge, std::move(places)});
        edge.curve = nullptr;
        edge.params.clear();
    }
    return taken;
}

void give_curves(ModelBuilder& model, const std::vector<CurvedEdge>& curves)
{
    for (Edge& edge : model.edges) {
        if (edge.curve) continue;
        std::vector<Vec3> places = places_at(model, edge.points);
        for (const bool reversed : {false, true}) {
            const auto own = std::ranges::find_if(curves, [&](const CurvedEdge& curved) {
                return std::ranges::equal(curved.places, places, [&](const Vec3& p, const Vec3& q) {
                    return (p - q).norm() <= model.tolerance;
                });
            });
            std::ranges::reverse(places);
            if (own == curves.end()) continue;
            edge.curve = own->edge.curve;
            edge.params = own->edge.params;
            if (reversed) std::ranges::reverse(edge.params);
            break;
        }
    }
}

template <class Entity>
void make_tags_unique(std::vector<Entity>& entities)
{
    int next = next_tag(entities, Origin::made_void, 0, next_tag(entities, Origin::given));
    std::set<int> taken;
    for (Entity& entity : entities)
        if (!taken.insert(entity.tag).second) entity.tag = next++;
}

/// Treats the parts of one model as members of an assembly, so that their faces in contact are found and
/// split.
class Joiner {
public:
    Joiner(const Model& model, std::vector<TouchingBody> bodies, std::vector<char> is_named, bool all_follow,
           const RunContext& context)
        : model_(model),
          bodies_(std::move(bodies)),
          is_named_(std::move(is_named)),
          all_follow_(all_follow),
          context_(context)
    {
    }

    std::optional<JoinedParts> run()
    {
        std::vector<OpenVolume> given(bodies_.size());
        std::vector<sweep::AssemblyMember> members(bodies_.size());
        for (std::size_t b = 0; b < bodies_.size(); ++b) {
            given[b].model = extract(model_, bodies_[b].faces);
            given[b].role.assign(bodies_[b].faces.size(), Role::wall);
            if (bodies_[b].complete) orient_consistently(given[b].model); // an open body has no inside
            members[b].volume = &given[b];
            members[b].region = "the body of " + name_of(model_, bodies_[b].faces.front());
        }
        for (std::size_t b = 0; b < bodies_.size(); ++b) split_off_contacts(b, given);
        sweep::ImprintedVolumes split = sweep::imprinted_parts(
            members, [&](const SharedFace& pair, bool same_side) { return is_contact(pair, same_side); },
            context_);
        if (split.shared.empty()) return std::nullopt;
        volumes_ = std::move(split.volumes);
        std::vector<Vec3> on_edges;
        for (const OpenVolume& own : given)
            for (const Edge& edge : own.model.edges)
                for (const Index p : edge.points) on_edges.push_back(own.model.at(p));
        const geometry::FacetTree tree = geometry::point_tree(on_edges);
        for (std::size_t b = 0; b < bodies_.size(); ++b) {
            for (const FaceId parent : split.parents[b]) bodies_[b].faces.push_back(original(b, parent));
            take_rims_of_others(b, split.parents[b], tree);
        }
        return joined(split.shared);
    }

private:
    /// The face of the original model of which a face of a body is a part.
    [[nodiscard]] FaceId original(std::size_t body, FaceId face) const
    {
        return bodies_[body].faces[face.index()];
    }

    /// Split the facets of bent faces that lie in flat faces of another body off the rest of these faces. A
    /// product whose edges are all rounded is one smooth face of facets, and only the flat part of it touches
    /// what it stands on.
    void split_off_contacts(std::size_t body, std::vector<OpenVolume>& given)
    {
        OpenVolume& volume = given[body];
        std::vector<std::pair<FaceId, Eigen::AlignedBox3d>> bent;
        const auto add = [&](FaceId id) {
            const Face& face = volume.model[id];
            if (!face.surface && face.given_quads.empty() && !plane_of(volume.model, id))
                bent.emplace_back(id, box_of(volume.model, id));
        };
        for (const FaceId face : all_faces(volume.model)) add(face);
        for (std::size_t other = 0; other < given.size() && !bent.empty(); ++other) {
            if (other == body || !bodies_[body].box.intersects(bodies_[other].box)) continue;
            for (const FaceId flat : all_faces(given[other].model)) {
                Eigen::AlignedBox3d reach = box_of(given[other].model, flat);
                reach.min().array() -= model_.tolerance;
                reach.max().array() += model_.tolerance;
                const auto plane = plane_of(given[other].model, flat);
                for (std::size_t b = 0; plane && b < bent.size(); ++b) {
                    if (!bent[b].second.intersects(reach)) continue;
                    const std::size_t before = volume.role.size();
                    split_off_plane(body, volume, bent[b].first, *plane, reach);
                    for (std::size_t f = before; f < volume.role.size(); ++f) add(FaceId(f));
                }
            }
        }
    }

    /// @param within  only facets in this box count
    void split_off_plane(std::size_t body, OpenVolume& volume, FaceId face, geometry::Plane plane,
                         const Eigen::AlignedBox3d& within)
    {
        const Model& model = volume.model;
        const std::vector<Triangle>& facets = model[face].triangles;
        const auto first = std::ranges::find_if(facets, [&](const Triangle& t) {
            return std::ranges::all_of(t, [&](Index p) {
                return std::abs(geometry::height(plane, model.at(p))) <= model.tolerance &&
                       within.contains(model.at(p));
            });
        });
        if (first == facets.end()) return;
        if (facet_area_vector(model, *first).dot(plane.normal) > 0) plane.normal = -plane.normal;
        // Turned over, the facets in the plane count as behind it and those beside them as in front of it.
        Model turned = model;
        flip_faces(turned, {face});
        std::vector<SectionWalk> walks = section_walks(turned, {face}, plane, model.tolerance);
        std::erase_if(walks, [](const SectionWalk& walk) {
            return std::ranges::any_of(walk.places, [](const SectionPlace& place) { return place.b >= 0; });
        });
        ModelBuilder builder(model);
        const WalkImprint made = imprint_walks(builder, walks, plane, model.tolerance, context_);
        for (std::size_t f = volume.role.size(); f < made.parent.size(); ++f) {
            bodies_[body].faces.push_back(original(body, made.parent[f]));
            volume.role.push_back(Role::wall);
        }
        volume.model = std::move(builder).finish();
    }

    /// Whether the corners of two round faces show that a gap separates their surfaces. Facets of such faces
    /// cross if the gap is thinner than their sag.
    [[nodiscard]] bool are_apart(FaceId a, FaceId b) const
    {
        const auto one = round_shape(model_, a), other = round_shape(model_, b);
        if (!one || !other) return false;
        const double error = off_shape(*one, a) + off_shape(*other, b);
        return std::max(off_shape(*one, b), off_shape(*other, a)) > model_.tolerance + error;
    }

    /// Maximum distance of a face's corners from a shape [model length].
    [[nodiscard]] double off_shape(const RoundShape& shape, FaceId face) const
    {
        double off = 0;
        for (const Index p : corner_points(model_[face]))
            off = std::max(off, std::abs(shape.height(model_.at(p))));
        return off;
    }

    /// Whether faces of two bodies are in contact. Two closed skins that touch from outside (solids side by
    /// side) count as in contact only if they are inside a third body.
    [[nodiscard]] bool is_contact(const SharedFace& pair, bool same_side) const
    {
        const TouchingBody &a = bodies_[pair.a], &b = bodies_[pair.b];
        if (!all_follow_ && is_named_[original(pair.a, pair.face_a).index()] == 0 &&
            is_named_[original(pair.b, pair.face_b).index()] == 0)
            return false;
        if (are_apart(original(pair.a, pair.face_a), original(pair.b, pair.face_b))) return false;
        if (!a.complete || !b.complete || same_side) return true;
        return std::ranges::any_of(bodies_, [&](const TouchingBody& other) {
            return &other != &a && &other != &b && other.box.contains(a.box) && other.box.contains(b.box);
        });
    }

    /// Remove the points of lines that divide flat faces, except points on edges of the model. A line and the
    /// rim that it follows then become one edge.
    /// @param tree  tree of the points on the edges of the bodies
    void take_rims_of_others(std::size_t b, const std::vector<FaceId>& parents,
                             const geometry::FacetTree& tree)
    {
        const double near = model_.tolerance * model_.tolerance;
        Model& model = volumes_[b].model;
        for (const FaceId face : std::set<FaceId>(parents.begin(), parents.end())) {
            const auto flat = plane_of(model, face);
            if (!flat) continue;
            std::vector<FaceId> parts;
            for (const FaceId part : all_faces(model))
                if (original(b, part) == original(b, face)) parts.push_back(part);
            if (!std::ranges::all_of(parts, [&](FaceId part) { return lies_in_plane(model, part, *flat); }))
                continue;
            std::vector<EdgeUse> lines;
            for (std::size_t e = 0; e < model.edges.size(); ++e)
                if (std::ranges::all_of(model.uses_of_edge(EdgeId(e)), [&](const FaceUse& use) {
                        return std::ranges::find(parts, use.face) != parts.end();
                    }))
                    lines.push_back({EdgeId(e), false});
            closure::straighten_lines(model, parts, *flat, {lines}, context_,
                                      [&](const Vec3& p) { return tree.closest(p, near).triangle >= 0; });
        }
    }

    /// Points of the rims of faces in contact.
    [[nodiscard]] std::vector<Vec3> rims_of(const std::vector<SharedFace>& contacts) const
    {
        std::vector<Vec3> places;
        const auto add_rim = [&](const Model& model, FaceId face) {
            for (const EdgeUse& use : uses_of(model[face])) {
                const std::vector<Vec3> own = places_at(model, model[use.edge].points);
                places.insert(places.end(), own.begin(), own.end());
            }
        };
        for (const SharedFace& pair : contacts) {
            add_rim(volumes_[pair.a].model, pair.face_a);
            add_rim(volumes_[pair.b].model, pair.face_b);
        }
        return places;
    }

    /// The model without the faces in contact, its edges merged along their rims.
    JoinedParts joined(const std::vector<SharedFace>& contacts)
    {
        std::set<std::pair<std::size_t, FaceId>> gone;
        for (const SharedFace& pair : contacts) {
            gone.emplace(pair.a, pair.face_a);
            gone.emplace(pair.b, pair.face_b);
        }
        ModelBuilder parts;
        parts.diagonal = model_.diagonal;
        parts.tolerance = model_.tolerance;
        parts.source = model_.source;
        parts.notes = model_.notes;
        std::vector<FaceId> was; // for each face of `parts`, the original model's face
        for (std::size_t b = 0; b < bodies_.size(); ++b) {
            std::vector<FaceId> kept;
            for (const FaceId face : all_faces(volumes_[b].model)) {
                if (gone.contains({b, face})) continue;
                kept.push_back(face);
                was.push_back(original(b, face));
            }
            add_model(parts, extract(volumes_[b].model, kept));
        }
        // Use tags to recognise the remaining faces after stitching.
        for (std::size_t f = 0; f < was.size(); ++f) parts.faces[f].tag = static_cast<int>(f);
        const std::vector<CurvedEdge> curves = take_curves(parts, rims_of(contacts));
        Model stitched = std::move(parts).finish();
        healing::stitch(stitched, model_.tolerance, context_);
        ModelBuilder whole(std::move(stitched));
        give_curves(whole, curves);
        JoinedParts result;
        result.faces_of.resize(model_.faces.size());
        std::vector<char> is_other(model_.faces.size(), 1);
        for (std::size_t f = 0; f < whole.faces.size(); ++f) {
            const FaceId before = was[static_cast<std::size_t>(whole.faces[f].tag)];
            whole.faces[f].tag = model_[before].tag;
            result.faces_of[before.index()].emplace_back(f);
        }
        for (const TouchingBody& body : bodies_)
            for (const FaceId face : body.faces) is_other[face.index()] = 0;
        std::vector<FaceId> others;
        for (const FaceId face : all_faces(model_)) {
            if (is_other[face.index()] == 0) continue;
            result.faces_of[face.index()].emplace_back(whole.faces.size() + others.size());
            others.push_back(face);
        }
        add_model(whole, extract(model_, others));
        make_tags_unique(whole.edges);
        make_tags_unique(whole.vertices);
        result.model = std::move(whole).finish();
        const SharedFace& first = contacts.front();
        result.note = formatted("note: {} and {} touch; the area that they share does not bound the volume",
                                entity_of(model_, original(first.a, first.face_a)),
                                entity_of(model_, original(first.b, first.face_b)));
        return result;
    }

    const Model& model_;
    std::vector<TouchingBody> bodies_; ///< their faces include the parts of split faces, as in `volumes_`
    std::vector<char> is_named_;
    bool all_follow_;
    const RunContext& context_;
    std::vector<OpenVolume> volumes_;
};

/// The model without some faces. Empty if there are none.
std::optional<JoinedParts> without_faces(const Model& model, const std::vector<FaceId>& gone,
                                         std::string note)
{
    if (gone.empty()) return std::nullopt;
    JoinedParts result;
    result.note = std::move(note);
    result.faces_of.resize(model.faces.size());
    std::vector<FaceId> kept;
    for (const FaceId face : all_faces(model)) {
        if (std::ranges::find(gone, face) != gone.end()) continue;
        result.faces_of[face.index()].emplace_back(kept.size());
        kept.push_back(face);
    }
    result.model = extract(model, kept);
    return result;
}

} // namespace

std::optional<JoinedParts> leave_out_other_bodies(const Model& model, const std::vector<FaceId>& ends,
                                                  const RunContext& context)
{
    std::vector<Body> around = topology::bodies(model, context);
    if (around.size() < 2) return std::nullopt;
    std::erase_if(around, [&](const Body& body) {
        const auto is_in = [&](FaceId face) { return std::ranges::binary_search(body.faces, face); };
        if (!std::ranges::all_of(ends, is_in)) return true;
        std::vector<FaceId> own;
        for (const FaceId face : ends)
            own.emplace_back(
                static_cast<std::size_t>(std::ranges::lower_bound(body.faces, face) - body.faces.begin()));
        return !cavity_round(extract(model, body.faces), own, context).empty();
    });
    if (around.empty()) return std::nullopt;
    if (around.size() > 1)
        throw InvalidInput(Message("topology.walls_ambiguous",
                                   "walls = \"auto\": the named ends bound both {} and {}", around[0].name,
                                   around[1].name)
                               .remedy("give faces = {{ region = \"{}\" }} instead of the roles, or name "
                                       "the other end too",
                                       around[0].name));
    std::vector<FaceId> gone = all_faces(model);
    std::erase_if(gone, [&](FaceId face) { return std::ranges::binary_search(around[0].faces, face); });
    return without_faces(
        model, gone,
        formatted("note: the walls are searched on {}, which the named ends bound", around[0].name));
}

std::optional<JoinedParts> leave_out_double_faces(const Model& model, const std::vector<FaceId>& ends)
{
    std::vector<FaceId> order = ends;
    std::ranges::copy(all_faces(model), std::back_inserter(order));
    std::map<std::set<EdgeId>, FaceId> first;
    std::vector<FaceId> gone;
    std::string note;
    for (const FaceId face : order) {
        const auto [own, added] = first.emplace(edges_of(model, {face}), face);
        const FaceId other = own->second;
        if (added || other == face || own->first.empty() ||
            (face_centroid(model, face) - face_centroid(model, other)).norm() > model.tolerance)
            continue;
        if (gone.empty())
            note = formatted("note: {} is left out, because it coincides with {}", entity_of(model, face),
                             entity_of(model, other));
        gone.push_back(face);
    }
    return without_faces(model, gone, note);
}

std::optional<JoinedParts> leave_out_shared_faces(const Model& model, const std::vector<FaceId>& named,
                                                  bool all_follow)
{
    std::vector<int> uses(model.edges.size(), 0);
    for (const FaceId face : all_follow ? all_faces(model) : named)
        for (const EdgeUse& use : uses_of(model[face])) ++uses[use.edge.index()];
    std::vector<FaceId> shared;
    for (const FaceId face : all_faces(model)) {
        const bool is_end = all_follow && std::ranges::find(named, face) != named.end();
        if (!is_end && !model[face].loops.empty() &&
            std::ranges::all_of(uses_of(model[face]),
                                [&](const EdgeUse& use) { return uses[use.edge.index()] == 3; }))
            shared.push_back(face);
    }
    return without_faces(
        model, shared,
        shared.empty() ? ""
                       : formatted("note: {} is left out, because two other faces meet at each of its edges",
                                   entity_of(model, shared.front())));
}

void add_model(ModelBuilder& builder, const Model& more)
{
    ModelBuilder given(more);
    for (Vertex& vertex : given.vertices) vertex.origin = Origin::given;
    for (Edge& edge : given.edges) edge.origin = Origin::given;
    healing::append(builder, std::move(given).finish());
}

std::optional<JoinedParts> join_touching_parts(const Model& model, const std::vector<FaceId>& named,
                                               bool all_follow, const RunContext& context)
{
    std::vector<char> is_named(model.faces.size(), 0);
    for (const FaceId face : named) is_named[face.index()] = 1;
    std::vector<TouchingBody> bodies = bodies_named(model, is_named);
    keep_near(bodies);
    if (bodies.size() < 2) return std::nullopt;
    return Joiner(model, std::move(bodies), std::move(is_named), all_follow, context).run();
}

} // namespace lacuna::fill
