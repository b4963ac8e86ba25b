// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/improve_joined.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/matching/side_lines.h>
#include <lacuna/quality/quality.h>
#include <lacuna/surface/shared/edge_nodes.h>
#include <lacuna/surface/shared/projector.h>
#include <lacuna/sweep/detail/cell_region.h>
#include <lacuna/sweep/detail/compare_face.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <string>
#include <utility>

namespace lacuna::sweep {

using namespace topology;

namespace {

using PartFace = std::pair<std::size_t, FaceId>; ///< a part, and a face of its volume
using Support = std::pair<const Model*, FaceId>; ///< a face on which nodes slide

/// The common edges of two faces.
class Curve {
public:
    Curve(const Model& model, FaceId one, FaceId other) : model_(&model)
    {
        std::map<VertexId, std::vector<Vec3>> ways; // directions in which edges leave each vertex
        std::vector<Triangle> thin;
        for (std::size_t e = 0; e < model.edges.size(); ++e) {
            const std::span<const FaceUse> uses = model.uses_of_edge(EdgeId(e));
            if (uses.size() != 2 || std::minmax(uses[0].face, uses[1].face) != std::minmax(one, other))
                continue;
            const Edge& edge = model.edges[e];
            const std::vector<Vec3> line = surface::edge_line(model, EdgeId(e));
            ways[edge.from].push_back((line[1] - line[0]).stableNormalized());
            ways[edge.to].push_back((line[line.size() - 2] - line.back()).stableNormalized());
            for (std::size_t i = 0; i + 1 < line.size(); ++i) {
                thin.push_back({edge.points[i], edge.points[i + 1], edge.points[i + 1]});
                sides_.push_back({EdgeId(e), i});
            }
            arcs_[EdgeId(e)] = geometry::arc_lengths(line);
        }
        if (!thin.empty()) tree_ = geometry::FacetTree(model.points, thin);
        for (const auto& [vertex, out] : ways)
            if (out.size() != 2 || out[0].dot(out[1]) > -kOneCurve)
                corners_.push_back(model.at(model[vertex].point));
    }

    [[nodiscard]] bool empty() const { return sides_.empty(); }
    /// Whether a point is at an end or a corner of the curve.
    [[nodiscard]] bool is_corner(const Vec3& point) const
    {
        return std::ranges::any_of(
            corners_, [&](const Vec3& corner) { return (corner - point).norm() <= model_->tolerance; });
    }
    [[nodiscard]] Vec3 direction(const Vec3& point) const
    {
        const auto& [edge, i] = sides_[index(tree_.closest(point).triangle)];
        const std::vector<Index>& points = (*model_)[edge].points;
        return (model_->at(points[i + 1]) - model_->at(points[i])).stableNormalized();
    }
    [[nodiscard]] Vec3 project(const Vec3& point) const
    {
        const geometry::FacetTree::Hit hit = tree_.closest(point);
        const auto& [edge, i] = sides_[index(hit.triangle)];
        const std::vector<double>& arcs = arcs_.at(edge);
        const double at = arcs[i] + (1 - hit.barycentric[0]) * (arcs[i + 1] - arcs[i]);
        return surface::edge_points(*model_, edge, std::array{at / arcs.back()}).front();
    }

private:
    const Model* model_;
    std::vector<std::pair<EdgeId, std::size_t>> sides_; ///< for each side in the tree: edge and segment
    std::map<EdgeId, std::vector<double>> arcs_;        ///< running lengths of the edges' points
    std::vector<Vec3> corners_;
    geometry::FacetTree tree_;
};

/// The volume of a mesh, and that of the sealed shape.
struct WholeVolume {
    double mesh = 0, sealed = 0;
    bool in_pieces = false;
};

/// The volumes of the wholes to which parts belong, by name. Pieces of one whole may exchange volume, because
/// the faces between them are cuts.
std::map<std::string, WholeVolume> whole_volumes(const std::vector<Swept>& parts,
                                                 std::span<const AssemblyMember> members)
{
    std::map<std::string, WholeVolume> wholes;
    for (std::size_t p = 0; p < parts.size(); ++p) {
        const bool is_piece = !members[p].whole.empty();
        WholeVolume& sum = wholes[is_piece ? members[p].whole : members[p].region];
        sum.mesh += parts[p].fidelity.volume;
        sum.sealed += parts[p].fidelity.sealed_volume;
        sum.in_pieces = is_piece;
    }
    return wholes;
}

double least_of(const std::vector<Swept>& parts)
{
    return std::ranges::min_element(parts, {}, &Swept::min_scaled_jacobian)->min_scaled_jacobian;
}

class JoinedImprover {
public:
    JoinedImprover(const SweptAssembly& assembly, std::span<const AssemblyMember> members,
                   const RunContext& context)
        : assembly_(assembly), members_(members), context_(context)
    {
        for (const SharedFace& face : assembly.shared) {
            const PartFace a{face.a, face.face_a}, b{face.b, face.face_b};
            const std::string& whole = members[face.a].whole;
            const bool is_cut = !whole.empty() && whole == members[face.b].whole && is_void(a) && is_void(b);
            shared_[b] = is_cut ? std::nullopt : std::optional(a);
            if (is_cut) shared_[a] = std::nullopt;
        }
    }

    std::optional<JoinedCells> run(const ImproveOptions& options, const RaiseOrder& raise_order)
    {
        find_cells();
        const auto project = [&](Index on, std::span<Vec3> points) {
            if (index(on) < supports_.size())
                projectors_
                    .try_emplace(on, *supports_[index(on)].first, std::vector{supports_[index(on)].second})
                    .first->second.project(points, context_);
            else
                for (Vec3& p : points) p = curve(on).project(p);
        };
        const auto along = [&](Index on, const Vec3& point) -> Vec3 {
            return index(on) < supports_.size() ? Vec3(Vec3::Zero()) : curve(on).direction(point);
        };
        const CellsView view{nodes_, cells_.size(), [&](std::size_t c) { return cells_[c]; }};
        const std::vector<Vec3> before = nodes_;
        JoinedCells result{assembly_.parts, improve_cells(nodes_, view, locked_, options,
                                                          {on_, project, along, {}}, context_)};
        std::set<std::size_t> moved;
        for (std::size_t p = 0; p < members_.size(); ++p) {
            std::vector<Vec3>& places = result.parts[p].mesh.nodes;
            for (std::size_t n = 0; n < places.size(); ++n) {
                const std::size_t own = number(p, n);
                if (nodes_[own] == before[own]) continue;
                places[n] = nodes_[own];
                moved.insert(p);
            }
        }
        if (moved.empty() || (raise_order && !raise_order(result.parts, moved))) return std::nullopt;
        for (const std::size_t p : moved) {
            Swept& part = result.parts[p];
            const quality::Proof proof = quality::prove(part.mesh, members_[p].options.min_scaled_jacobian,
                                                        context_);
            if (proof.finding) return std::nullopt;
            part.quality = proof.quality;
            part.fidelity.volume = proof.quality.volume;
            part.min_scaled_jacobian = proof.quality.min_scaled_jacobian;
        }
        if (least_of(result.parts) < least_of(assembly_.parts) || loses_volume(result.parts) ||
            !compare_again(result.parts, moved))
            return std::nullopt;
        return result;
    }

private:
    /// Whether the volume of a whole differs visibly from the sealed one, and by more than before.
    [[nodiscard]] bool loses_volume(const std::vector<Swept>& parts) const
    {
        const auto before = whole_volumes(assembly_.parts, members_);
        return std::ranges::any_of(whole_volumes(parts, members_), [&](const auto& whole) {
            const double sealed = whole.second.sealed;
            return std::abs(whole.second.mesh - sealed) >
                   std::max(std::abs(before.at(whole.first).mesh - sealed), kSameVolume * sealed);
        });
    }

    [[nodiscard]] std::size_t number(std::size_t part, std::size_t node) const
    {
        return index(assembly_.numbering[part].of(static_cast<Index>(node)));
    }
    [[nodiscard]] const Curve& curve(Index on) const { return curves_[index(on) - supports_.size()]; }
    [[nodiscard]] const Model& model(std::size_t part) const { return members_[part].volume->model; }
    [[nodiscard]] bool is_void(const PartFace& of) const
    {
        return model(of.first)[of.second].origin == Origin::made_void;
    }

    /// The face on which the nodes of a part's face slide: the face of the whole volume that was cut, or that
    /// of the first of two volumes. Empty for a face between two pieces of one volume.
    [[nodiscard]] std::optional<Support> support_of(PartFace of) const
    {
        if (const auto shared = shared_.find(of); shared != shared_.end()) {
            if (!shared->second) return std::nullopt;
            of = *shared->second;
        }
        const Face& face = model(of.first)[of.second];
        const OpenVolume* const whole = members_[of.first].piece_of;
        for (std::size_t f = 0; whole != nullptr && !is_void(of) && f < whole->model.faces.size(); ++f)
            if (whole->model.faces[f].tag == face.tag && whole->model.faces[f].origin == Origin::given)
                return Support(&whole->model, FaceId(f));
        return Support(&model(of.first), of.second);
    }

    /// Gather the cells of all parts, and the face or curve on which each node of the skin slides. Given
    /// nodes, those of boundary layers and those of walls that continue over a void face stay.
    void find_cells()
    {
        nodes_.resize(assembly_.nodes);
        locked_.resize(assembly_.nodes, 0);
        std::map<std::size_t, std::set<Index>> at; // for each node of the skin, its faces
        for (std::size_t p = 0; p < members_.size(); ++p) {
            const Swept& part = assembly_.parts[p];
            const bool fixed = members_[p].fixed != nullptr;
            for (std::size_t n = 0; n < part.mesh.nodes.size(); ++n) {
                nodes_[number(p, n)] = part.mesh.nodes[n];
                if (fixed || (n < part.held.size() && part.held[n] != 0)) locked_[number(p, n)] = 1;
            }
            for (std::size_t c = 0; c < part.mesh.cell_count(); ++c) {
                cells_.push_back(part.mesh.hex(c));
                for (Index& n : cells_.back()) n = assembly_.numbering[p].of(n);
            }
            std::map<FaceId, Index> group; // of each face; -1: none
            for (const FaceId face : all_faces(model(p))) {
                const auto support = support_of({p, face});
                group[face] = -1;
                if (!support) continue;
                const auto is_new = known_.try_emplace(*support, static_cast<Index>(supports_.size()));
                if (is_new.second) supports_.push_back(*support), faces_.emplace_back();
                group[face] = is_new.first->second;
                faces_[index(group[face])].emplace_back(p, face);
            }
            for (std::size_t i = 0; i < part.mesh.skin_count(); ++i) {
                const mesh::SkinQuad quad = mesh::skin_quad(part.mesh, i);
                const FaceId face = part.faces[index(quad.patch)];
                const bool kept = model(p)[face].keeps_nodes || matching::continued_wall(model(p), face);
                for (const Index n : quad.nodes) {
                    if (group.at(face) >= 0) at[number(p, index(n))].insert(group.at(face));
                    if (kept) locked_[number(p, index(n))] = 1;
                }
            }
        }
        on_.assign(nodes_.size(), -1);
        // Nodes that the user placed on edges stay, too.
        const bool placed = std::ranges::any_of(members_, [](const AssemblyMember& member) {
            return !member.options.intervals.empty() || !member.options.layers.heights.empty();
        });
        for (const auto& [n, faces] : at) {
            if (faces.size() == 1) on_[n] = *faces.begin();
            if (faces.size() == 2 && !placed) on_[n] = curve_of(*faces.begin(), *faces.rbegin());
            if (faces.size() > 1 && (on_[n] < 0 || curve(on_[n]).is_corner(nodes_[n]))) locked_[n] = 1;
        }
    }

    /// The curve between two faces, numbered after the faces; -1: they have no common edge.
    Index curve_of(Index one, Index other)
    {
        const auto [known, is_new] = curve_.try_emplace({one, other}, -1);
        const Support &a = supports_[index(one)], &b = supports_[index(other)];
        if (!is_new || a.first != b.first) return known->second;
        Curve made(*a.first, a.second, b.second);
        if (made.empty()) return -1;
        curves_.push_back(std::move(made));
        return known->second = static_cast<Index>(supports_.size() + curves_.size() - 1);
    }

    /// Compare faces with the quads of all their parts together, because nodes may have moved over the lines
    /// between these parts. @return  whether the skin is still on every face
    bool compare_again(std::vector<Swept>& parts, const std::set<std::size_t>& moved) const
    {
        std::vector<Skin> skins;
        for (std::size_t p = 0; p < parts.size(); ++p)
            skins.push_back(skin_of(parts[p].skin(), parts[p].faces, model(p).faces.size(), context_));
        for (const std::vector<PartFace>& faces : faces_) {
            const auto has_moved = [&](const PartFace& own) { return moved.contains(own.first); };
            if (std::ranges::none_of(faces, has_moved)) continue;
            Skin skin;
            SkinOfFace all;
            surface::FaceShape shape;
            for (const auto& [p, face] : faces) {
                const SkinOfFace& own = skins[p].faces[face.index()];
                if (own.quads.empty()) continue;
                const auto size = [side = own.mean_side](const Vec3&) { return side; };
                shape.append(surface::face_shape(model(p), face, size));
                for (Quad quad : own.quads) {
                    for (Index& n : quad) n += static_cast<Index>(skin.points.size());
                    all.quads.push_back(quad);
                }
                all.side.insert(all.side.end(), own.side.begin(), own.side.end());
                all.item.insert(all.item.end(), own.item.begin(), own.item.end());
                skin.points.insert(skin.points.end(), skins[p].points.begin(), skins[p].points.end());
            }
            if (all.quads.empty()) continue;
            const auto& [first, face] = faces.front();
            const DeviationLimit limit = limit_of(model(first), face,
                                                  {members_[first].options.max_deviation, {}, {}});
            const FaceFidelity found = compare_face(nullptr, skin, all, std::move(shape), 1, limit, context_);
            if (found.misfit != Misfit::none) return false;
            for (const auto& [p, own] : faces) {
                FaceFidelity& of_part = parts[p].fidelity.faces[own.index()];
                if (of_part.quads == 0) continue;
                of_part.max_distance = found.max_distance, of_part.mean_distance = found.mean_distance;
                of_part.place = found.place;
            }
        }
        for (const std::size_t p : moved) {
            sum_distances(parts[p].fidelity, model(p));
            parts[p].report.push_back("after moving nodes together with its neighbours: " +
                                      in_words(parts[p].fidelity));
        }
        return true;
    }

    const SweptAssembly& assembly_;
    const std::span<const AssemblyMember> members_;
    const RunContext& context_;
    /// For the second side of a shared face: the first side. For both sides of a cut: empty.
    std::map<PartFace, std::optional<PartFace>> shared_;
    std::vector<Vec3> nodes_;
    std::vector<Hex> cells_;
    std::vector<char> locked_;
    std::vector<Index> on_; ///< for each node, the face or curve on which it slides; -1: none
    std::vector<Support> supports_;
    std::map<Support, Index> known_;           ///< their numbers
    std::vector<std::vector<PartFace>> faces_; ///< for each of them, the faces of the parts
    std::vector<Curve> curves_;
    std::map<std::pair<Index, Index>, Index> curve_;
    std::map<Index, surface::Projector> projectors_;
};

} // namespace

void note_lost_wholes(SweptAssembly& assembly, std::span<const AssemblyMember> members,
                      const RunContext& context)
{
    for (const auto& [whole, volume] : whole_volumes(assembly.parts, members)) {
        const double lost = 1 - volume.mesh / volume.sealed;
        if (!volume.in_pieces || std::abs(lost) <= kVolumeNoted) continue;
        assembly.report.push_back(
            formatted("note: {}: the meshes of the pieces together have {:.2g} % {} "
                      "volume than the sealed shape; use a smaller 'size' [sweep.volume]",
                      whole, 100 * std::abs(lost), lost > 0 ? "less" : "more"));
        log_line(context, assembly.report.back());
    }
}

std::optional<JoinedCells> improve_joined(const SweptAssembly& assembly,
                                          std::span<const AssemblyMember> members,
                                          const RaiseOrder& raise_order, const RunContext& context)
{
    ImproveOptions options = members.front().options.improving;
    bool may = assembly.parts.size() > 1;
    for (std::size_t p = 0; p < members.size(); ++p) {
        options.good_enough = std::max(options.good_enough, members[p].options.min_scaled_jacobian);
        may = may && members[p].options.improve && !assembly.parts[p].layers;
    }
    if (!may || least_of(assembly.parts) >= options.good_enough) return std::nullopt;
    // Bent sides take off up to half of what the corners have: tees of order 2 with corners of 0.53 had 0.26.
    if (raise_order) options.good_enough = (1 + options.good_enough) / 2;
    return JoinedImprover(assembly, members, context).run(options, raise_order);
}

} // namespace lacuna::sweep
