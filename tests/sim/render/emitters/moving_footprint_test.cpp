// Footprints in time: drift, noise that becomes another, flows that go on, and the substorm's envelope.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "sim/base/number/constants.h"
#include "sim/emit/aurora/motion.h"
#include "sim/emit/footprint/map/plane_flow.h"
#include "sim/render/emitters/emitter_makers.h"
#include "sim/render/emitters/footprint_volumes.h"
#include "sim/scene/emitters/emitter_kinds.h"
#include "sim/scene/file/scene_toml.h"

namespace vegard::sim::moving_footprint_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const NumberAs<double> kPlain = [](const double& n) { return n; };

void add_emitters(const EmitterInputs<double>& in, Emitters<double>& all) {
  footprint_maker().emitters(in, all);
}
void add_emitters(const EmitterInputs<FreeDual>& in, Emitters<FreeDual>& all) {
  footprint_maker().emitters_with_derivatives(in, all);
}

/// What all emitters of a scene's footprints give along rays over the sky.
template <class T>
std::vector<T> light_of(const Scene& scene, const NumberAs<T>& number) {
  Emitters<T> all;
  add_emitters(EmitterInputs<T>{scene, {}, number, 2}, all);
  std::vector<T> direction[3];
  for (int i = 0; i < 60; ++i) {
    const double elevation = (10.0 + 1.3 * i) * kRadiansPerDegree, azimuth = 0.4 * i;
    direction[0].push_back(std::cos(elevation) * std::sin(azimuth));
    direction[1].push_back(std::cos(elevation) * std::cos(azimuth));
    direction[2].push_back(std::sin(elevation));
  }
  const std::size_t count = direction[0].size();
  std::vector<T> rayleigh(3 * count, T(0.0)), kept(3 * count, T(1.0));
  std::vector<double> end(count, kInfinity), entry(count, kInfinity), depth(count, kInfinity);
  for (const auto& emitter : all)
    emitter->march({count, {direction[0].data(), direction[1].data(), direction[2].data()}, end.data()},
                   {3, rayleigh.data(), kept.data(), entry.data(), depth.data()});
  return rayleigh;
}
std::vector<double> light_of(const Scene& scene) { return light_of<double>(scene, kPlain); }

double sum(const std::vector<double>& all) { return std::accumulate(all.begin(), all.end(), 0.0); }

// Light without a past, where the instant is what is asked for.
const std::string kAtOnce = "[emission]\nlag = \"none\"\n";

const char* const kArc =
    "[[footprint]]\ncenter_km = [0, 0]\nsize_km = [300, 300]\ncell_km = 2\n"
    "east_km = [-100, 100]\nnorth_km = [10, 40]\nwidth_km = 12\n";
const char* const kCurtain =
    "[[footprint]]\nmodel = \"curtain\"\ncenter_km = [0, 0]\neast_km = [-100, 100]\nnorth_km = [10, 40]\n";
const char* const kNoise =
    "[[footprint]]\nsource = \"noise\"\ncenter_km = [0, 0]\nsize_km = [400, 400]\ncell_km = 4\n"
    "noise_scale_km = 100\n";
const char* const kShell =
    "[[footprint]]\nshape = \"shell\"\nface_cells = 64\nlatitude_deg = [66, 67]\nlongitude_deg = [-8, 8]\n"
    "width_km = 200\n";

// Rays see what has drifted as they see what stands there. A box goes on by its whole map, so that its cells
// are the same; a shell's cells are not, and the curve is drawn on others.
TEST(MovingFootprint, DriftsToWhereItWouldStand) {
  for (const char* source : {kArc, kCurtain, kNoise}) {
    const std::string text = source;
    const Scene moving =
        parse_scene(text + "drift_km_s = [0.5, -0.25]\n[time]\nstart_s = 80\n" + kAtOnce, "a.toml");
    std::string shifted = text;
    shifted.replace(shifted.find("center_km = [0, 0]"), 18, "center_km = [40, -20]");
    const std::vector<double> seen = light_of(moving), want = light_of(parse_scene(shifted, "a.toml"));
    const double peak = *std::max_element(want.begin(), want.end());
    ASSERT_GT(peak, 100.0);
    for (std::size_t i = 0; i < want.size(); ++i) EXPECT_NEAR(seen[i], want[i], 1e-4 * peak) << text << i;
    EXPECT_NE(sum(light_of(parse_scene(text, "a.toml"))), sum(seen));
  }
}

TEST(MovingFootprint, TurnsAShellAboutTheEarthsAxis) {
  const std::string text = kShell;
  // 3 degrees at 6481 km, in 100 s.
  const double speed = 3.0 * kRadiansPerDegree * (kEarthRadiusKm + kFootAltitudeKm) / 100.0;
  const Scene moving = parse_scene(
      text + "drift_km_s = [" + std::to_string(speed) + ", 0]\n[time]\nstart_s = 100\n" + kAtOnce, "a.toml");
  std::string turned = text;
  turned.replace(turned.find("[-8, 8]"), 7, "[-5, 11]");
  const std::vector<double> seen = light_of(moving), want = light_of(parse_scene(turned, "a.toml"));
  const double peak = *std::max_element(want.begin(), want.end());
  ASSERT_GT(peak, 100.0);
  // Cells of 160 km under a curve of 200 km: interpolation leaves a per cent.
  for (std::size_t i = 0; i < want.size(); ++i) EXPECT_NEAR(seen[i], want[i], 0.02 * peak) << i;
  const std::vector<double> before = light_of(parse_scene(text, "a.toml"));
  double off = 0.0;
  for (std::size_t i = 0; i < seen.size(); ++i) off = std::max(off, std::abs(seen[i] - before[i]));
  EXPECT_GT(off, 0.1 * peak);
}

// A drift through an exposure is the mean of its instants, each of which is a picture of its own.
TEST(MovingFootprint, IsTheMeanOfItsInstantsInAnExposure) {
  for (const char* source : {kArc, kCurtain, kShell}) {
    const std::string text = std::string(source) + "drift_km_s = [1.5, 0]\n";
    const std::vector<double> exposed =
        light_of(parse_scene(text + "[time]\nexposure_s = 60\ninstants = 3\n" + kAtOnce, "a.toml"));
    std::vector<double> mean(exposed.size(), 0.0);
    for (const char* start : {"0", "20", "40"}) {
      const std::vector<double> one =
          light_of(parse_scene(text + "[time]\nstart_s = " + start + "\n" + kAtOnce, "a.toml"));
      for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += one[i] / 3.0;
    }
    const double peak = *std::max_element(mean.begin(), mean.end());
    for (std::size_t i = 0; i < mean.size(); ++i) EXPECT_NEAR(exposed[i], mean[i], 1e-5 * peak);
  }
}

// The same of light that lags, but for where its past is looked at: within 1 % of the brightest.
TEST(MovingFootprint, IsTheMeanOfItsInstantsWithTheirPast) {
  const std::string text = std::string(kArc) + "drift_km_s = [1.5, 0]\n";
  for (const int instants : {3, 8}) {
    const std::vector<double> exposed = light_of(parse_scene(
        text + "[time]\nexposure_s = 60\ninstants = " + std::to_string(instants) + "\n", "a.toml"));
    std::vector<double> mean(exposed.size(), 0.0);
    for (int i = 0; i < instants; ++i) {
      const std::vector<double> one = light_of(
          parse_scene(text + "[time]\nstart_s = " + std::to_string(60.0 * i / instants) + "\n", "a.toml"));
      for (std::size_t p = 0; p < mean.size(); ++p) mean[p] += one[p] / instants;
    }
    const double peak = *std::max_element(mean.begin(), mean.end());
    for (std::size_t p = 0; p < mean.size(); ++p) EXPECT_NEAR(exposed[p], mean[p], 0.01 * peak) << instants;
  }
}

TEST(MovingFootprint, HasNoiseThatBecomesAnotherWithoutAJump) {
  const std::string text = std::string(kNoise) + "noise_lifetime_s = 10\n" + kAtOnce + "[time]\nstart_s = ";
  const std::vector<double> first = light_of(parse_scene(text + "0\n", "a.toml")),
                            soon = light_of(parse_scene(text + "0.01\n", "a.toml")),
                            later = light_of(parse_scene(text + "10\n", "a.toml"));
  double near = 0.0, far = 0.0, size = 0.0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    near += std::abs(soon[i] - first[i]);
    far += std::abs(later[i] - first[i]);
    size += first[i];
  }
  EXPECT_GT(near, 0.0);
  EXPECT_LT(near, 0.02 * size);
  EXPECT_GT(far, 0.3 * size) << "seed 1";
}

TEST(MovingFootprint, WindsOnWithTheClock) {
  Footprint f;
  f.flow_turns = 0.5;
  f.flow_turns_per_s = 0.1;
  EXPECT_EQ(flow_turns_at(f, 0.0), 0.5);
  EXPECT_NEAR(flow_turns_at(f, 12.0), 1.7, 1e-12);
  EXPECT_EQ(flow_turns_at(f, -6.0), 0.0);
  EXPECT_EQ(flow_turns_at(f, 1e6), 10.0);
  const std::string text = kArc;
  EXPECT_EQ(
      light_of(parse_scene(text + "flow_turns_per_s = 0.01\n[time]\nstart_s = 30\n" + kAtOnce, "a.toml")),
      light_of(parse_scene(text + "flow_turns = 0.3\n", "a.toml")));
}

// The envelope is a factor of the flux, and so of the light, whatever the source; sheets have it by
// themselves.
TEST(MovingFootprint, GoesByTheSubstorm) {
  const std::string substorm =
      "[substorm]\nquiet = 0.1\ngrown = 0.3\nonset_s = 100\ngrowth_s = 50\nexpansion_s = 20\n"
      "recovery_s = 60\n[time]\nstart_s = ";
  for (const std::string& text :
       {std::string(kArc), std::string(kCurtain), std::string(kNoise), std::string(kShell),
        std::string("[[sheet]]\ncenter_km = [0, 30]\nlength_km = 200\n[[footprint]]\nsource = \"sheets\"\n"
                    "center_km = [0, 0]\nsize_km = [300, 300]\ncell_km = 2\n")}) {
    const double whole = sum(light_of(parse_scene(text, "a.toml")));
    ASSERT_GT(whole, 0.0);
    for (const char* start : {"0", "80", "105", "150"}) {
      const Scene scene = parse_scene(text + substorm + start + "\n" + kAtOnce, "a.toml");
      EXPECT_NEAR(sum(light_of(scene)) / whole, substorm_level(scene.substorm, std::stod(start)), 1e-5)
          << text << start;
    }
  }
}

// 427.8 nm is there at once; 630.0 nm, of up to two minutes, is behind the drift.
TEST(MovingFootprint, LeavesForbiddenLinesBehindIt) {
  const std::string text = std::string(kArc) + "drift_km_s = [0, 0.5]\n[time]\nstart_s = 60\n";
  const Scene lagging = parse_scene(text, "a.toml"), at_once = parse_scene(text + kAtOnce, "a.toml");
  ASSERT_EQ(lagging.emission.lines[0], 630.0);
  ASSERT_EQ(lagging.emission.lines[2], 427.8);
  const std::vector<double> seen = light_of(lagging), now = light_of(at_once);
  const std::size_t rays = seen.size() / 3;
  double blue = 0.0, red = 0.0, blue_off = 0.0, red_off = 0.0;
  for (std::size_t i = 0; i < rays; ++i) {
    const std::size_t b = 2 * rays + i;
    blue += now[b];
    red += now[i];
    blue_off += std::abs(seen[b] - now[b]);
    red_off += std::abs(seen[i] - now[i]);
  }
  ASSERT_GT(red, 10.0);
  EXPECT_LT(blue_off, 1e-5 * blue);
  EXPECT_GT(red_off, 0.1 * red);
}

// The march is the same sum of emitters for dual numbers as for plain ones; the map's cells have kinks, which
// a difference may straddle, and the rates of profiles are floats.
TEST(MovingFootprint, HasTheDerivativesOfItsLaggingLight) {
  const std::string text = std::string(kArc) + "drift_km_s = [0.2, 0.5]\n[time]\nstart_s = 60\n";
  const Scene scene = parse_scene(text, "a.toml");
  const Footprint& f = scene.footprints[0];
  const std::vector<FreeDual> light = light_of<FreeDual>(scene, [&](const double& n) {
    FreeDual number(n);
    if (&n == &f.center_km.north) number.d.t[0] = 1.0;
    if (&n == &f.energy_flux_mw_m2) number.d.t[1] = 1.0;
    return number;
  });
  const auto check = [&](int which, double step, double tolerance) {
    const auto other = [&](double by) {
      Scene changed = scene;
      Footprint& g = changed.footprints[0];
      (which == 0 ? g.center_km.north : g.energy_flux_mw_m2) += by;
      return light_of(changed);
    };
    const std::vector<double> less = other(-step), more = other(step);
    double most = 0.0;
    for (const FreeDual& l : light) most = std::max(most, std::abs(l.d.t[which]));
    ASSERT_GT(most, 1.0);
    for (std::size_t i = 0; i < light.size(); ++i)
      EXPECT_NEAR(light[i].d.t[which], (more[i] - less[i]) / (2.0 * step), tolerance * most) << which << i;
  };
  check(0, 0.5, 0.01);  // rays are marched in floats, whose rounding a shorter step would show
  check(1, 0.1, 0.002);
}

TEST(MovingFootprint, IsKnownToMove) {
  const EmitterKind& kind = *std::find_if(emitter_kinds().begin(), emitter_kinds().end(),
                                          [](const EmitterKind& k) { return k.table == "footprint"; });
  const std::pair<const char*, bool> cases[] = {{"", false},
                                                {"drift_km_s = [0.1, 0]\n", true},
                                                {"flow_turns_per_s = 0.1\n", true},
                                                {"noise_lifetime_s = 5\n", false},
                                                {"[substorm]\nquiet = 0.5\n", true}};
  for (const auto& [more, does] : cases)
    EXPECT_EQ(moves(kind, parse_scene(std::string(kArc) + more, "a.toml")), does) << more;
  EXPECT_TRUE(moves(kind, parse_scene(std::string(kNoise) + "noise_lifetime_s = 5\n", "a.toml")));
}

}  // namespace
}  // namespace vegard::sim::moving_footprint_test
