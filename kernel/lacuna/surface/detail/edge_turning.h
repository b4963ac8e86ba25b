// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

#include <vector>

namespace lacuna::surface {

/// The turn of an edge, or of a chain of edges, along its length.
///
/// The bend at a point of the polyline is spread over the adjacent half of each of its two segments. A
/// polyline with points on a curve therefore turns as evenly as the curve. Sharp bends count as corners.
/// Corners, and the vertices between edges, add nothing to the turn.
class EdgeTurning {
public:
    EdgeTurning(const topology::Model& model, EdgeId edge);
    EdgeTurning(const topology::Model& model, const std::vector<topology::EdgeUse>& uses);

    /// Turn between two running lengths, in the direction of the edge or the chain [radian]. @pre from <= to
    [[nodiscard]] double between(double from, double to) const { return upto(to) - upto(from); }
    [[nodiscard]] double length() const { return at_.back(); }

private:
    void append(const topology::Model& model, topology::EdgeUse use);
    [[nodiscard]] double upto(double s) const;

    std::vector<double> at_{0}, sum_{0}; ///< running lengths, and the turn up to each length
};

} // namespace lacuna::surface
