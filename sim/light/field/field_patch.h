// A magnetic field over a part of the Earth as polynomials: what is worked out once, and then read at every
// foot, by packs of floats as by dual numbers.
//
// Of each component a sum of products of Chebyshev polynomials of two places, each of a degree of at most
// kFieldDegree; interpolated at Chebyshev's nodes (W. H. Press et al., "Numerical recipes", 2007, section
// 5.8). A face's places are first made even by the angle, in which the field is smooth.
#pragma once

#include <array>

namespace vegard::sim {

inline constexpr int kFieldDegree = 12;
inline constexpr int kFieldTerms = (kFieldDegree + 1) * (kFieldDegree + 1);

/// How far a patch of a plane reaches to each side, in km; beyond it the field is that of its edge.
inline constexpr double kFieldReachKm = 3000.0;
/// The same of a cube's face, whose own places go from -1 to 1.
inline constexpr double kFieldReachOfFace = 1.3;

struct FieldPatch {
  double per_place = 1.0;  ///< times a place, of a face evened(): from -1 to 1 over the patch
  /// [component][term], of T_i(x) T_j(y) by i and then j; in units of 50000 nT.
  std::array<double, 3 * kFieldTerms> coefficient{};
  std::array<float, 3 * kFieldTerms> rounded{};  ///< the same

  template <class Number>
  const Number* numbers() const;
};
template <>
inline const double* FieldPatch::numbers<double>() const {
  return coefficient.data();
}
template <>
inline const float* FieldPatch::numbers<float>() const {
  return rounded.data();
}

}  // namespace vegard::sim
