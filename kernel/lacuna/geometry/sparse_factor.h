// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/core/types.h>

#include <Eigen/SparseCore>

#include <vector>

namespace lacuna::geometry {

/// A = Pᵀ L D Lᵀ P of a symmetric matrix, which can be stopped while it is made.
///
/// Row by row (Davis, Algorithm 849, as Eigen::SimplicialLDLT has it) in the order of approximate minimum
/// degree; the same numbers as Eigen's, bit for bit. Eigen's own can only be stopped before and after.
class SparseFactor {
public:
    /// @param lower  the lower triangle with the diagonal; what lies above it is not read.
    /// @throw Cancelled  within some ten thousandths of a second; not while the order is found, which takes
    ///         a tenth of the whole.
    explicit SparseFactor(const Eigen::SparseMatrix<double>& lower, const RunContext& context = {});

    /// False where a pivot vanished: the matrix is singular, and nothing else may be asked.
    [[nodiscard]] bool good() const { return good_; }
    /// Solve for each column.
    [[nodiscard]] Eigen::MatrixXd solve(const Eigen::Ref<const Eigen::MatrixXd>& right) const;

    /// L without its diagonal of ones.
    [[nodiscard]] const Eigen::SparseMatrix<double>& lower() const { return lower_; }
    [[nodiscard]] const Eigen::VectorXd& diagonal() const { return diagonal_; }
    /// Where each row of the matrix went.
    [[nodiscard]] const Eigen::PermutationMatrix<Eigen::Dynamic>& order() const { return order_; }

private:
    Eigen::SparseMatrix<double> lower_;
    Eigen::VectorXd diagonal_;
    Eigen::PermutationMatrix<Eigen::Dynamic> order_;
    bool good_ = true;
};

} // namespace lacuna::geometry
