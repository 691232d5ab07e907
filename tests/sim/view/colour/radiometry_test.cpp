#include "sim/view/colour/radiometry.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vegard::sim::radiometry_test {
namespace {

TEST(Radiometry, AKilorayleighOfGreenIsAsBrightAsTheConversionOfTheLiteratureSays) {
  // Baker and Romick 1976, doi:10.1364/AO.15.001966: 1 R is 1.58e-11 / lambda W cm^-2 sr^-1, lambda in
  // nanometres. Their h c is rounded to three digits.
  const double w_m2_sr = 1.58e-11 / 557.7 * 1e4;
  EXPECT_NEAR(radiance_w_m2_sr_per_rayleigh(557.7) / w_m2_sr, 1.0, 1e-3);
  // With 683 lm/W and V(557.7 nm) = 0.9983 (CIE, between 555 nm: 1.0000 and 560 nm: 0.9950).
  EXPECT_NEAR(luminance_cd_m2_per_rayleigh(557.7) / (683.0 * 0.9983 * w_m2_sr), 1.0, 2e-3);
}

TEST(Radiometry, PhotonsOnAPixelAreThoseThroughTheLensTowardsIt) {
  // The same from the other side: a lens of focal length f and diameter f/N takes, from the solid angle
  // (p/f)^2 that a pixel sees, L (p/f)^2 pi (f/N)^2 / 4 photons per second, whatever f.
  const Optics optics{2.0, 0.8, 5.0};
  for (const double f_m : {0.008, 0.05}) {
    const double solid_angle = std::pow(5e-6 / f_m, 2),
                 area_m2 = std::acos(-1.0) * std::pow(f_m / 2.0, 2) / 4.0;
    const double photons = 1e10 / (4.0 * std::acos(-1.0)) * solid_angle * area_m2 * 0.8;
    EXPECT_NEAR(pixel_photons_s_per_rayleigh(optics) / photons, 1.0, 1e-12);
  }
}

}  // namespace
}  // namespace vegard::sim::radiometry_test
