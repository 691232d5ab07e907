// Bands in which the Sun is looked at: ultraviolet lines of its corona, two lines of the visible corona, and
// white light. A part of emission_lines().
#pragma once

#include <optional>
#include <vector>

#include "sim/scene/lines/emission_line.h"

namespace vegard::sim {

/// Light of a line by the temperature of what shines, relative to its highest:
///   exp(-1/2 ((log10 T - peak_log_k) / width_log_k)²).
/// It stands for the line's contribution function, whose peak is where its ion is most abundant in ionisation
/// equilibrium and whose width over half its height is some 0.2 to 0.4 of log10 T, 2.35 width_log_k.
struct TemperatureResponse {
  double peak_log_k, width_log_k;
  const char* source;  ///< of the peak
};

std::vector<EmissionLine> solar_lines();

/// None for white light, which free electrons scatter at any temperature, and for all other lines.
std::optional<TemperatureResponse> temperature_response(double wavelength_nm);

/// Whether a line is one of those.
bool is_solar(const EmissionLine& line);

}  // namespace vegard::sim
