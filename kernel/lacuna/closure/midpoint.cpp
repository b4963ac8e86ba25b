// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/midpoint.h>

#include <lacuna/closure/detail/outline.h>
#include <lacuna/closure/detail/pieces.h>
#include <lacuna/closure/detail/transfinite_fill.h>
#include <lacuna/closure/detail/void_entities.h>
#include <lacuna/closure/shared/straighten_lines.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/geometry/shared/pattern_search.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/face_plane.h>
#include <lacuna/topology/shared/side_points.h>
#include <lacuna/topology/shared/split_edge.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <ranges>
#include <span>
#include <utility>

namespace lacuna::closure {

using namespace topology;

namespace {

/// The three edges at a vertex, in the order of right-handed axes into the volume. `across[k]` is the face at
/// the vertex that edge `k` does not bound.
struct Net {
    std::array<EdgeId, 3> edge;
    std::array<FaceId, 3> across;
};

/// Whether each face is bounded by one loop of at least three edges between different faces, and has no given
/// mesh.
bool has_simple_faces(const Model& model)
{
    return std::ranges::all_of(model.faces, [&](const Face& face) {
        return face.loops.size() == 1 && face.loops[0].uses.size() > 2 && face.given_quads.empty() &&
               std::ranges::all_of(face.loops[0].uses, [&](const EdgeUse& use) {
                   const std::span<const FaceUse> users = model.uses_of_edge(use.edge);
                   return users.size() == 2 && users[0].face != users[1].face;
               });
    });
}

/// The net of each vertex of a skin of simple faces; empty if some vertex does not have three edges.
std::vector<Net> net_of(const Model& model)
{
    struct Turn {
        EdgeId in, out;
        FaceId face;
    };
    std::vector<std::vector<Turn>> turns(model.vertices.size());
    for (const FaceId face : all_faces(model)) {
        EdgeUse before = model[face].loops[0].uses.back();
        for (const EdgeUse& use : model[face].loops[0].uses) {
            turns[use_from(model, use).index()].push_back({before.edge, use.edge, face});
            before = use;
        }
    }
    std::vector<Net> net;
    for (std::vector<Turn>& at : turns) {
        if (at.size() != 3) return {};
        if (at[1].in != at[0].out) std::swap(at[1], at[2]);
        if (at[1].in != at[0].out || at[2].in != at[1].out || at[0].in != at[2].out) return {};
        net.push_back({{at[0].in, at[1].in, at[2].in}, {at[1].face, at[2].face, at[0].face}});
    }
    return net;
}

/// Centre of the volume within a closed skin.
Vec3 centroid(const Model& model)
{
    Vec3 sum = Vec3::Zero();
    double volume = 0;
    const Vec3 origin = model.at(model.vertices.front().point);
    for (const FaceId face : all_faces(model)) {
        for (const Triangle& t : model[face].triangles) {
            const Vec3 a = model.at(t[0]) - origin, b = model.at(t[1]) - origin, c = model.at(t[2]) - origin;
            const double own = a.dot(b.cross(c));
            sum += own * (a + b + c) / 4;
            volume += own;
        }
    }
    return origin + sum / volume;
}

/// The eight corners of the block at a vertex of the volume, as indices of places in `Middles`. Corner 0 is
/// that vertex. The neighbour of corner c along axis k is corner c ^ (1 << k).
using Block = std::array<std::size_t, 8>;

/// The places of vertices, middles of edges, middles of faces and the middle of the volume, in this order.
class Middles {
public:
    Middles(const Model& model, const std::vector<Net>& net, const std::vector<VertexId>& middle_of_edge)
    {
        for (std::size_t v = 0; v < net.size(); ++v) places_.push_back(model.at(model.vertices[v].point));
        for (const VertexId middle : middle_of_edge) places_.push_back(model.at(model[middle].point));
        faces_ = places_.size();
        for (const FaceId face : all_faces(model)) {
            facets_.emplace_back(model.points, model[face].triangles);
            is_cut_.push_back(model[face].origin == Origin::made_void && !model[face].name.empty());
            places_.push_back(facets_.back().closest(face_centroid(model, face)).point);
        }
        places_.push_back(centroid(model));
        blocks_at_.resize(places_.size());
        for (std::size_t v = 0; v < net.size(); ++v) {
            Block block{v};
            for (std::size_t k = 0; k < 3; ++k) {
                block[std::size_t{1} << k] = net.size() + net[v].edge[k].index();
                block[7 - (std::size_t{1} << k)] = faces_ + net[v].across[k].index();
            }
            block[7] = places_.size() - 1;
            for (const std::size_t place : block) blocks_at_[place].push_back(blocks_.size());
            blocks_.push_back(block);
        }
    }

    [[nodiscard]] const Vec3& of_face(std::size_t face) const { return places_[faces_ + face]; }
    [[nodiscard]] const Vec3& of_volume() const { return places_.back(); }

    /// The least scaled Jacobian at the corners of all blocks; edges of blocks are taken as straight.
    [[nodiscard]] double least() const
    {
        double least = 1;
        for (const Block& block : blocks_)
            for (std::size_t c = 0; c < 8; ++c) least = std::min(least, jacobian(block, c));
        return least;
    }

    /// Move the middles of faces (unless `fixed`) and of the volume, where this improves the adjacent blocks.
    /// Moves are along the coordinate axes, in steps that are halved when no middle moves any more. The
    /// middles of cut faces stay at their centroids, because the adjacent piece shares these faces.
    void improve(bool fixed, const RunContext& context)
    {
        for (double step = geometry::kLongestStep; step >= geometry::kShortestStep; step /= 2) {
            bool moved = true;
            for (int round = 0; moved && round < kMostRounds; ++round) {
                check_cancelled(context);
                moved = false;
                for (std::size_t p = fixed ? places_.size() - 1 : faces_; p < places_.size(); ++p)
                    moved = move(p, step) || moved;
            }
        }
    }

private:
    /// Move a middle along the coordinate axes. @param step  share of the shortest edge of blocks.
    /// @return  whether it moved
    bool move(std::size_t p, double step)
    {
        if (p - faces_ < facets_.size() && is_cut_[p - faces_]) return false;
        bool moved = false;
        double loss = loss_at(p);
        const double length = step * shortest_at(p);
        for (int k = 0; k < 6; ++k) {
            const Vec3 before = places_[p];
            places_[p][k / 2] += k % 2 == 0 ? length : -length;
            if (p - faces_ < facets_.size()) places_[p] = facets_[p - faces_].closest(places_[p]).point;
            const double now = loss_at(p);
            if (now < loss) {
                loss = now;
                moved = true;
            } else {
                places_[p] = before;
            }
        }
        return moved;
    }

    [[nodiscard]] double jacobian(const Block& block, std::size_t corner) const
    {
        std::array<Vec3, 3> way;
        for (std::size_t k = 0; k < 3; ++k)
            way[k] =
                (places_[block[corner ^ (std::size_t{1} << k)]] - places_[block[corner]]).stableNormalized();
        const double volume = way[0].dot(way[1].cross(way[2]));
        return std::popcount(corner) % 2 == 0 ? volume : -volume;
    }

    /// Sum of (1 − scaled Jacobian)^8 over all corners of the blocks at a place. The high power makes the
    /// worst corner dominate.
    [[nodiscard]] double loss_at(std::size_t place) const
    {
        constexpr int kPower = 8;
        double loss = 0;
        for (const std::size_t b : blocks_at_[place])
            for (std::size_t c = 0; c < 8; ++c) loss += std::pow(1 - jacobian(blocks_[b], c), kPower);
        return loss;
    }

    /// The length of the shortest edge of blocks at a place.
    [[nodiscard]] double shortest_at(std::size_t place) const
    {
        double least = kInfinity;
        for (const std::size_t b : blocks_at_[place]) {
            const Block& block = blocks_[b];
            const auto c = static_cast<std::size_t>(std::ranges::find(block, place) - block.begin());
            for (std::size_t k = 0; k < 3; ++k)
                least = std::min(least, (places_[block[c ^ (std::size_t{1} << k)]] - places_[place]).norm());
        }
        return least;
    }

    std::vector<Vec3> places_;
    std::size_t faces_ = 0;                   ///< position of the first middle of a face
    std::vector<geometry::FacetTree> facets_; ///< by face
    std::vector<bool> is_cut_;                ///< by face: whether it was made by a cut
    std::vector<Block> blocks_;
    std::vector<std::vector<std::size_t>> blocks_at_; ///< by place: the blocks with a corner there
};

/// A copy of a volume whose faces are split.
class Splitter {
protected:
    Splitter(const OpenVolume& volume, const RunContext& context)
        : context_(context), volume_(volume), model_(volume_.model), whole_(all_faces(model_))
    {
        std::ranges::fill(volume_.role, Role::wall);
    }

    /// Split a face along plane sections from points of its rim to a place on the face.
    /// @return  the edges of each line; empty if a section leaves the face.
    std::vector<std::vector<EdgeUse>> split_face(FaceId face, const Vec3& place,
                                                 const std::vector<Index>& from)
    {
        const std::optional<geometry::Plane> flat = plane_of(model_, face);
        ModelBuilder builder(std::move(model_));
        const Index centre = point_on_face(builder, face, place);
        builder.build_loops(context_);
        Vec3 normal = Vec3::Zero();
        for (const Triangle& t : builder[face].triangles) {
            if (std::ranges::find(t, centre) == t.end()) continue;
            normal += (builder.at(t[1]) - builder.at(t[0])).cross(builder.at(t[2]) - builder.at(t[0]));
        }
        model_ = std::move(builder).finish();
        const Vec3 middle = model_.at(centre);
        // Lines of earlier sections are kept: they are edges now, and still separate parts of the face.
        std::vector<SectionWalk> walks;
        std::vector<std::vector<EdgeUse>> lines;
        for (const Index start : from) {
            const geometry::Plane plane = geometry::plane_across(middle,
                                                                 (model_.at(start) - middle).cross(normal));
            std::vector<FaceId> parts;
            for (const FaceId part : all_faces(model_))
                if (whole_[part.index()] == face) parts.push_back(part);
            SectionWalk& line = walks.emplace_back();
            for (const SectionWalk& walk : section_walks(model_, parts, plane, model_.tolerance)) {
                const auto a = std::ranges::find(walk.places, SectionPlace{start}),
                           b = std::ranges::find(walk.places, SectionPlace{centre});
                if (a == walk.places.end() || b == walk.places.end()) continue;
                line.places.assign(std::min(a, b), std::max(a, b) + 1);
                if (b < a) std::ranges::reverse(line.places);
            }
            if (line.places.empty()) return {};
            WalkImprint made = imprint(volume_, walks, plane, context_);
            for (std::size_t f = whole_.size(); f < made.parent.size(); ++f)
                whole_.push_back(whole_[made.parent[f].index()]);
            lines = std::move(made.lines); // the earlier ones may have been divided
            line.places.clear();
            for (const Index p : use_points(model_, lines.back())) line.places.push_back({p});
        }
        if (!flat) return lines;
        std::vector<FaceId> parts;
        for (const FaceId part : all_faces(model_))
            if (whole_[part.index()] == face) parts.push_back(part);
        straighten_lines(model_, parts, *flat, lines, context_);
        return lines;
    }

    VertexId add_vertex(const Vec3& place)
    {
        ModelBuilder builder(std::move(model_));
        builder.points.push_back(place);
        const VertexId vertex = builder.add_void_vertex(static_cast<Index>(builder.points.size()) - 1);
        model_ = std::move(builder).finish();
        return vertex;
    }

    FaceId add_face(VoidFilling filling, const std::vector<std::vector<EdgeUse>>& sides)
    {
        Loop& loop = filling.loops.emplace_back();
        for (const std::vector<EdgeUse>& side : sides)
            loop.uses.insert(loop.uses.end(), side.begin(), side.end());
        filling.name = partition_name(model_);
        return add_void_face(volume_, std::move(filling), Role::wall);
    }

    const RunContext& context_;
    OpenVolume volume_;
    Model& model_;
    std::vector<FaceId> whole_; ///< by face of the split skin: the face of the input that it is a part of
};

/// Divides a volume into blocks. Each vertex of the volume has three edges.
class Divider : Splitter {
public:
    Divider(const OpenVolume& volume, std::vector<Net> net, const RunContext& context)
        : Splitter(volume, context), net_(std::move(net))
    {
    }

    /// @param fixed  whether the middles of faces stay at their centroids, so that volumes that share a face
    ///         agree.
    std::vector<OpenVolume> run(bool fixed)
    {
        const std::size_t edges = model_.edges.size(), faces = model_.faces.size();
        for (std::size_t e = 0; e < edges; ++e)
            middle_of_edge_.push_back(split_edge(model_, EdgeId(e), 0.5).vertex);
        Middles middles(model_, net_, middle_of_edge_);
        middles.improve(fixed, context_);
        if (middles.least() < kFoldedQuad) return {};
        lines_.resize(edges);
        for (std::size_t f = 0; f < faces; ++f) {
            std::vector<Index> from;
            std::vector<EdgeId> own;
            for (const EdgeUse& use : model_.faces[f].loops[0].uses) {
                if (use.edge.index() >= edges) continue; // the second half of an edge
                own.push_back(use.edge);
                from.push_back(model_[middle_of_edge_[use.edge.index()]].point);
            }
            const auto lines = split_face(FaceId(f), middles.of_face(f), from);
            if (lines.empty()) return {};
            for (std::size_t k = 0; k < own.size(); ++k) lines_[own[k].index()].push_back(lines[k]);
            middle_of_face_.push_back(use_to(model_, lines[0].back()));
        }
        join_middles(add_vertex(middles.of_volume()));
        return blocks();
    }

private:
    /// Add the edges from the middles of faces to the middle of the volume. Add a face for each edge of the
    /// skin, between the blocks at the edge's ends.
    void join_middles(VertexId middle)
    {
        std::map<VertexId, EdgeUse> spoke;
        for (const VertexId own : middle_of_face_)
            spoke[own] = {add_void_edge_through(model_, own, middle), false};
        for (const std::vector<std::vector<EdgeUse>>& line : lines_) {
            std::vector<EdgeUse> back;
            for (auto use = line[1].rbegin(); use != line[1].rend(); ++use) back.push_back(opposite(*use));
            const std::vector<std::vector<EdgeUse>> sides{
                line[0],
                {spoke.at(use_to(model_, line[0].back()))},
                {opposite(spoke.at(use_to(model_, line[1].back())))},
                back};
            between_.push_back(add_face(fill_transfinite(model_, sides, nullptr, context_), sides));
        }
    }

    std::vector<OpenVolume> blocks()
    {
        std::vector<Roles> roles(net_.size());
        for (std::size_t f = 0; f < whole_.size(); ++f)
            for (const EdgeUse& use : uses_of(model_.faces[f]))
                if (const std::size_t v = use_from(model_, use).index(); v < net_.size())
                    roles[v].walls.emplace_back(f);
        std::vector<OpenVolume> made;
        for (std::size_t v = 0; v < net_.size(); ++v) {
            for (const EdgeId edge : net_[v].edge) roles[v].walls.push_back(between_[edge.index()]);
            made.push_back(open_volume(model_, roles[v], context_));
        }
        return made;
    }

    std::vector<Net> net_;
    std::vector<VertexId> middle_of_edge_, middle_of_face_;
    std::vector<std::vector<std::vector<EdgeUse>>> lines_; ///< by edge: the lines from the middle of the edge
                                                           ///< to the middles of its two faces
    std::vector<FaceId> between_; ///< by edge of the volume: the face between the blocks at the edge's two
                                  ///< vertices
};

/// Divides a volume into cones with their apex at the volume's centroid. The base of a cone is a three-sided
/// face, or a triangle of another face: such a face is split by lines from its vertices to its centroid.
class ConeMaker : Splitter {
public:
    ConeMaker(const OpenVolume& volume, const RunContext& context) : Splitter(volume, context) {}

    /// @return  empty if there would be more than `most` cones, or a line leaves its face.
    std::vector<OpenVolume> run(std::size_t most)
    {
        const Vec3 place = centroid(model_);
        std::size_t cones = 0;
        for (const Face& face : model_.faces) {
            const std::size_t sides = face.loops[0].uses.size();
            cones += sides == 3 ? 1 : sides;
        }
        if (cones > most) return {};
        const std::size_t faces = model_.faces.size();
        for (std::size_t f = 0; f < faces; ++f) {
            std::vector<Index> from;
            for (const EdgeUse& use : model_.faces[f].loops[0].uses)
                from.push_back(model_[use_from(model_, use)].point);
            if (from.size() > 3 && split_face(FaceId(f), face_centroid(model_, FaceId(f)), from).empty())
                return {};
        }
        const VertexId middle = add_vertex(place);
        const std::size_t vertices = middle.index(), edges = model_.edges.size();
        std::vector<EdgeUse> spoke;
        for (std::size_t v = 0; v < vertices; ++v)
            spoke.push_back({add_void_edge_through(model_, VertexId(v), middle), false});
        std::vector<FaceId> between;
        for (std::size_t e = 0; e < edges; ++e) {
            const Edge& edge = model_.edges[e];
            VoidFilling filling;
            for (std::size_t i = 0; i + 1 < edge.points.size(); ++i)
                filling.triangles.push_back({edge.points[i], edge.points[i + 1], model_[middle].point});
            between.push_back(add_face(
                std::move(filling),
                {{{EdgeId(e), false}}, {spoke[edge.to.index()]}, {opposite(spoke[edge.from.index()])}}));
        }
        std::vector<OpenVolume> made;
        for (std::size_t f = 0; f < whole_.size(); ++f) {
            Roles roles{{}, {}, {FaceId(f)}};
            for (const EdgeUse& use : uses_of(model_.faces[f]))
                roles.walls.push_back(between[use.edge.index()]);
            made.push_back(open_volume(model_, roles, context_));
        }
        return made;
    }
};

} // namespace

std::vector<OpenVolume> midpoint_blocks(const OpenVolume& volume, std::size_t most, const RunContext& context)
{
    std::vector<OpenVolume> blocks;
    if (!has_simple_faces(volume.model)) return blocks;
    const std::vector<Net> net = net_of(volume.model);
    if (!net.empty() && net.size() <= most) blocks = Divider(volume, net, context).run(false);
    if (!blocks.empty()) return blocks;
    for (const OpenVolume& cone : ConeMaker(volume, context).run(most / 4)) {
        std::vector<OpenVolume> own = Divider(cone, net_of(cone.model), context).run(true);
        if (own.empty()) return {};
        std::ranges::move(own, std::back_inserter(blocks));
    }
    return blocks;
}

} // namespace lacuna::closure
