
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "sim/light/tables/emission_table.h"
#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/lines/scene_lines.h"
#include "tests/support/glow.h"

namespace vegard::sim::emission_lines_test {
namespace {

TEST(EmissionLines, AreOneListByWavelength) {
  const std::vector<double>& known = known_emission_lines_nm();
  ASSERT_EQ(known.size(), emission_lines().size());
  EXPECT_TRUE(std::is_sorted(known.begin(), known.end()));
  for (const double wavelength_nm : known)
    EXPECT_EQ(find_emission_line(wavelength_nm)->wavelength_nm, wavelength_nm);
  for (const double asked_for : {337.1, 391.4, 427.8, 520.0, 557.7, 630.0, 636.4, 777.4, 844.6})
    EXPECT_NE(find_emission_line(asked_for), nullptr) << asked_for;
  EXPECT_EQ(find_emission_line(600.0), nullptr);
}

TEST(EmissionLines, HaveAColumnOrARatioWithASource) {
  const EmissionTable& table = tests::glow().tables.maxwellian();
  for (const EmissionLine& line : emission_lines()) {
    if (!is_auroral(line)) continue;
    EXPECT_TRUE(table.has(line.table_column)) << line.wavelength_nm;
    const std::string own = "ver_" + std::to_string(std::lround(10.0 * line.wavelength_nm));
    EXPECT_EQ(line.table_column == own, line.ratio == 1.0) << line.wavelength_nm;
    EXPECT_EQ(line.table_column == own, std::string(line.ratio_source).empty()) << line.wavelength_nm;
  }
}

TEST(EmissionLines, HaveComponentsWhoseSharesAddUpToOne) {
  for (const EmissionLine& line : emission_lines()) {
    double sum = 0.0;
    bool named_after_one = false;
    for (const LineComponent& component : line.components) {
      sum += component.share;
      named_after_one = named_after_one || component.wavelength_nm == line.wavelength_nm;
    }
    EXPECT_NEAR(sum, 1.0, 1e-9) << line.wavelength_nm;
    EXPECT_TRUE(named_after_one) << line.wavelength_nm;
  }
  EXPECT_EQ(find_emission_line(670.5)->components.size(), 29u);
}

/// Vibrational states of a Morse potential on a grid of distances, by the sinc functions of Colbert and
/// Miller 1992 (J. Chem. Phys. 96, 1982, equation 2.6).
struct Vibration {
  Eigen::VectorXd energy_cm1;  ///< above the potential's minimum
  Eigen::MatrixXd state;       ///< [distance, level]
};

constexpr int kDistances = 140;
constexpr double kFirstDistance_A = 0.8, kDistanceStep_A = 0.01;

Vibration morse_vibration(double we_cm1, double wexe_cm1, double re_A) {
  constexpr double kHbar2Over2M = 16.857629 / 7.0015370;  // cm⁻¹ Å², of the reduced mass of N2 in dalton
  const double depth = we_cm1 * we_cm1 / (4.0 * wexe_cm1), steepness = std::sqrt(wexe_cm1 / kHbar2Over2M);
  Eigen::MatrixXd hamiltonian(kDistances, kDistances);
  for (int i = 0; i < kDistances; ++i)
    for (int j = 0; j < kDistances; ++j) {
      const double n = i - j;
      const double kinetic = i == j ? M_PI * M_PI / 3.0 : ((i - j) % 2 == 0 ? 2.0 : -2.0) / (n * n);
      hamiltonian(i, j) = kHbar2Over2M / (kDistanceStep_A * kDistanceStep_A) * kinetic;
      if (i != j) continue;
      const double r = kFirstDistance_A + i * kDistanceStep_A;
      hamiltonian(i, j) += depth * std::pow(1.0 - std::exp(-steepness * (r - re_A)), 2);
    }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(hamiltonian);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

TEST(EmissionLines, OfTheFirstPositiveSystemBranchAsItsOverlapsDo) {
  // Constants of A3Sigma and B3Pi: Huber and Herzberg 1979. The lowest states of a Morse potential lie at we
  // (v + 1/2) - wexe (v + 1/2)².
  const Vibration a = morse_vibration(1460.64, 13.87, 1.2866), b = morse_vibration(1733.39, 14.122, 1.2126);
  for (int v = 0; v < 10; ++v)
    ASSERT_NEAR(b.energy_cm1[v], 1733.39 * (v + 0.5) - 14.122 * (v + 0.5) * (v + 0.5), 0.5) << v;
  // A band's photons from one upper level go as (wavenumber)³ × (overlap with the transition moment)². The
  // moment falls with the distance; its slope, 1.8 of its value at 1.25 Å per Å, is the one number fitted.
  const auto strength = [&](int upper, int lower) {
    const double wavenumber = 59619.4 - 50203.6 + b.energy_cm1[upper] - a.energy_cm1[lower];
    double overlap = 0.0;
    for (int i = 0; i < kDistances; ++i) {
      const double r = kFirstDistance_A + i * kDistanceStep_A;
      overlap += b.state(i, upper) * a.state(i, lower) * (1.0 - 1.8 * (r - 1.25));
    }
    return std::pow(wavenumber, 3) * overlap * overlap;
  };
  constexpr struct {
    double head_nm;
    int upper, lower;
  } kBands[] = {{590.6, 9, 5}, {595.9, 8, 4}, {601.4, 7, 3}, {607.0, 6, 2}, {612.7, 5, 1}, {618.7, 4, 0},
                {639.8, 9, 6}, {646.9, 8, 5}, {654.5, 7, 4}, {662.4, 6, 3}, {670.5, 5, 2}, {679.0, 4, 1},
                {687.5, 3, 0}, {716.5, 7, 5}, {727.4, 6, 4}, {738.7, 5, 3}, {750.5, 4, 2}, {761.3, 9, 8},
                {762.6, 3, 1}, {775.2, 8, 7}, {775.4, 2, 0}, {789.7, 7, 6}, {804.8, 6, 5}, {820.6, 5, 4},
                {837.0, 4, 3}, {854.2, 3, 2}, {872.3, 2, 1}, {891.2, 1, 0}, {898.3, 6, 6}};
  const std::vector<LineComponent>& listed_bands = find_emission_line(670.5)->components;
  ASSERT_EQ(listed_bands.size(), std::size(kBands));
  std::map<int, std::map<int, double>> shares;
  for (std::size_t i = 0; i < std::size(kBands); ++i) {
    ASSERT_EQ(listed_bands[i].wavelength_nm, kBands[i].head_nm);
    const double origin_nm =
        1e7 / (59619.4 - 50203.6 + b.energy_cm1[kBands[i].upper] - a.energy_cm1[kBands[i].lower]);
    // Heads lie a few nm above origins: enough to know a band by, since those of one upper level are 40 nm
    // apart or more.
    EXPECT_NEAR(kBands[i].head_nm - origin_nm, 2.5, 1.5) << kBands[i].head_nm;
    shares[kBands[i].upper][kBands[i].lower] = listed_bands[i].share;
  }
  int compared = 0;
  for (const auto& [upper, bands] : shares) {
    double listed = 0.0, computed = 0.0;
    for (const auto& [lower, share] : bands) listed += share, computed += strength(upper, lower);
    for (const auto& [lower, share] : bands) {
      if (bands.size() < 2 || share < 0.05 * listed) continue;
      // 10 %: Morse potentials against those from spectra; shares have two digits.
      EXPECT_NEAR(strength(upper, lower) / computed, share / listed, 0.1 * share / listed)
          << upper << " to " << lower;
      ++compared;
    }
  }
  EXPECT_EQ(compared, 23);
}

TEST(EmissionLines, OfTheSunHaveNoColumnAndAPeakOfTemperature) {
  // Ions come by their charge: iron that has lost more electrons is hotter.
  double before = 0.0;
  for (const double asked_for : {30.4, 17.1, 637.4, 19.5, 530.3, 28.4, 33.5, 9.4, 13.1}) {
    const EmissionLine* line = find_emission_line(asked_for);
    ASSERT_NE(line, nullptr) << asked_for;
    EXPECT_FALSE(is_auroral(*line)) << asked_for;
    EXPECT_TRUE(is_solar(*line)) << asked_for;
    EXPECT_EQ(default_blur_width_deg(asked_for), 0.0);
    const auto response = temperature_response(asked_for);
    ASSERT_TRUE(response.has_value()) << asked_for;
    EXPECT_GT(response->peak_log_k, before) << asked_for;
    EXPECT_GT(response->width_log_k, 0.0) << asked_for;
    EXPECT_FALSE(std::string(response->source).empty()) << asked_for;
    before = response->peak_log_k;
  }
  EXPECT_TRUE(is_solar(*find_emission_line(560.0)));  // white light
  EXPECT_FALSE(temperature_response(560.0).has_value());
  for (const double other : {557.7, 550.0, 656.3}) {
    EXPECT_FALSE(is_solar(*find_emission_line(other))) << other;
    EXPECT_FALSE(temperature_response(other).has_value()) << other;
  }
}

TEST(EmissionLines, OfNebulaeHaveNoColumnAndTheRatiosOfTheirUpperLevels) {
  for (const double asked_for : {450.0, 468.6, 486.1, 500.7, 550.0, 656.3, 658.4, 673.1}) {
    ASSERT_NE(find_emission_line(asked_for), nullptr) << asked_for;
    EXPECT_FALSE(is_auroral(*find_emission_line(asked_for))) << asked_for;
    EXPECT_EQ(default_blur_width_deg(asked_for), 0.0);
  }
  EXPECT_TRUE(is_auroral(*find_emission_line(557.7)));
  // Photons go as energy times wavelength. The shares are given to three digits.
  const auto energy_ratio = [](double nm) {
    const std::vector<LineComponent>& pair = find_emission_line(nm)->components;
    EXPECT_EQ(pair.size(), 2u);
    return pair[1].share / pair[0].share * pair[0].wavelength_nm / pair[1].wavelength_nm;
  };
  EXPECT_NEAR(energy_ratio(500.7), 2.98, 0.02);
  EXPECT_NEAR(energy_ratio(658.4), 3.05, 0.02);
}

TEST(EmissionLines, ContinuaFollowTheirLaws) {
  const std::vector<LineComponent>& synchrotron = find_emission_line(550.0)->components;
  const LineComponent &first = synchrotron.front(), &last = synchrotron.back();
  // Energy per frequency: photons per wavelength times λ² / λ.
  const double by_frequency =
      std::log(last.share * last.wavelength_nm / (first.share * first.wavelength_nm)) /
      std::log(first.wavelength_nm / last.wavelength_nm);
  EXPECT_NEAR(by_frequency, -0.43, 1e-9);
  // Wien's law for photons per wavelength: the peak of 15 000 K lies at 245 nm, so that starlight falls.
  const std::vector<LineComponent>& starlight = find_emission_line(450.0)->components;
  for (std::size_t i = 1; i < starlight.size(); ++i) EXPECT_LT(starlight[i].share, starlight[i - 1].share);
}

TEST(EmissionLines, AreBlurredLikeTheLineFromTheSameAtoms) {
  EXPECT_EQ(default_blur_width_deg(636.4), default_blur_width_deg(630.0));
  EXPECT_GT(default_blur_width_deg(630.0), 0.0);
  EXPECT_EQ(default_blur_width_deg(391.4), 0.0);
}

}  // namespace
}  // namespace vegard::sim::emission_lines_test
