// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/core/types.h>

#include <span>

namespace lacuna::geometry {

/// The surface a face was faceted from, as something that can be projected on. The kernel never asks what
/// it is; `cad/` implements it, and so may a host with a CAD kernel of its own.
class ExactSurface {
public:
    virtual ~ExactSurface() = default;

    /// Move each point to the closest point of the surface near its start parameter.
    ///
    /// @param points  in: near the surface; out: on it to rounding [model length].
    /// @param uv      in: a start parameter for each point (as that of the closest facet); out: the point's
    ///         own.
    /// @pre  points.size() == uv.size().
    /// @throw BackendError where the projection does not converge; Cancelled.
    virtual void project(std::span<Vec3> points, std::span<Vec2> uv,
                         const RunContext& context = {}) const = 0;
};

/// The curve an edge was faceted from.
class ExactCurve {
public:
    virtual ~ExactCurve() = default;

    /// Points of the curve at its own parameters. @pre params.size() == points.size().
    virtual void evaluate(std::span<const double> params, std::span<Vec3> points,
                          const RunContext& context = {}) const = 0;
};

} // namespace lacuna::geometry
