// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/topology/model.h>

#include <span>
#include <vector>

namespace lacuna::surface {

/// A point that was projected onto a face.
struct Projected {
    const geometry::FacetTree::Hit* from = nullptr; ///< the closest point on the facets
    Index triangle = -1;                            ///< index of that facet in the face
    Vec3* at = nullptr; ///< the point after projection, on the exact surface; `keep_inside()` moves it
};

/// The border of a face with exact geometry. The exact surface extends beyond the border.
///
/// Seams and poles are not part of the border. Whether a point is inside or outside follows from the nearest
/// place on the border's polyline: the point is inside if it lies in the inward direction from there.
/// - Between the ends of a side, the inward direction is that of the side.
/// - At a corner, it is the sum of the inward directions of both sides (Bærentzen and Aanæs 2005).
/// - If the distance from the side is at most `Side::bulge`, the exact curve may pass on either side of the
///   point. The nearest point of the exact curve is then used instead.
class Trimming {
public:
    Trimming(const topology::Model& model, FaceId face);

    /// Move every point outside the face to the nearest point of the face's border curves. Other points stay
    /// bit-identical.
    void keep_inside(std::span<const Projected> points, const RunContext& context = {}) const;

private:
    /// A side of the border's polyline, in the direction of the loop.
    struct Side {
        topology::EdgeUse use{};
        std::size_t segment = 0; ///< segment of the edge, in the direction of the edge
        Vec3 normal = Vec3::Zero(), inward = Vec3::Zero();
        Vec3 inward_at_start = Vec3::Zero(), inward_at_end = Vec3::Zero();
        double bulge = 0; ///< largest distance of the exact curve from this side [model length]
    };
    /// A point that is outside, or so close to the border that the exact curve must decide.
    struct Near {
        std::size_t point = 0, side = 0;
        double share = 0; ///< position as a share of the side
        Vec3 on_border = Vec3::Zero(), inward = Vec3::Zero();
    };

    void add_loop(const topology::Loop& loop, const std::vector<Index>& facet_of_side);
    [[nodiscard]] double to_sides(const Projected& point) const;
    [[nodiscard]] bool is_near(const Projected& point, Near& near) const;
    void settle(std::span<const Projected> points, std::span<Near> near) const;

    const topology::Model* model_;
    FaceId face_;
    std::vector<Side> sides_;
    geometry::FacetTree tree_; ///< one degenerate facet (without area) for each side
    double most_bulge_ = 0;
};

} // namespace lacuna::surface
