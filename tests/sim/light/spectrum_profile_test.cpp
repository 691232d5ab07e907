#include "sim/light/spectrum_profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/light/electron.h"
#include "sim/light/sheet_profile.h"
#include "sim/light/tables/emission_table.h"
#include "sim/scene/table/parameter_id.h"
#include "tests/support/glow.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::spectrum_profile_test {
namespace {

const std::vector<double> kLines = {630.0, 557.7, 427.8};

double peak_of(const std::vector<float>& rate, int line) {
  double peak = 0.0;
  for (int a = 0; a < HeightProfile::kAltitudes; ++a)
    peak = std::max<double>(peak, std::abs(rate[static_cast<std::size_t>(a) * 4 + line]));
  return peak;
}

/// At the altitudes of the tables; between them each is a spline of its own.
void expect_close(const HeightProfile& found, const HeightProfile& wanted, double share_of_peak) {
  for (int l = 0; l < found.lines; ++l) {
    for (const double altitude : tests::glow().tables.maxwellian().altitudes_km()) {
      const auto a = static_cast<std::size_t>((altitude - HeightProfile::kBottomKm) / HeightProfile::kStepKm);
      EXPECT_NEAR(found.rate[a * 4 + l], wanted.rate[a * 4 + l], share_of_peak * peak_of(wanted.rate, l))
          << "line " << l << ", altitude " << altitude;
    }
  }
}

/// km below the peak of 557.7 nm at which its light has fallen to a tenth.
double border_km(const HeightProfile& profile) {
  int peak = 0;
  for (int a = 0; a < HeightProfile::kAltitudes; ++a)
    if (profile.rate[a * 4 + 1] > profile.rate[peak * 4 + 1]) peak = a;
  int a = peak;
  while (a > 0 && profile.rate[a * 4 + 1] > 0.1f * profile.rate[peak * 4 + 1]) --a;
  return (peak - a) * HeightProfile::kStepKm;
}

TEST(SpectrumProfile, TheNarrowerTheSpectrumTheSharperTheLowerBorder) {
  // At one mean energy.
  for (const double mean : {2.0, 5.0, 10.0, 20.0}) {
    const double mono = border_km(mono_profile(tests::glow(), kLines, mean));
    const double narrow = border_km(gaussian_profile(tests::glow(), kLines, mean, 0.15));
    const double wide = border_km(gaussian_profile(tests::glow(), kLines, mean, 0.3));
    EXPECT_LT(mono, narrow) << mean;
    EXPECT_LT(narrow, wide) << mean;
  }
  EXPECT_LT(border_km(mono_profile(tests::glow(), kLines, 10.0)),
            0.65 * border_km(maxwellian_profile(tests::glow(), kLines, 5.0)));
}

TEST(SpectrumProfile, ANarrowGaussianIsOneEnergy) {
  // What is left is of second order in the spread.
  expect_close(gaussian_profile(tests::glow(), kLines, 6.0, 0.01), mono_profile(tests::glow(), kLines, 6.0),
               2e-3);
}

TEST(SpectrumProfile, AGaussianIsTheIntegralOverItsEnergies) {
  // By fine trapezoids over the logarithm of the energy, to six standard deviations.
  for (const double spread : {0.05, 0.2, 0.5, 1.0}) {
    constexpr int kSteps = 1500;
    const double centre = 5.0, last = std::log(1.0 + 6.0 * spread);
    const double first = spread < 1.0 / 6.0 ? std::log(1.0 - 6.0 * spread) : -6.0;
    HeightProfile wanted = dark_profile(3);
    std::vector<double> sum(wanted.rate.size(), 0.0);
    double weights = 0.0;
    for (int i = 1; i < kSteps; ++i) {
      const double x = std::exp(first + (last - first) * i / kSteps), u = (x - 1.0) / spread;
      const double weight = x * x * std::exp(-0.5 * u * u);
      const HeightProfile piece = mono_profile(tests::glow(), kLines, centre * x);
      for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += weight * piece.rate[k];
      weights += weight;
    }
    for (std::size_t k = 0; k < sum.size(); ++k) wanted.rate[k] = static_cast<float>(sum[k] / weights);
    expect_close(gaussian_profile(tests::glow(), kLines, centre, spread), wanted, 1e-4);
  }
}

TEST(SpectrumProfile, SharesOfTheEnergyFluxAndMeanEnergyAreThoseOfTheGaussian) {
  for (const double spread : {0.01, 0.2, 0.6, 1.0}) {
    double shares = 0.0, slopes = 0.0, electrons = 0.0;
    for (const GaussianPiece& piece : gaussian_pieces(4.0, spread)) {
      shares += piece.share;
      slopes += piece.share * piece.d_log_share_d_spread;
      electrons += piece.share / piece.energy_kev;
    }
    EXPECT_NEAR(shares, 1.0, 1e-11);
    EXPECT_NEAR(slopes, 0.0, 1e-9);
    // Energy flux over number flux. Electrons below exp(-14 spread) are not counted.
    EXPECT_NEAR(1.0 / electrons / gaussian_mean_energy_kev(4.0, spread), 1.0, 2e-3) << spread;
  }
  Sheet sheet;
  sheet.energy_kev = 4.0;
  EXPECT_EQ(mean_energy_kev(sheet), 8.0);
  sheet.profile = ProfileKind::mono;
  EXPECT_EQ(mean_energy_kev(sheet), 4.0);
  sheet.profile = ProfileKind::gaussian;
  EXPECT_NEAR(*mean_energy_kev(sheet), 4.0, 1e-4);
  sheet.profile = ProfileKind::file;
  EXPECT_FALSE(mean_energy_kev(sheet));
}

TEST(SpectrumProfile, DerivativesByTheSpreadAreThoseOfTheRate) {
  // Central differences of floats; alone, and of a given brightness. A narrow step, since pieces pass the
  // energy at which the yields begin to be held.
  constexpr double h = 0.003;
  for (const double brightness : {0.0, 10.0}) {
    for (const double spread : {0.05, 0.2, 0.7}) {
      Sheet sheet;
      sheet.profile = ProfileKind::gaussian;
      sheet.brightness_kilorayleigh = brightness;
      const auto at = [&](double value) {
        sheet.energy_spread = value;
        return sheet_profile(kLines, tests::with_sheet(sheet), 0);
      };
      const HeightProfile more = at(spread * (1.0 + h)), less = at(spread * (1.0 - h)), here = at(spread);
      const Scene scene = tests::with_sheet(sheet);
      const std::vector<float> slope =
          profile_slope(kLines, scene, 0, parameter_with(ParameterRole::energy_spread, 0));
      ASSERT_EQ(slope.size(), here.rate.size());
      for (int l = 0; l < 3; ++l) {
        const double peak = peak_of(slope, l);
        ASSERT_GT(peak, 0.0);
        for (int a = 0; a < HeightProfile::kAltitudes; a += 3)
          EXPECT_NEAR(slope[a * 4 + l], (more.rate[a * 4 + l] - less.rate[a * 4 + l]) / (2.0 * h * spread),
                      1e-3 * peak + 1.2e-7 / (h * spread) * here.rate[a * 4 + l])
              << spread << ", line " << l << ", altitude " << HeightProfile::altitude_km(a);
      }
      EXPECT_TRUE(profile_slope(kLines, scene, 0, parameter_at(scene, "sheet.width_km").value()).empty());
    }
  }
}

}  // namespace
}  // namespace vegard::sim::spectrum_profile_test
