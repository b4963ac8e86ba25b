// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/geometry/facet_tree.h>
#include <lacuna/topology/model.h>

#include <mutex>
#include <span>
#include <vector>

namespace lacuna::surface {

/// A point that was projected on a face: where on the facets it came from, and where it is now. What it
/// points to is the caller's.
struct Projected {
    const geometry::FacetTree::Hit* from = nullptr; ///< the closest place on the facets
    Index triangle = -1;                            ///< that facet, of the face
    Vec3* at = nullptr;                             ///< on the exact surface
};

/// The border of a face with exact geometry, which its surface goes beyond.
///
/// A seam is no border, nor is a pole. Inside and outside are told by the side of the border's polyline that
/// is nearest, at its corners by the sum of the two inward directions (Bærentzen and Aanæs 2005), and where a
/// point is as near as the curve may bulge, by the exact curve.
class Trimming {
public:
    Trimming(const topology::Model& model, FaceId face);

    /// Move every point outside the face to the nearest point of its trimming curves; the others stay to the
    /// bit. Costs the points well inside a comparison.
    void keep_inside(std::span<const Projected> points, const RunContext& context = {}) const;

private:
    /// A side of the border's polyline, as the loop runs.
    struct Side {
        topology::EdgeUse use{};
        std::size_t segment = 0; ///< of the edge, as the edge runs
        Vec3 normal = Vec3::Zero(), inward = Vec3::Zero();
        Vec3 inward_at_start = Vec3::Zero(), inward_at_end = Vec3::Zero();
        double bulge = 0; ///< how far off the curve may be at most [model length]
    };
    /// A point that is outside, or so near to the border that its curve must tell.
    struct Near {
        std::size_t point = 0, side = 0;
        double share = 0; ///< of the side
        Vec3 on_border = Vec3::Zero(), inward = Vec3::Zero();
    };

    /// How far a place of a facet is from the border at least.
    struct Clearance {
        double facet = 0;            ///< of the whole facet [model length]
        Vec3 heights = Vec3::Zero(); ///< of the facet over each side [model length]
    };

    void add_loop(const topology::Loop& loop, const std::vector<Index>& facet_of_side);
    [[nodiscard]] Clearance clearance_of(Index triangle) const;
    void measure_clearance() const;
    [[nodiscard]] bool is_clear(const Projected& point, bool measured) const;
    [[nodiscard]] bool is_near(const Projected& point, Near& near) const;
    void settle(std::span<const Projected> points, std::span<Near> near) const;

    const topology::Model* model_;
    FaceId face_;
    std::vector<Side> sides_;
    geometry::FacetTree tree_; ///< a facet of no area for each side
    double most_bulge_ = 0;
    mutable std::once_flag once_;
    mutable std::vector<Clearance> clearance_; ///< of each facet, once that is asked for
};

} // namespace lacuna::surface
