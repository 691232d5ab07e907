// Rows of radars: against the whole covariance, their derivatives against differences, and what is refused.
#include "fit/compare/radars.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <fstream>
#include <string>

#include "sim/emit/aurora/foot_line.h"
#include "sim/light/tables/emission_tables.h"
#include "sim/scene/table/parameter_id.h"
#include "tests/support/expect_error.h"
#include "tests/support/small_scene.h"
#include "tests/support/temporary_folder.h"

namespace vegard::fit::radars_test {
namespace {

using sim::ErrorKind;

constexpr double kEastKm = 20.0, kNorthKm = 190.0;  // over the arc of arc_scene()

/// A foot's latitude and longitude, of a scene's site.
void look_at(const sim::Scene& scene, double east_km, double north_km, sim::RadarEntry& entry) {
  const sim::PlaceOnEarth place = sim::place_of_foot(scene, {east_km, north_km});
  entry.latitude_deg = place.latitude_deg;
  entry.longitude_deg = place.longitude_deg;
}

sim::Scene arc_scene(const tests::TemporaryFolder& folder) {
  sim::Scene scene = tests::small_scene();
  scene.file = folder / "scene.toml";
  scene.site.latitude_deg = 66.0;
  scene.site.longitude_deg = 20.0;
  scene.sheets[0].width_km = 5.0;
  scene.sheets[0].energy_kev = 4.0;
  scene.emission.tables = "vegard";
  sim::RadarEntry entry;
  entry.name = "radar";
  entry.file = "density.csv";
  look_at(scene, kEastKm, kNorthKm, entry);
  scene.fit.radars = {entry};
  return scene;
}

/// Densities of `density` m^-3 by altitude with 10 % of error.
void write_densities(const tests::TemporaryFolder& folder, const std::string& extra_columns = "",
                     const std::string& extra = "") {
  std::ofstream file(folder / "density.csv");
  file << "altitude_km,density_m3,density_m3_error" << extra_columns << "\n";
  for (int altitude = 90; altitude <= 150; altitude += 5) {
    const double density = 4e11 * std::exp(-std::pow((altitude - 110.0) / 20.0, 2));
    file << altitude << "," << density << "," << 0.1 * density + 1e9 << extra << "\n";
  }
}

struct Rows {
  std::vector<double> residuals, jacobian;
};
Rows rows_of(const Radars& radars, const sim::Scene& scene, const std::vector<sim::ParameterId>& ids) {
  Rows rows;
  ParameterMap::Motion motion;
  motion.numbers = ids;
  motion.moved = ids.size();
  radars.evaluate(scene, &motion, rows.residuals, &rows.jacobian);
  return rows;
}

TEST(Radars, HaveExactDerivatives) {
  const tests::TemporaryFolder folder;
  write_densities(folder);
  for (const bool is_beam : {false, true}) {
    sim::Scene scene = arc_scene(folder);
    sim::RadarEntry& entry = scene.fit.radars[0];
    entry.scale_sigma = 0.3;
    if (is_beam) {
      // A slanting beam from the south crosses the sheet at 110 km.
      entry.latitude_deg.reset();
      entry.longitude_deg.reset();
      entry.azimuth_deg = 5.0;
      entry.elevation_deg = 29.0;
      entry.seconds = 60.0;
    }
    const Radars radars(scene);
    std::vector<std::string> paths = {"sheet.main.center_km.north", "sheet.main.center_km.east",
                                      "sheet.main.bearing_deg",     "sheet.main.width_km",
                                      "sheet.main.thickness_km",    "sheet.main.phase_rad",
                                      "sheet.main.energy_kev",      "sheet.main.energy_flux_mw_m2"};
    if (is_beam) paths.push_back("field.inclination_deg"), paths.push_back("field.declination_deg");
    std::vector<sim::ParameterId> ids;
    for (const std::string& path : paths) ids.push_back(*sim::parameter_at(scene, path));
    const Rows rows = rows_of(radars, scene, ids);
    ASSERT_EQ(static_cast<int>(rows.residuals.size()), radars.rows());
    EXPECT_GT(radars.rows(), radars.values()) << "a scale and physics";
    for (std::size_t k = 0; k < ids.size(); ++k) {
      double& number = *sim::number_at(scene, ids[k]);
      const double was = number, step = 1e-4 * std::max(1.0, std::abs(was));
      std::vector<double> low, high;
      number = was - step;
      radars.evaluate(scene, nullptr, low, nullptr);
      number = was + step;
      radars.evaluate(scene, nullptr, high, nullptr);
      number = was;
      double largest = 0.0;
      for (std::size_t r = 0; r < low.size(); ++r)
        largest = std::max(largest, std::abs(high[r] - low[r]) / (2.0 * step));
      EXPECT_GT(largest, 1e-4) << paths[k];
      for (std::size_t r = 0; r < low.size(); ++r)
        EXPECT_NEAR(rows.jacobian[r * ids.size() + k], (high[r] - low[r]) / (2.0 * step), 2e-3 * largest)
            << paths[k] << " row " << r;
    }
  }
}

/// The sum of squares is that of the densities with noise, physics and scale in one covariance.
TEST(Radars, SquaresAreThoseOfTheWholeCovariance) {
  const tests::TemporaryFolder folder;
  write_densities(folder);
  sim::Scene scene = arc_scene(folder);
  scene.fit.radars[0].scale_sigma = 0.2;
  const Radars radars(scene);
  std::vector<double> rows;
  radars.evaluate(scene, nullptr, rows, nullptr);
  double chi2 = 0.0;
  for (const double row : rows) chi2 += row * row;
  const FittedRadar fitted = radars.fitted(scene)[0];
  const auto count = static_cast<Eigen::Index>(fitted.altitude_km.size());
  const Eigen::MatrixXd modes =
      RadarDensity(sim::emission_tables(scene), fitted.altitude_km, {})
          .physics_modes({}, fitted.energy_kev, fitted.energy_flux_mw_m2, scene.seed);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(count, count);
  Eigen::VectorXd off(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto a = static_cast<std::size_t>(i);
    off[i] = fitted.density_cm3[a] - fitted.electrons_cm3[a];
    covariance(i, i) = fitted.sigma_cm3[a] * fitted.sigma_cm3[a];
  }
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index k = 0; k < count; ++k)
      covariance(i, k) += fitted.electrons_cm3[static_cast<std::size_t>(i)] *
                          fitted.electrons_cm3[static_cast<std::size_t>(k)] *
                          (modes.row(i).dot(modes.row(k)) + 0.2 * 0.2);
  EXPECT_NEAR(chi2, off.dot(covariance.ldlt().solve(off)), 1e-6 * chi2);
  EXPECT_NEAR(fitted.chi2, chi2, 1e-9 * chi2);
  ASSERT_TRUE(fitted.scale_sigma);
  EXPECT_GT(*fitted.scale_sigma, 0.0);
  EXPECT_LT(*fitted.scale_sigma, 0.2);
  EXPECT_EQ(fitted.values, 13);
}

TEST(Radars, PlacesOfTheFileAndTheBeamSeeTheSameFieldLine) {
  const tests::TemporaryFolder folder;
  sim::Scene scene = arc_scene(folder);
  const sim::RadarEntry foot = scene.fit.radars[0];
  // A vertical field: the field line is over its foot.
  scene.field.inclination_deg = 90.0;
  write_densities(folder, ",latitude_deg,longitude_deg",
                  "," + std::to_string(*foot.latitude_deg) + "," + std::to_string(*foot.longitude_deg));
  std::vector<double> of_foot, of_file;
  Radars(scene).evaluate(scene, nullptr, of_foot, nullptr);
  scene.fit.radars[0].latitude_deg.reset();
  scene.fit.radars[0].longitude_deg.reset();
  const Radars radars(scene);
  radars.evaluate(scene, nullptr, of_file, nullptr);
  ASSERT_EQ(of_foot.size(), of_file.size());
  // A field that is vertical at the site leans against the vertical of a foot 190 km away by 1.7 degrees.
  const FittedRadar fitted = radars.fitted(scene)[0];
  EXPECT_NEAR(fitted.foot_latitude_deg, *foot.latitude_deg, 0.02);
  EXPECT_NEAR(fitted.energy_kev, 4.0, 1e-9);
  for (const bool is_held : {true, false}) {
    scene.fit.radars[0].scale_sigma = is_held ? std::optional<double>() : 0.1;
    EXPECT_EQ(Radars(scene).fitted(scene)[0].scale_sigma.has_value(), !is_held);
  }
}

TEST(Radars, RefuseWhatCannotBeCompared) {
  const tests::TemporaryFolder folder;
  write_densities(folder);
  const sim::Scene good = arc_scene(folder);
  const auto refused = [&](ErrorKind kind, const std::vector<std::string>& words, const auto& change) {
    sim::Scene scene = good;
    change(scene);
    tests::expect_words(kind, words, [&] { Radars{scene}; });
  };
  refused(ErrorKind::scene, {"radar 'radar'", "km away", "fit.radar"},
          [](sim::Scene& scene) { look_at(scene, kEastKm, kNorthKm + 60.0, scene.fit.radars[0]); });
  refused(ErrorKind::scene, {"where the radar looks", "latitude_deg", "azimuth_deg"}, [](sim::Scene& scene) {
    scene.fit.radars[0].latitude_deg.reset();
    scene.fit.radars[0].longitude_deg.reset();
  });
  refused(ErrorKind::scene, {"site.longitude_deg", "radar 'radar'"},
          [](sim::Scene& scene) { scene.site.longitude_deg = sim::Site{}.longitude_deg; });
  refused(ErrorKind::scene, {"sheet.main.profile", "electrons"},
          [](sim::Scene& scene) { scene.sheets[0].profile = sim::ProfileKind::form; });
  refused(ErrorKind::scene, {"brightness_kilorayleigh", "energy_flux_mw_m2"},
          [](sim::Scene& scene) { scene.sheets[0].brightness_kilorayleigh = 10.0; });
  refused(ErrorKind::scene, {"folds", "fold_spacing_km"},
          [](sim::Scene& scene) { scene.sheets[0].fold_spacing_km = 30.0; });
  refused(ErrorKind::scene, {"[[sheet]]"}, [](sim::Scene& scene) { scene.sheets.clear(); });
  refused(ErrorKind::unreadable_input, {"none.csv"},
          [](sim::Scene& scene) { scene.fit.radars[0].file = "none.csv"; });
  std::ofstream(folder / "bare.csv") << "altitude_km,density_m3\n90,1e11\n";
  refused(ErrorKind::unreadable_input, {"bare.csv", "errors", "density_m3_error"},
          [](sim::Scene& scene) { scene.fit.radars[0].file = "bare.csv"; });
  std::ofstream(folder / "words.csv") << "height,ne,dne\n90,1e11,1e9\n";
  refused(ErrorKind::unreadable_input, {"words.csv", "density_m3"},
          [](sim::Scene& scene) { scene.fit.radars[0].file = "words.csv"; });
  {
    std::ofstream file(folder / "times.csv");
    file << "time_s,altitude_km,density_m3,density_m3_error\n";
    for (const int time : {0, 60, 120})
      for (int altitude = 90; altitude < 120; altitude += 5)
        file << time << "," << altitude << ",1e11,1e10\n";
  }
  refused(ErrorKind::scene, {"time_s", "3 profiles", "0 to 120"},
          [](sim::Scene& scene) { scene.fit.radars[0].file = "times.csv"; });
  refused(ErrorKind::scene, {"time_s", "900", "120"}, [](sim::Scene& scene) {
    scene.fit.radars[0].file = "times.csv";
    scene.fit.radars[0].time_s = 900.0;
  });
  sim::Scene timed = good;
  timed.fit.radars[0].file = "times.csv";
  timed.fit.radars[0].time_s = 50.0;
  EXPECT_EQ(Radars(timed).fitted(timed)[0].time_s, 60.0);
}

}  // namespace
}  // namespace vegard::fit::radars_test
