// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <Eigen/SparseCore>

#include <deque>

namespace lacuna::geometry {

/// A sparse matrix of a diffusion kind, to be solved with in time linear in its size.
///
/// Algorithm: smoothed aggregation (Vaněk, Mandel and Brezina 1996) with one sweep of Gauss-Seidel either
/// way, as the preconditioner of BiCGStab (van der Vorst 1992), since mean value weights are not symmetric.
/// The aggregates, and so the result to the bit, depend on the matrix alone.
class Multigrid {
public:
    using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

    /// @param matrix  taken; compressed; diagonal above 0, the rest of a row not above 0 and no larger in
    ///                sum.
    /// @throw Cancelled
    Multigrid(Matrix&& matrix, const RunContext& context);

    /// False where the matrix does not grow smaller by aggregation: solve() then finds nothing.
    [[nodiscard]] bool good() const { return good_; }

    /// @return false where it does not settle; `x` is of no use then.
    /// @throw Cancelled
    [[nodiscard]] bool solve(const Eigen::VectorXd& right, Eigen::VectorXd& x,
                             const RunContext& context) const;

private:
    struct Level {
        Matrix matrix;
        Matrix up, down; ///< from the next, coarser level, and to it
    };
    void cycle(std::size_t level, const Eigen::VectorXd& right, Eigen::VectorXd& x) const;

    std::deque<Level> levels_; ///< never moved, which would copy; the last has no `up` and `down`
    Eigen::PartialPivLU<Eigen::MatrixXd> coarsest_;
    bool good_ = true;
};

} // namespace lacuna::geometry
