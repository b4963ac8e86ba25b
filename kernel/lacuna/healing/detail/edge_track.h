// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

#include <optional>
#include <span>
#include <vector>

namespace lacuna::healing {

/// Measures distances to an edge: to the exact curve if the edge has one, otherwise to the polyline.
class EdgeTrack {
public:
    /// Copies the edge's geometry, so the model may change afterwards.
    EdgeTrack(const topology::Model& model, EdgeId edge, const RunContext& context);

    /// A position on the edge.
    struct EdgePosition {
        double s = 0;        ///< position on the polyline; example: 2.25 is a quarter of the way from point 2
                             ///< to point 3
        double param = 0;    ///< curve parameter; 0 without a curve
        double distance = 0; ///< distance from the query point [model length]
        Vec3 at = Vec3::Zero();
    };
    /// For each point, the closest position on the edge, at any distance.
    [[nodiscard]] std::vector<EdgePosition> locate(std::span<const Vec3> points, double tolerance,
                                                   const RunContext& context) const;
    /// For points that are ordered along the edge: the position of each point. Each search starts at the
    /// previous position, so `s` never decreases. Empty if a point is further away than `tolerance`.
    [[nodiscard]] std::optional<std::vector<EdgePosition>> follow(std::span<const Vec3> points,
                                                                  double tolerance,
                                                                  const RunContext& context) const;

    /// Points of the polyline; for an exact curve, also the point of the curve in the middle of each side.
    [[nodiscard]] const std::vector<Vec3>& samples() const { return points_; }
    /// Largest distance from the curve to the chords between samples [model length].
    [[nodiscard]] double sagitta() const { return sagitta_; }
    [[nodiscard]] double length() const { return length_; }
    [[nodiscard]] bool exact() const { return curve_ != nullptr; }

private:
    EdgePosition on_segment(const Vec3& p, std::size_t segment) const;
    void refine(std::span<const Vec3> points, std::span<EdgePosition> places, double reach,
                const RunContext& context) const;

    std::vector<Vec3> points_;
    std::vector<double> params_; ///< curve parameter of each sample; empty without a curve
    std::shared_ptr<const geometry::ExactCurve> curve_;
    double per_side_ = 1; ///< samples per side of the edge's polyline
    double sagitta_ = 0, length_ = 0;
};

/// Largest distance from a sample of either edge to the other edge [model length].
double greatest_gap(const EdgeTrack& a, const EdgeTrack& b, double tolerance, const RunContext& context);

} // namespace lacuna::healing
