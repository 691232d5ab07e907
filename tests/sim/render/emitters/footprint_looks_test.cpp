// The light of footprints that move lags behind their electrons (docs/physics.md, rows B18 and B26).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "sim/emit/aurora/motion.h"
#include "sim/emit/footprint/map/footprint_map.h"
#include "sim/light/atmosphere.h"
#include "sim/light/excited_atom.h"
#include "sim/render/emitters/footprint_volumes.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/lines/emission_lines.h"

namespace vegard::sim::footprint_looks_test {
namespace {

const std::string kArc =
    "[[footprint]]\ncenter_km = [0, 0]\nsize_km = [300, 300]\ncell_km = 2\n"
    "east_km = [-100, 100]\nnorth_km = [10, 40]\nwidth_km = 12\n";
const std::string kDrift = "drift_km_s = [0.3, 0.4]\n";

Scene scene_of(const std::string& text) { return parse_scene(text, "a.toml"); }

std::vector<FootprintLook> looks_of(const Scene& scene) {
  return footprint_looks(scene, scene.footprints[0]);
}

double part(const FootprintLook& look, std::size_t line, int altitude) {
  return look.share * (look.of_lines.empty() ? 1.0 : look.of_lines[line][altitude]);
}

double tau_s(const Scene& scene, std::size_t line, int altitude) {
  return effective_lifetime_s(*find_emission_line(scene.emission.lines[line]),
                              standard_air(HeightProfile::altitude_km(altitude)));
}

int at_altitude(double km) {
  int a = 0;
  while (HeightProfile::altitude_km(a) < km) ++a;
  return a;
}

TEST(FootprintLooks, AreOneWithoutAPastWhereNothingChanges) {
  for (const std::string& text :
       {kArc, kArc + kDrift + "[emission]\nlag = \"none\"\n", kArc + kDrift + "light = \"colours\"\n"}) {
    const std::vector<FootprintLook> looks = looks_of(scene_of(text));
    ASSERT_EQ(looks.size(), 1u) << text;
    EXPECT_EQ(looks[0].share, 1.0);
    EXPECT_TRUE(looks[0].of_lines.empty());
  }
}

// Light is moved in time, none is made or lost: single precision, and as many sums as there are looks.
TEST(FootprintLooks, AddUpToTheWholeLightOfEveryLineAtEveryAltitude) {
  for (const std::string& text :
       {kArc + kDrift, kArc + kDrift + "[time]\nexposure_s = 30\ninstants = 5\n",
        kArc + "flow_turns_per_s = 0.1\n", kArc + kDrift + "model = \"curtain\"\n",
        std::string("[[footprint]]\nshape = \"shell\"\nface_cells = 64\nlatitude_deg = [66, 67]\n"
                    "longitude_deg = [-8, 8]\nwidth_km = 200\ndrift_km_s = [0.5, 0]\n")}) {
    const Scene scene = scene_of(text);
    const std::vector<FootprintLook> looks = looks_of(scene);
    ASSERT_GT(looks.size(), 2u) << text;
    for (std::size_t l = 0; l < scene.emission.lines.size(); ++l)
      for (int a = 0; a < HeightProfile::kAltitudes; a += 20) {
        double sum = 0.0;
        for (const FootprintLook& look : looks) sum += part(look, l, a);
        EXPECT_NEAR(sum, 1.0, 1e-5) << text << " line " << l;
      }
  }
}

// The mean age of light is its atoms' effective lifetime. An interval of age that doubles counts evenly in
// the logarithm: its mean is 1/ln 2 = 1.443 times its start, between 1.33 and 1.5 of what an exponential has
// there; the first, a sixteenth of the 24 s in which the arc drifts over its width, counts as none.
TEST(FootprintLooks, AreOnAverageAsOldAsTheAtomsThatShine) {
  const Scene scene = scene_of(kArc + kDrift + "[time]\nstart_s = 1000\n");
  const std::vector<FootprintLook> looks = looks_of(scene);
  for (std::size_t l = 0; l < scene.emission.lines.size(); ++l) {
    if (is_prompt(*find_emission_line(scene.emission.lines[l]))) continue;
    for (const double km : {180.0, 220.0, 260.0, 299.0}) {
      const int a = at_altitude(km);
      const double tau = tau_s(scene, l, a);
      double mean = 0.0;
      for (const FootprintLook& look : looks)
        for (const double instant : look.instants_s)
          mean += part(look, l, a) / static_cast<double>(look.instants_s.size()) * (1000.0 - instant);
      EXPECT_NEAR(mean, tau, 0.06 * tau + 1.5) << scene.emission.lines[l] << " nm at " << km << " km";
    }
  }
}

/// When a line's light of an altitude began, on average, and the share of it that there is.
std::pair<double, double> mean_instant_s(const Scene& scene, std::size_t line, int altitude) {
  double sum = 0.0, share = 0.0;
  for (const FootprintLook& look : looks_of(scene))
    for (const double instant : look.instants_s) {
      const double here = part(look, line, altitude) / static_cast<double>(look.instants_s.size());
      sum += here * instant;
      share += here;
    }
  return {sum / share, share};
}

// Light of an exposure is that of its instants on average: their past has the mean age of that of one
// instant, to some per cent of it (where looks lie in an interval of age goes by their number).
TEST(FootprintLooks, CountEachInstantOfAnExposureAlike) {
  const std::string shell =
      "[[footprint]]\nshape = \"shell\"\nface_cells = 64\nlatitude_deg = [66, 67]\n"
      "longitude_deg = [-8, 8]\nwidth_km = 200\ndrift_km_s = [0.5, 0]\n";
  for (const std::string& text : {kArc + "drift_km_s = [2, 2]\n", kArc + kDrift + "model = \"curtain\"\n",
                                  kArc + kDrift + "flow_turns_per_s = 0.01\n", shell})
    for (const int instants : {2, 3, 5, 8, 20, 70}) {
      const Scene one = scene_of(text),
                  all = scene_of(text + "[time]\nexposure_s = 2000\ninstants = " + std::to_string(instants));
      const double middle_s = 1000.0 * (instants - 1) / instants;
      for (std::size_t l = 0; l < one.emission.lines.size(); ++l)
        for (const double km : {120.0, 220.0, 299.0}) {
          const int a = at_altitude(km);
          const auto [mean_s, share] = mean_instant_s(all, l, a);
          const double age_s = -mean_instant_s(one, l, a).first;
          EXPECT_NEAR(share, 1.0, 1e-5);
          EXPECT_NEAR(mean_s, middle_s - age_s, 0.04 * age_s + 0.5)
              << text << instants << " instants, line " << l << " at " << km << " km";
        }
    }
}

// Old light of an early instant is there as well as old light of a late one: in each interval of age the
// looks reach nearly over the exposure and the interval together. Were the oldest before the last instant,
// and the youngest before the first, they would reach over the difference of the two only.
TEST(FootprintLooks, HaveEachAgeBeforeEachPartOfAnExposure) {
  for (const std::string& text : {kArc + kDrift, kArc + kDrift + "model = \"curtain\"\n"})
    for (const int instants : {8, 16, 32}) {
      const Scene scene = scene_of(text + "[time]\nexposure_s = 30\ninstants = " + std::to_string(instants));
      const Footprint& f = scene.footprints[0];
      const AgeIntervals ages(scene, f.top_km, soonest_change_s(scene, f));
      const double exposure_s = 30.0 * (instants - 1) / instants;
      std::vector<std::vector<double>> of_age(static_cast<std::size_t>(ages.count()));
      const std::vector<LightShare> shares = ages.shares();
      for (const FootprintLook& look : looks_of(scene))
        for (std::size_t age = 1; age < of_age.size(); ++age)
          if (look.of_lines == shares[age])
            of_age[age].insert(of_age[age].end(), look.instants_s.begin(), look.instants_s.end());
      for (int age = 1; age < ages.count(); ++age) {
        const std::vector<double>& then = of_age[static_cast<std::size_t>(age)];
        ASSERT_GE(then.size(), 8u);
        const auto [first, last] = std::minmax_element(then.begin(), then.end());
        const double age_s = ages.age_s(age, 1.0) - ages.age_s(age, 0.0);
        EXPECT_GT(*last - *first, 0.7 * (exposure_s + age_s)) << text << instants << " age " << age;
      }
    }
}

// One map goes no further than the footprint is long, wherever instants lie.
TEST(FootprintLooks, HaveMapsOfABoundedSize) {
  for (const int instants : {1, 2, 3, 8}) {
    const Scene scene = scene_of(
        kArc + "drift_km_s = [2, 2]\n[time]\nexposure_s = 4000\ninstants = " + std::to_string(instants));
    const std::vector<FootprintLook> looks = looks_of(scene);
    double numbers = 0.0;
    for (const FootprintLook& look : looks) {
      const auto [first, last] = std::minmax_element(look.instants_s.begin(), look.instants_s.end());
      EXPECT_LE(std::hypot(2.0, 2.0) * (*last - *first), 300.0);
      numbers += look.instants_s.size() > 1 ? 4.0 : 1.0;  // twice as long and wide at most
    }
    // 150 by 150 cells of 8 bytes, and a cell of margin each way.
    EXPECT_LE(map_bytes(scene, scene.footprints[0], sizeof(double)), numbers * 152.0 * 152.0 * 8.0);
    EXPECT_GE(map_bytes(scene, scene.footprints[0], sizeof(double)), looks.size() * 150.0 * 150.0 * 8.0);
  }
}

// After a step of the electrons' flux, within a second, of 557.7 and 630.0 nm 1 - exp(-t/tau) is there.
TEST(FootprintLooks, RiseAfterAStepAsExcitedAtomsDo) {
  for (const double since_s : {2.0, 20.0, 60.0, 200.0}) {
    const Scene scene =
        scene_of(kArc +
                 "[substorm]\nquiet = 0\ngrown = 0\nonset_s = -0.5\ngrowth_s = 1\nexpansion_s = 1\n"
                 "recovery_s = 1e6\n[time]\nstart_s = " +
                 std::to_string(since_s) + "\n");
    const std::vector<FootprintLook> looks = looks_of(scene);
    ASSERT_EQ(looks.size(), 1u);
    for (std::size_t l = 0; l < scene.emission.lines.size(); ++l) {
      const bool at_once = is_prompt(*find_emission_line(scene.emission.lines[l]));
      for (const double km : {120.0, 200.0, 280.0}) {
        const int a = at_altitude(km);
        const double want = at_once ? 1.0 : 1.0 - std::exp(-since_s / tau_s(scene, l, a));
        // Eight looks evenly in the logarithm of an interval that doubles.
        EXPECT_NEAR(part(looks[0], l, a), want, 0.03)
            << scene.emission.lines[l] << ' ' << km << ' ' << since_s;
      }
    }
  }
}

TEST(MeanOf, KeepsFluxAndCentreOfWhatIsShifted) {
  PlaneFootprint<double> plane;
  plane.west_km = -3.0;
  plane.south_km = 5.0;
  plane.cell_km = 2.0;
  plane.grid = {3, 2, {1.0, 2.0, 0.0, 0.5, 0.0, 4.0}, {0.1, 0.2, 0.0, 0.3, 0.0, 0.4}};
  const std::vector<EastNorth> corners{{-3.0, 5.0}, {1.7, 4.1}, {12.3, 9.9}};
  const PlaneFootprint<double> mean = mean_of<double>({plane}, corners);
  const auto moments = [](const PlaneFootprint<double>& of) {
    std::vector<double> m(4, 0.0);
    for (int r = 0; r < of.grid.rows; ++r)
      for (int c = 0; c < of.grid.columns; ++c) {
        const std::size_t i = static_cast<std::size_t>(r) * of.grid.columns + c;
        const double flux = of.grid.flux_mw_m2[i];
        m[0] += flux;
        m[1] += flux * (of.west_km + (c + 0.5) * of.cell_km);
        m[2] += flux * (of.south_km + (r + 0.5) * of.cell_km);
        m[3] += flux * of.grid.ln_energy[i];
      }
    return m;
  };
  const std::vector<double> one = moments(plane), all = moments(mean);
  double east = 0.0, north = 0.0;
  for (const EastNorth& corner : corners) {
    east += (corner.east - plane.west_km) / 3.0;
    north += (corner.north - plane.south_km) / 3.0;
  }
  EXPECT_NEAR(all[0], one[0], 1e-12);
  EXPECT_NEAR(all[1], one[1] + one[0] * east, 1e-11);
  EXPECT_NEAR(all[2], one[2] + one[0] * north, 1e-11);
  EXPECT_NEAR(all[3], one[3], 1e-12);
}

}  // namespace
}  // namespace vegard::sim::footprint_looks_test
