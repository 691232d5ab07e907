// A magnetic field over a part of the Earth as polynomials, which are computed once and then evaluated at
// every foot, for packs of floats, for double and for dual numbers.
//
// Each component is a sum of products of Chebyshev polynomials of two coordinates, each of a degree of at
// most kFieldDegree, interpolated at Chebyshev nodes (W. H. Press et al., "Numerical recipes", 2007,
// section 5.8). Coordinates on a cube's face are first made nearly proportional to the angle (evened() in
// field_body.h), in which the field is smooth.
#pragma once

#include <array>
#include <memory>

#include "sim/base/number/dual.h"
#include "sim/light/field/igrf.h"
#include "sim/scene/structs/site.h"

namespace vegard::sim {

inline constexpr int kFieldDegree = 12;
inline constexpr int kFieldTerms = (kFieldDegree + 1) * (kFieldDegree + 1);

/// Half the width, in km, of a patch in the tangent plane; beyond it the field is that at its edge.
inline constexpr double kFieldReachKm = 3000.0;
/// Half the width of a patch on a cube's face, whose coordinates go from -1 to 1.
inline constexpr double kFieldReachOfFace = 1.3;

struct FieldPatch {
  double per_place = 1.0;  ///< factor on coordinates (on a face: after evened()) to -1 .. 1 over the patch
  /// [component][term] of T_i(x) T_j(y), ordered by i and then j; in units of 50000 nT.
  std::array<double, 3 * kFieldTerms> coefficient{};
  std::array<float, 3 * kFieldTerms> rounded{};  ///< `coefficient` as floats

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

template <class T>
inline T select(bool which, const T& yes, const T& no) {
  return which ? yes : no;
}

#define VEGARD_INLINE inline
#include "sim/light/field/field_body.h"
#undef VEGARD_INLINE

/// Returns the field in the site's east, north and up, as a function of the foot's east and north at
/// kFootAltitudeKm in the tangent plane, in km. Latitudes on the scene's sphere are used as geodetic ones.
std::shared_ptr<const FieldPatch> plane_field(const Igrf& igrf, const Site& site);

/// Returns the field in the Earth's axes, as a function of the coordinates on the faces of a cube about its
/// centre (sim/emit/footprint/map/footprint_map.h). The field is fixed to the Earth; the cube is rotated to
/// the east by `turned_deg`.
std::shared_ptr<const std::array<FieldPatch, 6>> face_fields(const Igrf& igrf, double turned_deg);

}  // namespace vegard::sim
