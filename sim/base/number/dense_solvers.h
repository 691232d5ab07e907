// Decompositions of dense matrices whose size is known only at run time, by Eigen.
//
// Each is compiled once, here: of all that our files use, Eigen's decompositions cost a compiler most. Small
// matrices of a fixed size use Eigen's classes where they stand.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace vegard::sim {

/// Eigenvalues in ascending order, and their unit eigenvectors, a column each.
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
  bool converged = false;
};

/// Of a symmetric matrix; only its lower triangle is read.
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& matrix);

/// In descending order.
Eigen::VectorXd singular_values(const Eigen::MatrixXd& matrix);

/// Inverse of a square matrix that has one, by LU with partial pivoting.
Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& matrix);

/// Cholesky's lower triangle L of a positive definite matrix L Lᵀ; none if it is not.
std::optional<Eigen::MatrixXd> cholesky_root(const Eigen::MatrixXd& matrix);

/// Inverse of a positive definite matrix by Cholesky's decomposition; none if the reciprocal of its condition
/// number is not above `least_rcond`.
std::optional<Eigen::MatrixXd> inverse_of_definite(const Eigen::MatrixXd& matrix, double least_rcond);

/// x of matrix x = right, for a positive or negative semidefinite matrix (LDLT with pivoting).
Eigen::MatrixXd solve_symmetric(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right);
Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right);

/// x that makes |rows x - right| least (QR with column pivoting); a vector's or each column's.
Eigen::MatrixXd least_squares(const Eigen::MatrixXd& rows, const Eigen::MatrixXd& right);
Eigen::VectorXd least_squares(const Eigen::MatrixXd& rows, const Eigen::VectorXd& right);

/// Of the QR decomposition of a matrix with at least as many rows as columns: the orthonormal columns of Q that
/// span the matrix's columns, and the square upper triangle R.
Eigen::MatrixXd orthonormal_columns(const Eigen::MatrixXd& matrix);
Eigen::MatrixXd upper_triangle(const Eigen::MatrixXd& matrix);

}  // namespace vegard::sim
