// The altitude of a thin layer of light that is seen edge-on, at the Earth's limb.
//
// If the layer is assumed spherically symmetric, with the emission e(z) at the altitude z, a line of sight
// with the tangent altitude h sees
//   N(h) = 2 integral over z > h of e(z) (R + z) / sqrt((R + z)^2 - (R + h)^2) dz,
// Abel's integral (Rodgers, "Inverse Methods for Atmospheric Sounding" (2000); a thin shell at the altitude
// z0 is brightest at h = z0, and its light is proportional to 1 / sqrt(z0 - h) at h < z0). e(z) is modelled
// as a Gaussian with different widths below and above its peak; the widths include the blur of lens and
// pixels. A constant is added for the sky behind the layer. Least squares, all points with the same weight.
//
// Light that is not spherically symmetric, such as an arc that crosses the limb, appears too low if it is
// nearer or farther than the tangent point: by d^2 / 2R at the distance d from this point, 7 km at 300 km.
#pragma once

#include <optional>
#include <vector>

namespace vegard::fit {

/// Below this altitude clouds and scattered light at the limb cannot be distinguished from a layer.
inline constexpr double kLimbAirKm = 40.0;

struct LimbLayer {
  double peak_km = 0.0, sigma_peak_km = 0.0;  ///< of the emission; the error follows from the points' scatter
  double lower_km = 0.0, upper_km = 0.0;      ///< altitudes at which the emission is half of the peak's
  double apparent_peak_km = 0.0;              ///< tangent altitude at which the light is largest
  double light = 0.0;                         ///< largest light along a line of sight, without `sky`
  double sky = 0.0;                           ///< light of the sky behind the layer
  double rms_over_light = 0.0;                ///< rms of the residuals
};

/// Fits a layer to the light at tangent altitudes, which may be in any order; points that are not finite, or
/// below kLimbAirKm, are not used. The layer must be below `observer_km`. None if fewer than eight points
/// remain, the light has no peak within them, or no layer is found.
std::optional<LimbLayer> find_limb_layer(const std::vector<double>& tangent_km,
                                         const std::vector<double>& light, double observer_km);

/// Returns N(h) of a layer, without the sky behind it, in units of the emission at the peak times km; for
/// pictures of the model.
double limb_column_km(double tangent_km, double peak_km, double lower_km, double upper_km);

}  // namespace vegard::fit
