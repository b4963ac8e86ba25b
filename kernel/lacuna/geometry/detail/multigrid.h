// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <Eigen/SparseCore>

#include <deque>

namespace lacuna::geometry {

/// Solver for sparse matrices from diffusion problems, in time linear in the size of the matrix.
///
/// Algorithm: smoothed aggregation (Vaněk, Mandel and Brezina 1996), with a forward and a backward
/// Gauss-Seidel sweep on each level, is the preconditioner of BiCGStab (van der Vorst 1992). Conjugate
/// gradients cannot be used, because matrices of mean value weights are not symmetric. The aggregates depend
/// only on the matrix, so results are reproducible to the bit.
class Multigrid {
public:
    using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

    /// @param matrix  moved; compressed, with positive diagonal, other entries <= 0, and weakly diagonally
    ///                dominant rows.
    /// @throw Cancelled
    Multigrid(Matrix&& matrix, const RunContext& context);

    /// @return false if aggregation does not reduce the matrix, or if the iteration does not converge; `x` is
    ///         then undefined.
    /// @throw Cancelled
    [[nodiscard]] bool solve(const Eigen::VectorXd& right, Eigen::VectorXd& x,
                             const RunContext& context) const;

private:
    struct Level {
        Matrix matrix;
        Matrix up, down; ///< interpolation from the next coarser level, and restriction to it
    };
    void cycle(std::size_t level, const Eigen::VectorXd& right, Eigen::VectorXd& x) const;

    std::deque<Level> levels_; ///< a deque, so that levels are not copied; the last has no `up` and `down`
    Eigen::PartialPivLU<Eigen::MatrixXd> coarsest_;
    bool good_ = true; ///< whether aggregation reduces the matrix
};

} // namespace lacuna::geometry
