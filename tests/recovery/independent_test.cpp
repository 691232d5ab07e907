// Pictures made by another program (line-of-sight integration, not beams), fitted from starts far off: what
// is true of them is to be found again.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "fit/answer/derived.h"
#include "fit/fit.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/table/parameter_table.h"
#include "tests/recovery/independent_picture.h"
#include "tests/support/source_folder.h"

namespace vegard::fit::independent_test {
namespace {

using Json = nlohmann::json;

const std::filesystem::path kShipped = std::filesystem::path(tests::source_folder()) / "data/examples/h000";

/// The start that the shipped example has too: the place, the wave and the energy far off, the rest as it is.
sim::Scene start_scene(const Json& truth) {
  sim::Scene scene = known_scene(truth);
  sim::Sheet& sheet = scene.sheets[0];
  sheet.center_km = {1.3 * sheet.center_km.east, 1.3 * sheet.center_km.north};
  sheet.bearing_deg += 5.0;
  sheet.energy_kev *= 2.0;
  sheet.thickness_km *= 1.3;
  sheet.wavelength_km *= 1.3;
  sheet.phase_rad = 0.0;
  for (const char* key :
       {"center_km", "bearing_deg", "thickness_km", "wavelength_km", "phase_rad", "energy_kev"}) {
    sim::FreeParameter free;
    free.path = std::string("sheet.main.") + key;
    scene.fit.free.push_back(free);
  }
  sim::validate(scene);
  return scene;
}

/// Degrees between two lines, which have no direction.
double angle_between(double a_deg, double b_deg) { return std::abs(std::remainder(a_deg - b_deg, 180.0)); }

/// What a fit of such a picture is to reach.
void expect_targets(const FitResult& result, const sim::Sheet& truth) {
  ASSERT_EQ(result.best.sheets.size(), 1u);
  const sim::Sheet& found = result.best.sheets[0];
  const double distance = nearest_distance_km(truth);
  EXPECT_NEAR(found.energy_kev, truth.energy_kev, 0.20 * truth.energy_kev);
  EXPECT_NEAR(nearest_distance_km(found), distance, 0.08 * distance);
  EXPECT_LT(result.rms_over_peak, 0.04);
  EXPECT_GT(result.rms_over_peak, 0.0);
  // Where no end of the arc is in view (h002), its place along itself trades off against the phase: a doubt,
  // rightly.
  EXPECT_TRUE(result.verdict == Verdict::good || result.verdict == Verdict::doubtful) << result.verdict_line;
}

double sigma_of(const FitResult& result, const std::string& path) {
  for (const FittedParameter& p : result.parameters)
    if (p.path == path && p.sigma) return *p.sigma;
  ADD_FAILURE() << path << " has no error bar";
  return 0.0;
}

double distance_sigma(const FitResult& result) {
  for (const DerivedNumber& d : result.derived)
    if (d.name == "distance of the main sheet" && d.sigma) return *d.sigma;
  ADD_FAILURE() << "the distance has no error bar";
  return 0.0;
}

// Error bars stand for noise and for correlated residuals, as far as the residuals show it. They do
// not know of what this model lacks and the other program's picture has (rays of uneven brightness, which
// bend all seven numbers alike); and one picture is no statistics. Five of them tell an error bar that is a
// few times too small from one that is wrong.
constexpr double kSigmas = 5.0;

void expect_within_error_bars(const FitResult& result, const sim::Sheet& truth) {
  const sim::Sheet& found = result.best.sheets.at(0);
  EXPECT_NEAR(found.energy_kev, truth.energy_kev, kSigmas * sigma_of(result, "sheet.main.energy_kev"));
  EXPECT_NEAR(nearest_distance_km(found), nearest_distance_km(truth), kSigmas * distance_sigma(result));
  EXPECT_LT(angle_between(found.bearing_deg, truth.bearing_deg),
            kSigmas * sigma_of(result, "sheet.main.bearing_deg"));
  EXPECT_NEAR(found.wavelength_km, truth.wavelength_km,
              kSigmas * sigma_of(result, "sheet.main.wavelength_km"));
  // And they say something.
  EXPECT_LT(distance_sigma(result), 0.08 * nearest_distance_km(truth));
  EXPECT_LT(sigma_of(result, "sheet.main.energy_kev"), 0.20 * truth.energy_kev);
}

TEST(ShippedPhotograph, IsFittedToItsTruth) {
  const sim::Scene scene = sim::read_scene((kShipped / "scene.toml").string());
  const sim::Sheet truth = true_sheet(read_json(kShipped / "truth.json"));
  const Photo photo = read_photo((kShipped / "photo.jpg").string(), Decoding::automatic);
  const FitResult result = fit_photo(scene, photo, FitOptions{});
  expect_targets(result, truth);
  expect_within_error_bars(result, truth);
}

// Else the photographs below would be fitted from other starts than the example that is shown.
TEST(ShippedPhotograph, StartsWhereTheOthersDo) {
  const sim::Scene shipped = sim::read_scene((kShipped / "scene.toml").string());
  const sim::Scene built = start_scene(read_json(kShipped / "truth.json"));
  const std::vector<sim::ParameterPath> paths = sim::all_paths(built);
  ASSERT_EQ(sim::all_paths(shipped).size(), paths.size());
  for (const sim::ParameterPath& path : paths) {
    if (path.row->kind != sim::ParameterKind::real) {
      EXPECT_EQ(sim::value_text(shipped, path), sim::value_text(built, path)) << path.text;
      continue;
    }
    // The file has four decimals.
    EXPECT_NEAR(*sim::real_value(shipped, path), *sim::real_value(built, path), 1.5e-4) << path.text;
  }
}

class MorePhotographs : public ::testing::TestWithParam<const char*> {};

TEST_P(MorePhotographs, AreFittedToTheirTruth) {
  const std::string name = GetParam();
  const std::optional<std::filesystem::path> folder = photographs();
  if (!folder || !std::filesystem::exists(*folder / (name + ".jpg")))
    GTEST_SKIP() << name << ".jpg is not here; VEGARD_PHOTOS may name the folder that has it";
  const Json truth = read_json(*folder / (name + ".truth.json"));
  const Photo photo = read_photo((*folder / (name + ".jpg")).string(), Decoding::automatic);
  const FitResult result = fit_photo(start_scene(truth), photo, FitOptions{});
  const sim::Sheet sheet = true_sheet(truth);
  expect_targets(result, sheet);
  // The middle along the sheet has an error bar that holds it, or none (h002).
  const sim::EastNorth found = result.best.sheets.at(0).center_km;
  const double off = std::hypot(found.east - sheet.center_km.east, found.north - sheet.center_km.north);
  double square = 0.0;
  for (const FittedParameter& p : result.parameters)
    if (p.path.find("center_km") != std::string::npos) {
      EXPECT_TRUE(p.sigma || name == "h002") << p.path;
      square += p.sigma ? *p.sigma * *p.sigma : std::numeric_limits<double>::infinity();
    }
  EXPECT_LT(off, kSigmas * std::sqrt(square));
}

INSTANTIATE_TEST_SUITE_P(Independent, MorePhotographs, ::testing::Values("h001", "h002", "h003"),
                         [](const auto& made) { return std::string(made.param); });

}  // namespace
}  // namespace vegard::fit::independent_test
