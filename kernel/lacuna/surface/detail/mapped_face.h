// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/size_field.h>
#include <lacuna/topology/model.h>

#include <array>
#include <cstddef>
#include <vector>

/// How a grid lies on a face of four sides, before there is one. Internal to this folder.
namespace lacuna::surface {

/// A grid over a face, sampled in space.
class MappedFace {
public:
    /// @param corners  from `four_corners()`.
    MappedFace(const topology::Model& model, FaceId face, const std::vector<std::size_t>& corners);

    /// Sides that the size asks for on lines between the sides of a pair, evenly spread from the one to the
    /// other, those two left out: of the sides 0 and 2, and of 1 and 3.
    [[nodiscard]] std::array<std::vector<double>, 2> wanted_inside(const SizeField& size) const;

    struct Shape {
        double mean_scaled_jacobian = 1; ///< in space
        /// Of its sides along one way, those 0.6 to 1.6 times as long as their root mean square, all by the
        /// size asked for: the way with fewer.
        double even_share = 1;
    };
    /// How good the best grid will be, with any number of columns and rows.
    [[nodiscard]] Shape shape(const SizeField& size) const;

private:
    [[nodiscard]] const Vec3& at(std::size_t i, std::size_t j) const;
    [[nodiscard]] double sides_between(const Vec3& a, const Vec3& b, const SizeField& size) const;

    std::vector<Vec3> points_; ///< row by row from side 0
};

} // namespace lacuna::surface
