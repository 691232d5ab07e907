#include "sim/view/sensor/filmic_tone.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/view/colour/colour.h"
#include "sim/view/sensor/sensor.h"
#include "sim/view/sensor/tone_curve.h"

namespace vegard::sim::filmic_tone_test {
namespace {

/// Hue and chroma in Oklab, by Ottosson's matrices for linear sRGB, which the code does not use.
struct Hue {
  double degrees, chroma;
};
Hue hue_of(const Vector3& rgb) {
  const Matrix3 lms = {{{0.4122214708, 0.5363325363, 0.0514459929},
                        {0.2119034982, 0.6806995451, 0.1073969566},
                        {0.0883024619, 0.2817188376, 0.6299787005}}};
  const Vector3 v = product(lms, rgb);
  const double l = std::cbrt(v[0]), m = std::cbrt(v[1]), s = std::cbrt(v[2]);
  const double a = 1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s;
  const double b = 0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s;
  return {std::atan2(b, a) / kRadiansPerDegree, std::hypot(a, b)};
}
double hue_shift(const Vector3& from, const Vector3& to) {
  return std::abs(std::remainder(hue_of(from).degrees - hue_of(to).degrees, 360.0));
}

Vector3 of(const Vector3& colour, double factor) {
  return {colour[0] * factor, colour[1] * factor, colour[2] * factor};
}
Vector3 clipped(const Vector3& rgb) {
  return {std::clamp(rgb[0], 0.0, 1.0), std::clamp(rgb[1], 0.0, 1.0), std::clamp(rgb[2], 0.0, 1.0)};
}
double largest(const Vector3& v) { return std::max({v[0], v[1], v[2]}); }

/// The aurora's lines as a picture holds them, their mixtures, and colours around the gamut's edge.
std::vector<Vector3> colours() {
  std::vector<Vector3> all;
  for (const double nm : {427.8, 486.1, 557.7, 589.3, 630.0}) {
    Vector3 line = rgb_of_line(nm, Primaries::srgb);
    for (double& c : line) c = std::max(c, 0.0);
    all.push_back(of(line, 1.0 / largest(line)));
  }
  for (std::size_t i = 0; i < 5; ++i) {
    Vector3 mixed;
    for (int c = 0; c < 3; ++c) mixed[c] = all[i][c] + 0.4 * all[(i + 2) % 5][c];
    all.push_back(mixed);
  }
  for (int i = 0; i < 60; ++i) {
    const double turn = i / 10.0;
    const auto channel = [&](double middle) {
      return std::clamp(2.0 - std::abs(std::remainder(turn - middle, 6.0)), 0.0, 1.0);
    };
    all.push_back({channel(0.0), channel(2.0), channel(4.0)});
  }
  return all;
}

TEST(FilmicTone, KeepsTheHueFromShadowToTheBrightestHighlight) {
  const FilmicTone tone(Primaries::srgb);
  double worst = 0.0, worst_clipped = 0.0;
  for (const Vector3& colour : colours()) {
    for (double light = 1e-3; light < 2e5; light *= 1.5) {
      const double shift = hue_shift(colour, tone.shown(of(colour, light)));
      EXPECT_LT(shift, 3.0) << colour[0] << " " << colour[1] << " " << colour[2] << " times " << light;
      worst = std::max(worst, shift);
      const Vector3 cut = clipped(of(colour, light));
      if (hue_of(cut).chroma > 0.02) worst_clipped = std::max(worst_clipped, hue_shift(colour, cut));
    }
    EXPECT_GT(hue_of(tone.shown(of(colour, 1e5))).chroma,
              0.02);  // even there a colour, so that hue means one
  }
  EXPECT_GT(worst_clipped, 30.0);  // what this is for: green becomes yellow where channels are clipped
  RecordProperty("worst_degrees", std::to_string(worst));
}

TEST(FilmicTone, LeavesWhatIsBelowTheKneeAndNeverReachesWhite) {
  const FilmicTone tone(Primaries::srgb);
  const Vector3 dim = {0.5, 0.2, 0.01};
  EXPECT_EQ(tone.shown(dim), dim);
  EXPECT_EQ(tone.shown({0.3, -0.1, 0.2}), (Vector3{0.3, 0.0, 0.2}));
  double before = 0.0;
  for (double light = 0.01; light < 1e4; light *= 1.1) {
    const double shown = filmic_roll_off(light);
    EXPECT_GT(shown, before);
    EXPECT_LT(shown, 1.0);
    EXPECT_NEAR(filmic_light(shown), light, 1e-9 * light * light + 1e-12);
    EXPECT_NEAR(largest(tone.shown({light, 0.5 * light, 0.1 * light})), std::min(shown, 1.0 - 5e-6), 1e-12);
    before = shown;
  }
  // Without an edge at the knee: slopes on both sides.
  constexpr double kStep = 1e-6;
  EXPECT_NEAR(filmic_roll_off(kFilmicKnee + kStep) - kFilmicKnee, kStep, 1e-11);
  EXPECT_EQ(filmic_roll_off(1.0), 0.75);  // half of the way from knee to white
}

TEST(FilmicTone, ComesBack) {
  for (const Primaries primaries : {Primaries::srgb, Primaries::rec2020, Primaries::acescg}) {
    const FilmicTone tone(primaries);
    for (const Vector3& colour : colours())
      for (const double light : {0.2, 0.6, 1.0, 4.0}) {
        const Vector3 from = of(colour, light), back = tone.light(tone.shown(from));
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(back[c], from[c], 1e-3 * largest(from));
      }
  }
}

TEST(FilmicTone, GreyStaysGreyAndFollowsTheCurveOfGrey) {
  const ToneCurve grey = ToneCurve::filmic();
  for (const Primaries primaries : {Primaries::srgb, Primaries::smpte_c, Primaries::acescg}) {
    Scene scene;
    scene.sensor.tone = ToneKind::filmic;
    scene.sensor.primaries = primaries;
    Image light(5, 1, {"R", "G", "B"});
    const double lights[] = {0.1, 0.5, 0.9, 2.0, 30.0};
    for (int x = 0; x < 5; ++x)
      for (int c = 0; c < 3; ++c) light.at(x, 0, c) = static_cast<float>(lights[x]);
    const Image shown = encoded(scene, light);
    for (int x = 0; x < 5; ++x)
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(shown.at(x, 0, c), grey.encode(lights[x]), 1e-6);
  }
}

}  // namespace
}  // namespace vegard::sim::filmic_tone_test
