// Curtains refined by beams: which curves stay, go and come. A made picture of two curves, seed 11.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "fit/fit.h"
#include "fit/report/table/curtain_steps_table.h"
#include "sim/emit/aurora/sheet_curve.h"
#include "sim/scene/file/scene_toml.h"
#include "tests/support/two_stations.h"

namespace vegard::fit::curtain_fit_test {
namespace {

const char* const kCamera =
    "[site]\nlatitude_deg = 67.0\n[field]\ninclination_deg = 78.0\n[camera]\nwidth = 72\nheight = 54\n"
    "hfov_deg = 62\nelevation_deg = 33\n[sensor]\ngain_per_kilorayleigh = 0.01\n"
    "[sky]\nlevel = [0.003, 0.006, 0.008]\n[fit]\nbands = 12\n";

/// The near curve is the brighter one.
sim::Scene two_curves() {
  return sim::parse_scene(std::string(kCamera) +
                              "[[sheet]]\nname = \"near\"\ncourse = \"curve\"\nlayers = 1\nwidth_km = 2\n"
                              "beams_per_km = 12\nenergy_flux_mw_m2 = 13\nenergy_kev = 4\n"
                              "east_km = [-80, -30, 25, 80]\nnorth_km = [180, 168, 190, 178]\n"
                              "[[sheet]]\nname = \"far\"\ncourse = \"curve\"\nlayers = 1\nwidth_km = 2\n"
                              "beams_per_km = 12\nenergy_flux_mw_m2 = 6.5\nenergy_kev = 3\n"
                              "east_km = [-110, -20, 60, 120]\nnorth_km = [275, 290, 272, 280]\n",
                          "scene");
}

const Photo& photo() {
  static const Photo made = tests::photo_of(two_curves(), 0.002, 11);
  return made;
}

/// What a map might say of a curve: beside it by some km, with other energy and light.
Ridge ridge_of(const sim::Sheet& sheet, const std::string& name, double off_km, double flux,
               double energy_kev) {
  Ridge ridge;
  ridge.name = name;
  for (const sim::EastNorth& foot :
       sim::curve_feet(sheet, 0.0, static_cast<int>(sim::curve_layout(sheet).length_km / 5.0) + 1))
    ridge.points.push_back({{foot.east, foot.north + off_km}, flux, energy_kev, 2.5});
  return ridge;
}

Ridge near_ridge() { return ridge_of(two_curves().sheets[0], "curtain_1", 3.0, 9.0, 3.6); }
Ridge far_ridge(const std::string& name) { return ridge_of(two_curves().sheets[1], name, -4.0, 4.0, 3.4); }
/// Where nothing is.
Ridge ghost(const std::string& name) {
  Ridge ridge = ridge_of(two_curves().sheets[0], name, 48.0, 0.8, 3.0);
  return ridge;
}

FitOptions options(int threads = 2) {
  FitOptions options;
  options.threads = threads;
  return options;
}

/// Mean distance of the curve from a true one, across, where both are in view.
double apart_km(const sim::Sheet& sheet, const sim::Sheet& truth) {
  double sum = 0.0, count = 0.0;
  const std::vector<sim::EastNorth> feet = sim::curve_feet(truth, 0.0, 2000);
  for (const sim::EastNorth& foot : sim::curve_feet(sheet, 0.0, 60)) {
    double nearest = 1e9;
    for (const sim::EastNorth& other : feet)
      nearest = std::min(nearest, std::hypot(foot.east - other.east, foot.north - other.north));
    sum += nearest;
    count += 1.0;
  }
  return sum / count;
}

TEST(CurtainFit, DropsACurveThatIsNotThereAndAddsOneThatIs) {
  const FitResult result =
      fit_curtains(sim::parse_scene(kCamera, "scene"), {photo()}, {near_ridge(), ghost("curtain_2")},
                   {far_ridge("faint_1")}, options());
  for (const CurtainStep& step : result.curtain_steps)
    std::printf("%s\n", curtain_step_in_words(step).c_str());
  ASSERT_EQ(result.best.sheets.size(), 2u);
  EXPECT_EQ(result.best.sheets[0].name, "curtain_1");
  EXPECT_EQ(result.best.sheets[1].name, "faint_1");
  // The far curve is missing at first, and the ghost stands in for it until it is there.
  const CurtainStep* last_kept = nullptr;
  bool dropped = false, added = false;
  for (const CurtainStep& step : result.curtain_steps) {
    if (!step.kept) continue;
    last_kept = &step;
    if (step.change == CurtainStep::Change::start) continue;
    EXPECT_GT(step.bic_lower_by, 10.0) << curtain_step_in_words(step);
    dropped = dropped || (step.change == CurtainStep::Change::drop && step.curtain == "curtain_2");
    added = added || (step.change == CurtainStep::Change::add && step.curtain == "faint_1");
  }
  ASSERT_NE(last_kept, nullptr);
  EXPECT_TRUE(dropped && added);
  EXPECT_EQ(last_kept->curtains, 2);
  EXPECT_LT(last_kept->chi2, result.curtain_steps[0].chi2);
  EXPECT_LT(apart_km(result.best.sheets[0], two_curves().sheets[0]), 1.5);
  EXPECT_LT(apart_km(result.best.sheets[1], two_curves().sheets[1]), 6.0);
  EXPECT_NEAR(result.chi2, last_kept->chi2, 1e-6 * last_kept->chi2);
  EXPECT_LT(result.chi2, result.chi2_initial);
}

TEST(CurtainFit, KeepsWhatIsThereAndAddsNothing) {
  const FitResult result =
      fit_curtains(sim::parse_scene(kCamera, "scene"), {photo()}, {near_ridge(), far_ridge("curtain_2")},
                   {ghost("faint_1")}, options());
  for (const CurtainStep& step : result.curtain_steps)
    std::printf("%s\n", curtain_step_in_words(step).c_str());
  ASSERT_EQ(result.best.sheets.size(), 2u);
  EXPECT_EQ(result.best.sheets[1].name, "curtain_2");
  for (const CurtainStep& step : result.curtain_steps)
    EXPECT_EQ(step.kept, step.change == CurtainStep::Change::start) << curtain_step_in_words(step);
  // The energies are the truth's, and the errors know how far they are not.
  int within = 0, energies = 0;
  for (const FittedParameter& p : result.parameters) {
    const std::string of_near = "sheet.curtain_1.point_energy_kev.";
    if (p.path.compare(0, of_near.size(), of_near) != 0) continue;
    EXPECT_NEAR(std::log(p.value / 4.0), 0.0, 0.2) << p.path;
    ++energies;
    if (p.sigma && std::abs(p.value - 4.0) < 3.0 * *p.sigma) ++within;
  }
  EXPECT_GE(energies, 3);
  EXPECT_GE(within, energies - 1);
}

TEST(CurtainFit, IsTheSameForAnyNumberOfThreads) {
  FitOptions some = options(1), more = options(3);
  some.max_evaluations = more.max_evaluations = 3;
  const FitResult a = fit_curtains(sim::parse_scene(kCamera, "scene"), {photo()}, {near_ridge()}, {}, some);
  const FitResult b = fit_curtains(sim::parse_scene(kCamera, "scene"), {photo()}, {near_ridge()}, {}, more);
  ASSERT_EQ(a.parameters.size(), b.parameters.size());
  for (std::size_t j = 0; j < a.parameters.size(); ++j)
    EXPECT_EQ(a.parameters[j].value, b.parameters[j].value);
  EXPECT_EQ(a.chi2, b.chi2);
}

}  // namespace
}  // namespace vegard::fit::curtain_fit_test
