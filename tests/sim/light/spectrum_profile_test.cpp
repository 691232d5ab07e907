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
    for (const ElectronPiece& piece : gaussian_pieces(4.0, spread, SlopeBy::energy_spread)) {
      shares += piece.share;
      slopes += piece.share * piece.d_log_share;
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

/// The sum over a Maxwellian in place of the pieces' own shares.
HeightProfile maxwellian_of(const std::vector<ElectronPiece>& pieces, double energy_kev) {
  HeightProfile made = dark_profile(3);
  std::vector<double> sum(made.rate.size(), 0.0);
  double weights = 0.0;
  for (const ElectronPiece& piece : pieces) {
    const double weight = std::pow(piece.energy_kev, 3) * std::exp(-piece.energy_kev / energy_kev);
    const HeightProfile light = mono_profile(tests::glow(), kLines, piece.energy_kev);
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += weight * light.rate[k];
    weights += weight;
  }
  for (std::size_t k = 0; k < sum.size(); ++k) made.rate[k] = static_cast<float>(sum[k] / weights);
  return made;
}

TEST(SpectrumProfile, AKappaDistributionBecomesAMaxwellian) {
  // What is left is of the first order in 1/kappa.
  for (const double energy : {0.5, 2.0, 8.0}) {
    const HeightProfile wanted = maxwellian_of(kappa_pieces(tests::glow(), energy, 100.0), energy);
    expect_close(kappa_profile(tests::glow(), kLines, energy, 1e7), wanted, 1e-5);
    expect_close(kappa_profile(tests::glow(), kLines, energy, kMaxKappa), wanted, 0.08);
    // The program's own tables have both of one computation.
    const EmissionSource own = {emission_tables(kDefaultEmissionTables)};
    expect_close(kappa_profile(own, kLines, energy, 1e7), maxwellian_profile(own, kLines, energy), 0.05);
  }
}

TEST(SpectrumProfile, SharesOfAKappaDistributionAndItsMeanEnergy) {
  for (const double kappa : {kMinKappa, 5.0, 20.0, kMaxKappa}) {
    double shares = 0.0, slopes = 0.0, electrons = 0.0;
    for (const ElectronPiece& piece : kappa_pieces(tests::glow(), 1.0, kappa)) {
      shares += piece.share;
      slopes += piece.share * piece.d_log_share;
      electrons += piece.share / piece.energy_kev;
    }
    EXPECT_NEAR(shares, 1.0, 1e-11);
    EXPECT_NEAR(slopes, 0.0, 1e-9);
    const double mean = mean_energy_over_e0({ElectronSpectrum::Kind::kappa, 0.0, kappa});
    EXPECT_NEAR(mean, 2.0 * kappa / (kappa - 2.0), 1e-12);
    // Up to 330 keV: of the energy flux at a kappa of 2.5 a good part is above.
    if (kappa > 4.0)
      EXPECT_NEAR(1.0 / electrons / mean, 1.0, 2e-3) << kappa;
    else
      EXPECT_LT(1.0 / electrons, 0.95 * mean);
  }
  EXPECT_EQ(mean_energy_over_e0({}), 2.0);
  EXPECT_EQ(mean_energy_over_e0({ElectronSpectrum::Kind::mono}), 1.0);
  EXPECT_NEAR(mean_energy_over_e0({ElectronSpectrum::Kind::gaussian, 0.5}), 1.028, 1e-3);
}

TEST(SpectrumProfile, DerivativesByTheEnergyAreThoseOfTheRate) {
  // Central differences of floats; at the tables' ends, where a kappa distribution is cut, too.
  constexpr double h = 0.003;
  for (const double kappa : {kMinKappa, 5.0, 50.0}) {
    for (const double energy : {0.05, 0.7, 3.0, 15.0}) {
      const auto at = [&](double ln) {
        return kappa_profile(tests::glow(), kLines, energy * std::exp(ln), kappa);
      };
      const HeightProfile more = at(h), less = at(-h), here = at(0.0);
      for (int l = 0; l < 3; ++l) {
        const double peak = peak_of(here.d_rate_d_ln_energy, l);
        ASSERT_GT(peak, 0.0);
        for (int a = 0; a < HeightProfile::kAltitudes; a += 3)
          EXPECT_NEAR(here.d_rate_d_ln_energy[a * 4 + l],
                      (more.rate[a * 4 + l] - less.rate[a * 4 + l]) / (2.0 * h),
                      1e-3 * peak + 1.2e-7 / h * here.rate[a * 4 + l])
              << kappa << ", " << energy << " keV, line " << l << ", altitude "
              << HeightProfile::altitude_km(a);
      }
    }
  }
}

TEST(SpectrumProfile, TheSmallerKappaTheMoreSlowAndFastElectronsAtOneMeanEnergy) {
  constexpr double kMean = 4.0;
  double red = 0.0, low = 0.0;
  for (const double kappa : {kMaxKappa, 10.0, 5.0, 4.0}) {
    const double energy = kMean / mean_energy_over_e0({ElectronSpectrum::Kind::kappa, 0.0, kappa});
    const HeightProfile profile = kappa_profile(tests::glow(), kLines, energy, kappa);
    const double blue = column_below(profile, 2, HeightProfile::kTopKm).rayleigh;
    const double more_red = column_below(profile, 0, HeightProfile::kTopKm).rayleigh / blue,
                 more_low = column_below(profile, 2, 95.0).rayleigh / blue;
    EXPECT_GT(more_red, red) << kappa;
    EXPECT_GT(more_low, low) << kappa;
    red = more_red;
    low = more_low;
  }
}

TEST(ElectronSpectrum, NamesTheProfileOfItsKind) {
  using Kind = ElectronSpectrum::Kind;
  const auto profile = [](const ElectronSpectrum& spectrum, double flux = 1.0) {
    return electron_profile(tests::glow(), kLines, spectrum, 3.0, flux).rate;
  };
  EXPECT_EQ(profile({}, 5.0), maxwellian_profile(tests::glow(), kLines, 3.0, 5.0).rate);
  EXPECT_EQ(profile({Kind::mono}, 5.0), mono_profile(tests::glow(), kLines, 3.0).rate);
  EXPECT_EQ(profile({Kind::gaussian, 0.4}), gaussian_profile(tests::glow(), kLines, 3.0, 0.4).rate);
  EXPECT_EQ(profile({Kind::kappa, 0.4, 7.0}), kappa_profile(tests::glow(), kLines, 3.0, 7.0).rate);
  for (const Kind kind : {Kind::maxwellian, Kind::gaussian, Kind::mono, Kind::kappa})
    EXPECT_EQ(spectrum_kind(spectrum_word(kind)), kind);
}

}  // namespace
}  // namespace vegard::sim::spectrum_profile_test
