// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

#include <memory>
#include <span>
#include <vector>

namespace lacuna::cad {

/// An edge as exactly as it is known, over the share of its length.
class EdgeShape {
public:
    /// A given edge with a curve is that curve; one without is its polyline; a void edge is straight, or
    /// smooth through its points.
    EdgeShape(const topology::Model& model, EdgeId edge);

    /// Places at shares in [0, 1], from `from` to `to` of the edge.
    [[nodiscard]] std::vector<Vec3> at(std::span<const double> shares) const;
    /// The shares of the edge's own points.
    [[nodiscard]] const std::vector<double>& shares() const { return shares_; }
    [[nodiscard]] double length() const { return length_; }
    [[nodiscard]] bool is_straight() const { return kind_ == Kind::straight; }
    /// True where it turns sharply at its own inner points.
    [[nodiscard]] bool is_polyline() const { return kind_ == Kind::polyline; }
    /// How far it is from its own polyline [model length].
    [[nodiscard]] double sagitta() const;

private:
    enum class Kind { exact, straight, smooth, polyline };

    [[nodiscard]] double parameter(double share) const;

    Kind kind_ = Kind::straight;
    std::shared_ptr<const geometry::ExactCurve> curve_;
    std::vector<double> fine_shares_, fine_params_; ///< of an exact curve
    std::vector<Vec3> points_;                      ///< the edge's own
    std::vector<double> shares_;
    double length_ = 0;
};

/// Edges in a row as one side of a patch.
class PatchSide {
public:
    PatchSide(const topology::Model& model, const std::vector<topology::EdgeUse>& uses);

    [[nodiscard]] std::vector<Vec3> at(std::span<const double> shares) const;
    /// Shares between the ends where it may turn sharply: vertices, and the points of polylines. Rising.
    [[nodiscard]] const std::vector<double>& breaks() const { return breaks_; }
    /// The model points along it and their shares, both ends included.
    [[nodiscard]] const std::vector<Index>& points() const { return points_; }
    [[nodiscard]] const std::vector<double>& shares() const { return shares_; }
    [[nodiscard]] double sagitta() const { return sagitta_; }

private:
    struct Piece {
        EdgeShape shape;
        bool reversed;
        double low, high; ///< its shares of the side
    };
    std::vector<Piece> pieces_;
    std::vector<double> breaks_, shares_;
    std::vector<Index> points_;
    double sagitta_ = 0;
};

} // namespace lacuna::cad
