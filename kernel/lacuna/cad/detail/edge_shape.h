// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

#include <memory>
#include <span>
#include <vector>

namespace lacuna::cad {

/// The most exact shape that is known for an edge, as a function of its relative arc length (the share).
class EdgeShape {
public:
    /// The shape is the first of these that applies:
    /// 1. the exact curve of the edge, if there is one;
    /// 2. a straight line, if the points of the edge are collinear;
    /// 3. for a void edge, a smooth curve through its points, unless the edge is a moved copy of a polyline
    ///    with kinks;
    /// 4. the polyline through the points of the edge.
    EdgeShape(const topology::Model& model, EdgeId edge);

    /// Points at shares in [0, 1] of the length, counted from the edge's `from` to its `to`.
    [[nodiscard]] std::vector<Vec3> at(std::span<const double> shares) const;
    /// The share, in [0, 1], of each model point on the edge.
    [[nodiscard]] const std::vector<double>& shares() const { return shares_; }
    [[nodiscard]] double length() const { return length_; }
    [[nodiscard]] bool is_straight() const { return kind_ == Kind::straight; }
    /// True if the edge may have a kink at each of its inner points.
    [[nodiscard]] bool is_polyline() const { return kind_ == Kind::polyline; }
    /// Largest distance between the edge and its polyline [model length].
    [[nodiscard]] double sagitta() const;

private:
    enum class Kind { exact, straight, smooth, polyline };

    [[nodiscard]] double parameter(double share) const;

    Kind kind_ = Kind::straight;
    std::shared_ptr<const geometry::ExactCurve> curve_;
    std::vector<double> fine_shares_, fine_params_; ///< samples of an exact curve
    std::vector<Vec3> points_;                      ///< model points on the edge
    std::vector<double> shares_;
    double length_ = 0;
};

/// Consecutive edges that form one side of a patch.
class PatchSide {
public:
    PatchSide(const topology::Model& model, const std::vector<topology::EdgeUse>& uses);

    [[nodiscard]] std::vector<Vec3> at(std::span<const double> shares) const;
    /// Shares, ascending, where the side may have a kink: inner vertices, and the points of polylines.
    [[nodiscard]] const std::vector<double>& breaks() const { return breaks_; }
    /// The model points on the side and their shares, both ends included.
    [[nodiscard]] const std::vector<Index>& points() const { return points_; }
    [[nodiscard]] const std::vector<double>& shares() const { return shares_; }
    [[nodiscard]] double sagitta() const { return sagitta_; }

private:
    struct Piece {
        EdgeShape shape;
        bool reversed;
        double low, high; ///< range of shares on the side
    };
    std::vector<Piece> pieces_;
    std::vector<double> breaks_, shares_;
    std::vector<Index> points_;
    double sagitta_ = 0;
};

} // namespace lacuna::cad
