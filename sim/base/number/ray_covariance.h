// The covariance of the light of rays along a picture's row, averaged over all positions of the rays.
#pragma once

namespace vegard::sim {

/// The properties of rays (Sheet::ray_contrast, ray_width_km).
struct Rays {
  double contrast = 0.5;  ///< standard deviation of ln(light) along the sheet
  double width_km = 1.0;  ///< full width at half maximum of the autocorrelation
};

/// Returns the covariance of ln(light) at two points `apart_km` apart along the sheet, after a Gaussian smear
/// with the variance `smear_km2` along the sheet.
///
/// The light of rays is log-normal, exp(c g - c^2 / 2), with the autocorrelation rho = exp(-4 ln 2 (d / w)^2)
/// of g (docs/physics.md, rays): its covariance is exp(c^2 rho) - 1 = sum of c^2n rho^n / n!, each term a
/// Gaussian of variance w^2 / (8 n ln 2), to which the smear adds twice its own variance. The smeared light
/// is still log-normal, to a good approximation (Fenton 1960, doi:10.1109/TCOM.1960.1097606: sums of
/// log-normal numbers), so the covariance of its logarithm is ln(1 + covariance of the light).
double ray_log_covariance(const Rays& rays, double smear_km2, double apart_km);

}  // namespace vegard::sim
