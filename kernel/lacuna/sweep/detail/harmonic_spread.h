// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/core/types.h>
#include <lacuna/mesh/shared/incidence.h>

#include <Eigen/SparseCore>

#include <cstddef>
#include <span>
#include <vector>

namespace lacuna::sweep {

/// For each node, the nodes that it shares a quad side with, in increasing order.
using NodeGraph = mesh::Incidence;

/// Cost: O(quads).
NodeGraph node_graph(std::span<const Quad> quads, std::size_t nodes);

/// Weight of each side, in the order of the graph's neighbours: the length of the dual side, which joins the
/// centres of the adjacent quads, divided by the side's own length. These are finite-volume weights: never
/// negative, and insensitive to grading.
std::vector<double> side_weights(const NodeGraph& graph, std::span<const Quad> quads,
                                 std::span<const Vec3> nodes);

/// Spreads values given at fixed nodes over the other nodes: each gets the weighted mean of its neighbours.
///
/// Uses the graph Laplacian, factored once. The weights are positive, so values never leave the range of the
/// given ones. Parts of the mesh without a fixed node get zero.
class HarmonicSpread {
public:
    /// Number of fields solved together. Each entry of the factor is then read once for all 4 × 3
    /// coordinates.
    static constexpr int kFields = 4;

    /// @param weights  for each side of the graph, equal in both directions, above 0.
    /// @param fixed    the nodes at which values are given, without duplicates.
    /// @throw Cancelled
    HarmonicSpread(const NodeGraph& graph, std::span<const double> weights, std::span<const Index> fixed,
                   const RunContext& context = {});

    /// Fields after spreading.
    class Fields {
    public:
        /// The values at a node: x, y and z of the first field, then of the second and so on. One number
        /// after the last value may be read too, and has no meaning. Null if the node is fixed, or not
        /// connected to any fixed node.
        [[nodiscard]] const double* of(std::size_t node) const
        {
            return place_[node] < 0 ? nullptr : &rows_[static_cast<std::size_t>(place_[node]) * 3 * kFields];
        }

    private:
        friend class HarmonicSpread;
        std::span<const Index> place_;
        std::vector<double> rows_;
    };

    /// Spread up to `kFields` fields, on one thread.
    /// @param values  fields × fixed.size(), field-major.
    /// @return  the fields; refers to this object
    [[nodiscard]] Fields spread(std::span<const Vec3> values) const;

    /// Spread fields from the fixed nodes, and add them at the other nodes: out[f · stride + node] += value.
    /// The result of a field does not depend on other fields in the call, or on the number of threads.
    /// @param values  fields × fixed.size(), field-major.
    void add(std::span<const Vec3> values, std::size_t fields, Vec3* out, std::size_t stride,
             const RunContext& context = {}) const;

    /// Solve for a load at every free node, with fixed nodes held at zero. Works in place, with one Vec3 per
    /// node of the mesh; values at fixed nodes are ignored and set to zero.
    void solve(std::span<Vec3> load) const;

private:
    struct RimSide {
        Index row, fixed; ///< row of the free node in the factor; index of the fixed node in the list `fixed`
        double weight;
    };
    std::size_t fixed_count_ = 0;
    /// For each node of the mesh, its row in the factor; -1: fixed or not connected.
    std::vector<Index> place_;
    std::vector<RimSide> rim_sides_; ///< sides between a free node and a fixed one
    Eigen::SparseMatrix<double> lower_;
    Eigen::VectorXd diagonal_;
};

} // namespace lacuna::sweep
