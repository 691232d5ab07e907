// A camera and a radar together, of an arc that the simulator itself renders, with noise of fixed seeds.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "fit/compare/radars.h"
#include "fit/fit.h"
#include "sim/emit/aurora/foot_line.h"
#include "sim/scene/lines/scene_lines.h"
#include "tests/support/expect_error.h"
#include "tests/support/free_paths.h"
#include "tests/support/rendered_photo.h"
#include "tests/support/small_scene.h"
#include "tests/support/temporary_folder.h"

namespace vegard::fit::radar_fit_test {
namespace {

constexpr double kRadarError = 0.1;  // of a density
constexpr double kBeamsEastKm = 12.0;
constexpr std::size_t kModes = 8;

/// An arc of 5 km to the north.
sim::Scene arc() {
  sim::Scene scene = tests::small_scene();
  scene.site.latitude_deg = 66.0;
  scene.site.longitude_deg = 20.0;
  sim::Sheet& sheet = scene.sheets[0];
  sheet.width_km = 5.0;
  sheet.thickness_km = 1.0;
  sheet.layers = 1;
  sheet.length_km = 400.0;
  sheet.energy_kev = 4.0;
  sheet.energy_flux_mw_m2 = 8.0;
  sheet.beams = 2000;
  sheet.spacing_jitter = 0.0;
  scene.sky.level = {0.02, 0.03, 0.04};
  scene.fit.bands = 6;
  scene.fit.sky_terms = 1;
  scene.fit.scan_points = 0;
  return scene;
}

/// As a camera for one line has it, whose picture tells of the energy by its shape alone.
sim::Scene green_arc() {
  sim::Scene scene = arc();
  sim::change_lines(scene, {557.7});
  scene.sensor.response = "grey";
  scene.sky.level = {0.03, 0.03, 0.03};
  scene.fit.model_error = 0.05;
  return scene;
}

/// The arc's own densities at feet so far north of the site, a beam each, with noise of this seed.
void add_beams(const tests::TemporaryFolder& folder, const std::vector<double>& north_km, unsigned seed,
               sim::Scene& scene) {
  scene.file = folder / "scene.toml";
  std::vector<double> altitudes;
  for (int altitude = 90; altitude <= 150; altitude += 4) altitudes.push_back(altitude);
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const auto put = [&](const std::string& file, const std::vector<double>& densities_cm3, bool is_noisy) {
    std::string text = "altitude_km,density_cm3,density_cm3_error\n";
    for (std::size_t i = 0; i < altitudes.size(); ++i) {
      const double sigma = kRadarError * densities_cm3[i] + 2e3;
      text += fmt::format("{},{},{}\n", altitudes[i],
                          densities_cm3[i] + (is_noisy ? sigma * normal(random) : 0.0), sigma);
    }
    tests::put(folder / file, text);
  };
  scene.fit.radars.clear();
  for (const double north : north_km) {
    sim::RadarEntry entry;
    entry.name = "beam " + std::to_string(scene.fit.radars.size() + 1);
    entry.file = "density" + std::to_string(scene.fit.radars.size() + 1) + ".csv";
    const sim::PlaceOnEarth place = sim::place_of_foot(scene, {kBeamsEastKm, north});
    entry.latitude_deg = place.latitude_deg;
    entry.longitude_deg = place.longitude_deg;
    scene.fit.radars.push_back(entry);
    put(entry.file, std::vector<double>(altitudes.size(), 1e5), false);  // for their altitudes
  }
  for (const FittedRadar& radar : Radars(scene).fitted(scene)) put(radar.file, radar.electrons_cm3, true);
}

/// `modes`: the fit learns the physics of the tables too, so that the picture counts for no more than it
/// knows.
FitResult refitted(const sim::Scene& truth, const Photo& photo, bool has_radar, std::size_t modes = 0) {
  sim::Scene scene = truth;
  if (!has_radar) scene.fit.radars.clear();
  scene.fit.free = {tests::free_entry("sheet.main.center_km.north"),
                    tests::free_entry("sheet.main.energy_kev")};
  scene.fit.free[0].start = 193.0;
  scene.fit.free[1].start = 5.0;
  if (has_radar) scene.fit.free.push_back(tests::free_entry("sheet.main.energy_flux_mw_m2"));
  if (modes > 0) {
    scene.emission.modes.assign(modes, 0.0);
    scene.fit.free.push_back(tests::free_entry("emission.modes"));
    scene.fit.free.back().prior = sim::Prior{0.0, 1.0};
  }
  sim::validate(scene);
  return fit_photo(scene, photo, {});
}

const FittedParameter& parameter_of(const FitResult& result, const std::string& key) {
  for (const FittedParameter& p : result.parameters)
    if (p.path == "sheet.main." + key) return p;
  throw std::out_of_range(key);
}

const DerivedNumber& derived_of(const FitResult& result, const std::string& beginning) {
  for (const DerivedNumber& d : result.derived)
    if (d.name.find(beginning) == 0) return d;
  throw std::out_of_range(beginning);
}

const std::pair<const char*, double> kKnown[] = {
    {"center_km.north", 190.0}, {"energy_kev", 4.0}, {"energy_flux_mw_m2", 8.0}};

void expect_truth(const FitResult& result) {
  for (const auto& [key, value] : kKnown) {
    const FittedParameter& p = parameter_of(result, key);
    ASSERT_TRUE(p.sigma) << key << ": " << p.why_no_sigma;
    EXPECT_NEAR(p.value, value, 3.0 * *p.sigma) << key;
  }
  for (const FittedRadar& radar : result.radars) EXPECT_FALSE(contradicts(radar)) << radar.name;
}

TEST(RadarFit, FindsTheArcAndItsElectrons) {
  const tests::TemporaryFolder folder;
  sim::Scene truth = arc();
  add_beams(folder, {187.0}, 7, truth);
  const FitResult result = refitted(truth, tests::noisy_photo(truth, 0.004, 3), true);
  expect_truth(result);
  ASSERT_EQ(result.radars.size(), 1u);
  EXPECT_EQ(result.radars[0].values, 16);
  EXPECT_EQ(result.statistics.back().name, "radar beam 1");
  // What physics leaves open of the picture would be 1 keV: the energy itself is nearer.
  EXPECT_NEAR(parameter_of(result, "energy_kev").value, 4.0, 0.1);
}

/// Three beams across the arc say where it is and which electrons fall, the picture how high its light then
/// is. Measured: distance 3.2 to 0.52 km, peak 1.46 to 0.28 km, E0 0.97 to 0.15 keV. One beam makes E0 3.4
/// times better known, height and distance 1.8 times.
TEST(RadarFit, MakesHeightAndDistanceThreeTimesBetterKnown) {
  const tests::TemporaryFolder folder;
  sim::Scene truth = green_arc();
  add_beams(folder, {186.0, 190.0, 194.0}, 7, truth);
  const Photo photo = tests::noisy_photo(truth, 0.02, 3);
  const FitResult alone = refitted(truth, photo, false, kModes), joint = refitted(truth, photo, true, kModes);
  expect_truth(joint);
  ASSERT_EQ(joint.radars.size(), 3u);
  for (const auto& [name, value] : {std::pair<const char*, double>{"distance of the main sheet", 187.91},
                                    {"peak altitude of 557.7 nm", 105.31}}) {
    const DerivedNumber &before = derived_of(alone, name), &after = derived_of(joint, name);
    ASSERT_TRUE(before.sigma && after.sigma) << name;
    EXPECT_LT(3.0 * *after.sigma, *before.sigma) << name;
    EXPECT_NEAR(after.value, value, 3.0 * *after.sigma) << name;
  }
}

/// Densities that no electrons of the scene make.
TEST(RadarFit, DoubtsWhatIsNotExplained) {
  const tests::TemporaryFolder folder;
  sim::Scene truth = arc();
  add_beams(folder, {190.0}, 7, truth);
  std::string text = "altitude_km,density_cm3,density_cm3_error\n";
  for (int altitude = 90; altitude <= 150; altitude += 4)
    text += fmt::format("{},{},1e3\n", altitude, altitude % 8 == 0 ? 1e5 : 4e5);
  tests::put(folder / "density1.csv", text);
  const FitResult result = refitted(truth, tests::noisy_photo(truth, 0.004, 3), true);
  EXPECT_EQ(result.verdict, Verdict::doubtful) << result.verdict_line;
  EXPECT_TRUE(tests::has_facts(result.verdict_line, "radar beam 1"));
}

}  // namespace
}  // namespace vegard::fit::radar_fit_test
