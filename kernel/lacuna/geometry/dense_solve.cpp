// SPDX-License-Identifier: MIT
#include <lacuna/geometry/shared/dense_solve.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

namespace lacuna::geometry {

Eigen::VectorXd solve_lu(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right)
{
    return matrix.partialPivLu().solve(right);
}

Eigen::MatrixXd solve_symmetric(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right)
{
    return matrix.ldlt().solve(right);
}

Eigen::VectorXd least_squares(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right)
{
    return matrix.colPivHouseholderQr().solve(right);
}

Vec3 symmetric_eigenvalues(const Eigen::Matrix3d& matrix)
{
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
}

SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& matrix)
{
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
    return {solver.eigenvalues(), solver.eigenvectors()};
}

} // namespace lacuna::geometry
