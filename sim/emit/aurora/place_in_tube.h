// In the mean over all draws the deflections turn a beam into a tube about its field line. This header gives
// the place in the tube's cross-section at which a beam with quadrature nodes is evaluated.
#pragma once

#include <cmath>

#include "sim/base/number/vec3.h"
#include "sim/light/sample.h"

namespace vegard::sim {

/// The offsets of a beam along its sheet and across it, in standard deviations; each has two components,
/// along across1 and across2 of a FallFrame. Across the sheet, tube and sheet together are a Gaussian with
/// the sum of both variances: a beam at a node of the sheet's width w is moved outwards by (sqrt(w² + v) - w)
/// times its node in standard deviations, where v is the tube's variance in one direction. So nothing is
/// drawn across a sheet, and beams along it stay evenly spaced. T is double or a lane type.
template <class T>
struct PlaceInTube {
  T along[2]{}, across[2]{};
  T width_km{};  ///< of the sheet, perpendicular to it and to the field
};

/// Returns the tube's variance in one direction across at the end of a path of length 1 (MeanPath of
/// sim/emit/aurora/fall-inl.h, to second order in the pitch angle).
inline double tube_variance_at_end(const Deflection<LocalDual>& d) {
  const double cone = d.loss_cone_rad.v, step = d.pitch_step_rad.v;
  double start = 0.0, growth = 0.0;  // of the pitch angle
  switch (d.law) {
    case PitchLaw::product:
      growth = cone * step;
      break;
    case PitchLaw::increment:
      growth = step;
      break;
    case PitchLaw::constant:
      start = cone;
      break;
    case PitchLaw::reduced:
      start = cone - step;
      growth = step;
      break;
  }
  return d.path_step / 3.0 * (start * start + start * growth + growth * growth / 3.0);
}

/// Returns a beam's place in the tube. `tangent`: tangent of the sheet at the foot, of any length; `aside`:
/// the unit vector along which the foot is `across` times `width_km` away from the sheet's middle; `along`:
/// the offset along the sheet in standard deviations.
inline PlaceInTube<double> place_in_tube(const FallFrame<double>& fall, EastNorth tangent, EastNorth aside,
                                         double width_km, double across, double along) {
  const auto component = [](const double(&axis)[3], EastNorth d) {
    return axis[0] * d.east + axis[1] * d.north;
  };
  // The sheet holds the field; what is at a right angle to both lies in the plane of the cross-section.
  double sheet[2] = {component(fall.across1, tangent), component(fall.across2, tangent)};
  const double length = std::hypot(sheet[0], sheet[1]);
  for (double& x : sheet) x = length > 0.0 ? x / length : (&x == sheet ? 1.0 : 0.0);
  const double normal[2] = {-sheet[1], sheet[0]};
  const double off = component(fall.across1, aside) * normal[0] + component(fall.across2, aside) * normal[1];
  PlaceInTube<double> place;
  for (int i = 0; i < 2; ++i) {
    place.along[i] = along * sheet[i];
    place.across[i] = off < 0.0 ? -across * normal[i] : across * normal[i];
  }
  place.width_km = std::abs(off) * width_km;
  return place;
}

}  // namespace vegard::sim
