#include "sim/light/air/msis_air.h"

#include <cmath>
#include <cstddef>

#include <fmt/format.h>

#include "sim/base/error.h"
#include "sim/base/utc_time.h"

namespace vegard::sim {
namespace {

constexpr double kSecondsPerDay = 86400.0, kSecondsPerHour = 3600.0, kDegreesPerHour = 15.0;
constexpr const char* kStandardName = "us76";

NamedConditions midnight(const char* name, const char* day, double f107, double ap) {
  // Midnight by the mean Sun at 212 E is 9 h 52 min UT.
  AirConditions conditions;
  conditions.utc_s = utc_seconds(std::string(day) + "T09:52:00Z").value();
  conditions.latitude_deg = 65.0;
  conditions.longitude_deg = -148.0;
  conditions.f107 = conditions.f107a = f107;
  conditions.ap = ap;
  return {name, conditions};
}

}  // namespace

MsisDrivers msis_drivers(const AirConditions& conditions) {
  MsisDrivers drivers;
  const double day = std::floor(conditions.utc_s / kSecondsPerDay);
  const std::string year = utc_text(conditions.utc_s).substr(0, 4);
  const double new_year = std::floor(utc_seconds(year + "-01-01T00:00:00Z").value() / kSecondsPerDay);
  drivers.day_of_year = 1.0 + day - new_year;
  drivers.ut_s = conditions.utc_s - day * kSecondsPerDay;
  drivers.latitude_deg = conditions.latitude_deg;
  drivers.longitude_deg = conditions.longitude_deg;
  const double hours = drivers.ut_s / kSecondsPerHour + conditions.longitude_deg / kDegreesPerHour;
  drivers.local_time_h = hours - 24.0 * std::floor(hours / 24.0);
  drivers.f107 = conditions.f107;
  drivers.f107a = conditions.f107a;
  drivers.ap = conditions.ap;
  drivers.ap_history = conditions.ap_history;
  return drivers;
}

MsisModel sound_msis_model(const AirConditions& conditions) {
  MsisModel model(msis_drivers(conditions));
  if (model.sound()) return model;
  throw Error(ErrorKind::usage, "NRLMSISE-00 has no air for " + condition_words(conditions))
      .key("--ap")
      .expected("conditions nearer to those that it was fitted to")
      .hint(
          "at high latitudes its lower thermosphere fails in the greatest storms; it holds up to an Ap of "
          "100 "
          "and a mean flux of 250");
}

std::string condition_words(const AirConditions& conditions) {
  const int minutes = static_cast<int>(std::lround(60.0 * msis_drivers(conditions).local_time_h)) % (24 * 60);
  const auto degrees = [](double angle, char positive, char negative) {
    return fmt::format("{:g} {}", std::abs(angle), angle < 0.0 ? negative : positive);
  };
  const double east =
      conditions.longitude_deg > 180.0 ? conditions.longitude_deg - 360.0 : conditions.longitude_deg;
  std::string words =
      fmt::format("{}, {} {}, {:02}:{:02} local time, F10.7 {:g}, mean {:g}, ", utc_text(conditions.utc_s),
                  degrees(conditions.latitude_deg, 'N', 'S'), degrees(east, 'E', 'W'), minutes / 60,
                  minutes % 60, conditions.f107, conditions.f107a);
  if (!conditions.ap_history) return words + fmt::format("Ap {:g}", conditions.ap);
  words += "ap";
  for (const double ap : *conditions.ap_history) words += fmt::format(" {:g}", ap);
  return words;
}

std::vector<double> air_altitudes(double bottom_km, double top_km) {
  std::vector<double> altitudes = {bottom_km};
  for (double next = std::floor(bottom_km) + 1.0; next < top_km; next += next < 150.0   ? 1.0
                                                                         : next < 200.0 ? 2.0
                                                                                        : 5.0)
    altitudes.push_back(next);
  altitudes.push_back(top_km);
  return altitudes;
}

AirTable msis_air(const AirConditions& conditions, double bottom_km, double top_km) {
  constexpr std::array<MsisGas, kGases> kOrder = {MsisGas::n2, MsisGas::o2, MsisGas::o};
  const MsisModel model = sound_msis_model(conditions);
  AirTable table;
  table.altitude_km = air_altitudes(bottom_km, top_km);
  for (const double altitude : table.altitude_km) {
    const MsisAir air = model.at(altitude);
    table.temperature_k.push_back(air.temperature_k);
    for (std::size_t g = 0; g < kGases; ++g) table.density_cm3[g].push_back(air.of(kOrder[g]));
    table.n_cm3.push_back(air.of(MsisGas::n));
  }
  return table;
}

const std::vector<NamedConditions>& named_conditions() {
  static const std::vector<NamedConditions> all = {
      midnight("winter_quiet", "2014-12-21", 75.0, 4.0), midnight("winter_active", "2014-12-21", 200.0, 50.0),
      midnight("equinox", "2014-03-21", 150.0, 20.0), midnight("summer_quiet", "2014-06-21", 75.0, 4.0),
      midnight("summer_active", "2014-06-21", 200.0, 50.0)};
  return all;
}

std::vector<std::string> air_names() {
  std::vector<std::string> names = {kStandardName};
  for (const NamedConditions& named : named_conditions()) names.push_back(named.name);
  return names;
}

std::optional<AirTable> named_air(const std::string& name) {
  if (name == kStandardName) return standard_air_table();
  for (const NamedConditions& named : named_conditions())
    if (name == named.name) return msis_air(named.conditions);
  return std::nullopt;
}

}  // namespace vegard::sim
