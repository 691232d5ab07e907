// Pictures with the tone "filmic" say so, and their light comes back as from other pictures.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fit/photo/photo.h"
#include "sim/base/picture/image_io.h"
#include "sim/view/sensor/sensor.h"
#include "tests/support/expect_error.h"

namespace vegard::fit::filmic_photo_test {
namespace {

/// A ramp of aurora-like colours from dark to twice white, four rows of each so that JPEG does not mix them.
sim::Image ramp() {
  sim::Image light(64, 32, {"R", "G", "B"});
  const double colours[4][3] = {{0.24, 1.0, 0.02}, {1.0, 0.1, 0.05}, {0.3, 0.2, 1.0}, {0.8, 0.9, 1.0}};
  for (int y = 0; y < light.height; ++y)
    for (int x = 0; x < light.width; ++x)
      for (int c = 0; c < 3; ++c)
        light.at(x, y, c) = static_cast<float>(colours[y / 8][c] * 2.0 * (x / 8 * 8 + 4) / 64.0);
  return light;
}

std::string file_of(const sim::Image& light, sim::ImageFormat format, int bits, sim::Primaries primaries,
                    const std::string& says) {
  sim::Scene scene;
  scene.sensor.tone = sim::ToneKind::filmic;
  scene.sensor.primaries = primaries;
  sim::ImageAttributes attributes = {{"scene", "a long text"}, {"units", "filmic-encoded"}};
  if (!says.empty()) attributes["encoding"] = says;
  return sim::encode_display(format, sim::encoded(scene, light), bits, 100, attributes);
}

TEST(FilmicPhoto, GivesItsLightBackInEveryFormat) {
  const sim::Image light = ramp();
  struct Kind {
    sim::ImageFormat format;
    int bits;
    double worst;  // of light up to white: half a step of the file there (JPEG: its rounding on top)
  };
  for (const Kind& kind : {Kind{sim::ImageFormat::png, 16, 2e-4}, Kind{sim::ImageFormat::tiff, 16, 2e-4},
                           Kind{sim::ImageFormat::png, 8, 0.025}, Kind{sim::ImageFormat::jpeg, 8, 0.06}}) {
    const Photo photo = read_photo_bytes(
        file_of(light, kind.format, kind.bits, sim::Primaries::srgb, "filmic, primaries srgb"), "it",
        Decoding::automatic);
    EXPECT_EQ(photo.decoding.find("filmic"), 0u) << photo.decoding;
    double worst = 0.0;
    for (int y = 0; y < light.height; ++y)
      for (int x = 0; x < light.width; ++x) {
        const double most = std::max({light.at(x, y, 0), light.at(x, y, 1), light.at(x, y, 2)});
        for (int c = 0; c < 3; ++c) {
          const std::size_t i = light.index(x, y, c);
          // What other tones would have cut off is not measured.
          if (most > 1.1) {
            EXPECT_EQ(photo.usable[i], 0) << x << " " << y;
          }
          if (most > 0.9) continue;
          EXPECT_EQ(photo.usable[i], 1) << x << " " << y;
          worst = std::max(worst, std::abs(double{photo.linear.data[i]} - light.data[i]));
        }
      }
    EXPECT_LT(worst, kind.worst) << photo.decoding;
    EXPECT_GT(code_step(photo, 0.95), 2.0 / ((1 << kind.bits) - 1));  // wide steps near white are known
  }
}

TEST(FilmicPhoto, OfOtherPrimariesIsTheLightOfSrgb) {
  sim::Scene wide;
  wide.sensor.primaries = sim::Primaries::rec2020;
  const sim::Image light = ramp();
  const Photo photo = read_photo_bytes(
      file_of(light, sim::ImageFormat::png, 16, sim::Primaries::rec2020, "filmic, primaries rec2020"), "it",
      Decoding::automatic, &wide);
  for (int x = 0; x < 24; ++x)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(photo.linear.at(x, 0, c), light.at(x, 0, c), 1e-3);
}

TEST(FilmicPhoto, WithoutTheWordsIsTakenForWhatItsFormatSays) {
  for (const char* says : {"", "filmic, primaries of a mill", "film"}) {
    const Photo photo = read_photo_bytes(
        file_of(ramp(), sim::ImageFormat::png, 8, sim::Primaries::srgb, says), "it", Decoding::automatic);
    EXPECT_EQ(photo.decoding.find("sRGB"), 0u) << photo.decoding;
  }
}

TEST(FilmicPhoto, HasNoWayBackToTheSensor) {
  sim::Scene scene;
  scene.sensor.tone = sim::ToneKind::filmic;
  const std::string bytes =
      file_of(ramp(), sim::ImageFormat::png, 8, sim::Primaries::srgb, "filmic, primaries srgb");
  tests::expect_words(sim::ErrorKind::scene, {"sensor.tone"},
                      [&] { read_photo_bytes(bytes, "it", Decoding::sensor, &scene); });
}

}  // namespace
}  // namespace vegard::fit::filmic_photo_test
