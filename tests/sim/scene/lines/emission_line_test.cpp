
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "sim/light/tables/emission_table.h"
#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/lines/scene_lines.h"
#include "sim/scene/lines/solar_lines.h"
#include "tests/support/glow.h"

namespace vegard::sim::emission_line_test {
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
}  // namespace vegard::sim::emission_line_test
