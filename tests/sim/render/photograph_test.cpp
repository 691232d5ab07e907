// A photograph made of known light, and the light found again within the noise. Scene seed 20140221.
//
// Means are taken over pixels behind their own filter, which are independent: four standard errors. A mean of
// n squares of standard normal numbers has the standard deviation sqrt(2 / n): four of them.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>

#include "sim/render/render.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/view/colour/radiometry.h"
#include "sim/view/sensor/expected_counts.h"
#include "sim/view/sensor/sensor.h"
#include "sim/view/sensor/tone_curve.h"
#include "tests/support/kind_named.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::photograph_test {
namespace {

/// A band in a bright sky behind a lens that darkens its corners. Its light is smooth over many pixels, so
/// that what a mosaic leaves out can be filled in.
Scene photographed_scene() {
  Scene scene = tests::small_scene();
  scene.blur.width_deg = {2.5, 2.5, 2.5};
  scene.sky.level = {0.12, 0.10, 0.14};
  scene.sensor.vignetting_cos_power = 4.0;
  scene.sensor.vignetting = {-0.1, 0.05, -0.02};
  scene.sensor.iso = 1600.0;
  scene.time.exposure_s = 2.0;
  return scene;
}

/// As a file of so many bits holds it.
Image stored(const Image& encoded, int bits) {
  const double largest = (1 << bits) - 1;
  Image file = encoded;
  for (float& value : file.data) value = static_cast<float>(std::round(value * largest) / largest);
  return file;
}

struct Recovered {
  Image light;
  std::vector<std::uint8_t> usable;
};

Recovered recovered(const Scene& scene, const Image& file, double file_step) {
  const ToneCurve tone(scene);
  Recovered result{file, std::vector<std::uint8_t>(file.data.size(), 1)};
  for (float& value : result.light.data) value = static_cast<float>(tone.decode(value));
  recover_light(scene, file_step, result.light, result.usable);
  return result;
}

Image photograph_file(const Scene& scene, const Image& truth, int bits) {
  return stored(encoded(scene, developed(scene, raw_numbers(scene, truth))), bits);
}

/// Sums over the pixels of one channel.
struct Comparison {
  double error = 0.0, variance = 0.0, chi2 = 0.0;
  int count = 0;
  void add(double difference, double expected_variance) {
    error += difference, variance += expected_variance;
    chi2 += difference * difference / expected_variance;
    ++count;
  }
};

/// Tone, bits of the converter, mosaic, bits of the file.
using Settings = std::tuple<std::string, int, std::string, int>;
class RoundTrip : public ::testing::TestWithParam<Settings> {};

TEST_P(RoundTrip, FindsTheLightWithinItsNoise) {
  Scene scene = photographed_scene();
  int file_bits = 0;
  std::string tone, mosaic_word;
  std::tie(tone, scene.sensor.bits, mosaic_word, file_bits) = GetParam();
  scene.sensor.tone = tests::kind_named<ToneKind>(tone);
  scene.sensor.mosaic = tests::kind_named<MosaicPattern>(mosaic_word);
  scene.sensor.gamma = 1.8;
  scene.sensor.tone_file = "curve.csv";
  scene.tables["sensor.tone_file"] =
      "linear,encoded\n0,0\n0.02,0.2\n0.05,0.32\n0.1,0.45\n0.2,0.62\n0.4,0.8\n0.7,0.93\n1,1\n";
  const Image truth = light_on_sensor(scene, render(scene));
  const Recovered found =
      recovered(scene, photograph_file(scene, truth, file_bits), 1.0 / ((1 << file_bits) - 1));
  const double step = 1.0 / ((1 << file_bits) - 1);
  const Image of_truth = light_variance(scene, truth, step);
  const Image of_found = light_variance(scene, found.light, step);

  const bool mosaic = scene.sensor.mosaic != MosaicPattern::none;
  for (int c = 0; c < 3; ++c) {
    Comparison own, all, as_known;
    for (int y = 0; y < truth.height; ++y)
      for (int x = 0; x < truth.width; ++x) {
        ASSERT_EQ(found.usable[truth.index(x, y, c)], 1);
        const double difference = found.light.at(x, y, c) - truth.at(x, y, c);
        all.add(difference, of_truth.at(x, y, c));
        as_known.add(difference, of_found.at(x, y, c));
        if (!mosaic || filter_of_pixel(scene.sensor.mosaic, x, y) == c)
          own.add(difference, of_truth.at(x, y, c));
      }
    RecordProperty("mean_error_sigma_" + std::to_string(c),
                   std::to_string(own.error / std::sqrt(own.variance)));
    RecordProperty("chi2_" + std::to_string(c), std::to_string(own.chi2 / own.count));
    EXPECT_NEAR(own.error, 0.0, 4.0 * std::sqrt(own.variance)) << "channel " << c;
    EXPECT_NEAR(own.chi2 / own.count, 1.0, 4.0 * std::sqrt(2.0 / own.count)) << "channel " << c;
    // Interpolated pixels share their noise, a ninth of them at most being independent.
    const double independent = mosaic ? all.count / 9.0 : all.count;
    EXPECT_NEAR(all.chi2 / all.count, 1.0, 4.0 * std::sqrt(2.0 / independent)) << "channel " << c;
    // A variance from a noisy count of m electrons makes chi2 too large by 2 / m; the darkest have 100, and
    // behind a mosaic it is of the interpolated light.
    EXPECT_NEAR(as_known.chi2 / as_known.count, 1.0, 0.02 + 4.0 * std::sqrt(2.0 / independent))
        << "channel " << c;
  }
}

std::string name_of(const ::testing::TestParamInfo<Settings>& info) {
  return std::get<0>(info.param) + std::to_string(std::get<1>(info.param)) + std::get<2>(info.param) +
         "File" + std::to_string(std::get<3>(info.param));
}

INSTANTIATE_TEST_SUITE_P(Converters, RoundTrip,
                         ::testing::Combine(::testing::Values("srgb", "gamma", "file"),
                                            ::testing::Values(8, 12, 14, 16),
                                            ::testing::Values("none", "rggb"), ::testing::Values(16)),
                         name_of);
// Not an 8-bit converter with an 8-bit file: the few levels of the one meet the steps of the other always in
// the same way, and the second rounding is no random number.
INSTANTIATE_TEST_SUITE_P(Files, RoundTrip,
                         ::testing::Combine(::testing::Values("srgb", "gamma", "file"), ::testing::Values(14),
                                            ::testing::Values("none", "rggb"), ::testing::Values(8)),
                         name_of);

// Of a straight tone a step of the file is a step of the light on the sensor: uniform within it, a twelfth of
// its square.
TEST(Photograph, AFilesStepsAddTheirOwnVariance) {
  Scene scene = photographed_scene();
  scene.sensor.mosaic = MosaicPattern::none;
  scene.sensor.tone = ToneKind::gamma;
  scene.sensor.gamma = 1.0;
  const Image light = light_on_sensor(scene, render(scene));
  const double step = 1.0 / 100.0;
  const Image without = light_variance(scene, light, 0.0), with = light_variance(scene, light, step);
  const Vignetting vignetting(scene);
  for (int y = 0; y < light.height; y += 7)
    for (int x = 0; x < light.width; x += 5)
      for (int c = 0; c < 3; ++c) {
        const double added =
            (with.at(x, y, c) - without.at(x, y, c)) * std::pow(vignetting.at(x + 0.5, y + 0.5), 2);
        EXPECT_NEAR(added / (step * step / 12.0), 1.0, 0.01) << x << ", " << y;
      }
}

// 10^8 electrons, 16 bits: photons scatter by 1e-4 of white at most, numbers by 1.5e-5.
TEST(Photograph, OfManyElectronsIsTheLight) {
  Scene scene = photographed_scene();
  scene.sensor.mosaic = MosaicPattern::none;
  scene.sensor.full_well_e = 1e8, scene.sensor.iso = scene.sensor.base_iso;
  scene.sensor.bits = 16;
  const Image truth = light_on_sensor(scene, render(scene));
  const Recovered found = recovered(scene, photograph_file(scene, truth, 16), 1.0 / 65535.0);
  double largest = 0.0;
  for (std::size_t i = 0; i < truth.data.size(); ++i)
    largest = std::max(largest, std::abs(static_cast<double>(found.light.data[i]) - truth.data[i]));
  EXPECT_LT(largest, 5e-4);
  EXPECT_GT(largest, 1e-5);  // there is noise
}

TEST(Photograph, IsAFunctionOfSeedAndFrameAlone) {
  Scene scene = photographed_scene();
  const Image truth = light_on_sensor(scene, render(scene));
  const Image once = raw_numbers(scene, truth, 0, 1);
  EXPECT_EQ(once.data, raw_numbers(scene, truth, 0, 2).data);
  EXPECT_NE(once.data, raw_numbers(scene, truth, 1, 1).data);
  scene.seed += 1;
  EXPECT_NE(once.data, raw_numbers(scene, truth, 0, 1).data);
}

// Two frames of one light differ by the noise of both: independent, and as large as is said.
TEST(Photograph, FramesHaveIndependentNoise) {
  Scene scene = photographed_scene();
  scene.sensor.mosaic = MosaicPattern::none;
  scene.sensor.bits = 16;
  const Image truth = light_on_sensor(scene, render(scene));
  const Image a = developed(scene, raw_numbers(scene, truth, 0)),
              b = developed(scene, raw_numbers(scene, truth, 1));
  const Image variance = light_variance(scene, truth, 0.0);
  const Vignetting vignetting(scene);
  double chi2 = 0.0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      const double seen = vignetting.at(x + 0.5, y + 0.5);
      for (int c = 0; c < 3; ++c) {
        const double difference = a.at(x, y, c) - b.at(x, y, c);
        chi2 += difference * difference / (2.0 * seen * seen * variance.at(x, y, c));
      }
    }
  const double n = static_cast<double>(a.data.size());
  EXPECT_NEAR(chi2 / n, 1.0, 4.0 * std::sqrt(2.0 / n));
}

// At a high ISO the number is full, at the base ISO the pixel, whose electrons are still read with noise;
// below that the pixel is full long before the number.
TEST(Photograph, SaturatesAndSaysSo) {
  Scene scene = photographed_scene();
  scene.sensor.vignetting_cos_power = 0.0, scene.sensor.vignetting = {0.0, 0.0, 0.0};
  for (const MosaicPattern mosaic : {MosaicPattern::none, MosaicPattern::rggb})
    for (const double iso : {1600.0, 100.0, 50.0}) {
      scene.sensor.mosaic = mosaic;
      scene.sensor.iso = iso;
      Image light(12, 4, {"R", "G", "B"});
      for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 12; ++x)
          for (int c = 0; c < 3; ++c) light.at(x, y, c) = x < 6 ? 0.3f : 1.5f;
      const Image raw = raw_numbers(scene, light);
      const SensorScale scale = sensor_scale(scene.sensor, scene.time);
      const double full_dn = scale.black_dn + scale.saturation_e * scale.dn_per_electron;
      EXPECT_NEAR(raw.at(11, 0, 0), full_dn, 6.0 * scale.read_noise_e * scale.dn_per_electron + 0.5);
      Recovered found{developed(scene, raw), std::vector<std::uint8_t>(light.data.size(), 1)};
      recover_light(scene, 0.0, found.light, found.usable);
      for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 12; ++x) {
          if (x == 5 || x == 6) continue;  // behind a mosaic they take from both sides
          EXPECT_EQ(found.usable[light.index(x, y, 1)], x < 6)
              << word_of(mosaic) << " at " << x << " ISO " << iso;
        }
    }
}

// The noise-free picture has the lens and the tone curve of the scene, which the same inverse takes off.
TEST(Photograph, WithoutNoiseComesBackToTheStepsOfItsFile) {
  Scene scene = photographed_scene();
  scene.sensor.tone = ToneKind::gamma;
  const Rendering rendering = render(scene);
  const Image truth = light_on_sensor(scene, rendering);
  const Recovered found = recovered(scene, stored(display_picture(scene, rendering), 16), 1.0 / 65535.0);
  for (std::size_t i = 0; i < truth.data.size(); ++i) ASSERT_NEAR(found.light.data[i], truth.data[i], 1e-4);
}

// With a gain below 1 a full green channel is stored at 0.6 of white, rounded to the file's steps: it is full
// all the same.
TEST(Photograph, FullChannelsAreFoundBehindAGainBelowOneAndAFilesSteps) {
  Scene scene = photographed_scene();
  scene.sensor.response = "nikon_d700";
  scene.sensor.white_balance = {1.0, 0.6, 1.0};
  scene.sensor.mosaic = MosaicPattern::none;
  scene.sensor.vignetting_cos_power = 0.0, scene.sensor.vignetting = {0.0, 0.0, 0.0};
  scene.camera.width = 32, scene.camera.height = 16;
  Image light(32, 16, {"R", "G", "B"});
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 32; ++x)
      for (int c = 0; c < 3; ++c) light.at(x, y, c) = x < 16 ? 0.1f : (c == 1 ? 2.0f : 0.1f);
  for (const int bits : {8, 16}) {
    const Recovered found = recovered(scene, photograph_file(scene, light, bits), 1.0 / ((1 << bits) - 1));
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 32; ++x) ASSERT_EQ(found.usable[light.index(x, y, 1)], x < 16) << bits << " " << x;
  }
}

// A matrix makes colours of raw numbers; the numbers are there before it.
TEST(Photograph, RawNumbersOfACameraDoNotDependOnItsMatrix) {
  Scene scene = photographed_scene();
  scene.sensor.response = "sony_a7s_ii";
  scene.sensor.exposure = ExposureRule::camera;
  scene.sensor.mosaic = MosaicPattern::none;
  const auto raw_by = [&](MatrixRule rule) {
    scene.sensor.matrix_rule = rule;
    scene.sensor.white_balance_rule =
        rule == MatrixRule::none ? WhiteBalanceRule::given : WhiteBalanceRule::daylight;
    scene.sky = {};  // it is given in the picture's own colours
    return raw_numbers(scene, light_on_sensor(scene, render(scene)));
  };
  const Image without = raw_by(MatrixRule::none), with = raw_by(MatrixRule::colorimetric);
  // The same random numbers, so that only a rounding of the mean could make another number.
  std::size_t differing = 0;
  for (std::size_t i = 0; i < with.data.size(); ++i) differing += with.data[i] != without.data[i];
  EXPECT_LT(differing, with.data.size() / 1000);
}

TEST(Photograph, RawNumbersAreTheExpectedCounts) {
  Scene scene = photographed_scene();
  scene.sensor.exposure = ExposureRule::camera;
  scene.sensor.mosaic = MosaicPattern::none;
  scene.sensor.dark_e_s = 20.0;
  const ExpectedCounts counts = expected_counts(scene);
  // 30 kR of 557.7 nm on the axis, through the scene's own colours.
  constexpr double kKilorayleigh = 30.0;
  const double green_dn = kKilorayleigh * counts.lines[1].dn_per_kilorayleigh[1];
  Image light(61, 61, {"R", "G", "B"});
  for (int i = 0; i < 61 * 61; ++i)
    light.data[3 * i + 1] =
        static_cast<float>(kKilorayleigh * counts.lines[1].electrons_per_kilorayleigh[1] / counts.white_e);
  scene.camera.width = scene.camera.height = 61;
  scene.sensor.vignetting_cos_power = 0.0, scene.sensor.vignetting = {0.0, 0.0, 0.0};
  const Image raw = raw_numbers(scene, light);
  double sum = 0.0;
  for (int i = 0; i < 61 * 61; ++i) sum += raw.data[3 * i + 1];
  const double electrons = green_dn / counts.dn_per_electron + counts.dark_e;
  const double sigma_dn = std::sqrt(electrons + 9.0) * counts.dn_per_electron;
  EXPECT_NEAR(sum / (61 * 61), counts.black_dn + green_dn + counts.dark_e * counts.dn_per_electron,
              4.0 * sigma_dn / 61.0);
}

}  // namespace
}  // namespace vegard::sim::photograph_test
