// The expected picture against the mean of many draws, bin by bin.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "sim/base/parallel.h"
#include "sim/render/beam_exposer.h"
#include "sim/render/beams/sheet_nodes.h"
#include "sim/render/film.h"
#include "sim/render/picture.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/view/film/blur.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::expected_picture_test {
namespace {

constexpr int kDraws = 256, kBin = 8, kRows = 3;
constexpr double kFine = 8.0;  // the quadrature's own error is then far below that of the mean of the draws

/// Blurred rayleighs of a film with cells of 2 x 1 pixels, in bins of kBin pixels by kRows rows, all lines.
std::vector<double> binned(const Scene& scene, const BeamSampling& sampling) {
  const FilmGeometry film = film_for(scene, 0, 0, scene.camera.width, scene.camera.height, 2.0, 1.0);
  BeamExposer exposer(scene, film, 1, 0.0, sampling);
  Exposure exposure;
  exposer.expose(scene, exposure);
  Image light;
  form_lines(scene, exposure, all_of(film), 1, light);
  const int lines = exposure.lines, left = static_cast<int>(-film.x0_px / 2.0),
            top = static_cast<int>(-film.y0_px);
  const int across = scene.camera.width / kBin, down = scene.camera.height / kRows;
  std::vector<double> bins(static_cast<std::size_t>(across) * down * lines, 0.0);
  for (int y = 0; y < down * kRows; ++y)
    for (int x = 0; x < across * kBin / 2; ++x)
      for (int l = 0; l < lines; ++l)
        bins[(static_cast<std::size_t>(y / kRows) * across + x * 2 / kBin) * lines + l] +=
            light.at(left + x, top + y, l) / (kBin / 2 * kRows);
  return bins;
}

struct Mean {
  std::vector<double> mean, error;
};

Mean mean_of_draws(const Scene& scene) {
  std::vector<std::vector<double>> draws(kDraws);
  parallel_for(kDraws, 0, [&](std::size_t i, int) { draws[i] = binned(scene, BeamSampling{i, false, 0.0}); });
  Mean m;
  for (std::size_t k = 0; k < draws.front().size(); ++k) {
    double sum = 0.0, squares = 0.0;
    for (const std::vector<double>& draw : draws) {
      sum += draw[k] / kDraws;
      squares += draw[k] * draw[k] / kDraws;
    }
    m.mean.push_back(sum);
    m.error.push_back(std::sqrt(std::max(0.0, squares - sum * sum) / (kDraws - 1)));
  }
  return m;
}

Scene base() {
  Scene scene = tests::small_scene();
  scene.seed = 7;
  scene.sheets[0].beams = 200;
  scene.sheets[0].spacing_jitter = 1.0;  // so that drawn beams stand anywhere, as the mean has them
  scene.sheets[0].width_km = 2.5;
  scene.blur.width_deg = {0.5, 0.4, 0.4};
  return scene;
}

std::vector<std::pair<std::string, Scene>> scenes() {
  std::vector<std::pair<std::string, Scene>> all;
  const auto add = [&](const char* what, const std::function<void(Sheet&)>& change) {
    all.emplace_back(what, base());
    change(all.back().second.sheets[0]);
  };
  add("as it is", [](Sheet&) {});
  add("tied", [](Sheet& s) { s.spacing_rule = SpacingRule::tied; });
  add("literal", [](Sheet& s) { s.spacing_rule = SpacingRule::literal; });
  add("one layer", [](Sheet& s) { s.layers = 1; });
  add("two arcs", [](Sheet& s) { s.arcs = 2; });
  add("rays", [](Sheet& s) { s.ray_contrast = 0.5; });
  add("long and short rays", [](Sheet& s) { s.ray_length_contrast = 0.5; });
  add("patches", [](Sheet& s) {
    s.patch_size_km = 20.0;
    s.patch_contrast = 0.4;
  });
  add("random depth", [](Sheet& s) { s.path_spread = 0.3; });
  add("wide pitch angles", [](Sheet& s) {
    s.pitch_law = PitchLaw::constant;
    s.loss_cone_deg = 6.0;
    s.path_step = 0.01;
  });
  add("overhead", [](Sheet& s) { s.center_km = {3.0, 25.0}; });
  all.back().second.camera.elevation_deg = 80.0;
  add("by a fisheye", [](Sheet&) {});
  all.back().second.camera.model = LensModel::equidistant;
  all.back().second.camera.focal_px = 130.0;
  add("a dipole's field", [](Sheet&) {});
  all.back().second.field.model = FieldModel::dipole;
  add("a curve", [](Sheet& s) {
    s.course = SheetCourse::curve;
    s.east_km = {-150.0, -40.0, 60.0, 160.0};
    s.north_km = {190.0, 170.0, 200.0, 185.0};
    s.point_energy_kev = {2.0, 4.0, 3.0, 6.0};
    s.point_brightness = {1.0, 2.0, 0.5, 1.0};
    s.point_width_km = {1.0, 2.0, 3.0, 2.0};
  });
  return all;
}

/// Of bins with light. Three standard errors leave out 0.27 % of normal noise, here up to 3 %: neighbours
/// share their beams, and by the tied and the literal rule all of a layer's beams share one sum of steps. Six
/// leave out nothing. Draws 0 to 255 of seed 7.
TEST(ExpectedPicture, IsTheMeanOfManyDraws) {
  for (const auto& [what, scene] : scenes()) {
    SCOPED_TRACE(what);
    const Mean draws = mean_of_draws(scene);
    const std::vector<double> expected = binned(scene, BeamSampling{0, true, 0.0, kFine});
    const double peak = *std::max_element(draws.mean.begin(), draws.mean.end());
    int lit = 0, beyond = 0, far = 0;
    for (std::size_t k = 0; k < expected.size(); ++k) {
      if (draws.mean[k] < 1e-3 * peak) continue;  // few points: not normal
      ++lit;
      const double off = std::abs(expected[k] - draws.mean[k]) / draws.error[k];
      beyond += off > 3.0;
      far += off > 6.0;
    }
    EXPECT_GT(lit, 300);
    EXPECT_LE(beyond, 0.03 * lit);
    EXPECT_EQ(far, 0);
  }
}

/// What a fit uses is coarser. Its error, here without the smoothing that profiles have, is to stay below a
/// half of the model error of 2 % that a fit assumes. By the literal rule places along are drawn as well, and
/// it is about as large as that error.
TEST(ExpectedPicture, IsAccurateToHalfOfTheModelError) {
  for (const auto& [what, scene] : scenes()) {
    SCOPED_TRACE(what);
    const std::vector<double> fine = binned(scene, BeamSampling{0, true, 0.0, kFine}),
                              usual = binned(scene, BeamSampling{0, true, 0.0});
    double square = 0.0, light = 0.0;
    for (std::size_t k = 0; k < fine.size(); ++k) {
      square += (usual[k] - fine[k]) * (usual[k] - fine[k]);
      light += fine[k] * fine[k];
    }
    EXPECT_LT(std::sqrt(square / light), what == "literal" ? 0.03 : 0.01);
  }
}

/// Derivatives of all lines' light in wide cells, by numbers that move it along columns and over rows,
/// [parameter][cell], smoothed over the rows as profiles are.
std::vector<double> slopes_in_wide_cells(const Scene& scene, double fineness) {
  constexpr double kSmoothing_px = 2.0;
  FilmGeometry film = film_for(scene, 0, 0, scene.camera.width, scene.camera.height, 10.0, 1.0);
  film.ramp_px = 4.0;
  BeamExposer exposer(scene, film, 1, 0.0, BeamSampling{0, true, kSmoothing_px, fineness});
  Exposure exposure;
  const std::vector<ParameterId> free = {parameter_with(ParameterRole::phase, 0),
                                         parameter_with(ParameterRole::wavelength, 0),
                                         parameter_with(ParameterRole::bearing, 0)};
  exposer.expose_with_derivatives(scene, free, exposure);
  const std::size_t cells = exposure.cells();
  std::vector<double> slopes(cells * free.size(), 0.0);
  std::vector<float> plane(cells), smooth(cells);
  for (std::size_t j = 0; j < free.size(); ++j) {
    for (std::size_t i = 0; i < cells; ++i) {
      plane[i] = 0.0f;
      for (int l = 0; l < exposure.lines; ++l)
        plane[i] += exposure.derivative[(l * cells + i) * exposure.free_stride + j];
    }
    blur_down(plane.data(), smooth.data(), film.rows, film.columns, 1, gaussian_kernel(kSmoothing_px), 1);
    std::copy(smooth.begin(), smooth.end(), slopes.begin() + static_cast<std::ptrdiff_t>(j * cells));
  }
  return slopes;
}

/// What the quadrature leaves in derivatives passes for information in error bars: root mean square, of that
/// of the finer one's. Beams that are not evenly spaced along a sheet, or ramps with kinks, leave 20 % in
/// that by the bearing.
TEST(ExpectedPicture, HasTheDerivativesOfAFinerOneInWideCells) {
  const Scene scene = base();
  const std::vector<double> fine = slopes_in_wide_cells(scene, 4.0),
                            usual = slopes_in_wide_cells(scene, 1.25);
  const std::size_t bins = fine.size() / 3;
  for (std::size_t j = 0; j < 3; ++j) {
    double square = 0.0, all = 0.0;
    for (std::size_t i = j * bins; i < (j + 1) * bins; ++i) {
      square += (usual[i] - fine[i]) * (usual[i] - fine[i]);
      all += fine[i] * fine[i];
    }
    EXPECT_LT(std::sqrt(square / all), 0.08);
  }
}

/// Beams stay where they were laid out while a fit changes the sheet: its width counts as it is now, beside
/// the tube's, and so does its derivative, but for the tube's variance, which is taken where most light is.
TEST(ExpectedPicture, OfAThinSheetDoesNotHangOnTheWidthThatItWasLaidOutWith) {
  constexpr double kStep_km = 0.02;
  const auto with_width = [](double width_km) {
    Scene scene = base();
    scene.sheets[0].width_km = width_km;
    scene.sheets[0].pitch_law = PitchLaw::constant;
    scene.sheets[0].loss_cone_deg = 3.0;
    return scene;
  };
  const Scene wide = with_width(1.5), thin = with_width(0.4);
  const FilmGeometry film = film_for(wide, 0, 0, wide.camera.width, wide.camera.height, 2.0, 1.0);
  BeamExposer of_wide(wide, film, 1, 0.0, BeamSampling{0, true, 0.0, 4.0}),
      of_thin(thin, film, 1, 0.0, BeamSampling{0, true, 0.0, 4.0});
  Exposure there, here, more, less;
  of_wide.expose_with_derivatives(thin, {parameter_at(thin, "sheet.main.width_km").value()}, there);
  of_thin.expose(thin, here);
  of_wide.expose(with_width(0.4 + kStep_km), more);
  of_wide.expose(with_width(0.4 - kStep_km), less);
  double square = 0.0, light = 0.0, square_of_slope = 0.0, slopes = 0.0;
  for (std::size_t i = 0; i < here.rayleigh.size(); ++i) {
    square += (there.rayleigh[i] - here.rayleigh[i]) * (there.rayleigh[i] - here.rayleigh[i]);
    light += here.rayleigh[i] * here.rayleigh[i];
    const double slope = (more.rayleigh[i] - less.rayleigh[i]) / (2.0 * kStep_km);
    const double off = there.derivative[i * there.free_stride] - slope;
    square_of_slope += off * off;
    slopes += slope * slope;
  }
  EXPECT_LT(std::sqrt(square / light), 0.01);
  EXPECT_LT(std::sqrt(square_of_slope / slopes), 0.03);
}

/// One draw is many times as far from the mean as the quadrature is; and no draw is in the mean.
TEST(ExpectedPicture, DoesNotDependOnTheSeed) {
  Scene scene = base(), other = base();
  other.seed = 8;
  EXPECT_EQ(binned(scene, BeamSampling{0, true, 0.0}), binned(other, BeamSampling{0, true, 0.0}));
  EXPECT_NE(binned(scene, {}), binned(other, {}));
}

TEST(ExpectedPicture, IsNoneOfFoldsCurlsAndUndulatingBorders) {
  Scene scene = base();
  EXPECT_TRUE(has_expected_picture(scene));
  scene.sheets[0].fold_spacing_km = 30.0;
  EXPECT_FALSE(has_expected_picture(scene));
  scene = base();
  scene.sheets[0].curl_spacing_km = 5.0;
  EXPECT_FALSE(has_expected_picture(scene));
  scene = base();
  scene.sheets[0].border_amplitude_km = 3.0;
  EXPECT_FALSE(has_expected_picture(scene));
}

}  // namespace
}  // namespace vegard::sim::expected_picture_test
