#include "fit/track/sgp4.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "sim/base/error.h"
#include "sim/base/utc_time.h"

namespace vegard::fit::sgp4_test {
namespace {

/// A published case: elements, and place and velocity some minutes later.
struct Case {
  const char *first, *second;
  struct At {
    double minutes;
    double km[3], km_s[3];
  };
  std::vector<At> states;
};

// The verification cases of Vallado et al. 2006, AIAA 2006-6753, that are near the Earth: an eccentric orbit,
// moderate drag, the case of Spacetrack Report 3 itself, a perigee below 220 km. They are published to 8
// digits after the point, 10 micrometres; the velocities to a micrometre a second.
const std::vector<Case>& cases() {
  static const std::vector<Case> all = {
      {"1 00005U 58002B   00179.78495062  .00000023  00000-0  28098-4 0  4753",
       "2 00005  34.2682 348.7242 1859667 331.7664  19.3264 10.82419157413667",
       {{0.0, {7022.46529266, -1400.08296755, 0.03995155}, {1.893841015, 6.405893759, 4.534807250}},
        {360.0, {-7154.03120202, -3783.17682504, -3536.19412294}, {4.741887409, -4.151817765, -2.093935425}},
        {4320.0, {-9060.47373569, 4658.70952502, 813.68673153}, {-2.232832783, -4.110453490, -3.157345433}}}},
      {"1 06251U 62025E   06176.82412014  .00008885  00000-0  12808-3 0  3985",
       "2 06251  58.0579  54.0425 0030035 139.1568 221.1854 15.56387291  6774",
       {{0.0, {3988.31022699, 5498.96657235, 0.90055879}, {-3.290032738, 2.357652820, 6.496623475}},
        {120.0, {-3935.69800083, 409.10980837, 5471.33577327}, {-3.374784183, -6.635211043, -1.942056221}},
        {2880.0, {1159.27802897, 5056.60175495, 4353.49418579}, {-5.968060341, -2.314790406, 4.230722669}}}},
      {"1 29238U 06022G   06177.28732010  .00766286  10823-4  13334-2 0   101",
       "2 29238  51.5595 213.7903 0202579  95.2503 267.9010 15.73823839  1061",
       {{0.0, {-5566.59512819, -3789.75991159, 67.60382245}, {2.873759367, -3.825340523, 6.023253926}},
        {1440.0,
         {-2629.55011449, 3400.98040158, -5344.38217129},
         {-6.368548448, -3.998963509, 0.577253064}}}},
      {"1 88888U          80275.98708465  .00073094  13844-3  66816-4 0    87",
       "2 88888  72.8435 115.9689 0086731  52.6988 110.5714 16.05824518  1058",
       {{0.0, {2328.96975262, -5995.22051338, 1719.97297192}, {2.912073281, -0.983417956, -7.090816210}},
        {1440.0, {2742.55398832, -6079.67009123, -326.39012649}, {1.948497651, 1.211072678, -7.356193131}}}}};
  return all;
}

OrbitalElements elements_of(const Case& of) {
  return read_orbital_elements(std::string("NAME\n") + of.first + "\n" + of.second + "\n", "a.tle").front();
}

TEST(Sgp4, IsWherePublishedCasesAre) {
  for (const Case& of : cases()) {
    const Sgp4 orbit(elements_of(of), "a.tle");
    for (const Case::At& at : of.states) {
      const OrbitState state = orbit.at(at.minutes);
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(state.km[i], at.km[i], 2e-7) << of.second << " " << at.minutes;
        EXPECT_NEAR(state.km_s[i], at.km_s[i], 2e-9) << of.second << " " << at.minutes;
      }
    }
  }
}

// The velocity is the place's own change: by differences of a second, to the third power of its share of a
// turn.
TEST(Sgp4, MovesAsItSays) {
  const Sgp4 orbit(elements_of(cases()[1]), "a.tle");
  const OrbitState before = orbit.at(100.0 - 1.0 / 60.0), now = orbit.at(100.0),
                   after = orbit.at(100.0 + 1.0 / 60.0);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(0.5 * (after.km[i] - before.km[i]), now.km_s[i], 1e-5);
}

TEST(Sgp4, ReadsElements) {
  const OrbitalElements of = elements_of(cases()[0]);
  EXPECT_EQ(of.satellite, "00005");
  EXPECT_EQ(sim::utc_text(of.epoch_s), "2000-06-27T18:50:19.734Z");
  EXPECT_DOUBLE_EQ(of.drag, 2.8098e-5);
  EXPECT_DOUBLE_EQ(of.eccentricity, 0.1859667);
  EXPECT_DOUBLE_EQ(of.turns_per_day, 10.82419157);
}

std::string refusal(const std::string& text) {
  try {
    for (const OrbitalElements& of : read_orbital_elements(text, "a.tle")) Sgp4(of, "a.tle").at(0.0);
  } catch (const sim::Error& error) {
    return error.what();
  }
  return "none";
}

TEST(Sgp4, RefusesWhatIsNoOrbitNearTheEarth) {
  const std::string first = cases()[0].first, second = cases()[0].second;
  EXPECT_NE(refusal("nothing\n").find("no elements"), std::string::npos);
  std::string damaged = second;
  damaged[10] = '9';
  EXPECT_NE(refusal(first + "\n" + damaged + "\n").find("a.tle:2"), std::string::npos);
  EXPECT_NE(refusal(second + "\n").find("first line"), std::string::npos);
  EXPECT_NE(refusal(first.substr(0, 60) + "\n").find("60 columns"), std::string::npos);
  // A geostationary one of the same cases.
  EXPECT_NE(refusal("1 28626U 05008A   06176.46683397 -.00000205  00000-0  10000-3 0  2190\n"
                    "2 28626   0.0019 286.9433 0000335  13.7918  55.6504  1.00270176  4891\n")
                .find("1436 minutes"),
            std::string::npos);
}

}  // namespace
}  // namespace vegard::fit::sgp4_test
