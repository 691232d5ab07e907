// The light of density 1 per unit of path and emission line, of emitters on the Sun.
#pragma once

#include <cmath>
#include <vector>

#include "sim/light/emitter.h"
#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Returns the factor on a line's light at a temperature in MK, above 0 (sim/scene/lines/emission_lines.h).
template <class T>
T response_at(const TemperatureResponse& response, const T& temperature_mk) {
  const T off = (logarithm(temperature_mk) * (1.0 / std::log(10.0)) + (6.0 - response.peak_log_k)) *
                (1.0 / response.width_log_k);
  return exponential(off * off * -0.5);
}

/// Returns `rayleigh`, per line of the scene (or empty: dark). If the temperature in MK is not 0, lines with
/// a response to temperature are multiplied by it (sim/scene/lines/emission_lines.h).
template <class T>
std::vector<T> line_light(const Scene& scene, const std::vector<double>& rayleigh,
                          const double& temperature_mk, const NumberAs<T>& number) {
  std::vector<T> light;
  for (std::size_t l = 0; l < rayleigh.size(); ++l) {
    T of_line = number(rayleigh[l]);
    const auto response = temperature_response(scene.emission.lines[l]);
    if (response && temperature_mk > 0.0) of_line = of_line * response_at(*response, number(temperature_mk));
    light.push_back(of_line);
  }
  return light;
}

}  // namespace vegard::sim
