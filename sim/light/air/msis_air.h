// The air through which electrons fall, at a place and time and for a solar and magnetic activity.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "sim/light/air/msis_model.h"
#include "sim/light/transport/field_air.h"

namespace vegard::sim {

/// Fluxes in 10^-22 W m^-2 Hz^-1. `ap_history` as in MsisDrivers.
struct AirConditions {
  double utc_s = 0.0;  ///< seconds since 1970 (sim/base/utc_time.h)
  double latitude_deg = 0.0, longitude_deg = 0.0;
  double f107 = 150.0;   ///< of the day before
  double f107a = 150.0;  ///< mean of the 81 days about the day
  double ap = 4.0;       ///< of the day
  std::optional<std::array<double, 7>> ap_history;
};

/// Returns the model for these conditions. Throws Error(usage), key "--ap", if it is not sound
/// (MsisModel::sound()).
MsisModel sound_msis_model(const AirConditions& conditions);

/// Returns the model's inputs. Local time is that of the mean Sun: the coefficients depend on the season, not
/// on the equation of time.
MsisDrivers msis_drivers(const AirConditions& conditions);

/// Returns "2014-03-10T06:05:33Z, 65 N 148 W, 20:14 local time, F10.7 150, mean 140, Ap 20".
std::string condition_words(const AirConditions& conditions);

/// Returns altitudes from `bottom_km` to `top_km`, including both: 1 km apart below 150 km, 2 km below 200
/// km, 5 km above. Linear interpolation of the logarithms of densities between them is within 0.2 % of the
/// model, below 100 km (O) within 1 %.
std::vector<double> air_altitudes(double bottom_km, double top_km);

inline constexpr double kAirBottomKm = 75.0,
                        kAirTopKm = 640.0;  ///< of the transport, as standard_air_table()

/// Returns the air of sound_msis_model() at air_altitudes().
AirTable msis_air(const AirConditions& conditions, double bottom_km = kAirBottomKm,
                  double top_km = kAirTopKm);

/// Conditions that have a name: midnight by the mean Sun at 65 N 212 E. The numbers are round ones for quiet,
/// middling and disturbed days near the minimum, the mean and the maximum of a solar cycle; "equinox" is what
/// GLOW's tables were made for, but for 8 minutes.
struct NamedConditions {
  std::string name;  ///< "winter_quiet"
  AirConditions conditions;
};
const std::vector<NamedConditions>& named_conditions();

/// Returns the names of all air that is built in: "us76" and those of named_conditions().
std::vector<std::string> air_names();

/// Returns the air of such a name; nothing for another name.
std::optional<AirTable> named_air(const std::string& name);

}  // namespace vegard::sim
