// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lacuna/cad_worker/detail/cad_curves.h>
#include <lacuna/cad_worker/exact_geometry.h>

#include <vector>

namespace lacuna::cad_worker {

/// A map of one surface parameter to grid coordinates, in which the grid lines are the integers. Rising,
/// linear between knots.
class GridAxis {
public:
    GridAxis() = default;
    /// @param density  lines wanted between each knot and the next.
    GridAxis(std::vector<double> knots, const std::vector<double>& density, int least_cells);

    [[nodiscard]] double to_grid(double parameter) const;
    [[nodiscard]] double to_parameter(double grid) const;
    [[nodiscard]] int cells() const { return cells_; }

private:
    std::vector<double> knots_, grid_;
    int cells_ = 1;
};

/// The grid over a face's parameter rectangle.
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

/// Lay lines so that the normal turns, and the surface runs, no more than the fineness allows from one to the
/// next, cells are not too long, and there are not too many of them.
FaceGrid lay_grid(int tag, bool flat, const ParameterBox& box, const Fineness& fineness, double max_cells);

} // namespace lacuna::cad_worker
