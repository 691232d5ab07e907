#include "sim/view/celestial/instant.h"

#include <cctype>
#include <cmath>
#include <cstdio>

namespace vegard::sim {
namespace {

/// Days from 1970-01-01 in the Gregorian calendar; years begin in March, so that the leap day is their last.
long long days_from_civil(int year, int month, int day) {
  const long long y = month <= 2 ? year - 1 : year;
  const long long era = (y >= 0 ? y : y - 399) / 400;
  const long long year_of_era = y - era * 400;
  const long long day_of_year = (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 1;
  return era * 146097 + year_of_era * 365 + year_of_era / 4 - year_of_era / 100 + day_of_year - 719468;
}

constexpr double kJulianDateOf1970 = 2440587.5;
constexpr double kSecondsPerDay = 86400.0;

int days_in(int year, int month) {
  const long long next = month == 12 ? days_from_civil(year + 1, 1, 1) : days_from_civil(year, month + 1, 1);
  return static_cast<int>(next - days_from_civil(year, month, 1));
}

/// Exactly `digits` digits at `at`, which moves on; negative if they are not there.
int number(const std::string& text, std::size_t& at, int digits) {
  int value = 0;
  for (int i = 0; i < digits; ++i, ++at) {
    if (at >= text.size() || !std::isdigit(static_cast<unsigned char>(text[at]))) return -1;
    value = 10 * value + (text[at] - '0');
  }
  return value;
}

bool skip(const std::string& text, std::size_t& at, char character) {
  if (at >= text.size() || text[at] != character) return false;
  ++at;
  return true;
}

}  // namespace

std::optional<double> julian_date(const std::string& utc) {
  std::size_t at = 0;
  const int year = number(utc, at, 4);
  if (year < 0 || !skip(utc, at, '-')) return std::nullopt;
  const int month = number(utc, at, 2);
  if (month < 1 || month > 12 || !skip(utc, at, '-')) return std::nullopt;
  const int day = number(utc, at, 2);
  if (day < 1 || day > days_in(year, month) || !(skip(utc, at, 'T') || skip(utc, at, ' ')))
    return std::nullopt;
  const int hour = number(utc, at, 2);
  if (hour < 0 || hour > 23 || !skip(utc, at, ':')) return std::nullopt;
  const int minute = number(utc, at, 2);
  if (minute < 0 || minute > 59) return std::nullopt;
  double second = 0.0;
  if (skip(utc, at, ':')) {
    second = number(utc, at, 2);
    if (second < 0 || second > 60) return std::nullopt;
    if (skip(utc, at, '.')) {
      double place = 0.1;
      const std::size_t first = at;
      for (; at < utc.size() && std::isdigit(static_cast<unsigned char>(utc[at])); ++at, place *= 0.1)
        second += place * (utc[at] - '0');
      if (at == first) return std::nullopt;
    }
  }
  skip(utc, at, 'Z');
  if (at != utc.size()) return std::nullopt;
  return kJulianDateOf1970 + static_cast<double>(days_from_civil(year, month, day)) +
         (hour * 3600.0 + minute * 60.0 + second) / kSecondsPerDay;
}

std::string utc_text(double julian_date) {
  const auto seconds =
      static_cast<long long>(std::floor((julian_date - kJulianDateOf1970) * kSecondsPerDay + 0.5));
  const long long day_seconds = 86400;
  long long days = seconds / day_seconds;
  if (days * day_seconds > seconds) --days;
  const int rest = static_cast<int>(seconds - days * day_seconds);
  int year = 1970 + static_cast<int>(std::floor(static_cast<double>(days) / 365.2425));
  while (days_from_civil(year + 1, 1, 1) <= days) ++year;
  while (days_from_civil(year, 1, 1) > days) --year;
  int month = 12;
  while (days_from_civil(year, month, 1) > days) --month;
  const int day = static_cast<int>(days - days_from_civil(year, month, 1)) + 1;
  char text[64];
  std::snprintf(text, sizeof text, "%04d-%02d-%02dT%02d:%02d:%02dZ", year, month, day, rest / 3600,
                rest / 60 % 60, rest % 60);
  return text;
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
