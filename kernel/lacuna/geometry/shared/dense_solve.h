// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <Eigen/Core>

/// Dense solvers of Eigen, instantiated in one source file because their templates take long to compile.
namespace lacuna::geometry {

/// x of A x = b by LU with partial pivoting. @pre `matrix` is regular.
Eigen::VectorXd solve_lu(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right);

/// X of A X = B for a symmetric positive semidefinite matrix, of which the lower triangle is read.
Eigen::MatrixXd solve_symmetric(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right);

/// x with the least |A x - b|, by QR with column pivoting.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right);

/// Eigenvalues of a symmetric matrix, ascending.
Vec3 symmetric_eigenvalues(const Eigen::Matrix3d& matrix);

/// Eigenvalues of a symmetric matrix, ascending, and one unit eigenvector for each, as columns.
struct SymmetricEigen {
    Eigen::VectorXd values;
    Eigen::MatrixXd vectors;
};
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& matrix);

} // namespace lacuna::geometry
