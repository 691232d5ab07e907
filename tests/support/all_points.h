// All the points of a scene in one list.
#pragma once

#include <gtest/gtest.h>

#include "sim/render/beams/points.h"
#include "sim/scene/structs/scene.h"

namespace vegard::tests {

inline sim::EmissionPoints all_points(const sim::Scene& scene, int every = 1, int threads = 0) {
  sim::EmissionPoints all;
  all.lines = static_cast<int>(scene.emission.lines.size());
  sim::PointOptions options;
  options.every = every;
  options.threads = threads;
  const std::uint64_t count = sim::stream_points(scene, options, [&](const sim::EmissionPoints& some) {
    EXPECT_EQ(some.lines, all.lines);
    all.position_in_enu_km.insert(all.position_in_enu_km.end(), some.position_in_enu_km.begin(),
                                  some.position_in_enu_km.end());
    all.photons_per_s.insert(all.photons_per_s.end(), some.photons_per_s.begin(), some.photons_per_s.end());
  });
  EXPECT_EQ(count, all.size());
  EXPECT_EQ(all.photons_per_s.size(), all.size() * all.lines);
  return all;
}

}  // namespace vegard::tests
