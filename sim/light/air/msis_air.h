// The air for electrons to come down through, for a place, a time and an activity.
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

/// The model for them. Throws Error(usage), key "--ap", if it is not sound (MsisModel::sound()).
MsisModel sound_msis_model(const AirConditions& conditions);

/// Local time is that of the mean Sun: the coefficients know the season, not the equation of time.
MsisDrivers msis_drivers(const AirConditions& conditions);

/// "2014-03-10T06:05:33Z, 65 N 148 W, 20:14 local time, F10.7 150, mean 140, Ap 20".
std::string condition_words(const AirConditions& conditions);

/// From `bottom_km` to `top_km`, both in it: 1 km apart below 150 km, 2 km below 200 km, 5 km above. Straight
/// lines between the logarithms of densities there are within 0.2 % of the model, below 100 km (O) 1 %.
std::vector<double> air_altitudes(double bottom_km, double top_km);

inline constexpr double kAirBottomKm = 75.0,
                        kAirTopKm = 640.0;  ///< of the transport, as standard_air_table()

/// sound_msis_model() at these altitudes.
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

/// The names of all air that is built in: "us76" and those above.
std::vector<std::string> air_names();

/// That of a name; nothing for what is none.
std::optional<AirTable> named_air(const std::string& name);

}  // namespace vegard::sim
