// The height of a thin layer of light that is seen edge on, at the Earth's limb.
//
// Taken as the same all around, a layer has the emission e(z) at the altitude z, and a line of sight with the
// tangent altitude h sees
//   N(h) = 2 integral over z > h of e(z) (R + z) / sqrt((R + z)^2 - (R + h)^2) dz,
// Abel's integral (Rodgers, "Inverse Methods for Atmospheric Sounding" (2000); a thin shell of the height z0
// is brightest at h = z0, and at h < z0 goes as 1 / sqrt(z0 - h)). e(z) is a Gaussian with a width of its own
// on either side of its peak; what the picture's pixels and lens blur is in the widths. A constant is added,
// for the sky behind. Least squares, all points with the same weight.
//
// What is not the same all around, an arc that crosses the limb, is seen too low where it stands nearer or
// farther than the tangent point: by d^2 / 2R at the distance d from it, 7 km at 300 km.
#pragma once

#include <optional>
#include <vector>

namespace vegard::fit {

/// Below that altitude the limb's own light, clouds and scattered light are not distinguished from the layer.
inline constexpr double kLimbAirKm = 40.0;

struct LimbLayer {
  double peak_km = 0.0, sigma_peak_km = 0.0;  ///< of the emission; the error is that of the points' scatter
  double lower_km = 0.0, upper_km = 0.0;      ///< where the emission is half of the peak's
  double apparent_peak_km = 0.0;              ///< the tangent altitude of the most light
  double light = 0.0;                         ///< most light along a line of sight, without the sky behind
  double sky = 0.0;
  double rms_over_light = 0.0;  ///< rms of the residuals
};

/// From light at tangent altitudes, in any order; points that are not finite, or below kLimbAirKm, are not
/// used. `observer_km`: the layer is below it. None where fewer than eight points are left, the light has no
/// peak within them, or no layer is found.
std::optional<LimbLayer> find_limb_layer(const std::vector<double>& tangent_km,
                                         const std::vector<double>& light, double observer_km);

/// N(h) of a layer, without the sky behind, in units of e's at the peak times km; for pictures of the model.
double limb_column_km(double tangent_km, double peak_km, double lower_km, double upper_km);

}  // namespace vegard::fit
