// SPDX-License-Identifier: MIT
#include <lacuna/topology/shared/patches.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/incidence.h>
#include <lacuna/geometry/shared/angle.h>
#include <lacuna/geometry/shared/union_find.h>
#include <lacuna/topology/detail/directed_sides.h>
#include <lacuna/topology/shared/facet_area.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <unordered_map>

namespace lacuna::topology {

namespace {

/// The facets next to the segments of edges: one per face at a segment.
class FacetsAtEdges {
public:
    FacetsAtEdges(const Model& model, const RunContext& context) : model_(model)
    {
        for (const Edge& edge : model.edges)
            for (std::size_t i = 0; i + 1 < edge.points.size(); ++i)
                ends_.emplace_back(std::minmax(edge.points[i], edge.points[i + 1]));
        last_.assign(ends_.size(), kNoIndex);
        at_low_ = incidence(model.points.size(), [&](const auto& visit) {
            for (std::size_t s = 0; s < ends_.size(); ++s)
                visit(index(ends_[s].first), static_cast<Index>(s));
        });
        for (std::size_t f = 0; f < model.faces.size(); ++f) {
            check_cancelled(context);
            for (const Triangle& t : model.faces[f].triangles) {
                for (std::size_t i = 0; i < 3; ++i) {
                    const std::size_t found = segment(t[i], t[(i + 1) % 3]);
                    if (found == ends_.size()) continue;
                    std::size_t& last = last_[found];
                    if (last != kNoIndex && facets_[last].face == FaceId(f)) continue;
                    facets_.push_back({FaceId(f), t, last}); // only the first of each face
                    last = facets_.size() - 1;
                }
            }
        }
    }

    /// Mean angle between two faces along a shared edge, negative if concave [degrees]; 0 if they meet
    /// smoothly.
    /// @pre two different faces use the edge
    [[nodiscard]] double fold_across(EdgeId edge) const
    {
        const std::vector<Index>& points = model_[edge].points;
        const std::span<const FaceUse> uses = model_.uses_of_edge(edge);
        double sum = 0, above = 0;
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            const std::size_t s = segment(points[i], points[i + 1]);
            const std::size_t one = facet(s, uses[0].face), other = facet(s, uses[1].face);
            if (one == kNoIndex || other == kNoIndex) continue;
            const Triangle& t = facets_[other].facet;
            const Vec3 normal = facet_area_vector(model_, facets_[one].facet).stableNormalized();
            const Vec3 next = facet_area_vector(model_, t).stableNormalized();
            const Vec3 middle = (model_.at(t[0]) + model_.at(t[1]) + model_.at(t[2])) / 3;
            sum += std::atan2(normal.cross(next).norm(), normal.dot(next));
            above += normal.dot(middle - model_.at(points[i]));
        }
        const double angle = sum / static_cast<double>(points.size() - 1) * 180 / std::numbers::pi;
        return above > 0 ? -angle : angle;
    }

private:
    struct Beside {
        FaceId face;
        Triangle facet;
        std::size_t before; ///< index of the segment's facet before this one
    };

    /// Index of the facet of a face at a segment.
    [[nodiscard]] std::size_t facet(std::size_t segment, FaceId face) const
    {
        std::size_t f = last_[segment];
        while (f != kNoIndex && facets_[f].face != face) f = facets_[f].before;
        return f;
    }

    /// The first segment between two points; the number of segments if there is none.
    [[nodiscard]] std::size_t segment(Index a, Index b) const
    {
        const auto [low, high] = std::minmax(a, b);
        for (const Index s : at_low_.of(index(low)))
            if (ends_[index(s)].second == high) return index(s);
        return ends_.size();
    }

    const Model& model_;
    std::vector<std::pair<Index, Index>> ends_; ///< of each segment, ascending
    Incidence at_low_;                          ///< segments by their lower point
    std::vector<std::size_t> last_;             ///< by segment: index of its last facet
    std::vector<Beside> facets_;
};

template <class Id>
void sort_once(std::vector<Id>& ids)
{
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

void measure(const Model& model, SmoothPatch& patch, DirectedSides& sides)
{
    Vec3 sum = Vec3::Zero();
    for (const FaceId face : patch.faces) {
        const double area = face_area(model, face);
        patch.area += area;
        patch.centre += area * face_centroid(model, face);
        sum += face_area_vector(model, face);
        for (const EdgeUse& use : uses_of(model[face])) {
            patch.edges.push_back(use.edge);
            patch.vertices.push_back(use_from(model, use));
        }
    }
    patch.centre /= patch.area;
    patch.flatness = sum.norm() / patch.area;
    patch.normal = sum.stableNormalized();
    patch.rims = rims(model, patch.faces);
    sort_once(patch.edges);
    sort_once(patch.vertices);
    // An edge has one segment more than it has inner points, so without its points and segments the Euler
    // number is larger by 1.
    patch.inner_euler = euler_number(model, patch.faces, sides) - static_cast<long>(patch.vertices.size()) +
                        static_cast<long>(patch.edges.size());
}

/// Turn of a rim at a vertex in quarter turns, from the interior angle there: 1 at a right angle, 0 if the
/// rim is straight, negative if the interior angle is reflex.
long quarter_turns(double angle)
{
    return std::clamp(std::lround(2 - angle / (std::numbers::pi / 2)), -2L, 1L);
}

/// Sum up a patch's facets: the spread of their normals, and the turns of its rims.
/// @param is_vertex  for each model point, whether a vertex is there
void measure_facets(const Model& model, const std::vector<bool>& is_vertex, SmoothPatch& patch)
{
    std::unordered_map<Index, double> inside; // interior angle at the rims' vertices, by their points
    for (const Rim& rim : patch.rims)
        for (const EdgeUse& use : rim.uses) inside.emplace(model[use_from(model, use)].point, 0);
    for (const FaceId face : patch.faces) {
        for (const Triangle& t : model[face].triangles) {
            const Vec3 twice = (model.at(t[1]) - model.at(t[0])).cross(model.at(t[2]) - model.at(t[0]));
            const double length = twice.norm();
            if (length > 0) patch.spread += twice * twice.transpose() / (2 * length);
            for (std::size_t i = 0; i < 3; ++i) {
                if (!is_vertex[index(t[i])]) continue;
                const auto found = inside.find(t[i]);
                if (found == inside.end()) continue;
                const Vec3 a = model.at(t[(i + 1) % 3]) - model.at(t[i]);
                const Vec3 b = model.at(t[(i + 2) % 3]) - model.at(t[i]);
                found->second += geometry::angle_between(a, b);
            }
        }
    }
    for (const auto& [point, angle] : inside) patch.corners += quarter_turns(angle);
}

} // namespace

std::vector<double> folds_across(const Model& model, const RunContext& context)
{
    const FacetsAtEdges facets(model, context);
    std::vector<double> angle(model.edges.size(), 0);
    for (std::size_t e = 0; e < angle.size(); ++e) {
        const std::span<const FaceUse> uses = model.uses_of_edge(EdgeId(e));
        if (uses.size() != 2 || uses[0].face == uses[1].face) continue;
        check_cancelled(context);
        angle[e] = facets.fold_across(EdgeId(e));
    }
    return angle;
}

std::vector<double> angles_across(const Model& model, const RunContext& context)
{
    std::vector<double> angles = folds_across(model, context);
    for (double& angle : angles) angle = std::abs(angle);
    return angles;
}

std::vector<SmoothPatch> smooth_patches(const Model& model, const std::vector<double>& angle,
                                        const RunContext& context)
{
    geometry::UnionFind smooth(model.faces.size());
    for (std::size_t e = 0; e < model.edges.size(); ++e) {
        const std::span<const FaceUse> uses = model.uses_of_edge(EdgeId(e));
        if (uses.size() != 2 || uses[0].face == uses[1].face) continue;
        if (angle[e] < kCreaseAngle) smooth.unite_least(uses[0].face.index(), uses[1].face.index());
    }
    std::map<std::size_t, SmoothPatch> by_root;
    for (std::size_t f = 0; f < model.faces.size(); ++f) by_root[smooth.find(f)].faces.emplace_back(f);
    std::vector<SmoothPatch> patches;
    DirectedSides sides(model.points.size());
    std::vector<bool> is_vertex(model.points.size(), false);
    for (const Vertex& vertex : model.vertices) is_vertex[index(vertex.point)] = true;
    for (auto& [root, patch] : by_root) {
        check_cancelled(context);
        measure(model, patch, sides);
        measure_facets(model, is_vertex, patch);
        double sum = 0, length = 0;
        for (const Rim& rim : patch.rims) {
            for (const EdgeUse& use : rim.uses) {
                if (model.uses_of_edge(use.edge).size() != 2) continue;
                const double l = edge_length(model, use.edge);
                sum += l * std::abs(angle[use.edge.index()] - 90) / 90;
                length += l;
            }
        }
        patch.slant = length > 0 ? sum / length : 0;
        patches.push_back(std::move(patch));
    }
    return patches;
}

} // namespace lacuna::topology
