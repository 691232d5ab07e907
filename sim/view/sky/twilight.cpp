#include "sim/view/sky/twilight.h"

#include <algorithm>
#include <cmath>

namespace vegard::sim {

double twilight_mag_arcsec2(const TwilightBand& band, double sun_elevation_deg) {
  const double x = 90.0 - sun_elevation_deg - 95.0;
  return band.a0 + (band.a1 + band.a2 * x) * x;
}

double radiance_of_mag_arcsec2(const TwilightBand& band, double mag_arcsec2) {
  constexpr double kArcsecPerRadian = 206264.80624709636;
  return band.zero_w_m2_nm * std::pow(10.0, -0.4 * mag_arcsec2) * kArcsecPerRadian * kArcsecPerRadian;
}

Spectrum twilight_spectrum(double sun_elevation_deg) {
  std::array<double, kTwilightBands.size()> log_radiance{};
  for (std::size_t i = 0; i < kTwilightBands.size(); ++i) {
    const TwilightBand& band = kTwilightBands[i];
    log_radiance[i] = std::log(radiance_of_mag_arcsec2(band, twilight_mag_arcsec2(band, sun_elevation_deg)) -
                               radiance_of_mag_arcsec2(band, band.night_mag));
  }
  return [=](double nm) {
    std::size_t i = 0;
    while (i + 2 < kTwilightBands.size() && kTwilightBands[i + 1].wavelength_nm < nm) ++i;
    const double t = (nm - kTwilightBands[i].wavelength_nm) /
                     (kTwilightBands[i + 1].wavelength_nm - kTwilightBands[i].wavelength_nm);
    return std::exp(log_radiance[i] + t * (log_radiance[i + 1] - log_radiance[i]));
  };
}

}  // namespace vegard::sim
