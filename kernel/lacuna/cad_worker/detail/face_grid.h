// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lacuna/cad_worker/detail/cad_curves.h>
#include <lacuna/cad_worker/exact_geometry.h>

#include <vector>

namespace lacuna::cad_worker {

/// Piecewise linear, increasing map from a surface parameter to a grid coordinate. Grid lines are at integer
/// grid coordinates.
class GridAxis {
public:
    GridAxis() = default;
    /// @param density  number of grid lines wanted in each interval between knots.
    GridAxis(std::vector<double> knots, const std::vector<double>& density, int least_cells);

    [[nodiscard]] double to_grid(double parameter) const { return through(knots_, grid_, parameter); }
    [[nodiscard]] double to_parameter(double grid) const { return through(grid_, knots_, grid); }
    [[nodiscard]] int cells() const { return cells_; }

private:
    /// Value at `x` of the piecewise linear map that takes `from` to `to`.
    static double through(const std::vector<double>& from, const std::vector<double>& to, double x);

    std::vector<double> knots_, grid_;
    int cells_ = 1;
};

/// A grid over the parameter rectangle of a face.
struct FaceGrid {
    std::array<GridAxis, 2> axis;

    [[nodiscard]] Vec2 to_grid(const Vec2& uv) const
    {
        return {axis[0].to_grid(uv.x()), axis[1].to_grid(uv.y())};
    }
    [[nodiscard]] Vec2 to_uv(const Vec2& grid) const
    {
        return {axis[0].to_parameter(grid.x()), axis[1].to_parameter(grid.y())};
    }
};

/// Choose the grid lines such that between neighbouring lines the normal turns no more than the fineness
/// allows, and that cells are neither too long nor too slender. If this takes more than `max_cells` cells,
/// all cells become larger.
FaceGrid lay_grid(int tag, bool flat, const ParameterBox& box, const Fineness& fineness, double max_cells);

} // namespace lacuna::cad_worker
