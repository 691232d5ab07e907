#include "sim/render/film.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/render/beam_exposer.h"
#include "sim/render/render.h"
#include "sim/view/sky/air.h"
#include "tests/support/free_paths.h"
#include "tests/support/kind_named.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::air_on_film_test {
namespace {

Scene airy_scene() {
  Scene scene = tests::small_scene();
  scene.camera.elevation_deg = 22.0;
  scene.air.model = AirModel::standard;
  return scene;
}

FilmGeometry film_of(const Scene& scene) {
  return film_for(scene, 0, 0, scene.camera.width, scene.camera.height, 2.0, 1.0);
}

TEST(AirOnFilm, MultipliesByTheTransmissionOfEveryCell) {
  const Scene scene = airy_scene();
  BeamExposer exposer(scene, film_of(scene), 0);
  Exposure bare, dimmed;
  exposer.expose(scene, bare);
  exposer.expose(scene, dimmed);
  dim_by_air(scene, dimmed);
  const FilmGeometry& film = bare.geometry;
  int lit = 0;
  for (int row = 0; row < film.rows; row += 7)
    for (int column = 0; column < film.columns; column += 5) {
      const double elevation =
          direction_of_pixel(scene.camera, film.x0_px + (column + 0.5) * film.cell_width_px,
                             film.y0_px + (row + 0.5) * film.cell_height_px)
              .elevation_deg;
      for (int l = 0; l < bare.lines; ++l) {
        const std::size_t i = l * bare.cells() + static_cast<std::size_t>(row) * film.columns + column;
        const double share = air_transmission(scene, scene.emission.lines[l], elevation);
        EXPECT_NEAR(dimmed.rayleigh[i], share * bare.rayleigh[i], 1e-6 * bare.rayleigh[i]);
        lit += bare.rayleigh[i] > 0.0f;
      }
    }
  EXPECT_GT(lit, 100);
}

TEST(AirOnFilm, DerivativesAgreeWithDifferences) {
  const Scene scene = airy_scene();
  // Those of the film are tested elsewhere: here it stays as it is, and the air alone moves.
  std::vector<ParameterId> free;
  std::vector<ParameterPath> paths;
  for (const char* path : {"air.aerosol_optical_depth", "air.angstrom_exponent", "camera.elevation_deg",
                           "camera.roll_deg", "camera.hfov_deg", "camera.azimuth_deg"}) {
    paths.push_back(resolve(scene, path).front());
    free.push_back(paths.back().id);
  }
  BeamExposer exposer(scene, film_of(scene), 0);
  Exposure exposure;
  exposer.expose_with_derivatives(scene, free, exposure);
  Exposure bare;
  exposer.expose(scene, bare);
  const Exposure before = exposure;
  dim_by_air(scene, free, exposure);
  for (std::size_t j = 0; j < free.size(); ++j) {
    SCOPED_TRACE(paths[j].text);
    const double step = 1e-3;
    Scene more = scene, less = scene;
    *real_value(more, paths[j]) += step;
    *real_value(less, paths[j]) -= step;
    Exposure up = bare, down = bare;
    dim_by_air(more, up);
    dim_by_air(less, down);
    double error = 0.0, size = 0.0;
    for (std::size_t i = 0; i < bare.rayleigh.size(); ++i) {
      const std::size_t d = i * exposure.free_stride + j;
      const double share =
          before.rayleigh[i] > 0.0f ? static_cast<double>(exposure.rayleigh[i]) / before.rayleigh[i] : 0.0;
      const double by_air = exposure.derivative[d] - share * before.derivative[d];
      const double difference = (static_cast<double>(up.rayleigh[i]) - down.rayleigh[i]) / (2.0 * step);
      error += std::pow(by_air - difference, 2);
      size += difference * difference;
    }
    // The camera's azimuth turns the sky about the zenith, and the air is the same all round. A difference
    // of floats over 2e-3 is good to a few 1e-4 of the light, the slopes are some 1e-2 of it per degree.
    if (paths[j].text == "camera.azimuth_deg")
      EXPECT_LT(std::sqrt(error), 1e-3);
    else
      EXPECT_LT(std::sqrt(error / size), 0.02);
  }
}

TEST(AirOnFilm, LeavesAFilmWithoutAirAlone) {
  Scene scene = airy_scene();
  scene.air.model = AirModel::none;
  BeamExposer exposer(scene, film_of(scene), 0);
  Exposure bare, again;
  exposer.expose(scene, bare);
  again = bare;
  dim_by_air(scene, again);
  EXPECT_TRUE(std::equal(bare.rayleigh.begin(), bare.rayleigh.end(), again.rayleigh.begin()));
}

TEST(AirOnFilm, DimsBothKindsOfBlurAndEverySheet) {
  for (const char* model : {"angle", "physical"}) {
    Scene scene = airy_scene();
    scene.blur.model = tests::kind_named<BlurModel>(model);
    RenderOptions options;
    options.sheet_layers = true;
    const Rendering with = render(scene, options);
    scene.air.model = AirModel::none;
    const Rendering without = render(scene, options);
    double sums[3] = {0.0, 0.0, 0.0};
    for (std::size_t i = 0; i < with.rayleigh.data.size(); ++i) {
      sums[0] += without.rayleigh.data[i];
      sums[1] += with.rayleigh.data[i];
      sums[2] += with.sheets[0].rayleigh.data[i];
    }
    // Between 5 and 40 degrees up some 40 to 75 % of the green light arrives.
    EXPECT_LT(sums[1], 0.8 * sums[0]) << model;
    EXPECT_GT(sums[1], 0.4 * sums[0]) << model;
    EXPECT_NEAR(sums[2], sums[1], 1e-6 * sums[1]) << model;
  }
}

TEST(NightSkyInAPicture, IsALayerThatIsAdded) {
  Scene scene = airy_scene();
  EXPECT_TRUE(render(scene).night_sky.empty());
  scene.airglow.green_rayleigh = 163.0;
  scene.light_pollution.luminance_mcd_m2 = 1.0;
  const Rendering r = render(scene);
  ASSERT_FALSE(r.night_sky.empty());
  for (std::size_t i = 0; i < r.rgb.data.size(); ++i)
    ASSERT_NEAR(r.rgb.data[i], r.aurora.data[i] + r.night_sky.data[i], 1e-6);
}

}  // namespace
}  // namespace vegard::sim::air_on_film_test
