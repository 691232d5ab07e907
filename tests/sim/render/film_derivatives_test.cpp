// The film's derivatives against central differences of the reference in double, for every number that can
// be free.
//
// Light that crosses the film's border has no derivative, so the border is left out. The bilinear splat has
// kinks: a sample's derivative jumps where it crosses from one cell to the next, and floats cross elsewhere
// than doubles. Sums over blocks of columns and a blur down the rows, which the fit takes too, even that out:
// the difference's norm is below 1.5 or 3 % of the derivative's (measured: below 0.1 % for most; over eight
// seeds 0.2 to 1.0 % for the pitch step and, by the literal rule, 0.9 to 2.4 % for the length, where large
// contributions cancel).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "sim/render/beam_exposer.h"
#include "sim/render/film.h"
#include "sim/scene/table/parameter_id.h"
#include "sim/view/film/blur.h"
#include "tests/support/exposed.h"
#include "tests/support/free_paths.h"
#include "tests/support/kind_named.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::film_derivatives_test {
namespace {

constexpr int kColumns = 10, kBorder = 10;

/// Sums over kColumns columns, blurred down with a sigma of 2 rows; `at` gives a film cell's number.
template <class At>
std::vector<double> smoothed(const FilmGeometry& film, int lines, const At& at) {
  const BlurKernel kernel = gaussian_kernel(2.0);
  std::vector<double> result;
  for (int l = 0; l < lines; ++l)
    for (int first = kBorder; first + kColumns + kBorder <= film.columns; first += kColumns) {
      std::vector<double> sum(film.rows, 0.0);
      for (int r = 0; r < film.rows; ++r)
        for (int c = first; c < first + kColumns; ++c) sum[r] += at(l, r, c);
      for (int r = kBorder; r + kBorder < film.rows; ++r) {
        double blurred = 0.0;
        for (int k = -kernel.radius(); k <= kernel.radius(); ++k)
          blurred += kernel.weights[std::abs(k)] * sum[r + k];
        result.push_back(blurred);
      }
    }
  return result;
}

/// By every number that may be free, but those of the table `without`, which the scene does not depend on.
void expect_derivatives(const Scene& scene, double tolerance, const std::string& without = "") {
  const FilmGeometry film = film_for(scene, 0, 0, scene.camera.width, scene.camera.height, 1.0, 1.0);
  BeamExposer exposer(scene, film, 0, 0.5);
  std::vector<tests::FreePath> paths = tests::free_paths(scene);
  paths.erase(std::remove_if(paths.begin(), paths.end(),
                             [&](const tests::FreePath& p) { return p.path.row->table == without; }),
              paths.end());
  ASSERT_GT(paths.size(), 16u) << "more than one pass of the kernel";
  Exposure exposure;
  exposer.expose_with_derivatives(scene, tests::ids_of(paths), exposure);
  const int lines = exposure.lines;
  const std::size_t cells = exposure.cells();
  const auto cell = [&](int l, int r, int c) {
    return l * cells + static_cast<std::size_t>(r) * film.columns + c;
  };
  for (std::size_t j = 0; j < paths.size(); ++j) {
    SCOPED_TRACE(paths[j].path.text);
    Scene more = scene, less = scene;
    *real_value(more, paths[j].path) += paths[j].step;
    *real_value(less, paths[j].path) -= paths[j].step;
    std::vector<double> up, down;
    exposer.expose_reference(more, up);
    exposer.expose_reference(less, down);
    const auto exact = smoothed(film, lines, [&](int l, int r, int c) {
      return static_cast<double>(exposure.derivative[cell(l, r, c) * exposure.free_stride + j]);
    });
    const auto differences = smoothed(film, lines, [&](int l, int r, int c) {
      return (up[cell(l, r, c)] - down[cell(l, r, c)]) / (2.0 * paths[j].step);
    });
    double error = 0.0, size = 0.0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      error += std::pow(exact[i] - differences[i], 2);
      size += std::pow(differences[i], 2);
    }
    if (paths[j].path.row->table == "blur") {
      EXPECT_EQ(error + size, 0.0) << "the film is not blurred yet";
    } else {
      EXPECT_GT(size, 0.0);
      EXPECT_LT(std::sqrt(error / size), tolerance);
    }
  }
}

Scene scene_that_needs_all() {
  Scene scene = tests::small_scene();
  scene.sheets[0].arcs = 2;
  scene.sheets[0].arc_spacing_km = 14.0;
  // An end inside the picture, so that the length counts.
  scene.sheets[0].center_km.east = 130.0;
  scene.sheets[0].length_km = 250.0;
  // Folds, so that their stage counts.
  scene.sheets[0].fold_spacing_km = 25.0;
  scene.sheets[0].fold_length_km = 15.0;
  return scene;
}

TEST(FilmDerivatives, EveryFreeNumberAgreesWithDifferences) {
  Scene scene = scene_that_needs_all();
  scene.sheets[0].beams = 800;  // what differences make of the film's kinks falls with their number
  expect_derivatives(scene, 0.01);
}

/// A lens of every kind that differs in what its numbers do.
class FilmDerivativesThrough : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Lens, FilmDerivativesThrough, testing::Values("pinhole", "equisolid", "polynomial"));

TEST_P(FilmDerivativesThrough, AgreeWithDifferences) {
  Scene scene = scene_that_needs_all();
  scene.camera.model = tests::kind_named<LensModel>(GetParam());
  scene.camera.focal_px = 130.0;
  scene.camera.principal_x_px = -6.0;
  scene.camera.aspect = 1.05;
  scene.camera.mirrored = true;
  if (scene.camera.model != LensModel::equisolid) {
    scene.camera.k1 = -0.06;
    scene.camera.k2 = 0.01;
  }
  scene.camera.p1 = 0.003;
  expect_derivatives(scene, 0.01);
}

TEST(FilmDerivatives, OfASheetFullOfStructureAgreeWithDifferences) {
  Scene scene = tests::small_scene();
  scene.time.start_s = 1.3;
  Sheet& sheet = scene.sheets[0];
  sheet.arcs = 2;
  sheet.beams = 200;
  sheet.arc_spacing_km = 14.0;
  sheet.center_km.east = 130.0;
  sheet.length_km = 250.0;
  sheet.drift_km_s = {0.4, 0.1};
  sheet.fold_spacing_km = 25.0;
  sheet.fold_length_km = 15.0;
  sheet.fold_stage = 0.8;
  sheet.fold_speed_km_s = 2.0;
  sheet.fold_lifetime_s = 3.0;
  sheet.curl_spacing_km = 8.0;
  sheet.curl_radius_km = 1.5;
  sheet.curl_turn_rad = 1.5;
  sheet.curl_lifetime_s = 0.5;
  sheet.ray_contrast = 0.5;
  sheet.ray_width_km = 3.0;
  sheet.ray_length_contrast = 0.4;
  sheet.patch_size_km = 30.0;
  sheet.patch_contrast = 0.4;
  sheet.border_amplitude_km = 4.0;
  expect_derivatives(scene, 0.02);
}

TEST(FilmDerivatives, AFormOfGivenBrightnessAgreesWithDifferences) {
  Scene scene = tests::small_scene();
  scene.sheets[0].center_km.east = 130.0;
  scene.sheets[0].length_km = 250.0;
  scene.sheets[0].arcs = 2;
  scene.sheets[0].profile = ProfileKind::form;
  scene.sheets[0].upper_km = 60.0;
  scene.sheets[0].brightness_kilorayleigh = 10.0;
  scene.sheets[0].step_rule = PathStepRule::energy;
  scene.sheets[0].fold_spacing_km = 25.0;
  scene.sheets[0].fold_length_km = 15.0;
  scene.sheets[0].energy_kev = 4.0;
  expect_derivatives(scene, 0.01);
}

// 0.013 for the pitch step, whose differences are those of single samples that cross cells; what moves feet
// agrees to 0.01.
TEST(FilmDerivatives, OfSpiralsUnderTheReferenceFieldAgreeWithDifferences) {
  Scene scene = tests::small_scene();
  scene.field.model = FieldModel::igrf;
  scene.site.time_utc = "2012-03-04T00:00:00Z";
  scene.sheets[0].center_km.east = 130.0;
  scene.sheets[0].length_km = 250.0;
  scene.sheets[0].arcs = 2;
  scene.sheets[0].fold_spacing_km = 25.0;
  scene.sheets[0].fold_length_km = 15.0;
  scene.sheets[0].spiral_spacing_km = 80.0;
  scene.sheets[0].spiral_radius_km = 12.0;
  scene.sheets[0].spiral_turn_rad = 3.0;
  expect_derivatives(scene, 0.02, "field");
}

TEST(FilmDerivatives, UnderADipoleAgreeWithDifferences) {
  Scene scene = tests::small_scene();
  scene.field.model = FieldModel::dipole;
  scene.sheets[0].arcs = 2;
  scene.sheets[0].center_km.east = 130.0;
  scene.sheets[0].length_km = 250.0;
  scene.sheets[0].fold_spacing_km = 25.0;
  scene.sheets[0].fold_length_km = 15.0;
  expect_derivatives(scene, 0.01, "field");
  // What belongs to the beams alone goes through a kernel of its own.
  const std::vector<ParameterId> free = {parameter_with(ParameterRole::centre, 0, 1),
                                         parameter_with(ParameterRole::bearing, 0)};
  const FilmGeometry film = tests::whole_picture(scene);
  Exposure alone, among_all;
  BeamExposer exposer(scene, film, 1);
  exposer.expose_with_derivatives(scene, free, alone);
  exposer.expose_with_derivatives(scene, {free[0], free[1], parameter_with(ParameterRole::camera_roll)},
                                  among_all);
  double difference = 0.0, size = 0.0;
  for (std::size_t i = 0; i < alone.cells() * alone.lines; ++i)
    for (int k = 0; k < 2; ++k) {
      const double a = alone.derivative[i * alone.free_stride + k];
      const double b = among_all.derivative[i * among_all.free_stride + k];
      difference += (a - b) * (a - b);
      size += b * b;
    }
  EXPECT_GT(size, 0.0);
  EXPECT_LT(std::sqrt(difference / size), 1e-5) << "floats";
}

TEST(FilmDerivatives, OfACurveAgreeWithDifferences) {
  for (const bool varied : {false, true}) {
    Scene scene = tests::small_scene();
    scene.time.start_s = 1.3;
    Sheet& sheet = scene.sheets[0];
    sheet.beams = 100;
    sheet.course = SheetCourse::curve;
    // Its ends are in the picture.
    sheet.east_km = {-60.0, -40.0, 10.0, 30.0, 80.0};
    sheet.north_km = {170.0, 200.0, 190.0, 160.0, 180.0};
    sheet.drift_km_s = {0.4, 0.1};
    sheet.ray_contrast = 0.5;
    sheet.ray_width_km = 3.0;
    sheet.ray_length_contrast = 0.4;
    sheet.patch_size_km = 30.0;
    sheet.patch_contrast = 0.4;
    sheet.border_amplitude_km = 4.0;
    if (varied) {
      // None of the energies is at a rung of the ladder, where the light has a kink.
      sheet.point_brightness = {0.3, 1.0, 0.8, 2.0, 0.5};
      sheet.point_energy_kev = {2.03, 3.07, 5.11, 4.03, 6.5};
      sheet.point_width_km = {1.0, 2.0, 1.5, 0.7, 3.0};
    }
    expect_derivatives(scene, 0.02);
  }
}

TEST(FilmDerivatives, SouthernSheetsOfTheLiteralRuleAgreeWithDifferences) {
  Scene scene = tests::small_scene();
  scene.camera.azimuth_deg = 184.0;
  scene.field.inclination_deg = -74.0;
  Sheet& sheet = scene.sheets[0];
  sheet.center_km = {-100.0, -200.0};
  sheet.arcs = 2;
  sheet.length_km = 250.0;
  sheet.fold_spacing_km = 25.0;
  sheet.fold_length_km = 15.0;
  sheet.spacing_rule = SpacingRule::literal;
  sheet.pitch_law = PitchLaw::product;
  sheet.pitch_step_rad = 0.4;
  sheet.loss_cone_deg = 25.0;
  sheet.path_spread = 0.2;
  sheet.beams = 800;
  expect_derivatives(scene, 0.02);
}

TEST(FilmDerivatives, OfAnExposureOfADriftingSheetAgreeWithDifferences) {
  Scene scene = tests::small_scene();
  Sheet& sheet = scene.sheets[0];
  sheet.center_km.east = 130.0;
  sheet.length_km = 250.0;
  sheet.beams =
      150;  // of which a seventh stands for the light of each age: few samples, few to even out kinks
  sheet.arcs = 2;
  sheet.arc_spacing_km = 14.0;
  sheet.drift_km_s = {4.0, 2.5};
  sheet.sine_speed_km_s = 8.5;
  sheet.fold_spacing_km = 25.0;
  sheet.fold_length_km = 15.0;
  scene.substorm.quiet = 0.1;
  scene.substorm.onset_s = 10.0;
  scene.time.start_s = 7.0;
  scene.time.exposure_s = 6.0;  // 15 km to the north, and over the onset
  scene.time.instants = 4;
  expect_derivatives(scene, 0.01);
}

TEST(FilmDerivatives, TwoSheetsOtherPitchLawsAndFiveLinesAgreeWithDifferences) {
  Scene scene = tests::small_scene();
  scene.emission.lines = {630.0, 557.7, 427.8, 337.1, 777.4};
  scene.blur.width_deg = {0.43, 0.18, 0.0, 0.0, 0.0};
  scene.camera.width = 100;
  scene.camera.height = 75;
  scene.sheets[0].pitch_law = PitchLaw::constant;
  scene.sheets[0].beams = 200;
  Sheet second = scene.sheets[0];
  second.name = "second";
  second.center_km.north = 260.0;
  second.pitch_law = PitchLaw::increment;
  second.energy_kev = 8.0;
  scene.sheets.push_back(second);
  const FilmGeometry film = film_for(scene, 0, 0, 100, 75, 1.0, 1.0);
  BeamExposer exposer(scene, film, 0, 0.5);
  Exposure exposure;
  const std::vector<ParameterId> free = {
      parameter_with(ParameterRole::pitch_step, 0), parameter_with(ParameterRole::loss_cone, 0),
      parameter_with(ParameterRole::pitch_step, 1), parameter_with(ParameterRole::loss_cone, 1),
      parameter_with(ParameterRole::energy, 1)};
  exposer.expose_with_derivatives(scene, free, exposure);
  double size[5] = {};
  for (std::size_t i = 0; i < exposure.cells() * exposure.lines; ++i)
    for (int j = 0; j < 5; ++j) size[j] += std::abs(exposure.derivative[i * exposure.free_stride + j]);
  EXPECT_EQ(size[0], 0.0) << "the constant law knows no step";
  EXPECT_GT(size[1], 0.0);
  EXPECT_GT(size[2], 0.0);
  EXPECT_EQ(size[3], 0.0) << "the increment law knows no loss cone";
  const auto check = [&](double& number, int j, double step) {
    std::vector<double> up, down;
    const double here = number;
    number = here + step;
    exposer.expose_reference(scene, up);
    number = here - step;
    exposer.expose_reference(scene, down);
    number = here;
    const std::size_t cells = exposure.cells();
    const auto cell = [&](int l, int r, int c) {
      return l * cells + static_cast<std::size_t>(r) * film.columns + c;
    };
    const auto exact = smoothed(film, 5, [&](int l, int r, int c) {
      return static_cast<double>(exposure.derivative[cell(l, r, c) * exposure.free_stride + j]);
    });
    const auto differences = smoothed(film, 5, [&](int l, int r, int c) {
      return (up[cell(l, r, c)] - down[cell(l, r, c)]) / (2.0 * step);
    });
    double error = 0.0, norm = 0.0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      error += std::pow(exact[i] - differences[i], 2);
      norm += std::pow(differences[i], 2);
    }
    EXPECT_LT(std::sqrt(error / norm), 0.01) << j;
  };
  check(scene.sheets[0].loss_cone_deg, 1, 1e-4);
  check(scene.sheets[1].pitch_step_rad, 2, 1e-5);
  check(scene.sheets[1].energy_kev, 4, 0.04);
}

}  // namespace
}  // namespace vegard::sim::film_derivatives_test
