// The feet of the beams of a sheet whose course is a curve.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "sim/base/number/constants.h"
#include "sim/emit/aurora/sheet.h"
#include "sim/emit/aurora/sheet_curve.h"

namespace vegard::sim {

template <class T>
struct CurveFoot {
  BeamFoot<T> foot;
  T ln_energy{};  ///< logarithm of the energy in keV; 0 if the sheet has one energy only
  T along[2]{};   ///< the curve's direction there: a unit vector in east and north
  double width_km = 0.0;
};

/// Returns the foot of a beam on a curve. Its place in the cross-section moves it across the curve, to the
/// side of the sine's positive values; its flux is that of its stretch of the curve, whichever way the curve
/// bends.
template <class T>
CurveFoot<T> curve_foot(const SheetCurve<T>& curve, const SheetShape<T>& shape, const CurveLayout& layout,
                        const BeamPlace& place) {
  const auto [piece, fraction] = layout.piece_at(place.s);
  const CurvePlace<T> on = curve.place(piece, fraction);
  const auto& nodes = curve.nodes();
  const T width =
      nodes.ln_width.empty() ? shape.width_km : exponential(curve.along(nodes.ln_width, piece, fraction));
  T share(0.0);
  const double from = std::clamp(place.from, 0.0, 1.0), to = std::clamp(place.to, 0.0, 1.0);
  for (int k = layout.piece_at(from).first; k < curve.pieces() && layout.at[k] < to; ++k) {
    const double part =
        (std::min(to, layout.at[k + 1]) - std::max(from, layout.at[k])) / (layout.at[k + 1] - layout.at[k]);
    if (part > 0.0) share = share + curve.length_km(k) * part;
  }
  CurveFoot<T> result;
  const T aside = with_slope(width, place.width_slope) * (place.across * shape.side);
  result.width_km = value_of(width);
  for (int i = 0; i < 2; ++i) result.along[i] = on.along[i];
  result.foot.east_km = on.at[0] - aside * on.along[1];
  result.foot.north_km = on.at[1] + aside * on.along[0];
  result.foot.flux_km2_mw_m2 = shape.energy_flux_mw_m2 * width * share * kSqrtTwoPi;
  if (!nodes.ln_brightness.empty())
    result.foot.flux_km2_mw_m2 =
        result.foot.flux_km2_mw_m2 * exponential(curve.along(nodes.ln_brightness, piece, fraction));
  if (!nodes.ln_energy.empty()) result.ln_energy = curve.along(nodes.ln_energy, piece, fraction);
  return result;
}

/// Returns the first and the last piece of the curve that the feet of `places`, or their stretches, lie on.
inline std::pair<int, int> pieces_of(const CurveLayout& layout, const std::vector<BeamPlace>& places) {
  double first = 1.0, last = 0.0;
  for (const BeamPlace& place : places) {
    first = std::min({first, place.s, place.from});
    last = std::max({last, place.s, place.to});
  }
  return {layout.piece_at(first).first, layout.piece_at(last).first};
}

}  // namespace vegard::sim
