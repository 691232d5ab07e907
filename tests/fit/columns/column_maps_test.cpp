#include "fit/columns/column_maps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

namespace vegard::fit::column_maps_test {
namespace {

constexpr std::size_t kWidth = 31, kHeight = 17;

const ColumnModel& model() {
  static const ColumnModel three(sim::emission_tables("glow"), {427.8, 557.7, 630.0}, {});
  return three;
}

const ColumnChi2& chi2_of_maps() {
  static const ColumnChi2 chi2(model(), {true, true, false}, {}, 2);
  return chi2;
}

double energy_at(std::size_t x) { return 0.4 * std::pow(10.0 / 0.4, static_cast<double>(x) / (kWidth - 1)); }
double flux_at(std::size_t y) { return 0.5 * std::pow(30.0 / 0.5, static_cast<double>(y) / (kHeight - 1)); }

/// Energy grows to the right, flux downwards.
std::vector<LineMap> made_maps() {
  std::vector<LineMap> lines(model().lines());
  for (std::size_t l = 0; l < lines.size(); ++l) {
    lines[l].error = {5.0, 0.02};
    for (std::size_t y = 0; y < kHeight; ++y)
      for (std::size_t x = 0; x < kWidth; ++x)
        lines[l].rayleigh.push_back(static_cast<float>(
            std::exp(model().at(l, {std::log(energy_at(x)), std::log(flux_at(y)), 0.0}).ln_rayleigh)));
  }
  return lines;
}

bool same_bytes(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

TEST(ColumnMaps, GiveWhatTheyWereMadeOf) {
  const ColumnMaps maps = invert_maps(chi2_of_maps(), nullptr, made_maps(), kWidth, kHeight, 0);
  for (std::size_t y = 0; y < kHeight; ++y)
    for (std::size_t x = 0; x < kWidth; ++x) {
      const std::size_t i = y * kWidth + x;
      EXPECT_NEAR(maps.energy_kev[i] / energy_at(x), 1.0, 1e-4);
      EXPECT_NEAR(maps.flux_mw_m2[i] / flux_at(y), 1.0, 1e-4);
      EXPECT_EQ(maps.oxygen_factor[i], 1.0f);
    }
}

TEST(ColumnMaps, AreTheInversionOfEachPixel) {
  const std::vector<LineMap> lines = made_maps();
  const ColumnMaps maps = invert_maps(chi2_of_maps(), nullptr, lines, kWidth, kHeight, 0);
  const std::size_t i = 7 * kWidth + 12;
  ColumnData data;
  for (std::size_t l = 0; l < lines.size(); ++l) {
    data.rayleigh[l] = lines[l].rayleigh[i];
    data.sigma[l] = lines[l].error.of(lines[l].rayleigh[i]);
  }
  const ColumnInversion one = invert_columns(ColumnChi2(model(), {true, true, false}, {}), data);
  EXPECT_NEAR(maps.energy_kev[i], one.solutions.front().of[kLnEnergy].value, 1e-5);
  EXPECT_NEAR(maps.ln_energy_error[i], one.solutions.front().of[kLnEnergy].sigma_ln, 1e-6);
  EXPECT_NEAR(maps.relative_flux_error[i], one.solutions.front().of[kLnFlux].sigma_ln, 1e-6);
  EXPECT_EQ(maps.quality[i], static_cast<std::uint8_t>(one.verdict));
}

TEST(ColumnMaps, AreTheSameForAnyNumberOfThreads) {
  std::vector<LineMap> lines = made_maps();
  for (std::size_t l = 0; l < lines.size(); ++l)
    for (std::size_t i = 0; i < lines[l].rayleigh.size(); ++i)
      lines[l].rayleigh[i] *=
          1.0f + 0.03f * static_cast<float>(std::sin(1.7 * static_cast<double>(i * (l + 2))));
  const ColumnMaps one = invert_maps(chi2_of_maps(), nullptr, lines, kWidth, kHeight, 1);
  const ColumnMaps many = invert_maps(chi2_of_maps(), nullptr, lines, kWidth, kHeight, 0);
  EXPECT_TRUE(same_bytes(one.energy_kev, many.energy_kev));
  EXPECT_TRUE(same_bytes(one.flux_mw_m2, many.flux_mw_m2));
  EXPECT_TRUE(same_bytes(one.ln_energy_error, many.ln_energy_error));
  EXPECT_TRUE(same_bytes(one.chi2, many.chi2));
  EXPECT_EQ(one.quality, many.quality);
}

TEST(ColumnMaps, SayWhereThereIsNoAnswer) {
  std::vector<LineMap> lines = made_maps();
  lines[1].rayleigh[0] = std::numeric_limits<float>::quiet_NaN();
  for (LineMap& line : lines) line.rayleigh[1] = -2.0f;  // less than the noise of 5 R
  lines[1].rayleigh[2] *= 3.0f;
  const ColumnMaps maps = invert_maps(chi2_of_maps(), nullptr, lines, kWidth, kHeight, 0);
  EXPECT_TRUE(std::isnan(maps.energy_kev[0]));
  EXPECT_EQ(maps.quality[0], static_cast<std::uint8_t>(ColumnVerdict::not_measured));
  EXPECT_TRUE(std::isnan(maps.flux_mw_m2[1]));
  EXPECT_EQ(maps.quality[1], static_cast<std::uint8_t>(ColumnVerdict::no_light));
  EXPECT_EQ(maps.quality[2], static_cast<std::uint8_t>(ColumnVerdict::contradiction));
  EXPECT_EQ(maps.quality[5], static_cast<std::uint8_t>(ColumnVerdict::well_constrained));
}

}  // namespace
}  // namespace vegard::fit::column_maps_test
