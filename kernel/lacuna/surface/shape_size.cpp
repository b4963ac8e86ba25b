// SPDX-License-Identifier: MIT
#include <lacuna/surface/shared/shape_size.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/edge_key.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/quads/shared/measure_plane.h>
#include <lacuna/surface/detail/edge_turning.h>
#include <lacuna/surface/detail/face_sides.h>
#include <lacuna/surface/detail/facet_curvature.h>
#include <lacuna/surface/detail/graded_points.h>
#include <lacuna/surface/detail/width_sizes.h>
#include <lacuna/surface/shared/edge_nodes.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

namespace lacuna::surface {

using namespace topology;

namespace {

/// Two points of one edge face each other only if the path along the edge is longer than this multiple of the
/// chord. For a half circle the ratio is 1.57 [-].
constexpr double kWayRound = 1.5;
/// Minimum size that the curvature of a face requests, as a share of the requested size. Quads have the same
/// size in both directions, so a sharp bend in one direction would otherwise need hundreds of quads.
/// Heuristic.
constexpr double kLeastShare = 0.5;

/// Keep the cause with the smaller size.
void take_least(std::optional<SizeCause>& least, const SizeCause& cause)
{
    if (!least || cause.size < least->size) least = cause;
}

/// Add sizes required by curvature at the vertices of a face's facets.
void add_curvature(const Model& model, FaceId face, const SizeField& asked, int per_turn,
                   std::vector<PointSize>& sizes, std::optional<SizeCause>& cause)
{
    for (const PointCurvature& at : facet_curvature(model, face)) {
        if (!(at.most > 0)) continue;
        double size = std::max(kFullTurn / (at.most * per_turn), at.least_size);
        size = std::max(size, kLeastShare * asked(at.point));
        if (!(size < asked(at.point))) continue;
        sizes.push_back({at.point, size});
        take_least(cause, {size, face, {}, {}, 0});
    }
}

/// A point of a face's boundary.
struct RimPoint {
    Vec3 point;
    Vec3 inward; ///< unit vector in the face
    double curvature = 0;
};

/// A straight piece of a face's boundary.
struct RimPiece {
    EdgeId edge;
    Vec3 start;
    double from = 0;   ///< running length on the edge at the start of the piece
    double length = 0; ///< length of the whole edge
};

/// The boundary of a face as pieces in a tree. It finds the sizes that the local width requires.
class Width {
public:
    /// @param least  minimum size in narrow places, as a share of the requested size.
    Width(const Model& model, FaceId face, double least = 0) : model_(model), face_(face), least_(least)
    {
        double rim = 0;
        std::map<EdgeId, int> uses;
        for (const EdgeUse& use : uses_of(model[face])) ++uses[use.edge];
        std::vector<Vec3> points;
        std::vector<Triangle> triangles;
        for (const auto& [edge, count] : uses) {
            if (count > 1) continue; // a seam is not a boundary
            const std::vector<Vec3> line = edge_line(model, edge);
            const std::vector<double> arc = geometry::arc_lengths(line);
            for (std::size_t i = 0; i + 1 < line.size(); ++i) {
                const auto p = static_cast<Index>(points.size());
                points.push_back(line[i]);
                points.push_back(line[i + 1]);
                triangles.push_back({p, p + 1, p + 1});
                pieces_.push_back({edge, line[i], arc[i], arc.back()});
            }
            edges_.push_back(edge);
            rim += arc.back();
        }
        if (rim > 0) mean_width_ = 2 * face_area(model, face) / rim;
        tree_ = geometry::FacetTree(points, triangles);
        for (const Triangle& t : model[face].triangles) {
            for (std::size_t k = 0; k < 3; ++k) opposite_[edge_key(t[k], t[(k + 1) % 3])] = t[(k + 2) % 3];
        }
    }

    void add(const SizeField& asked, const ShapeSizing& sizing, std::vector<PointSize>& sizes,
             std::optional<SizeCause>& cause) const
    {
        for (const EdgeId edge : edges_) add(edge, asked, sizing, sizes, cause);
    }

private:
    /// The boundary point opposite to another boundary point.
    struct Opposite {
        EdgeId edge;
        double width = 0;
    };

    void add(EdgeId edge, const SizeField& asked, const ShapeSizing& sizing, std::vector<PointSize>& sizes,
             std::optional<SizeCause>& cause) const
    {
        const std::vector<Index>& chain = model_[edge].points;
        const EdgeTurning turning(model_, edge);
        double start = 0;
        for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
            const Vec3 &a = model_.at(chain[i]), &b = model_.at(chain[i + 1]);
            const double length = (b - a).norm();
            const auto corner = opposite_.find(edge_key(chain[i], chain[i + 1]));
            if (!(length > 0) || corner == opposite_.end()) continue;
            const Vec3 along = (b - a) / length;
            const Vec3 up = model_.at(corner->second) - a;
            const Vec3 inward = (up - up.dot(along) * along).stableNormalized();
            const double wanted = kSamplesPerSide * length / asked((a + b) / 2);
            const auto count = static_cast<std::size_t>(std::clamp(wanted, 1.0, kMostSamples));
            std::vector<std::array<double, 2>> parts; // intervals of the piece still to be sampled
            for (std::size_t k = count; k-- > 0;) {
                parts.push_back({length * static_cast<double>(k) / static_cast<double>(count),
                                 length * static_cast<double>(k + 1) / static_cast<double>(count)});
            }
            while (!parts.empty()) {
                const auto [from, to] = parts.back();
                parts.pop_back();
                const RimPoint at{a + (from + to) / 2 * along, inward,
                                  turning.between(start + from, start + to) / (to - from)};
                // The mesh sides are at most this long, because of the requested size and the edge's
                // curvature.
                const double bend = at.curvature * sizing.curvature / kFullTurn;
                const double most = 1 / std::max(1 / asked(at.point), bend);
                // At a larger width than this, the size is not reduced. Where the rim's curvature asks
                // for shorter sides, a straight edge opposite within the requested size gets similar ones.
                const double reach = std::max({sizing.gap * most,
                                               at.curvature * most * most / (8 * kSagOfWidth),
                                               most < asked(at.point) ? asked(at.point) : 0});
                const auto facing = opposite(edge, start + (from + to) / 2, at, reach);
                if (!facing) continue;
                const double width = facing->width;
                const auto because = [&](double size) {
                    take_least(cause, {size, face_, edge, facing->edge, width});
                };
                if (most < asked(at.point) && width < asked(at.point) && is_straight(facing->edge)) {
                    sizes.push_back({at.point, most});
                    because(most);
                }
                if (at.curvature > 0) {
                    const double size = std::sqrt(8 * kSagOfWidth * width / at.curvature);
                    if (size < most) sizes.push_back({at.point, size});
                    if (size < most) because(size);
                }
                double share = sizing.gap > 0 ? width / sizing.gap : most;
                share = std::max(share, least_ * asked(at.point));
                if (share >= most) continue;
                // Also add the point halfway to the opposite rim, so that quads stay small between the two
                // rims.
                sizes.push_back({at.point, share});
                sizes.push_back({at.point + width / 2 * at.inward, share});
                because(share);
                // If the interval is longer than `kApart` times the new size, divide it: otherwise the size
                // would grow too much between two samples.
                if (to - from > kApart * share && length < kMostSamples * (to - from)) {
                    parts.push_back({(from + to) / 2, to});
                    parts.push_back({from, (from + to) / 2});
                }
            }
            start += length;
        }
    }

    [[nodiscard]] bool is_straight(EdgeId edge) const
    {
        const std::vector<Vec3> line = edge_line(model_, edge);
        return geometry::arc_lengths(line).back() <= (line.back() - line.front()).norm() + model_.tolerance;
    }

    /// The boundary point opposite to this position, if it is within `reach`.
    [[nodiscard]] std::optional<Opposite> opposite(EdgeId edge, double s, const RimPoint& at,
                                                   double reach) const
    {
        if (!(reach > 0)) return std::nullopt;
        double radius = reach / 2;
        Vec3 met = at.point;
        std::optional<std::size_t> piece;
        for (int i = 0; i < kMostSteps; ++i) {
            const Vec3 centre = at.point + radius * at.inward;
            const auto hit = tree_.closest(centre, radius * radius * (1 - kVisible) * (1 - kVisible));
            if (hit.triangle < 0) break;
            const Vec3 to = hit.point - at.point;
            const double rise = to.dot(at.inward);
            if (!(rise > 0)) return std::nullopt;
            radius = to.squaredNorm() / (2 * rise);
            met = hit.point;
            piece = index(hit.triangle);
        }
        if (!piece) return std::nullopt;
        const double width = (met - at.point).norm();
        if (!(width > model_.tolerance) || (met - at.point).dot(at.inward) < kFacing * width)
            return std::nullopt;
        const EdgeId other = pieces_[*piece].edge;
        const Edge &a = model_[edge], &b = model_[other];
        if (edge == other) {
            const RimPiece& there = pieces_[*piece];
            double way = std::abs(there.from + (met - there.start).norm() - s);
            if (a.from == a.to) way = std::min(way, there.length - way);
            return way > kWayRound * width ? std::optional(Opposite{other, width}) : std::nullopt;
        }
        const bool at_start = a.from == b.from || a.from == b.to, at_end = a.to == b.from || a.to == b.to;
        if (!at_start && !at_end) return Opposite{other, width};
        // Near a common corner of two edges, the width goes to zero and is ignored. If the edges have both
        // ends in common, they enclose the face, and the width is at least the face's mean width.
        if (!at_start || !at_end || a.from == a.to) return std::nullopt;
        return Opposite{other, std::max(width, mean_width_)};
    }

    const Model& model_;
    FaceId face_;
    double least_;
    double mean_width_ = 0;
    geometry::FacetTree tree_;
    std::vector<RimPiece> pieces_; ///< piece of each triangle in the tree
    std::vector<EdgeId> edges_;
    std::unordered_map<std::uint64_t, Index> opposite_; ///< corner of the facet at a side
};

/// Whether a face can be mapped.
bool is_mapped(const Model& model, FaceId face)
{
    const auto corners = four_corners(model, face);
    return corners && alike(model, side_pairs(model, face, *corners));
}

/// Whether rows of quads around a face fill it: its two loops have no corners, and their distance varies less
/// than the accepted lengths of sides do.
bool is_ring(const Model& model, FaceId face)
{
    const std::vector<Loop>& loops = model[face].loops;
    if (loops.size() != 2) return false;
    for (const Loop& loop : loops) {
        for (std::size_t i = 0; i < loop.uses.size(); ++i) {
            const double angle = inner_angle(model, face, loop, i);
            if (angle < kCornerBelow || angle > kReversalAbove) return false;
        }
    }
    double least = kInfinity, most = 0;
    for (const std::size_t l : {0, 1}) {
        const std::vector<Index> facing = loop_points(model, loops[1 - l].uses);
        std::vector<Triangle> pieces;
        for (std::size_t i = 0; i < facing.size(); ++i)
            pieces.push_back({facing[i], facing[(i + 1) % facing.size()], facing[i]});
        const geometry::FacetTree tree(model.points, pieces);
        for (const Index p : loop_points(model, loops[l].uses)) {
            const double width = std::sqrt(tree.closest(model.at(p)).distance2);
            least = std::min(least, width);
            most = std::max(most, width);
        }
    }
    return least > 0 && most * quads::kShortestOfSize <= least * quads::kLongestOfSize;
}

} // namespace

void add_width_sizes(const Model& model, FaceId face, const SizeField& asked, const ShapeSizing& sizing,
                     double least, std::vector<PointSize>& sizes)
{
    std::optional<SizeCause> cause;
    Width(model, face, least).add(asked, sizing, sizes, cause);
}

ShapeSize shape_size(const OpenVolume& volume, const SizeField& asked, const ShapeSizing& sizing)
{
    ShapeSize result{asked, {}, {}};
    std::vector<PointSize> sizes;
    for (const FaceId face : volume.faces(Role::source)) {
        if (sizing.curvature > 0)
            add_curvature(volume.model, face, asked, sizing.curvature, sizes, result.curvature);
        if (sizing.counts_across && is_ring(volume.model, face)) continue;
        ShapeSizing own = sizing;
        if (sizing.counts_across && is_mapped(volume.model, face)) own.gap = 0;
        Width(volume.model, face).add(asked, own, sizes, result.width);
    }
    if (sizes.empty()) return result;
    result.at = [asked, points = std::make_shared<const GradedPoints>(std::move(sizes), kGrading)](
                    const Vec3& p) { return points->at(p, asked(p)); };
    return result;
}

} // namespace lacuna::surface
