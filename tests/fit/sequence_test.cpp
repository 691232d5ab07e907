// A sequence: three frames of a sheet whose electrons grow harder.
#include "fit/sequence.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fit/report/table/sequence_files.h"
#include "tests/support/expect_error.h"
#include "tests/support/two_stations.h"

namespace vegard::fit::sequence_test {
namespace {

constexpr double kEnergies[] = {3.0, 3.6, 4.3};

sim::Scene sequence_scene() {
  sim::Scene scene = tests::two_stations();
  scene.fit.photos.clear();
  scene.camera.width = 96;
  scene.camera.height = 72;
  scene.sheets[0].profile = sim::ProfileKind::maxwellian;
  scene.sheets[0].layers = 1;
  scene.sheets[0].beams = 4000;
  scene.fit.bands = 6;
  scene.sensor.calibration_error = 0.05;
  return scene;
}

/// Seed 21: noise, and beams in other random places than the model's.
Photo frame(int i) {
  sim::Scene truth = sequence_scene();
  truth.sheets[0].energy_kev = kEnergies[i];
  truth.sheets[0].energy_flux_mw_m2 = 5.0 + i;
  Photo photo = tests::photo_of(truth, 0.002, 21 + static_cast<std::uint64_t>(i));
  photo.decoding = "linear, told so";
  photo.sha256 = std::string(64, static_cast<char>('a' + i));
  return photo;
}

const SequenceNumber& number(const SequenceRow& row, const std::string& name) {
  for (const SequenceNumber& n : row.numbers)
    if (n.name == name) return n;
  throw std::runtime_error(name);
}

TEST(Sequence, FollowsTheEnergyFromFrameToFrame) {
  sim::Scene start = sequence_scene();
  start.seed += 1;
  start.sheets[0].beams = 800;
  start.sheets[0].energy_kev = 2.6;
  start.fit.overall_trials = 8;
  start.fit.scan_points = 4;
  start.fit.scan_descents = 1;
  start.fit.polish_descents = 1;
  for (const char* path : {"sheet.main.energy_kev", "sheet.main.center_km.north"}) {
    sim::FreeParameter free;
    free.path = path;
    start.fit.free.push_back(free);
  }
  std::vector<SequenceRow> rows;
  std::vector<int> evaluations;
  for (int i = 0; i < 3; ++i) {
    const Photo photo = frame(i);
    const FrameFit fit = fit_frame(start, photo, 10.0 * i, rows.empty() ? nullptr : &rows.back(), {});
    EXPECT_EQ(fit.result.photos[0].best.time.start_s, 10.0 * i);
    rows.push_back(sequence_row("frame_" + std::to_string(i), 10.0 * i, start, fit, photo));
    evaluations.push_back(fit.result.evaluations);
  }
  for (int i = 0; i < 3; ++i) {
    SCOPED_TRACE(i);
    ASSERT_EQ(rows[i].verdict, Verdict::good);
    EXPECT_EQ(rows[i].searched, i == 0) << "a descent is enough where the frame before has an answer";
    const SequenceNumber& energy = number(rows[i], "sheet.main.energy_kev");
    ASSERT_TRUE(energy.sigma);
    EXPECT_LT(std::abs(energy.value - kEnergies[i]), 3.0 * *energy.sigma);
    // The gain is known to 5 %: so is Q, better than that here, since the truth has the nominal gain.
    const SequenceNumber& flux = number(rows[i], "sheet.main.energy_flux_mw_m2");
    ASSERT_TRUE(flux.sigma);
    EXPECT_GT(*flux.sigma, 0.05 * flux.value);
    EXPECT_LT(std::abs(flux.value - (5.0 + i)), *flux.sigma);
  }
  EXPECT_LT(evaluations[1], evaluations[0]);

  const std::string csv = sequence_csv(rows);
  EXPECT_NE(csv.find("frame,time_s,verdict,search,chi2_per_dof,sheet.main.energy_kev (keV),"
                     "sigma of sheet.main.energy_kev (keV)"),
            std::string::npos);
  EXPECT_NE(csv.find("\nframe_1,10,good,warm,"), std::string::npos);
  EXPECT_NE(csv.find("\n# decoding: linear, told so\n"), std::string::npos);
  EXPECT_EQ(sequence_plot(rows).panels.size(), 4u) << "E0, Q, distance, lower border";

  // A row goes on as exactly what it was.
  const SequenceRow again = sequence_row_of(sequence_row_json(rows[1]), "row.json");
  EXPECT_EQ(again.values, rows[1].values);
  EXPECT_EQ(again.decoding, rows[1].decoding);
  EXPECT_EQ(sequence_row_json(again), sequence_row_json(rows[1]));
  EXPECT_EQ(sequence_csv({rows[0], again, rows[2]}), csv);
}

TEST(Sequence, FluxIsUnknownWithoutAScale) {
  sim::Scene scene = sequence_scene();
  FrameFit fit;
  fit.result.photos.resize(1);
  fit.result.photos[0].best = scene;
  fit.result.photos[0].solved = {{"gain", 0.06, 0.003}};
  EXPECT_EQ(sequence_row("a", 0.0, scene, fit, {}).numbers.size(), 1u);
  scene.sensor.calibration_error = 0.0;
  EXPECT_TRUE(sequence_row("a", 0.0, scene, fit, {}).numbers.empty());
}

TEST(Sequence, ABrokenRowIsNamed) {
  const std::string text = tests::expect_error(sim::ErrorKind::unreadable_input,
                                               [] { sequence_row_of("{\"frame\": 3", "a.json"); });
  EXPECT_NE(text.find("a.json"), std::string::npos);
}

}  // namespace
}  // namespace vegard::fit::sequence_test
