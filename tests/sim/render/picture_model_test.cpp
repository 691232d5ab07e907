// What a fit bins is what render() makes, on the same cells and to the last bit; and its derivatives are
// those of it.
#include "sim/render/picture_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "sim/render/picture.h"
#include "sim/render/render.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/rows/spline_rates.h"
#include "sim/scene/table/parameter_id.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/view/sky/night_sky.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::picture_model_test {
namespace {

/// A film of the whole picture.
FilmGeometry film_of(const Scene& scene, double cell_width_px, double cell_height_px) {
  return film_for(scene, 0, 0, scene.camera.width, scene.camera.height, cell_width_px, cell_height_px);
}

/// Means over so many rows of all columns of the picture, each cell for one pixel; every seventh cell is left
/// out.
CellWeights strips(const FilmGeometry& film, int rows) {
  const int first_row = static_cast<int>(std::lround(-film.y0_px / film.cell_height_px));
  const int first_column = static_cast<int>(std::lround(-film.x0_px / film.cell_width_px));
  CellWeights weights;
  for (int row = first_row; row + rows <= film.rows - first_row; row += rows) {
    weights.first_run.push_back(weights.runs.size());
    int cells = 0;
    for (int r = row; r < row + rows; ++r) {
      weights.runs.push_back({r, first_column, film.columns - 2 * first_column, weights.pixels.size()});
      for (int column = 0; column < weights.runs.back().columns; ++column) {
        const float weight = (r + column) % 7 == 0 ? 0.0f : 1.0f;
        weights.pixels.insert(weights.pixels.end(), 3, weight);
        cells += weight > 0.0f;
      }
    }
    weights.inverse.insert(weights.inverse.end(), 3, 1.0f / static_cast<float>(cells));
  }
  weights.first_run.push_back(weights.runs.size());
  return weights;
}

Scene plain_scene() {
  Scene scene = tests::small_scene();
  scene.sensor.gain_per_kilorayleigh = 1.0;
  return scene;
}

const char* const kArc = R"(
[camera]
width = 72
height = 54
hfov_deg = 80
elevation_deg = 28
[sensor]
gain_per_kilorayleigh = 1
[blur]
width_deg = [1.0, 0.5, 0.2]
[[footprint]]
size_km = [700, 200]
cell_km = 4
east_km = [-300, -140, 0, 130, 300]
north_km = [12, -20, 16, 30, -12]
width_km = 10
energy_kev = 4
)";

/// Scenes in which each step of the way has its say.
std::vector<std::pair<std::string, Scene>> scenes() {
  std::vector<std::pair<std::string, Scene>> all;
  const auto add = [&](const char* what, const std::function<void(Scene&)>& change) {
    all.emplace_back(what, plain_scene());
    change(all.back().second);
  };
  add("as it is", [](Scene&) {});
  add("the paper's kernels", [](Scene& s) { s.blur.kernel = BlurKernelKind::paper; });
  add("no blur", [](Scene& s) { s.blur.width_deg.assign(s.emission.lines.size(), 0.0); });
  add("air and the night sky's lights", [](Scene& s) {
    s.air.model = AirModel::standard;
    s.airglow.green_rayleigh = 250.0;
    s.airglow.red_rayleigh = 120.0;
    s.light_pollution.luminance_mcd_m2 = 1.0;
    s.twilight.shown = true;
  });
  add("five lines", [](Scene& s) {
    s.emission.lines = {630.0, 557.7, 427.8, 391.4, 844.6};
    s.blur.width_deg = {0.9, 0.3, 0.0, 0.1, 0.5};
  });
  add("other primaries", [](Scene& s) { s.sensor.primaries = Primaries::rec2020; });
  add("a grey sensor", [](Scene& s) { s.sensor.response = "grey"; });
  add("a wide lens", [](Scene& s) {
    s.camera.model = LensModel::equidistant;
    s.camera.focal_px = 60.0;
    s.airglow.green_rayleigh = 250.0;
  });
  all.emplace_back("a footprint", parse_scene(kArc, "arc.toml"));
  return all;
}

TEST(PictureModel, FormsThePictureThatRenderMakes) {
  bool any_negative = false;
  for (const auto& [what, scene] : scenes()) {
    SCOPED_TRACE(what);
    const Rendering rendering = render(scene);
    Image shown = rendering.aurora, shown_night_sky = rendering.night_sky;
    clip_out_of_gamut(shown);
    clip_out_of_gamut(shown_night_sky);
    any_negative = any_negative || shown.data != rendering.aurora.data;
    const FilmGeometry film = film_of(scene, 1.0, 1.0);
    const Window pixels = pixels_on(film, scene.camera);
    const CellWeights weights = strips(film, 9);
    for (const bool keeps_negative_light : {false, true}) {
      PictureModelOptions options;
      options.keeps_negative_light = keeps_negative_light;
      PictureModel model(scene, film, weights, options);
      PictureMeans means;
      model.evaluate(scene, means);
      const Image& whole = keeps_negative_light ? rendering.aurora : shown;
      const Image& night_sky = keeps_negative_light ? rendering.night_sky : shown_night_sky;
      for (int y = 0; y < pixels.rows; ++y)
        for (int x = 0; x < pixels.columns; ++x) {
          const int column = pixels.first_column + x, row = pixels.first_row + y;
          for (int l = 0; l < rendering.rayleigh.channels(); ++l)
            ASSERT_EQ(model.rayleigh().at(column, row, l), rendering.rayleigh.at(x, y, l)) << x << " " << y;
          for (int c = 0; c < 3; ++c)
            ASSERT_EQ(model.rgb().at(column, row, c), whole.at(x, y, c)) << x << " " << y;
        }
      // Sums in double of at most 9 x 160 floats, the night sky's of doubles: 1e-6 is a float's rounding.
      ASSERT_EQ(means.value.size(), weights.means() * 3);
      ASSERT_EQ(means.offset.empty(), night_sky.empty());
      for (std::size_t mean = 0; mean < weights.means(); ++mean)
        for (int c = 0; c < 3; ++c) {
          double aurora = 0.0, behind = 0.0, size = 0.0;
          for (std::size_t r = weights.first_run[mean]; r < weights.first_run[mean + 1]; ++r) {
            const CellWeights::Run& run = weights.runs[r];
            const int y = run.row - pixels.first_row;
            for (int x = 0; x < run.columns; ++x) {
              const float weight = weights.pixels[run.first_pixels + x * 3];
              aurora += weight * whole.at(x, y, c);
              if (!night_sky.empty()) behind += weight * night_sky.at(x, y, c);
              size += weight * std::abs(whole.at(x, y, c));
            }
          }
          const double inverse = weights.inverse[mean * 3 + c];
          EXPECT_NEAR(means.value[mean * 3 + c], aurora * inverse, 1e-6 * size * inverse);
          if (!night_sky.empty()) {
            EXPECT_NEAR(means.offset[mean * 3 + c], behind * inverse, 1e-6 * std::abs(behind) * inverse);
          }
        }
    }
  }
  EXPECT_TRUE(any_negative);  // else nothing was cut off
}

TEST(NightSkyOnFilm, IsThatOfThePictureToTheLastBit) {
  Scene scene = plain_scene();
  scene.air.model = AirModel::standard;
  scene.airglow.green_rayleigh = 250.0;
  scene.twilight.shown = true;
  scene.light_pollution.luminance_mcd_m2 = 1.0;
  const Image picture = night_sky_light(scene);
  const FilmGeometry film = film_of(scene, 1.0, 1.0);
  const Window pixels = pixels_on(film, scene.camera);
  const NightSkyOnFilm<double> values(scene, film);
  const NightSkyOnFilm<SkyDual> duals(scene, film);
  for (int y = 0; y < pixels.rows; y += 3)
    for (int x = 0; x < pixels.columns; x += 3) {
      const auto value = values.light(pixels.first_column + x, pixels.first_row + y);
      const auto dual = duals.light(pixels.first_column + x, pixels.first_row + y);
      for (int c = 0; c < 3; ++c) {
        ASSERT_EQ(static_cast<float>(value[c]), picture.at(x, y, c));
        ASSERT_NEAR(dual[c].v, value[c], 1e-14 * std::abs(value[c]));
      }
    }
}

double length(const std::vector<double>& v) {
  double square = 0.0;
  for (const double x : v) square += x * x;
  return std::sqrt(square);
}

/// Of `all`, [value][free], those by one parameter.
std::vector<double> by(const std::vector<double>& all, std::size_t free, std::size_t j) {
  std::vector<double> slope;
  for (std::size_t i = j; i < all.size(); i += free) slope.push_back(all[i]);
  return slope;
}

/// The film's floats leave 1e-7 of the light in a difference, and a step changes 1e-3 of it; samples that
/// cross from one cell to the next leave more, averaged over a strip. 2 % is left for both and for what is
/// not straight within a step.
void expect_derivatives(const Scene& scene, const std::vector<std::pair<std::string, double>>& steps) {
  const FilmGeometry film = film_of(scene, 4.0, 1.0);
  PictureModel model(scene, film, strips(film, 3));
  std::vector<ParameterPath> paths;
  std::vector<ParameterId> free;
  for (const auto& [path, step] : steps) {
    paths.push_back(resolve(scene, path).front());
    free.push_back(parameter_at(scene, path).value());
  }
  PictureMeans here;
  model.evaluate_with_derivatives(scene, free, here);
  PictureMeans plain;
  model.evaluate(scene, plain);
  ASSERT_EQ(here.value.size(), plain.value.size());
  for (std::size_t i = 0; i < plain.value.size(); ++i)
    ASSERT_NEAR(here.value[i], plain.value[i], 1e-4 * length(plain.value)) << i;
  for (std::size_t j = 0; j < steps.size(); ++j) {
    SCOPED_TRACE(steps[j].first);
    std::vector<double> value(plain.value.size()), offset(plain.offset.size());
    for (const double sign : {1.0, -1.0}) {
      Scene moved = scene;
      *real_value(moved, paths[j]) += sign * steps[j].second;
      PictureMeans there;
      model.evaluate(moved, there);
      for (std::size_t i = 0; i < value.size(); ++i)
        value[i] += sign * there.value[i] / (2.0 * steps[j].second);
      for (std::size_t i = 0; i < offset.size(); ++i)
        offset[i] += sign * there.offset[i] / (2.0 * steps[j].second);
    }
    const auto expect_same = [&](const std::vector<double>& difference, std::vector<double> slope) {
      ASSERT_EQ(slope.size(), difference.size());
      for (std::size_t i = 0; i < slope.size(); ++i) slope[i] -= difference[i];
      EXPECT_LE(length(slope), 0.02 * length(difference));
    };
    EXPECT_GT(length(value) + length(offset), 0.0);
    expect_same(value, by(here.derivative, free.size(), j));
    expect_same(offset, by(here.offset_derivative, free.size(), j));
  }
}

TEST(PictureModel, HasTheDerivativesOfEveryStep) {
  Scene scene = plain_scene();
  scene.air.model = AirModel::standard;
  scene.airglow.green_rayleigh = 250.0;
  scene.light_pollution.luminance_mcd_m2 = 1.0;
  scene.sheets[0].spacing_jitter = 0.0;
  expect_derivatives(scene, {{"sheet.main.energy_flux_mw_m2", 0.01},
                             {"sheet.main.center_km.north", 2e-3},
                             {"blur.width_deg.6300", 1e-3},
                             {"blur.width_deg.5577", 1e-3},
                             {"camera.hfov_deg", 0.01},
                             {"camera.elevation_deg", 5e-4},
                             {"air.aerosol_optical_depth", 1e-3},
                             {"airglow.green_rayleigh", 1.0},
                             {"light_pollution.luminance_mcd_m2", 0.01}});
}

TEST(PictureModel, HasTheDerivativesOfAFreeFormProfile) {
  Scene scene = plain_scene();
  scene.air.model = AirModel::standard;
  scene.sheets[0].profile = ProfileKind::spline;
  scene.sheets[0].spline_knots = 10;
  fill_spline_rates(scene);
  const std::vector<ParameterPath> rates = resolve(scene, "sheet.main.spline_rate");
  const double most =
      *std::max_element(scene.sheets[0].spline_rate.begin(), scene.sheets[0].spline_rate.end());
  expect_derivatives(scene, {{rates[2].text, 0.01 * most},
                             {rates[13].text, 0.01 * most},
                             {"sheet.main.energy_flux_mw_m2", 0.01},
                             {"blur.width_deg.5577", 1e-3}});
}

TEST(PictureModel, HasTheDerivativesOfLightThatLags) {
  // What shapes a profile shapes those of all ages, by line.
  Scene scene = plain_scene();
  scene.emission.flux_law = FluxLaw::column;
  scene.sheets[0].spacing_jitter = 0.0;
  scene.sheets[0].drift_km_s = {0.1, 0.4};
  Scene still = scene;
  still.emission.lag = EmissionLag::none;
  const FilmGeometry film = film_of(scene, 4.0, 1.0);
  PictureMeans late, prompt;
  PictureModel(scene, film, strips(film, 3)).evaluate(scene, late);
  PictureModel(still, film, strips(film, 3)).evaluate(still, prompt);
  double apart = 0.0;
  for (std::size_t i = 0; i < late.value.size(); ++i)
    apart = std::max(apart, std::abs(late.value[i] - prompt.value[i]));
  EXPECT_GT(apart, 0.005 * *std::max_element(prompt.value.begin(), prompt.value.end())) << "there is a lag";
  const std::vector<std::pair<std::string, double>> steps = {{"sheet.main.energy_flux_mw_m2", 0.01},
                                                             {"sheet.main.energy_kev", 0.003},
                                                             {"sheet.main.center_km.north", 2e-3},
                                                             {"camera.elevation_deg", 5e-4}};
  expect_derivatives(scene, steps);
  scene.sheets[0].profile = ProfileKind::form;
  scene.sheets[0].peak_km = 150.0;
  scene.sheets[0].upper_km = 100.0;
  expect_derivatives(scene, {{"sheet.main.peak_km", 0.02}, {"sheet.main.upper_km", 0.1}, steps[0]});
  scene.sheets[0].profile = ProfileKind::spline;
  scene.sheets[0].spline_knots = 10;
  fill_spline_rates(scene);
  const std::vector<ParameterPath> rates = resolve(scene, "sheet.main.spline_rate");
  const double most =
      *std::max_element(scene.sheets[0].spline_rate.begin(), scene.sheets[0].spline_rate.end());
  expect_derivatives(scene, {{rates[6].text, 0.01 * most}, {rates[16].text, 0.01 * most}});
}

}  // namespace
}  // namespace vegard::sim::picture_model_test
