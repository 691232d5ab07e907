// Photographs with noise of our own making, decoded and fitted by the sensor that made them.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "fit/fit.h"
#include "fit/photo/photo.h"
#include "sim/base/picture/image_io.h"
#include "sim/render/render.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/view/sensor/sensor.h"
#include "tests/support/kind_named.h"
#include "tests/support/source_folder.h"
#include "tests/support/temporary_folder.h"

namespace vegard::fit::photograph_test {
namespace {

const std::string kScenes = tests::source_folder() + "/tests/cli/scenes/";

/// A camera with its own tone curve and dark corners, at an ISO of 1600.
void set_camera(sim::Scene& scene) {
  scene.sensor.tone = sim::ToneKind::gamma;
  scene.sensor.gamma = 1.8;
  scene.sensor.vignetting_cos_power = 4.0;
  scene.sensor.vignetting = {-0.3, 0.1, 0.0};
  scene.time.exposure_s = 4.0;
}

struct Taken {
  sim::Image truth;
  std::string file;
};

Taken photograph_of(const sim::Scene& scene, const std::string& file, int bits, int quality) {
  const sim::Image truth = sim::light_on_sensor(scene, sim::render(scene));
  const sim::Image shown = sim::encoded(scene, sim::developed(scene, sim::raw_numbers(scene, truth)));
  sim::write_display(file, shown, bits, quality, {});
  return {truth, file};
}

TEST(PhotographOfASensor, IsDecodedByIt) {
  const tests::TemporaryFolder folder;
  sim::Scene scene = sim::read_scene(kScenes + "small.toml");
  set_camera(scene);
  scene.sky.level = {0.1, 0.1, 0.1};
  scene.sensor.mosaic = sim::MosaicPattern::none;
  const Taken taken = photograph_of(scene, folder / "photo.tif", 16, 100);
  const Photo photo = read_photo(taken.file, Decoding::sensor, &scene);
  EXPECT_EQ(photo.decoding, "sensor: gamma 1.8 (16-bit TIFF, as asked)");
  const sim::Image variance = sim::light_variance(scene, taken.truth, 1.0 / 65535.0);
  double chi2 = 0.0;
  for (std::size_t i = 0; i < photo.linear.data.size(); ++i) {
    EXPECT_EQ(photo.usable[i], 1);
    const double difference = photo.linear.data[i] - taken.truth.data[i];
    chi2 += difference * difference / variance.data[i];
  }
  const double n = static_cast<double>(photo.linear.data.size());
  EXPECT_NEAR(chi2 / n, 1.0, 4.0 * std::sqrt(2.0 / n));  // seed 7
  // The step of the file's code by the curve's slope, d linear / d code = 1.8 code^0.8.
  EXPECT_NEAR(code_step(photo, std::pow(0.5, 1.8)), 1.8 * std::pow(0.5, 0.8) / 65535.0, 1e-9);
}

// JPEG throws noise away and adds its own: the light comes back within twice the sensor's noise and its mean
// within a hundredth, no more is promised.
TEST(PhotographOfASensor, SuffersFromJpeg) {
  const tests::TemporaryFolder folder;
  sim::Scene scene = sim::read_scene(kScenes + "small.toml");
  set_camera(scene);
  scene.sky.level = {0.1, 0.1, 0.1};
  const Taken taken = photograph_of(scene, folder / "photo.jpg", 8, 95);
  const Photo photo = read_photo(taken.file, Decoding::sensor, &scene);
  const sim::Image variance = sim::light_variance(scene, taken.truth, 1.0 / 255.0);
  double chi2 = 0.0, sum = 0.0, true_sum = 0.0;
  for (std::size_t i = 0; i < photo.linear.data.size(); ++i) {
    const double difference = photo.linear.data[i] - taken.truth.data[i];
    chi2 += difference * difference / variance.data[i];
    sum += photo.linear.data[i], true_sum += taken.truth.data[i];
  }
  EXPECT_LT(chi2 / static_cast<double>(photo.linear.data.size()), 4.0);
  EXPECT_NEAR(sum / true_sum, 1.0, 0.01);
}

/// The energy and the distance of the fit's own scene, from a photograph with noise.
FitResult fitted(const std::string& file, Decoding decoding, const sim::Scene& scene) {
  FitOptions options;
  options.max_evaluations = 200;
  return fit_photo(scene, read_photo(file, decoding, &scene), options);
}

TEST(PhotographOfASensor, GivesTheEnergyBack) {
  const tests::TemporaryFolder folder;
  for (const char* mosaic : {"none", "rggb"}) {
    sim::Scene truth = sim::read_scene(kScenes + "small.toml");
    sim::Scene start = sim::read_scene(kScenes + "fit.toml");
    for (sim::Scene* scene : {&truth, &start}) {
      set_camera(*scene);
      scene->sensor.mosaic = tests::kind_named<sim::MosaicPattern>(mosaic);
      scene->sensor.gain_per_kilorayleigh = 0.03;
    }
    const Taken taken = photograph_of(truth, folder / (std::string(mosaic) + ".png"), 16, 100);
    const FitResult right = fitted(taken.file, Decoding::sensor, start);
    const FitResult wrong = fitted(taken.file, Decoding::srgb, start);
    ASSERT_EQ(right.parameters[1].path, "sheet.main.energy_kev");
    const double sigma = right.parameters[1].sigma.value_or(0.0);
    const double error = right.parameters[1].value - truth.sheets[0].energy_kev;
    const std::string name = mosaic;
    RecordProperty("energy_kev_" + name, std::to_string(right.parameters[1].value));
    RecordProperty("sigma_kev_" + name, std::to_string(sigma));
    RecordProperty("chi2_per_dof_" + name, std::to_string(right.chi2 / right.dof));
    RecordProperty("energy_kev_as_srgb_" + name, std::to_string(wrong.parameters[1].value));
    EXPECT_GT(sigma, 0.0);
    EXPECT_LT(std::abs(error), 3.0 * sigma) << mosaic;
    EXPECT_LT(std::abs(error), 0.05 * truth.sheets[0].energy_kev) << mosaic;
    EXPECT_LT(right.chi2, 0.5 * wrong.chi2) << mosaic;
  }
}

}  // namespace
}  // namespace vegard::fit::photograph_test
