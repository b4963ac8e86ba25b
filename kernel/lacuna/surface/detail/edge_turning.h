// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

#include <vector>

namespace lacuna::surface {

/// How much an edge, or a chain of them, turns along its length.
///
/// The bend at each point of the polyline is spread over the halves of the two sides that meet there, so a
/// polygon cut from a curve turns as evenly as the curve. Sharp bends are corners and count for nothing, nor
/// do the vertices between edges.
class EdgeTurning {
public:
    EdgeTurning(const topology::Model& model, EdgeId edge);
    EdgeTurning(const topology::Model& model, const std::vector<topology::EdgeUse>& uses);

    /// Turning between two running lengths, as the edge or the chain runs [radian]. @pre from <= to
    [[nodiscard]] double between(double from, double to) const { return upto(to) - upto(from); }
    [[nodiscard]] double length() const { return at_.back(); }

private:
    void append(const topology::Model& model, topology::EdgeUse use);
    [[nodiscard]] double upto(double s) const;

    std::vector<double> at_{0}, sum_{0}; ///< running lengths, and the turning up to each
};

} // namespace lacuna::surface
