#include "sim/base/number/dense_solvers.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace vegard::sim {

using Eigen::MatrixXd;
using Eigen::VectorXd;

SymmetricEigen symmetric_eigen(const MatrixXd& matrix) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors(), solver.info() == Eigen::Success};
}

VectorXd singular_values(const MatrixXd& matrix) { return Eigen::JacobiSVD<MatrixXd>(matrix).singularValues(); }

MatrixXd inverse_of(const MatrixXd& matrix) { return matrix.inverse(); }

std::optional<MatrixXd> cholesky_root(const MatrixXd& matrix) {
  const Eigen::LLT<MatrixXd> factors(matrix);
  if (factors.info() != Eigen::Success) return {};
  return MatrixXd(factors.matrixL());
}

std::optional<MatrixXd> inverse_of_definite(const MatrixXd& matrix, double least_rcond) {
  const Eigen::LLT<MatrixXd> factors(matrix);
  if (factors.info() != Eigen::Success || !(factors.rcond() > least_rcond)) return {};
  return factors.solve(MatrixXd::Identity(matrix.rows(), matrix.rows()));
}

MatrixXd solve_symmetric(const MatrixXd& matrix, const MatrixXd& right) { return matrix.ldlt().solve(right); }

VectorXd solve_symmetric(const MatrixXd& matrix, const VectorXd& right) { return matrix.ldlt().solve(right); }

MatrixXd least_squares(const MatrixXd& rows, const MatrixXd& right) {
  return rows.colPivHouseholderQr().solve(right);
}

VectorXd least_squares(const MatrixXd& rows, const VectorXd& right) {
  return rows.colPivHouseholderQr().solve(right);
}

MatrixXd orthonormal_columns(const MatrixXd& matrix) {
  return Eigen::HouseholderQR<MatrixXd>(matrix).householderQ() *
         MatrixXd::Identity(matrix.rows(), matrix.cols());
}

MatrixXd upper_triangle(const MatrixXd& matrix) {
  return Eigen::HouseholderQR<MatrixXd>(matrix)
      .matrixQR()
      .topRows(matrix.cols())
      .triangularView<Eigen::Upper>();
}

}  // namespace vegard::sim
