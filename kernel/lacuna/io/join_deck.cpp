// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/mesh_deck.h>

#include <lacuna/core/error.h>
#include <lacuna/core/run_context.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/same_corners.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/io/detail/deck_writer.h>
#include <lacuna/io/detail/join_sets.h>
#include <lacuna/io/detail/texts.h>
#include <lacuna/io/shared/mixed_deck.h>
#include <lacuna/topology/shared/cone_shape.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <ranges>
#include <set>
#include <unordered_map>

namespace lacuna::io {
namespace {

template <class Mesh>
class Joiner {
public:
    /// @param before  null: no mesh joined the deck before
    Joiner(const Deck& deck, const topology::Model& model, double scale, const Mesh& mesh,
           const JoinedBefore* before)
        : deck_(deck),
          model_(model),
          scale_(scale),
          mesh_(mesh),
          of_file_(before != nullptr ? before->of_file : deck.points.size()),
          known_(mesh.node_count(), -1)
    {
        for (std::size_t n = 0; before != nullptr && before->number && n < known_.size(); ++n)
            if (const std::size_t number = index(before->number(static_cast<Index>(n)));
                number < before->points.size())
                known_[n] = before->points[number];
    }

    /// Whether each quad of the skin is a face of an element of the deck.
    const std::vector<bool>& match()
    {
        find_nodes();
        match_faces();
        return matched_;
    }

    /// The deck's point for each node of the mesh; -1: none.
    /// @param gone  whether each quad of the skin was a face of an element that was left out.
    std::vector<Index> points(const std::vector<bool>& gone)
    {
        match();
        check_patches(gone);
        if (std::ranges::find(gone, true) == gone.end()) {
            check_quads_on_deck();
            check_lone_nodes();
        }
        std::vector<Index> points(mesh_.nodes.size(), -1);
        for (std::size_t n = 0; n < points.size(); ++n) points[n] = point_of(n);
        join_middles(deck_, mesh_, matched_, kSamePlace * model_.diagonal, scale_, points);
        points.resize(known_.size(), -1);
        for (std::size_t n = mesh_.nodes.size(); n < points.size(); ++n)
            if (known_[n] >= 0) points[n] = known_[n];
        return points;
    }

    /// The region with the most faces on the mesh among those whose material is known; null: none.
    /// @pre  points() was called
    [[nodiscard]] const DeckRegion* neighbour() const
    {
        const DeckRegion* best = nullptr;
        std::size_t most = 0;
        for (std::size_t r = 0; r < touching_.size(); ++r)
            if (!deck_.regions[r].material.empty() && touching_[r] > most) {
                best = &deck_.regions[r];
                most = touching_[r];
            }
        return best;
    }

    /// Log a note if elements of the deck overlap with the mesh.
    /// @pre  points() was called
    void note_inside(const RunContext& context) const
    {
        if (inside_.empty()) return;
        const auto [tag, region] = *inside_.begin();
        const std::string name = region >= 0 ? deck_.regions[index(region)].name : std::string();
        log_line(context,
                 formatted("note: the mesh overlaps {} of the deck's elements, such as element {}{}; "
                           "the option 'without' leaves them out",
                           inside_.size(), tag, name.empty() ? "" : " of " + name));
    }

private:
    void find_nodes()
    {
        std::vector<bool> on_skin(mesh_.nodes.size(), false);
        for (std::size_t i = 0; i < mesh_.skin_count(); ++i)
            for (const Index node : skin_quad(mesh_, i).nodes) on_skin[index(node)] = true;
        std::vector<Vec3> places;
        for (std::size_t n = 0; n < on_skin.size(); ++n)
            if (on_skin[n]) {
                skin_.push_back(static_cast<Index>(n));
                places.push_back(mesh_.nodes[n]);
            }
        at_ = nodes_at(deck_, places, kSamePlace * model_.diagonal, scale_);
        node_of_.assign(deck_.points.size(), -1);
        candidates_.resize(mesh_.nodes.size());
        for (std::size_t i = 0; i < skin_.size(); ++i) {
            const std::size_t node = index(skin_[i]);
            const auto at = at_.at(i); // rising: points of meshes that joined before come last
            const auto of_file = std::ranges::lower_bound(at, static_cast<Index>(of_file_)) - at.begin();
            candidates_[node] = known_[node] >= 0 ? std::span<const Index>(&known_[node], 1)
                                                  : at.first(static_cast<std::size_t>(of_file));
            for (const Index point : candidates_[node]) node_of_[index(point)] = skin_[i];
        }
    }

    /// Find the deck's faces and sides on the skin. Where points of the deck coincide, each face and side
    /// votes for its own points.
    void match_faces()
    {
        by_face_.assign(mesh_.nodes.size(), {-1, -1});
        by_side_ = by_face_;
        matched_.assign(mesh_.skin_count(), false);
        std::unordered_map<Quad, std::uint32_t, CornerHash<4>> faces;
        std::unordered_map<Segment, char, CornerHash<2>> sides;
        for (std::size_t i = 0; i < mesh_.skin_count(); ++i) {
            const Quad quad = skin_quad(mesh_, i).nodes;
            faces.emplace(face_key(quad), static_cast<std::uint32_t>(i));
            for (std::size_t k = 0; k < 4; ++k) sides.emplace(rising(Segment{quad[k], quad[(k + 1) % 4]}), 0);
        }
        touching_.assign(deck_.regions.size(), 0);
        const auto take = [&](std::span<const Index> points, Index region, const Element* solid) {
            Quad nodes{-1, -1, -1, -1};
            const std::size_t corners = points.size();
            bool all = true; // whether all corners lie on the skin
            for (std::size_t k = 0; k < corners; ++k) {
                nodes[k] = node_of_[index(points[k])];
                all = all && nodes[k] >= 0;
            }
            if (const auto found = all ? faces.find(rising(nodes)) : faces.end(); found != faces.end()) {
                matched_[found->second] = true;
                if (region >= 0) ++touching_[index(region)];
                if (solid != nullptr && is_inside(*solid, found->second)) inside_[solid->tag] = region;
                for (std::size_t k = 0; k < corners; ++k) vote(by_face_, nodes[k], points[k]);
            }
            for (std::size_t k = 0; k < corners; ++k) {
                const std::size_t next = (k + 1) % corners;
                if (!sides.contains(rising(Segment{nodes[k], nodes[next]}))) continue;
                vote(by_side_, nodes[k], points[k]);
                vote(by_side_, nodes[next], points[next]);
            }
        };
        for (const DeckBlock& block : deck_.blocks)
            for (std::size_t e = 0; e < block.count(); ++e) each_face(block, e, take);
    }

    struct Element {
        DeckTag tag;
        std::span<const Index> corners;
    };

    /// Whether an element with a face on quad `i` of the skin lies on the same side of it as the mesh.
    [[nodiscard]] bool is_inside(const Element& element, std::size_t i) const
    {
        Quad quad = skin_quad(mesh_, i).nodes; // the skin faces outward
        if (quad[3] < 0) quad[3] = quad[2];    // a triangle
        const auto at = [&](std::size_t k) -> const Vec3& { return mesh_.nodes[index(quad[k])]; };
        const Vec3 normal = (at(2) - at(0)).cross(at(3) - at(1));
        double height = 0; // of the element's corners above the quad
        for (const Index point : element.corners)
            for (std::size_t k = 0; k < 4; ++k)
                height += normal.dot(deck_.points[index(point)] * scale_ - at(k));
        return height < 0;
    }

    /// Call `take` for each face of an element, if at least two corners of the element are on the skin.
    template <class Take>
    void each_face(const DeckBlock& block, std::size_t e, const Take& take) const
    {
        const std::span<const Index> element = block.element(e);
        const DeckShapeInfo& info = shape_info(block.shape);
        const auto corners = element.first(index(info.corners));
        const auto is_on = [&](Index point) { return node_of_[index(point)] >= 0; };
        if (info.dimension < 2 || std::ranges::count_if(corners, is_on) < 2) return;
        if (info.dimension == 2) return take(corners, block.regions[e], nullptr);
        const Element solid{block.tags[e], corners};
        for (const Quad& face : face_corners(block.shape)) {
            Quad points{};
            const std::size_t count = face[3] < 0 ? 3 : 4;
            for (std::size_t k = 0; k < count; ++k) points[k] = element[index(face[k])];
            take(std::span<const Index>(points).first(count), block.regions[e], &solid);
        }
    }

    using Votes = std::vector<std::array<Index, 2>>; ///< for each node, at most two different points that
                                                     ///< were voted for

    static void vote(Votes& votes, Index node, Index point)
    {
        if (node < 0) return;
        std::array<Index, 2>& of = votes[index(node)];
        if (of[0] < 0 || of[0] == point)
            of[0] = point;
        else
            of[1] = point;
    }

    [[nodiscard]] Index point_of(std::size_t node) const
    {
        const std::span<const Index> candidates = candidates_[node];
        if (candidates.empty()) return -1;
        if (candidates.size() == 1) return candidates[0];
        for (const Votes* votes : {&by_face_, &by_side_}) {
            const auto& [first, second] = (*votes)[node];
            if (first < 0) continue;
            if (second < 0) return first;
            refuse(node, first, second);
        }
        refuse(node, candidates[0], candidates[1]);
    }

    [[noreturn]] void refuse(std::size_t node, Index first, Index second) const
    {
        const Vec3& p = mesh_.nodes[node];
        throw InvalidInput(Message("io.nodes_coincide",
                                   "{} and {} of the deck both lie at ({}, {}, {}), where the mesh has one "
                                   "node, and adjacent elements use both",
                                   numbered("node", deck_.point_tags[index(first)]),
                                   numbered("node", deck_.point_tags[index(second)]), p.x(), p.y(), p.z())
                               .remedy("merge coincident nodes in the deck"));
    }

    /// Check that every quad of the mesh that lies on a face of the deck is a face of an element of the deck.
    void check_patches(const std::vector<bool>& gone) const
    {
        std::vector<std::array<std::size_t, 2>> counts(mesh_.patches.size(), {0, 0});
        for (std::size_t i = 0; i < mesh_.skin_count(); ++i) {
            std::array<std::size_t, 2>& of = counts[index(skin_quad(mesh_, i).patch)];
            ++of[0];
            if (matched_[i] || gone[i]) ++of[1];
        }
        for (std::size_t p = 0; p < counts.size(); ++p) {
            const auto [quads, matched] = counts[p];
            const mesh::SkinPatch& patch = mesh_.patches[p];
            const std::optional<FaceId> id = face_of(patch);
            if (!id || matched == quads || faces_of_deck({*id}).empty()) continue;
            const topology::Face& face = model_[*id];
            const std::size_t given = face.given_quads.size();
            const std::size_t triangles = face.triangles.size() - std::min(2 * given, face.triangles.size());
            const Message why(
                "io.not_conformal",
                "{}: only {} of the mesh's {} quads match the deck, whose elements have {} quads "
                "and {} triangles there",
                entity_of(patch), found(matched), needed(quads), given, triangles);
            if (triangles > 0)
                throw InvalidInput(
                    why.remedy("only tetrahedra keep the triangles: sweep with quads = \"keep\" "
                               "and fallback = \"mixed\""));
            if (given == 0) throw InvalidInput(why.remedy("load the deck with keep_mesh = true"));
            throw InvalidInput(
                why.remedy("sweep with quads = \"auto\" or \"keep\", and with wedges = true if a rim has an "
                           "odd number of sides; if the quads of both ends differ, only the source keeps "
                           "its own: write without 'with' and tie the other end"));
        }
    }

    /// Check that at most one node of the mesh is a node of the deck where no side of an element is common.
    void check_lone_nodes() const
    {
        const auto is_alone = [&](Index node) {
            return known_[index(node)] < 0 && !candidates_[index(node)].empty() &&
                   by_face_[index(node)][0] < 0 && by_side_[index(node)][0] < 0;
        };
        const auto alone = std::ranges::count_if(skin_, is_alone);
        if (alone < 2) return;
        const Vec3& p = mesh_.nodes[index(*std::ranges::find_if(skin_, is_alone))];
        throw InvalidInput(
            Message("io.not_conformal",
                    "{} nodes of the mesh lie on nodes of the deck, such as the one at ({}, {}, {}), but no "
                    "sides of elements there are common",
                    found(alone), p.x(), p.y(), p.z())
                .remedy(
                    "name the deck's faces there among the volume's, or write the mesh without 'with' and "
                    "tie it to the deck"));
    }

    /// Check that no quad of the mesh lies on a face of the deck without being a face of its elements.
    void check_quads_on_deck() const
    {
        std::vector<Vec3> centres; // of the quads that no element shares
        Eigen::AlignedBox3d box;
        for (std::size_t i = 0; i < mesh_.skin_count(); ++i) {
            if (matched_[i]) continue;
            const Quad quad = skin_quad(mesh_, i).nodes;
            const std::size_t corners = quad[3] < 0 ? 3 : 4;
            Vec3 centre = Vec3::Zero();
            for (std::size_t k = 0; k < corners; ++k) centre += mesh_.nodes[index(quad[k])];
            centres.emplace_back(centre / static_cast<double>(corners));
            box.extend(centres.back());
        }
        if (centres.empty()) return;
        box.min().array() -= model_.tolerance;
        box.max().array() += model_.tolerance;
        std::set<int> own; // faces on which patches of the mesh lie
        for (const mesh::SkinPatch& patch : mesh_.patches) own.insert(patch.face);
        const auto is_near = [&](const Triangle& t) {
            Eigen::AlignedBox3d around;
            for (const Index p : t) around.extend(model_.at(p));
            return box.intersects(around);
        };
        std::vector<FaceId> near = topology::all_faces(model_);
        std::erase_if(near, [&](FaceId face) {
            return own.contains(model_[face].tag) || std::ranges::none_of(model_[face].triangles, is_near);
        });
        std::vector<Triangle> facets;
        std::vector<FaceId> face_of_facet;
        for (const FaceId face : faces_of_deck(near)) {
            std::ranges::copy_if(model_[face].triangles, std::back_inserter(facets), is_near);
            face_of_facet.resize(facets.size(), face);
        }
        std::map<FaceId, std::size_t> quads;
        const geometry::FacetTree tree(model_.points, facets);
        for (const Vec3& centre : centres) {
            const auto hit = tree.closest(centre, model_.tolerance * model_.tolerance);
            if (hit.triangle >= 0) ++quads[face_of_facet[index(hit.triangle)]];
        }
        if (quads.empty()) return;
        const auto [face, count] = *quads.begin();
        throw InvalidInput(
            Message("io.not_conformal",
                    "{} of the mesh's quads lie on {} of the deck, but are no faces of its elements",
                    found(count), topology::entity_of(model_, face))
                .remedy(
                    "name that face among the volume's, in place of the one that lies on it, or write the "
                    "mesh without 'with' and tie it to the deck"));
    }

    /// The model's face on which a patch lies; empty for a patch of a void face.
    [[nodiscard]] std::optional<FaceId> face_of(const mesh::SkinPatch& patch) const
    {
        if (patch.face == 0) return std::nullopt;
        const auto found = std::ranges::find(model_.faces, patch.face, &topology::Face::tag);
        if (found == model_.faces.end())
            throw InvalidInput(Message("io.other_model",
                                       "option 'with': the mesh has {}, but the first model does not",
                                       numbered("face", patch.face))
                                   .remedy("list the model from which the volume was made as the first"));
        return FaceId(static_cast<std::size_t>(found - model_.faces.begin()));
    }

    /// The faces whose points are all points of the deck.
    [[nodiscard]] std::vector<FaceId> faces_of_deck(const std::vector<FaceId>& faces) const
    {
        std::vector<Vec3> places;
        std::vector<std::size_t> first{0}; // place of each face, and the end
        for (const FaceId face : faces) {
            for (const Index p : topology::corner_points(model_[face])) places.push_back(model_.at(p));
            first.push_back(places.size());
        }
        const NodesAt at = nodes_at(deck_, places, kSamePlace * model_.diagonal, scale_);
        std::vector<FaceId> result;
        for (std::size_t f = 0; f < faces.size(); ++f)
            if (std::ranges::none_of(std::views::iota(first[f], first[f + 1]),
                                     [&](std::size_t i) { return at.at(i).empty(); }))
                result.push_back(faces[f]);
        return result;
    }

    const Deck& deck_;
    const topology::Model& model_;
    double scale_;
    const Mesh& mesh_;
    std::size_t of_file_;      ///< number of the deck's points without those of meshes that joined before
    std::vector<Index> known_; ///< for each node of the mesh: its point, if a mesh that joined before has it
    std::vector<Index> skin_;  ///< nodes of the mesh's skin
    NodesAt at_;               ///< points of the deck at these nodes
    std::vector<std::span<const Index>> candidates_; ///< points of the deck at each node of the mesh, in
                                                     ///< `at_`
    /// Node of the mesh at each of the deck's points; -1: none.
    std::vector<Index> node_of_;
    Votes by_face_, by_side_;
    std::vector<bool> matched_;         ///< for each quad of the skin, whether an element of the deck has it
    std::vector<std::size_t> touching_; ///< for each region, number of its faces on the skin
    std::map<DeckTag, Index> inside_;   ///< elements that overlap with the mesh, and their regions
};

template <class Mesh>
Deck joined(const Deck& deck, const topology::Model& model, double scale, const Mesh& mesh,
            const MeshDeckOptions& options, const RunContext& context, const Deck* gone, JoinedBefore* before)
{
    std::vector<bool> was_there(mesh.skin_count(), false);
    if (before != nullptr && before->meshes == 0) before->of_file = deck.points.size();
    if (gone != nullptr) was_there = Joiner(*gone, model, scale, mesh, nullptr).match();
    Joiner joiner(deck, model, scale, mesh, before);
    const std::vector<Index> points = joiner.points(was_there);
    joiner.note_inside(context);
    AddedMesh added{.points = points, .scale = scale};
    added.skin_cells = !format_of(options.format).is_numbered;
    std::map<Quad, DeckTag> skin_tags;
    for (const DeckBlock& block : deck.blocks) {
        const auto [dimension, corners, nodes] = shape_info(block.shape);
        for (std::size_t e = 0; added.skin_cells && dimension == 2 && e < block.count(); ++e) {
            // Skip the skins of meshes that joined before; their regions have no number yet.
            const Index region = block.regions[e];
            if (region >= 0 && deck.regions[index(region)].tag == 0) continue;
            const std::span<const Index> own = block.element(e);
            skin_tags.emplace(face_key({own[0], own[1], own[2], own[corners == 3 ? 2 : 3]}), block.tags[e]);
        }
    }
    added.skin_tags = &skin_tags;
    if (const DeckRegion* neighbour = joiner.neighbour()) {
        added.neighbour_material = neighbour->material;
        added.neighbour = neighbour->name;
    }
    added.before = before;
    Deck joined = deck;
    add_mesh(joined, mesh, added, options, context);
    return joined;
}

} // namespace

Deck join_deck(const Deck& deck, const topology::Model& model, double scale, const mesh::HexMesh& mesh,
               const MeshDeckOptions& options, const RunContext& context, const Deck* gone,
               JoinedBefore* before)
{
    return joined(deck, model, scale, mesh, options, context, gone, before);
}

Deck join_deck(const Deck& deck, const topology::Model& model, double scale, const mesh::TetPart& mesh,
               const MeshDeckOptions& options, const RunContext& context, const Deck* gone,
               JoinedBefore* before)
{
    return joined(deck, model, scale, mesh, options, context, gone, before);
}

} // namespace lacuna::io
