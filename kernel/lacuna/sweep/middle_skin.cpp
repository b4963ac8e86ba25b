// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/middle_skin.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/surface/shared/projector.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// A side of the skin. Its two quads may lie in different patches.
struct SkinSide {
    std::size_t place = 0; ///< index of the middle node of this side
    Index from = 0, to = 0;
    Index patch = -1, other = -1;
};

std::vector<SkinSide> skin_sides(const mesh::HexMesh& mesh)
{
    std::vector<SkinSide> all;
    all.reserve(4 * mesh.skin_count());
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
        const mesh::CellNodes nodes = mesh::skin_nodes(mesh, i);
        const Index patch = mesh::skin_quad(mesh, i).patch;
        for (std::size_t k = 0; k < 4; ++k) {
            const Index a = nodes.node[k], b = nodes.node[(k + 1) % 4];
            all.push_back({index(nodes.node[4 + k]) - corner_count(mesh), std::min(a, b), std::max(a, b),
                           patch, patch});
        }
    }
    std::ranges::stable_sort(all, {}, &SkinSide::place);
    std::vector<SkinSide> sides;
    sides.reserve(all.size() / 2);
    for (const SkinSide& side : all) {
        if (!sides.empty() && sides.back().place == side.place)
            sides.back().other = side.patch;
        else
            sides.push_back(side);
    }
    return sides;
}

/// Whether a face has given quads that the skin keeps.
bool keeps_quads(const Face& face) { return face.keeps_nodes && !face.given_quads.empty(); }

class SkinPlacer {
public:
    SkinPlacer(const OpenVolume& volume, const mesh::SkinNodes& corners, const std::vector<FaceId>& faces,
               const SecondOrderOptions& options, const RunContext& context)
        : model_(volume.model), corners_(corners), faces_(faces), options_(options), context_(context)
    {
    }

    PlacedSkin place()
    {
        for (const SkinSide& side : sides_) middle(side) = straight(side);
        take_given();
        place_on_edges();
        keep_straight();
        const LevelBlend blend(mesh_);
        for (const int level : {0, mesh_.layers}) blend_end(level, blend);
        project(true);
        blend_rows();
        bend_columns();
        project(false);
        for (const SkinSide& side : sides_)
            if (skin_.state(side.place) == Middle::open) skin_.set(side.place, Middle::loose);
        if (mesh_.middles.full) place_centres();
        return {std::move(skin_), counts_};
    }

private:
    [[nodiscard]] FaceId face(Index patch) const { return faces_[index(patch)]; }
    [[nodiscard]] Vec3& middle(const SkinSide& side) { return skin_.node(side.place); }
    [[nodiscard]] Vec3 straight(const SkinSide& side) const
    {
        return (corners_[side.from] + corners_[side.to]) / 2;
    }
    /// Sides whose middle is not placed yet, as far as `wanted(side)` selects them.
    template <class Wanted>
    [[nodiscard]] std::vector<const SkinSide*> open_sides(const Wanted& wanted) const
    {
        std::vector<const SkinSide*> open;
        for (const SkinSide& side : sides_)
            if (skin_.state(side.place) == Middle::open && wanted(side)) open.push_back(&side);
        return open;
    }
    /// Place the middles of sides on geometry. @param find  `middles_on_edges` or `middles_on_faces`
    template <class Find>
    void place_on(const std::vector<const SkinSide*>& sides, const Find& find)
    {
        std::vector<SideOfSkin> asked;
        for (const SkinSide* side : sides)
            asked.push_back({corners_[side->from], corners_[side->to], middle(*side), face(side->patch),
                             face(side->other)});
        const std::vector<std::optional<Vec3>> found = find(model_, asked, counts_, context_);
        for (std::size_t i = 0; i < sides.size(); ++i) {
            if (!found[i]) continue;
            middle(*sides[i]) = *found[i];
            skin_.set(sides[i]->place, Middle::settled);
        }
    }

    void take_given()
    {
        if (!options_.given) return;
        std::vector<const SkinSide*> asked;
        std::vector<Vec3> from, to;
        for (const SkinSide& side : sides_) {
            if (!options_.given_all_over && !model_[face(side.patch)].keeps_nodes &&
                !model_[face(side.other)].keeps_nodes)
                continue;
            asked.push_back(&side);
            from.push_back(corners_[side.from]);
            to.push_back(corners_[side.to]);
        }
        const std::vector<Vec3> given = options_.given(from, to);
        for (std::size_t i = 0; i < asked.size(); ++i) {
            if (!given[i].allFinite()) continue;
            middle(*asked[i]) = given[i];
            skin_.set(asked[i]->place, Middle::settled);
            ++counts_.given;
        }
    }

    void place_on_edges()
    {
        const auto between = [&](const SkinSide& side) { return face(side.patch) != face(side.other); };
        place_on(open_sides(between), middles_on_edges);
    }

    /// Keep sides of faces with given quads straight if no middle node is given.
    void keep_straight()
    {
        for (const SkinSide& side : sides_)
            if (skin_.state(side.place) == Middle::open &&
                (keeps_quads(model_[face(side.patch)]) || keeps_quads(model_[face(side.other)])))
                skin_.set(side.place, Middle::settled);
    }

    /// The corner node on a level that corresponds to source node `node`.
    [[nodiscard]] Vec3 corner(int level, Index node) const
    {
        return corners_[level * mesh_.nodes_per_layer + node];
    }

    void blend_end(int l, const LevelBlend& blend)
    {
        const std::size_t count = mesh_.middles.sides.size();
        std::vector<std::uint8_t> known(count, 0);
        std::vector<Vec3> bends(count, Vec3::Zero());
        std::vector<Vec3> nodes(index(mesh_.nodes_per_layer));
        for (Index n = 0; n < mesh_.nodes_per_layer; ++n) nodes[index(n)] = corner(l, n);
        const auto between = [&](std::size_t s) {
            const Segment& side = mesh_.middles.sides[s];
            return Vec3((nodes[index(side[0])] + nodes[index(side[1])]) / 2);
        };
        const auto place = [&](std::size_t s) { return places_.side(index(l), static_cast<Index>(s)); };
        for (std::size_t s = 0; s < count; ++s) {
            known[s] = skin_.state(place(s)) == Middle::settled ? 1 : 0;
            if (known[s] == 0) continue;
            bends[s] = skin_.node(place(s)) - between(s);
            const Segment& side = mesh_.middles.sides[s];
            const double length = (nodes[index(side[1])] - nodes[index(side[0])]).norm();
            if (bends[s].norm() < kSamePlace * length) bends[s].setZero(); // rounding
        }
        blend.blend(nodes.data(), known, bends);
        for (std::size_t s = 0; s < count; ++s)
            if (known[s] == 0) skin_.node(place(s)) = between(s) + bends[s];
    }

    /// Place the middles of sides that run around the walls. The bend of such a side is blended from known
    /// sides above and below it, in frames that rotate with the wall.
    void blend_rows()
    {
        const auto levels = index(mesh_.layers) + 1;
        std::vector<Vec3> at(levels), local(levels);
        for (std::size_t r = 0; r < mesh_.rim.size(); ++r) {
            const Segment& side = mesh_.rim[r];
            const auto place = [&](std::size_t l) { return places_.side(l, mesh_.middles.rim_side[r]); };
            const auto node = [&](std::size_t l, std::size_t end) {
                return corner(static_cast<int>(l), side[end]);
            };
            for (std::size_t l = 0; l < levels; ++l) at[l] = (node(l, 0) + node(l, 1)) / 2;
            const auto frame = [&](std::size_t l) {
                return SideFrame(node(l, 0), node(l, 1),
                                 at[std::min(l + 1, levels - 1)] - at[l - (l > 0 ? 1 : 0)]);
            };
            const auto bend = [&](std::size_t l) { return frame(l).local(skin_.node(place(l)) - at[l]); };
            for (std::size_t low = 0; low + 1 < levels;) {
                std::size_t high = low + 1;
                while (high + 1 < levels && skin_.state(place(high)) == Middle::open) ++high;
                if (high == low + 1) {
                    low = high;
                    continue;
                }
                const Vec3 below = bend(low), above = bend(high);
                double whole = 0, way = 0;
                for (std::size_t l = low; l < high; ++l) whole += (at[l + 1] - at[l]).norm();
                if (below.norm() + above.norm() > kFileAccuracy * kFileAccuracy && whole > 0) {
                    for (std::size_t l = low + 1; l < high; ++l) {
                        way += (at[l] - at[l - 1]).norm();
                        const Vec3 between = (1 - way / whole) * below + (way / whole) * above;
                        skin_.node(place(l)) = at[l] + frame(l).world(between);
                    }
                }
                low = high;
            }
        }
    }

    void bend_columns()
    {
        for (int l = 0; l < mesh_.layers; ++l)
            for (const Segment& side : mesh_.rim) {
                const std::size_t place = places_.upright(index(l), side[0]);
                if (skin_.state(place) != Middle::open) continue;
                const Vec3 bend = rim_bend(corners_, side[0], l);
                const double length = (corner(l + 1, side[0]) - corner(l, side[0])).norm();
                if (bend.norm() > kSamePlace * length) skin_.node(place) += bend;
            }
    }

    /// @param ends  true: project onto the faces of source and target; false: onto walls.
    void project(bool ends)
    {
        const std::size_t first_on_walls = places_.upright(0, 0);
        const std::size_t target = places_.side(index(mesh_.layers), 0);
        const auto wanted = [&](const SkinSide& side) {
            return (side.place < first_on_walls || side.place >= target) == ends;
        };
        place_on(open_sides(wanted), middles_on_faces);
    }

    /// The given centres of the skin's quads; NaN where none is given.
    [[nodiscard]] std::vector<Vec3> given_centres() const
    {
        std::vector<Vec3> found(mesh_.skin_count(), Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
        if (!options_.given_centres) return found;
        std::vector<std::array<Vec3, 4>> corners;
        std::vector<std::size_t> quads;
        for (std::size_t i = 0; i < mesh_.skin_count(); ++i) {
            const mesh::SkinQuad quad = mesh::skin_quad(mesh_, i);
            if (!options_.given_all_over && !keeps_quads(model_[face(quad.patch)])) continue;
            quads.push_back(i);
            std::array<Vec3, 4>& own = corners.emplace_back();
            for (std::size_t k = 0; k < 4; ++k) own[k] = corners_[quad.nodes[k]];
        }
        const std::vector<Vec3> given = options_.given_centres(corners);
        for (std::size_t i = 0; i < quads.size(); ++i) found[quads[i]] = given[i];
        return found;
    }

    /// Place the centres of the skin's quads. A centre is the given one, or it is interpolated from the
    /// middles of the quad's sides and projected if the face requires it.
    void place_centres()
    {
        const std::vector<Vec3> given = given_centres();
        std::map<FaceId, std::vector<std::size_t>> of_face;
        for (std::size_t i = 0; i < mesh_.skin_count(); ++i) {
            const FaceId face = faces_[index(mesh::skin_quad(mesh_, i).patch)];
            const mesh::CellNodes nodes = mesh::skin_nodes(mesh_, i);
            const auto place = [&](std::size_t n) { return index(nodes.node[n]) - corner_count(mesh_); };
            if (given[i].allFinite()) {
                skin_.node(place(8)) = given[i];
                skin_.set(place(8), Middle::settled);
                ++counts_.given;
                continue;
            }
            std::array<Vec3, 4> sides, corners;
            for (std::size_t k = 0; k < 4; ++k) {
                sides[k] = skin_.node(place(4 + k));
                corners[k] = corners_[nodes.node[k]];
            }
            skin_.node(place(8)) = middle_of_quad(sides, corners);
            skin_.set(place(8), Middle::loose);
            if (model_[face].surface != nullptr && !keeps_quads(model_[face]))
                of_face[face].push_back(place(8));
        }
        for (const auto& [face, places] : of_face) {
            check_cancelled(context_);
            std::vector<Vec3> points;
            for (const std::size_t place : places) points.push_back(skin_.node(place));
            surface::Projector(model_, {face}).project(points, context_);
            for (std::size_t i = 0; i < places.size(); ++i) {
                // Moves within rounding are not made, so that flat quads stay exactly flat.
                Vec3& at = skin_.node(places[i]);
                if ((points[i] - at).norm() > kRoundoff * model_.diagonal) at = points[i];
                skin_.set(places[i], Middle::settled);
            }
        }
    }

    const Model& model_;
    const mesh::SkinNodes& corners_;
    const mesh::HexMesh& mesh_ = corners_.mesh;
    const mesh::MiddlePlaces places_{mesh_};
    const std::vector<FaceId>& faces_;
    const SecondOrderOptions& options_;
    const RunContext& context_;
    const std::vector<SkinSide> sides_ = skin_sides(mesh_);
    SkinMiddles skin_{mesh_};
    SkinCounts counts_;
};

} // namespace

PlacedSkin place_skin(const OpenVolume& volume, const mesh::SkinNodes& corners,
                      const std::vector<FaceId>& faces, const SecondOrderOptions& options,
                      const RunContext& context)
{
    return SkinPlacer(volume, corners, faces, options, context).place();
}

} // namespace lacuna::sweep
