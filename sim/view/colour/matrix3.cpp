#include "sim/view/colour/matrix3.h"

#include <cmath>

namespace vegard::sim {

Matrix3 diagonal(const Vector3& numbers) {
  Matrix3 m{};
  for (int i = 0; i < 3; ++i) m[i][i] = numbers[i];
  return m;
}

Vector3 product(const Matrix3& m, const Vector3& v) {
  Vector3 r{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r[i] += m[i][j] * v[j];
  return r;
}

Matrix3 product(const Matrix3& a, const Matrix3& b) {
  Matrix3 m{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) m[i][j] += a[i][k] * b[k][j];
  return m;
}

namespace {

/// Returns the cofactor with its sign.
double cofactor(const Matrix3& m, int r, int c) {
  const int r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
  return m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
}

double determinant(const Matrix3& m) {
  return m[0][0] * cofactor(m, 0, 0) + m[0][1] * cofactor(m, 0, 1) + m[0][2] * cofactor(m, 0, 2);
}

}  // namespace

double relative_determinant(const Matrix3& m) {
  double lengths = 1.0;
  for (const Vector3& row : m) lengths *= std::sqrt(row[0] * row[0] + row[1] * row[1] + row[2] * row[2]);
  return lengths > 0.0 ? std::abs(determinant(m)) / lengths : 0.0;
}

Matrix3 inverse(const Matrix3& m) {
  const double all = determinant(m);
  Matrix3 result;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) result[r][c] = cofactor(m, c, r) / all;
  return result;
}

}  // namespace vegard::sim
