// The bands of solar pictures: ultraviolet lines of the corona, two visible lines of the corona, and white
// light. A part of emission_lines().
#pragma once

#include <optional>
#include <vector>

#include "sim/scene/lines/emission_lines.h"

namespace vegard::sim {

/// Light of a line as a function of the temperature of the plasma, relative to its maximum:
///   exp(-1/2 ((log10 T - peak_log_k) / width_log_k)²).
/// It approximates the line's contribution function, which peaks where the line's ion is most abundant in
/// ionisation equilibrium. The full width at half maximum, 2.35 width_log_k, is 0.2 to 0.4 in log10 T.
struct TemperatureResponse {
  double peak_log_k, width_log_k;
  const char* source;  ///< reference for the peak
};

std::vector<EmissionLine> solar_lines();

/// Returns nothing for white light, which free electrons scatter at any temperature, and for other lines.
std::optional<TemperatureResponse> temperature_response(double wavelength_nm);

/// True if the line is one of solar_lines().
bool is_solar(const EmissionLine& line);

}  // namespace vegard::sim
