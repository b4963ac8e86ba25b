// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/core/types.h>

#include <span>

namespace lacuna::geometry {

/// The exact surface of a face; points can be projected onto it. The kernel does not know the type of the
/// surface: `cad/` implements it, and a host may implement it with its own CAD kernel.
class ExactSurface {
public:
    virtual ~ExactSurface() = default;

    /// Project each point to the surface, near its start parameters.
    ///
    /// @param points  in: near the surface; out: on it up to rounding [model length].
    /// @param uv      in: start parameters of each point, such as those of the closest facet; out: the
    ///         parameters of the projected point.
    /// @pre  points.size() == uv.size().
    /// @throw BackendError  the projection does not converge; Cancelled.
    virtual void project(std::span<Vec3> points, std::span<Vec2> uv,
                         const RunContext& context = {}) const = 0;
};

/// The exact curve of an edge.
class ExactCurve {
public:
    virtual ~ExactCurve() = default;

    /// Evaluate the curve at parameters. @pre params.size() == points.size().
    virtual void evaluate(std::span<const double> params, std::span<Vec3> points,
                          const RunContext& context = {}) const = 0;
};

} // namespace lacuna::geometry
