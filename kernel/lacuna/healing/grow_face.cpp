// SPDX-License-Identifier: MIT
#include <lacuna/healing/shared/grow_face.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/edge_key.h>
#include <lacuna/core/shared/same_corners.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/healing/shared/add_facet.h>
#include <lacuna/healing/split_facets.h>
#include <lacuna/topology/open_volume.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <unordered_map>

namespace lacuna::healing {
namespace {

/// A triangle (fourth corner -1) or a given quad.
struct Cell {
    Quad corners;
    Index face;
    [[nodiscard]] std::size_t count() const { return corners[3] < 0 ? 3 : 4; }
};

/// Add the given quads of a face, and its triangles that are not halves of given quads, to `cells`. The index
/// of each triangle's cell is appended to `cell_of`.
void add_cells(const topology::Face& face, Index number, std::vector<Cell>& cells,
               std::vector<Index>& cell_of)
{
    std::map<std::array<Index, 3>, Index> halves;
    for (const Quad& quad : face.given_quads) {
        for (std::size_t k = 0; k < 4; ++k)
            halves.emplace(rising(Triangle{quad[k], quad[(k + 1) % 4], quad[(k + 2) % 4]}),
                           static_cast<Index>(cells.size()));
        cells.push_back({quad, number});
    }
    for (const Triangle& t : face.triangles) {
        const auto found = halves.find(rising(t));
        cell_of.push_back(found != halves.end() ? found->second : static_cast<Index>(cells.size()));
        if (found == halves.end()) cells.push_back({{t[0], t[1], t[2], -1}, number});
    }
}

class Grower {
public:
    Grower(const topology::Model& model, double angle) : model_(model)
    {
        least_cosine_ = std::cos(std::min(angle * std::numbers::pi / 180 + kFileAccuracy, std::numbers::pi));
        for (std::size_t f = 0; f < model.faces.size(); ++f)
            add_cells(model.faces[f], static_cast<Index>(f), cells_, cell_of_triangle_);
        for (std::size_t c = 0; c < cells_.size(); ++c)
            for (std::size_t k = 0; k < cells_[c].count(); ++k)
                users_[key(cells_[c], k)].push_back(static_cast<Index>(c));
    }

    [[nodiscard]] const std::vector<Cell>& cells() const { return cells_; }

    /// @return  by cell: whether growth reached it.
    std::vector<bool> grow(const Vec3& near, std::span<const FaceId> among, const RunContext& context)
    {
        std::vector<bool> may(model_.faces.size(), false);
        for (const FaceId face : among) may[face.index()] = true;
        std::vector<bool> grown(cells_.size(), false);
        std::vector<Index> front{nearest(near, may)};
        grown[index(front[0])] = true;
        for (std::size_t i = 0; i < front.size(); ++i) {
            if (i % kBetweenPolls == 0) check_cancelled(context);
            const Index from = front[i];
            for (std::size_t k = 0; k < cells_[index(from)].count(); ++k) {
                const std::vector<Index>& here = users_.at(key(cells_[index(from)], k));
                if (here.size() != 2) continue;
                const Index to = here[0] == from ? here[1] : here[0];
                if (grown[index(to)] || !may[index(cells_[index(to)].face)]) continue;
                const double sign = runs(to, corner(from, k), corner(from, k + 1)) ? -1 : 1;
                if (sign * normal(from).dot(normal(to)) < least_cosine_) continue;
                grown[index(to)] = true;
                front.push_back(to);
            }
        }
        seed_ = cells_[index(front[0])].face;
        return grown;
    }
    [[nodiscard]] Index seed_face() const { return seed_; }

private:
    [[nodiscard]] Index corner(Index c, std::size_t k) const
    {
        return cells_[index(c)].corners[k % cells_[index(c)].count()];
    }
    static std::uint64_t key(const Cell& cell, std::size_t k)
    {
        return edge_key(cell.corners[k], cell.corners[(k + 1) % cell.count()]);
    }
    [[nodiscard]] bool runs(Index c, Index a, Index b) const
    {
        for (std::size_t k = 0; k < cells_[index(c)].count(); ++k)
            if (corner(c, k) == a && corner(c, k + 1) == b) return true;
        return false;
    }
    [[nodiscard]] Vec3 normal(Index c) const
    {
        Vec3 sum = Vec3::Zero();
        const Vec3& origin = model_.at(corner(c, 0));
        for (std::size_t k = 1; k + 1 < cells_[index(c)].count(); ++k)
            sum += (model_.at(corner(c, k)) - origin).cross(model_.at(corner(c, k + 1)) - origin);
        return sum.normalized();
    }

    [[nodiscard]] Index nearest(const Vec3& near, const std::vector<bool>& may) const
    {
        std::vector<Triangle> triangles;
        std::vector<Index> cell;
        std::size_t at = 0;
        for (std::size_t f = 0; f < model_.faces.size(); ++f)
            for (const Triangle& t : model_.faces[f].triangles) {
                if (may[f]) {
                    triangles.push_back(t);
                    cell.push_back(cell_of_triangle_[at]);
                }
                ++at;
            }
        return cell[index(geometry::FacetTree(model_.points, triangles).closest(near).triangle)];
    }

    const topology::Model& model_;
    double least_cosine_ = 0;
    std::vector<Cell> cells_;
    std::vector<Index> cell_of_triangle_; ///< cell of each triangle, in the order of the faces
    std::unordered_map<std::uint64_t, std::vector<Index>> users_;
    Index seed_ = -1;
};

/// The cells as a soup: one label for each face, and one more for the cells that growth reached.
FacetSoup soup_of(const topology::Model& model, const std::vector<Cell>& cells,
                  const std::vector<bool>& grown)
{
    FacetSoup soup;
    soup.points = model.points;
    const auto grown_label = static_cast<int>(model.faces.size());
    for (std::size_t c = 0; c < cells.size(); ++c) {
        const int label = grown[c] ? grown_label : cells[c].face;
        add_facet(soup, std::span(cells[c].corners).first(cells[c].count()), label);
    }
    for (int label = 0; label <= grown_label; ++label) soup.label_name.push_back(std::to_string(label));
    soup.label_keeps_nodes.assign(model.faces.size() + 1, 0);
    for (std::size_t c = 0; c < cells.size(); ++c)
        if (model.faces[index(cells[c].face)].keeps_nodes)
            soup.label_keeps_nodes[grown[c] ? index(grown_label) : index(cells[c].face)] = 1;
    return soup;
}

/// Restore the order, tags, names and groups of the faces, new faces last, and the model's source, diagonal
/// and notes.
void arrange(const topology::Model& before, Index seed, GrownFace& found)
{
    topology::ModelBuilder model(std::move(found.model));
    const std::size_t count = before.faces.size();
    std::vector<std::vector<std::size_t>> parts(count + 1); // faces of each label, the largest first
    for (std::size_t f = 0; f < model.faces.size(); ++f) parts[std::stoul(model.faces[f].name)].push_back(f);
    for (std::vector<std::size_t>& of : parts)
        std::ranges::stable_sort(of, std::greater{},
                                 [&](std::size_t f) { return model.faces[f].triangles.size(); });
    int next = 0;
    for (const topology::Face& face : before.faces) next = std::max(next, face.tag);
    std::vector<topology::Face> all;
    const auto take = [&](std::size_t from, std::size_t as, int tag) {
        topology::Face& face = all.emplace_back(std::move(model.faces[from]));
        const topology::Face& old = before.faces[as];
        face.tag = tag;
        face.name = old.name;
        face.groups = old.groups;
        face.regions = old.regions;
        face.origin = old.origin;
        face.geometry = old.geometry;
    };
    found.now.assign(count, FaceId());
    for (std::size_t f = 0; f < count; ++f) {
        if (parts[f].empty()) continue;
        found.now[f] = FaceId(all.size());
        take(parts[f][0], f, before.faces[f].tag);
    }
    found.face = FaceId(all.size());
    take(parts[count].at(0), index(seed), ++next);
    for (std::size_t f = 0; f < count; ++f)
        for (std::size_t p = 1; p < parts[f].size(); ++p) take(parts[f][p], f, ++next);
    for (std::size_t p = 1; p < parts[count].size(); ++p) take(parts[count][p], index(seed), ++next);
    model.faces = std::move(all);
    model.source = before.source;
    model.diagonal = before.diagonal;
    model.notes = before.notes;
    found.model = std::move(model).finish();
}

} // namespace

GrownFace grow_face(const topology::Model& model, const Vec3& near, std::span<const FaceId> among,
                    const GrowOptions& options, const RunContext& context)
{
    if (!(options.angle > 0 && options.angle <= 180))
        throw InvalidInput("topology.bad_angle",
                           "the angle is {:.6g} degrees; it must be above {} and at most {}",
                           lacuna::found(options.angle), needed(0), needed(180));
    if (among.empty())
        throw InvalidInput(Message("healing.nothing_to_grow", "no face matches the selection")
                               .remedy("give fewer conditions"));
    for (std::size_t f = 0; f < model.faces.size(); ++f)
        if (model.faces[f].surface)
            throw InvalidInput(
                Message("healing.exact_faces",
                        "{} has an exact CAD surface and cannot be split: only faces of facets can",
                        entity_of(model, FaceId(f)))
                    .remedy("select it as it is"));
    Grower grower(model, options.angle);
    const std::vector<bool> grown = grower.grow(near, among, context);
    const Index seed = grower.seed_face();
    // Whether growth took exactly one existing face.
    bool same = true;
    for (std::size_t c = 0; c < grown.size(); ++c)
        same = same && grown[c] == (grower.cells()[c].face == seed);
    if (same) {
        return {model, FaceId(index(seed)), all_faces(model)};
    }
    GrownFace found;
    found.model = split_facets(soup_of(model, grower.cells(), grown),
                               {options.feature_angle, model.tolerance, true}, context);
    arrange(model, seed, found);
    return found;
}

} // namespace lacuna::healing
