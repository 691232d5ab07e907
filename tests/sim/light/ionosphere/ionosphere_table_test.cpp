#include "sim/light/ionosphere/ionosphere_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "sim/base/number/constants.h"
#include "sim/base/number/distributions.h"
#include "sim/base/number/random.h"

namespace vegard::sim::ionosphere_table_test {
namespace {

const IonosphereModel& model() {
  static const IonosphereModel made(emission_tables("vegard"), {});
  return made;
}

const IonosphereTable& table() {
  static const IonosphereTable made(model(), {0.5, 10.0, 0.05, 60.0}, 0, 1);
  return made;
}

TEST(IonosphereTable, IsTheIonosphereBetweenItsNodes) {
  for (const double energy : {0.61, 1.83, 5.3, 9.1})
    for (const double flux : {0.08, 1.7, 23.0}) {
      const Ionosphere direct = model().at(energy, flux);
      const ElectronEstimate electrons{energy, flux};
      const IonosphereEstimate found = table().at(electrons);
      EXPECT_NEAR(found.pedersen_s.value / direct.pedersen_s, 1.0, 0.01) << energy << " " << flux;
      EXPECT_NEAR(found.hall_s.value / direct.hall_s, 1.0, 0.01) << energy << " " << flux;
      EXPECT_NEAR(found.peak_cm3.value / direct.peak_cm3, 1.0, 0.01) << energy << " " << flux;
      EXPECT_NEAR(found.peak_km.value, direct.peak_km, 0.5) << energy << " " << flux;
      const std::vector<KnownNumber> density = table().profile(electrons, IonosphereNumber::electrons);
      for (std::size_t a = 0; a < density.size(); ++a) {
        const double here = direct.ions[a].electrons;
        if (here > 0.1 * direct.peak_cm3 && table().altitudes_km()[a] >= 85.0) {
          EXPECT_NEAR(density[a].value / here, 1.0, 0.01) << energy << " " << table().altitudes_km()[a];
        }
      }
    }
}

// Of electrons known to 15 % and 20 %, drawn about what is found, the conductances are within one standard
// deviation as often as a normal number is: 400 draws of seed 3 leave 2.3 % of 68 %.
TEST(IonosphereTable, HasErrorsThatHold) {
  constexpr std::uint64_t kSeed = 3;
  constexpr int kDraws = 400;
  const double ln_energy = 0.15, relative = 0.2, correlation = -0.4;
  int pedersen = 0, hall = 0, peak = 0;
  const Ionosphere truth = model().at(3.0, 5.0);
  for (std::uint32_t d = 0; d < kDraws; ++d) {
    const Words words = random_words(kSeed, Stream::physics, d, 0, 0);
    const double first = normal_quantile(uniform(words[0])), second = normal_quantile(uniform(words[1]));
    const double energy = 3.0 * std::exp(ln_energy * first),
                 flux = 5.0 * std::exp(relative * (correlation * first +
                                                   std::sqrt(1.0 - correlation * correlation) * second));
    const IonosphereEstimate found = table().at({energy, flux, ln_energy, relative, correlation});
    pedersen += std::abs(found.pedersen_s.value - truth.pedersen_s) < found.pedersen_s.sigma;
    hall += std::abs(found.hall_s.value - truth.hall_s) < found.hall_s.sigma;
    peak += std::abs(found.peak_km.value - truth.peak_km) < found.peak_km.sigma;
  }
  for (const int held : {pedersen, hall, peak}) {
    EXPECT_GT(held, 0.61 * kDraws);
    EXPECT_LT(held, 0.75 * kDraws);
  }
}

TEST(IonosphereTable, SaysWhatIsNotKnown) {
  EXPECT_TRUE(std::isnan(table().at({kNaN, 3.0, 0.1, 0.1}).pedersen_s.value));
  EXPECT_TRUE(std::isnan(table().at({3.0, kNaN, 0.1, 0.1}).hall_s.value));
  EXPECT_TRUE(std::isnan(table().at({3.0, 3.0, kNaN, 0.1}).hall_s.sigma));
  const IonosphereEstimate dark = table().at({kNaN, 0.0, kNaN, kNaN});
  EXPECT_EQ(dark.pedersen_s.value, 0.0);
  EXPECT_TRUE(std::isnan(dark.pedersen_s.sigma));
  EXPECT_TRUE(std::isnan(dark.peak_km.value));
}

// A point has derivatives too, by a table about it; physics adds to the error and not to the value.
TEST(IonosphereTable, OfAPointHasTheUncertaintyOfPhysics) {
  const IonosphereTable exact(model(), {3.0, 3.0, 5.0, 5.0}, 0, 1),
      drawn(model(), {3.0, 3.0, 5.0, 5.0}, 12, 1);
  const ElectronEstimate electrons{3.0, 5.0, 0.1, 0.1};
  const IonosphereEstimate without = exact.at(electrons), with = drawn.at(electrons);
  EXPECT_EQ(without.hall_s.value, with.hall_s.value);
  EXPECT_NEAR(without.hall_s.value / model().at(3.0, 5.0).hall_s, 1.0, 1e-3);
  EXPECT_EQ(without.hall_physics_sigma, 0.0);
  EXPECT_NEAR(std::hypot(without.hall_s.sigma, with.hall_physics_sigma) / with.hall_s.sigma, 1.0, 1e-9);
  // Recombination and densities are known to some 15 %, and so are conductances.
  EXPECT_GT(with.pedersen_physics_sigma / with.pedersen_s.value, 0.03);
  EXPECT_LT(with.pedersen_physics_sigma / with.pedersen_s.value, 0.4);
}

// Where there is nothing, nothing has no error of 0.
TEST(IonosphereTable, HasNoErrorOfWhatIsNotThere) {
  const std::vector<KnownNumber> n2p = table().profile({3.0, 5.0, 0.1, 0.1}, IonosphereNumber::n2p);
  const Ionosphere direct = model().at(3.0, 5.0);
  int absent = 0;
  for (std::size_t a = 0; a < n2p.size(); ++a) {
    if (direct.ions[a].n2p > 0.5) continue;
    ++absent;
    EXPECT_EQ(n2p[a].value, 0.0) << table().altitudes_km()[a];
    EXPECT_TRUE(std::isnan(n2p[a].sigma)) << table().altitudes_km()[a];
  }
  EXPECT_GT(absent, 0);
}

// Other draws of physics are within one standard deviation as often as a normal number is: 200 draws of seed
// 7 leave 3.3 % of 68 %, and 64 draws leave the standard deviation itself known to an eighth.
TEST(IonosphereTable, HasErrorsThatHoldOtherPhysics) {
  const IonosphereTable drawn(model(), {3.0, 3.0, 5.0, 5.0}, IonosphereTable::kUsualDraws, 1);
  const IonosphereEstimate found = drawn.at({3.0, 5.0, 0.0, 0.0});
  constexpr std::uint32_t kDraws = 200;
  int pedersen = 0, hall = 0, peak = 0;
  for (std::uint32_t d = 0; d < kDraws; ++d) {
    const Ionosphere other = model().drawn(3.0, 5.0, 7, d, 2);
    pedersen += std::abs(other.pedersen_s - found.pedersen_s.value) < found.pedersen_s.sigma;
    hall += std::abs(other.hall_s - found.hall_s.value) < found.hall_s.sigma;
    peak += std::abs(other.peak_cm3 - found.peak_cm3.value) < found.peak_cm3.sigma;
  }
  for (const int held : {pedersen, hall, peak}) {
    EXPECT_GT(held, 0.55 * kDraws);
    EXPECT_LT(held, 0.80 * kDraws);
  }
}

// Some time after the onset, without electrons from above there are the night's own ions.
TEST(IonosphereTable, KeepsTheNightWithoutFlux) {
  IonosphereRequest request;
  request.seconds = 60.0;
  const IonosphereModel in_time(emission_tables("vegard"), request);
  const IonosphereTable of_time(in_time, {2.0, 2.0, 1e-4, 1.0}, 0, 1);
  const IonosphereEstimate dark = of_time.at({kNaN, 0.0, kNaN, kNaN});
  EXPECT_GT(dark.pedersen_s.value, 0.01);
  EXPECT_LT(dark.pedersen_s.value, 1.0);
  const IonosphereEstimate lit = of_time.at({2.0, 1.0, 0.1, 0.1});
  EXPECT_GT(lit.pedersen_s.value, 5.0 * dark.pedersen_s.value);
  // The night's layer is assumed: it is no largest density that anybody knows.
  EXPECT_TRUE(std::isnan(dark.peak_cm3.value));
  EXPECT_LT(lit.peak_km.value, 150.0);
  // Its error is the factor of 3.
  const IonosphereTable drawn(in_time, {2.0, 2.0, 1e-4, 1.0}, 64, 1);
  std::size_t high = 0;
  while (drawn.altitudes_km()[high] < 300.0) ++high;
  const KnownNumber night = drawn.profile({2.0, 1e-4, 0.0, 0.0}, IonosphereNumber::electrons)[high];
  EXPECT_NEAR(night.value, 1e5, 1e4);
  // The aurora's peak does not go to the night's layer where that is drawn dense.
  EXPECT_LT(drawn.at({2.0, 1.0, 0.0, 0.0}).peak_km.sigma, 10.0);
  EXPECT_GT(night.sigma, 0.6 * night.value);  // 64 draws of a deviation of 1.1 leave a tenth
}

}  // namespace
}  // namespace vegard::sim::ionosphere_table_test
