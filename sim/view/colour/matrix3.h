// 3 x 3 matrices, row-major, for colours.
#pragma once

#include <array>

namespace vegard::sim {

using Vector3 = std::array<double, 3>;
using Matrix3 = std::array<Vector3, 3>;

inline constexpr Matrix3 kIdentity3 = {{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};

Matrix3 diagonal(const Vector3& numbers);

Vector3 product(const Matrix3& m, const Vector3& v);
Matrix3 product(const Matrix3& a, const Matrix3& b);

/// Returns |determinant| over the product of the rows' lengths: 1 for orthogonal rows, 0 for a matrix without
/// an inverse or with a row of zeros.
double relative_determinant(const Matrix3& m);

/// Returns the inverse, by cofactors. The matrix must have one.
Matrix3 inverse(const Matrix3& m);

}  // namespace vegard::sim
