#include "sim/light/transport/electron_grid.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vegard::sim::streams_test {
namespace {

TEST(PitchStreams, IntegrateHalvesOfTheSphere) {
  for (const int half : {4, 8}) {
    const Streams directions = pitch_streams(half);
    ASSERT_EQ(directions.half(), static_cast<std::size_t>(half));
    double number = 0.0, down = 0.0;
    for (std::size_t k = 0; k < directions.size(); ++k) {
      number += directions.weight[k];
      if (k < directions.half()) down += directions.weight[k] * directions.cosine[k];
    }
    EXPECT_NEAR(number, 2.0, 1e-12);
    EXPECT_NEAR(down, -0.5, 1e-12);
  }
}

TEST(ElasticTurn, KeepsNumbersAndTheMeanCosine) {
  for (const int half : {4, 8})
    for (const double ratio : {1e-3, 0.05, 0.4, 0.9, 1.0}) {
      const Streams directions = pitch_streams(half);
      const ElasticTurn turn = elastic_turn(directions, ratio);
      const std::size_t n = directions.size();
      for (std::size_t from = 0; from < n; ++from) {
        double number = 0.0, cosine = 0.0;
        for (std::size_t to = 0; to < n; ++to) {
          const double part = directions.weight[to] * turn.into[to * n + from] / directions.weight[from];
          number += part;
          cosine += part * directions.cosine[to];
        }
        EXPECT_NEAR(number, turn.kept, 1e-9) << ratio;
        // With what goes straight on, the mean cosine is 1 - ratio times the one before.
        EXPECT_NEAR(cosine + (1.0 - turn.kept) * directions.cosine[from],
                    (1.0 - ratio) * directions.cosine[from], 1e-8)
            << ratio;
      }
    }
}

TEST(ScatteringMoments, AreTheSameByRecurrenceAndByQuadrature) {
  // At a screening of 0.1 one takes over from the other.
  const double ratio = 0.2 * (1.1 * std::log(11.0) - 1.0);
  const std::vector<double> below = scattering_moments(ratio * (1.0 - 1e-7), 8);
  const std::vector<double> above = scattering_moments(ratio * (1.0 + 1e-7), 8);
  for (std::size_t l = 0; l < below.size(); ++l) EXPECT_NEAR(below[l], above[l], 1e-5) << l;
  EXPECT_EQ(scattering_moments(1.0, 4)[1], 0.0);
}

}  // namespace
}  // namespace vegard::sim::streams_test
