// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

#include <span>
#include <vector>

namespace lacuna::surface {

/// The polyline of an edge.
std::vector<Vec3> edge_line(const topology::Model& model, EdgeId edge);

/// Points of an edge at fractions of its length (0 at `from`, 1 at `to`), on the exact curve if there is one.
/// The end points are the points of the vertices, bit for bit.
std::vector<Vec3> edge_points(const topology::Model& model, EdgeId edge, std::span<const double> fractions);

/// A point of a chain.
struct ChainPosition {
    std::size_t use = 0; ///< index of the edge use in the chain
    double fraction = 0; ///< fraction of the edge's length, in the direction of the edge, not of the use
};

/// A chain of edge uses as one curve. Running length: length along the chain from its start to a position.
class Chain {
public:
    Chain(const topology::Model& model, std::vector<topology::EdgeUse> uses);

    [[nodiscard]] double length() const { return start_.back(); }
    [[nodiscard]] const std::vector<topology::EdgeUse>& uses() const { return uses_; }
    /// For a closed chain: subtract the chain's length from a running length that is not below it.
    /// @pre  the running length is below twice the chain's length
    [[nodiscard]] double wrapped(double s) const { return s >= length() ? s - length() : s; }
    /// Running length at the start of use i. If i is the number of uses, the length of the chain.
    [[nodiscard]] double start(std::size_t i) const { return start_[i]; }

    /// Edge and fraction at a running length.
    [[nodiscard]] ChainPosition position(double s) const;
    /// Points at running lengths, on the exact curves.
    [[nodiscard]] std::vector<Vec3> points(std::span<const double> lengths) const;

private:
    const topology::Model* model_;
    std::vector<topology::EdgeUse> uses_;
    std::vector<double> start_;
};

} // namespace lacuna::surface
