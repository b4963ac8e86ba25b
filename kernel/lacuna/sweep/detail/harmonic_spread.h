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

/// The nodes that share a quad side with each node, increasing.
using NodeGraph = mesh::Incidence;

/// O(quads).
NodeGraph node_graph(std::span<const Quad> quads, std::size_t nodes);

/// Weight of each side, in the order of the graph's neighbours: the length of the dual side, which joins the
/// centres of the adjacent quads, divided by the side's own length. These are finite-volume weights: never
/// negative, and insensitive to grading.
std::vector<double> side_weights(const NodeGraph& graph, std::span<const Quad> quads,
                                 std::span<const Vec3> nodes);

/// Spreads values given at fixed nodes over the rest, each the weighted mean of its neighbours.
///
/// Uses the graph Laplacian, factored once. The weights are positive, so a value never leaves the range of
/// the given ones. Parts of the mesh without a fixed node get zero.
class HarmonicSpread {
public:
    /// Number of fields solved together, so that each entry of the factor is read once for 12 numbers.
    static constexpr int kFields = 4;

    /// @param weights  of the graph's sides, equal in both directions, above 0.
    /// @param fixed    nodes whose values are given, without duplicates.
    /// @throw Cancelled
    HarmonicSpread(const NodeGraph& graph, std::span<const double> weights, std::span<const Index> fixed,
                   const RunContext& context = {});

    /// Fields after spreading.
    class Fields {
    public:
        /// The values at a node: x, y and z of the first field, of the second and so on, followed by one
        /// unused number that may be read. Null if the node is fixed or connected to no fixed node.
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

    /// Add fields, spread from the fixed nodes, to the nodes that are not fixed: out[f · stride + node] +=
    /// value.
    /// @param values  fields × fixed.size(), field-major.
    /// The result of a field does not depend on the other fields of the call, or on the number of threads.
    void add(std::span<const Vec3> values, std::size_t fields, Vec3* out, std::size_t stride,
             const RunContext& context = {}) const;

    /// Solve for a given load at every free node, with fixed nodes held at zero. In place: one Vec3 per node
    /// of the mesh; values of fixed nodes are ignored and set to zero.
    void solve(std::span<Vec3> load) const;

private:
    struct RimSide {
        Index row, fixed; ///< row of the free node in the factor; index of the fixed node in `fixed`
        double weight;
    };
    std::size_t fixed_count_ = 0;
    std::vector<Index> place_;       ///< for each node in the factor's order; -1: fixed or not connected
    std::vector<RimSide> rim_sides_; ///< sides between a free node and a fixed one
    Eigen::SparseMatrix<double> lower_;
    Eigen::VectorXd diagonal_;
};

} // namespace lacuna::sweep
