// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/geometry/exact.h>
#include <lacuna/geometry/shared/motion.h>

#include <memory>
#include <span>
#include <utility>
#include <vector>

/// Exact geometry of a volume that a motion creates from a source: the paths of the source's vertices, the
/// surfaces swept by its edges, and the moved source.
namespace lacuna::geometry {

/// The path of a point. Its parameter is the height, see `Motion`.
class PointPath final : public ExactCurve {
public:
    PointPath(MotionPointer motion, const Vec3& point) : motion_(std::move(motion)), point_(point) {}
    void evaluate(std::span<const double> params, std::span<Vec3> points,
                  const RunContext& context) const override;

private:
    MotionPointer motion_;
    Vec3 point_;
};

/// A curve of the source, moved to a height of the sweep. It keeps its parameter.
class MovedCurve final : public ExactCurve {
public:
    MovedCurve(MotionPointer motion, double height, std::shared_ptr<const ExactCurve> curve)
        : motion_(std::move(motion)), height_(height), curve_(std::move(curve))
    {
    }
    void evaluate(std::span<const double> params, std::span<Vec3> points,
                  const RunContext& context) const override;

private:
    MotionPointer motion_;
    double height_;
    std::shared_ptr<const ExactCurve> curve_;
};

/// A surface of the source, moved to a height of the sweep. It keeps its parameters.
/// @pre the motion is affine
class MovedSurface final : public ExactSurface {
public:
    MovedSurface(MotionPointer motion, double height, std::shared_ptr<const ExactSurface> surface)
        : motion_(std::move(motion)), height_(height), surface_(std::move(surface))
    {
    }
    void project(std::span<Vec3> points, std::span<Vec2> uv, const RunContext& context) const override;

private:
    MotionPointer motion_;
    double height_;
    std::shared_ptr<const ExactSurface> surface_;
};

/// An edge of a source: its exact curve if it has one, otherwise its polyline. The parameter of a polyline is
/// the index of the point.
struct SweptEdge {
    std::shared_ptr<const ExactCurve> curve; ///< null: the edge is the polyline
    std::vector<Vec3> points;
    std::vector<double> params; ///< parameter of each point
};

/// The surface that an edge sweeps between two heights. Its parameters are the parameter of the edge and the
/// height.
class SweptSurface final : public ExactSurface {
public:
    SweptSurface(MotionPointer motion, SweptEdge edge, double from, double to)
        : motion_(std::move(motion)), edge_(std::move(edge)), from_(from), to_(to)
    {
    }
    /// Projects along the surface's normals, by the Gauss-Newton method.
    void project(std::span<Vec3> points, std::span<Vec2> uv, const RunContext& context) const override;
    /// The points of the surface at the given parameters.
    [[nodiscard]] std::vector<Vec3> at(std::span<const Vec2> uv, const RunContext& context = {}) const;

    [[nodiscard]] const MotionPointer& motion() const { return motion_; }
    /// Parameters of the edge's points, and the range of heights.
    [[nodiscard]] const std::vector<double>& params() const { return edge_.params; }
    [[nodiscard]] std::pair<double, double> heights() const { return {from_, to_}; }
    /// Whether the edge has a kink at each of its points.
    [[nodiscard]] bool has_kinks() const { return edge_.curve == nullptr; }

private:
    MotionPointer motion_;
    SweptEdge edge_;
    double from_, to_;
};

} // namespace lacuna::geometry
