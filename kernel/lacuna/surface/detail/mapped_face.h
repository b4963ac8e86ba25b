// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/size_field.h>
#include <lacuna/topology/model.h>

#include <array>
#include <cstddef>
#include <vector>

/// Estimate of the quality of a mapped mesh on a four-sided face. Internal to this folder.
namespace lacuna::surface {

/// A fine grid of sample points over a face, by transfinite interpolation between its four sides.
class MappedFace {
public:
    /// @param corners  from `four_corners()`.
    MappedFace(const topology::Model& model, FaceId face, const std::vector<std::size_t>& corners);

    /// Number of sides that the size requires on each of some evenly spaced lines inside the face: first for
    /// lines parallel to sides 0 and 2, then for lines parallel to sides 1 and 3.
    [[nodiscard]] std::array<std::vector<double>, 2> wanted_inside(const SizeField& size) const;

    struct Shape {
        double mean_scaled_jacobian = 1; ///< mean over the quads of the sample grid, in space
        /// Relative length of a side: its length divided by the requested size. For each direction of the
        /// grid, take the share of sides whose relative length is 0.6 to 1.6 times the root mean square
        /// relative length. This is the smaller of the two shares.
        double even_share = 1;
    };
    /// Quality of a mapped mesh if its numbers of columns and rows are chosen well.
    [[nodiscard]] Shape shape(const SizeField& size) const;

private:
    [[nodiscard]] const Vec3& at(std::size_t i, std::size_t j) const;
    [[nodiscard]] double sides_between(const Vec3& a, const Vec3& b, const SizeField& size) const;

    std::vector<Vec3> points_; ///< row by row from side 0
};

} // namespace lacuna::surface
