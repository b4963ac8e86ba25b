// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

#include <optional>
#include <span>
#include <vector>

namespace lacuna::healing {

/// An edge to measure distances to: its exact curve where it has one, else its polyline.
class EdgeTrack {
public:
    /// The track keeps what it needs; the model may change.
    EdgeTrack(const topology::Model& model, EdgeId edge, const RunContext& context);

    /// A place of the edge.
    struct EdgePosition {
        double s = 0;        ///< place on the polyline: 2.25 is a quarter of the way from point 2 to point 3
        double param = 0;    ///< of the curve; 0 without one
        double distance = 0; ///< of the point asked about [model length]
        Vec3 at = Vec3::Zero();
    };
    /// The place closest to each point, wherever it is.
    [[nodiscard]] std::vector<EdgePosition> locate(std::span<const Vec3> points, double tolerance,
                                                   const RunContext& context) const;
    /// The place close to each point, the points being met in order: each search goes on from the last
    /// place, so that `s` never falls. Nothing where a point is further than `tolerance`.
    [[nodiscard]] std::optional<std::vector<EdgePosition>> follow(std::span<const Vec3> points,
                                                                  double tolerance,
                                                                  const RunContext& context) const;

    /// The polyline; with a curve, with a point of it in the middle of every side too.
    [[nodiscard]] const std::vector<Vec3>& samples() const { return points_; }
    /// How far the curve may be from the samples' chords [model length].
    [[nodiscard]] double sagitta() const { return sagitta_; }
    [[nodiscard]] double length() const { return length_; }
    [[nodiscard]] bool exact() const { return curve_ != nullptr; }

private:
    EdgePosition on_segment(const Vec3& p, std::size_t segment) const;
    void refine(std::span<const Vec3> points, std::span<EdgePosition> places, double reach,
                const RunContext& context) const;

    std::vector<Vec3> points_;
    std::vector<double> params_; ///< of the samples; empty without a curve
    std::shared_ptr<const geometry::ExactCurve> curve_;
    double per_side_ = 1; ///< samples a side of the edge's polyline
    double sagitta_ = 0, length_ = 0;
};

/// How far apart two edges are at most: of the samples of each, the furthest from the other [model length].
double greatest_gap(const EdgeTrack& a, const EdgeTrack& b, double tolerance, const RunContext& context);

} // namespace lacuna::healing
