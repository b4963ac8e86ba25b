// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/size_field.h>
#include <lacuna/topology/model.h>

#include <array>
#include <cstddef>
#include <vector>

/// Prediction of a grid on a four-sided face. Internal to this folder.
namespace lacuna::surface {

/// A grid over a face, sampled in space.
class MappedFace {
public:
    /// @param corners  from `four_corners()`.
    MappedFace(const topology::Model& model, FaceId face, const std::vector<std::size_t>& corners);

    /// Number of sides that the size requires on each of some evenly spaced lines inside the face: first for
    /// lines parallel to sides 0 and 2, then for lines parallel to sides 1 and 3.
    [[nodiscard]] std::array<std::vector<double>, 2> wanted_inside(const SizeField& size) const;

    struct Shape {
        double mean_scaled_jacobian = 1; ///< in space
        /// Share of the grid's sides in one direction whose length relative to the size is 0.6 to 1.6 times
        /// the root mean square of this relative length. The smaller share of both directions.
        double even_share = 1;
    };
    /// Quality of the best grid with any number of columns and rows.
    [[nodiscard]] Shape shape(const SizeField& size) const;

private:
    [[nodiscard]] const Vec3& at(std::size_t i, std::size_t j) const;
    [[nodiscard]] double sides_between(const Vec3& a, const Vec3& b, const SizeField& size) const;

    std::vector<Vec3> points_; ///< row by row from side 0
};

} // namespace lacuna::surface
