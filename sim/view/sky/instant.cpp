#include "sim/view/sky/instant.h"

#include <cmath>

#include "sim/base/utc_time.h"

namespace vegard::sim {
namespace {

constexpr double kJulianDateOf1970 = 2440587.5;
constexpr double kInstantSecondsPerDay = 86400.0;

}  // namespace

std::optional<double> julian_date(const std::string& utc) {
  const std::optional<double> seconds = utc_seconds(utc);
  if (!seconds) return std::nullopt;
  return kJulianDateOf1970 + *seconds / kInstantSecondsPerDay;
}

std::string text_of_julian_date(double julian_date) {
  return utc_text(std::round((julian_date - kJulianDateOf1970) * kInstantSecondsPerDay));
}

double mean_sidereal_time_deg(double julian_date) {
  const double days = julian_date - kJ2000, t = days / kDaysPerCentury;
  // The whole turns of the days are taken out first: they would cost digits.
  const double turned = 280.46061837 + 360.0 * std::fmod(days, 1.0) + 0.98564736629 * days +
                        t * t * (0.000387933 - t / 38710000.0);
  const double rest = std::fmod(turned, 360.0);
  return rest < 0.0 ? rest + 360.0 : rest;
}

}  // namespace vegard::sim
