// Sheets of precipitating electrons: where their beams start.
//
// Source: Baranoski et al. 2000, section 3.1.1, equations (1) and (2), as read in docs/physics.md (rows
// B1-B7).
#pragma once

#include <cstdint>
#include <vector>

#include "sim/base/dual.h"
#include "sim/scene/scene.h"

namespace vegard::sim {

/// The numbers of a sheet that its beams' feet depend on. T is double or FreeDual.
template <class T>
struct SheetShape {
  T center_east_km, center_north_km;
  T bearing_rad;
  T length_km;
  T thickness_km;
  T wavelength_km;
  T phase_rad;
  T phase_shift_rad;
  T width_km;
  T energy_flux_mw_m2;
  double side;  ///< +1 in the northern hemisphere, -1 in the southern: the direction of u x B
};

/// Where a beam stands on its layer before any parameter is known: pure functions of the seed, frozen during
/// a fit.
struct BeamPlace {
  double s = 0.0;           ///< along the line from start (0) to end (1)
  double s_of_phase = 0.0;  ///< where the sine is read: s itself, or the even place of the literal rule
  double share = 0.0;       ///< of the layer's light; the shares of a layer sum to 1
  double across = 0.0;      ///< place in the Gaussian cross-section, in standard deviations
  double depth = 0.0;       ///< uniform in (0, 1), for the random depth
};

/// The places of one layer's beams, in order along the arc. Across the layer they follow van der Corput's
/// sequence, so that place along and place across together fill the sheet evenly (a Hammersley set, shifted
/// by the seed). tied: s += d_s (1 + j (2u - 1)), then scaled to end at 1, phase read at the jittered s,
/// light shared by spacing. literal: s += d_s (1 ± ξ), phase 2πD/λ · i/n whatever s is, mean step 1.25 d_s,
/// light shared equally.
std::vector<BeamPlace> beam_places(const Sheet& sheet, std::uint32_t sheet_index, std::uint32_t layer,
                                   std::uint64_t seed);

template <class T>
struct BeamFoot {
  T east_km, north_km;  ///< in the tangent plane, of the point of the field line at 110 km altitude
  T flux_km2_mw_m2;     ///< energy flux times the horizontal area that the beam stands for
};

/// The foot of a beam. Equation (1) with P_i added: P = P_i + s u + w sin(phase) (u x B)/|u x B|, in the
/// tangent plane. The area is Q's Gaussian cross-section, width sqrt(2 pi), times the beam's share of the
/// arc's length.
template <class T>
BeamFoot<T> beam_foot(const SheetShape<T>& sheet, const BeamPlace& place, int layer, int layers) {
  const T toward_east = sine(sheet.bearing_rad), toward_north = cosine(sheet.bearing_rad);
  const double layer_part = layers > 1 ? static_cast<double>(layer) / (layers - 1) : 0.0;
  constexpr double kTwoPi = 6.283185307179586;
  const T phase = sheet.length_km * (kTwoPi * place.s_of_phase) / sheet.wavelength_km + sheet.phase_rad +
                  sheet.phase_shift_rad * layer_part;
  const T along = sheet.length_km * (place.s - 0.5);
  const T left = (sheet.thickness_km * sine(phase) + sheet.width_km * place.across) * sheet.side;
  constexpr double kSqrtTwoPi = 2.5066282746310002;
  return {sheet.center_east_km + along * toward_east - left * toward_north,
          sheet.center_north_km + along * toward_north + left * toward_east,
          sheet.energy_flux_mw_m2 * sheet.width_km * sheet.length_km * (kSqrtTwoPi * place.share)};
}

}  // namespace vegard::sim
