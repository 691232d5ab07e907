// The output of `vegard atmosphere`: the air of a place and time as a table, and as text.
#pragma once

#include <string>
#include <vector>

#include "sim/light/air/msis_air.h"

namespace vegard::apps {

/// The model's air at altitudes, from the bottom up.
struct AirColumn {
  sim::AirConditions conditions;
  std::vector<double> altitude_km;
  std::vector<sim::MsisAir> air;
};

/// Computes the air. Throws Error(usage) where the model is not valid.
AirColumn air_column(const sim::AirConditions& conditions, double bottom_km, double top_km);

/// CSV that sim::read_air_table() reads: conditions in comments; altitude_km, T_K, densities in cm^-3, mass.
std::string air_csv(const AirColumn& column);

/// Lines of text: conditions, temperatures, the altitude above which O is more abundant than N2.
std::string air_text(const AirColumn& column);

/// The same as JSON, with the densities of the gases at the bottom and the top.
std::string air_json(const AirColumn& column);

/// The named conditions, a line each, and as JSON.
std::string named_conditions_text();
std::string named_conditions_json();

}  // namespace vegard::apps
