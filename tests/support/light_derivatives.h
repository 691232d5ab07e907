// Derivatives of an emitter's light beside differences of its light.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "tests/support/sun_rays.h"

namespace vegard::tests {

/// Of one line, along rays through the places (0, right, up) of level_sun(distance): the tangents of `dual`
/// by the numbers, in their order, against central differences of the emitters that make() makes once they
/// are changed. Returns how many rays are lit.
inline int expect_light_derivatives(const sim::Emitter<sim::FreeDual>& dual,
                                    const std::vector<double*>& numbers,
                                    const std::function<std::unique_ptr<sim::Emitter<double>>()>& make,
                                    double distance, const std::vector<std::array<double, 2>>& places,
                                    double cell_rad) {
  std::vector<sim::FreeDual> lights;
  int lit = 0;
  for (const auto& [right, up] : places) {
    const double length = std::sqrt(right * right + up * up + distance * distance);
    const sim::FreeDual d[3] = {right / length, distance / length, up / length};
    sim::FreeDual light(0.0), kept(1.0);
    double end = std::numeric_limits<double>::infinity(), entry = end, depth = end;
    dual.march({1, {&d[0], &d[1], &d[2]}, &end, cell_rad}, {1, &light, &kept, &entry, &depth});
    lights.push_back(light);
    lit += light.v > 0.0;
  }
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double was = *numbers[i], step = 1e-6 * std::max(1.0, was);
    *numbers[i] = was + step;
    const auto more = make();
    *numbers[i] = was - step;
    const auto less = make();
    *numbers[i] = was;
    for (std::size_t k = 0; k < places.size(); ++k) {
      const auto of = [&](const sim::Emitter<double>& emitter) {
        return sun_ray(emitter, distance, places[k][0], places[k][1], cell_rad).rayleigh;
      };
      const double difference = (of(*more) - of(*less)) / (2.0 * step);
      EXPECT_NEAR(lights[k].d.t[i], difference, 2e-5 * (lights[k].v + std::abs(difference)))
          << "number " << i << " ray " << k;
    }
  }
  return lit;
}

}  // namespace vegard::tests
