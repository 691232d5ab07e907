#include "sim/base/utc_time.h"

#include <algorithm>
#include <cstdio>

namespace vegard::sim {
namespace {

/// Whether `text` looks like `form`, in which 0 stands for any digit.
}  // namespace

int days_in_month(int year, int month) {
  constexpr int kDays[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  const bool leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
  return kDays[month - 1] + (month == 2 && leap ? 1 : 0);
}

bool is_possible(const CivilTime& time) {
  return time.year >= 1 && time.year <= 9999 && time.month >= 1 && time.month <= 12 && time.day >= 1 &&
         time.day <= days_in_month(time.year, time.month) && time.hour >= 0 && time.hour < 24 &&
         time.minute >= 0 && time.minute < 60 && time.second >= 0 && time.second <= 60;
}

std::string iso_text(const CivilTime& time) {
  char text[80];
  std::snprintf(text, sizeof text, "%04d-%02d-%02dT%02d:%02d:%02d", time.year, time.month, time.day,
                time.hour, time.minute, time.second);
  return time.subsecond.empty() ? text : text + ("." + time.subsecond);
}

std::optional<CivilTime> civil_time(const std::string& text) {
  const std::string whole = text.substr(0, 19), rest = text.size() > 19 ? text.substr(19) : "";
  if (!has_form(whole, "0000-00-00T00:00:00") && !has_form(whole, "0000-00-00 00:00:00")) return std::nullopt;
  const auto number = [&](std::size_t begin, std::size_t digits) {
    return std::stoi(whole.substr(begin, digits));
  };
  CivilTime time{number(0, 4), number(5, 2), number(8, 2), number(11, 2), number(14, 2), number(17, 2), ""};
  if (!rest.empty()) {
    if (rest[0] != '.' || rest.size() < 2 || rest.find_first_not_of("0123456789", 1) != std::string::npos)
      return std::nullopt;
    time.subsecond = rest.substr(1);
  }
  return is_possible(time) ? std::optional<CivilTime>(time) : std::nullopt;
}

std::optional<int> offset_minutes(const std::string& text) {
  if (text == "Z") return 0;
  if (!has_form(text, "+00:00") && !has_form(text, "-00:00")) return std::nullopt;
  const int hours = std::stoi(text.substr(1, 2)), minutes = std::stoi(text.substr(4, 2));
  if (minutes >= 60 || 60 * hours + minutes > 14 * 60) return std::nullopt;
  return (text[0] == '-' ? -1 : 1) * (60 * hours + minutes);
}

CivilTime minutes_later(CivilTime time, int minutes) {
  const int of_day = 60 * time.hour + time.minute + minutes;
  const int days = of_day >= 0 ? of_day / 1440 : -((1439 - of_day) / 1440);
  time.hour = (of_day - 1440 * days) / 60;
  time.minute = (of_day - 1440 * days) % 60;
  time.day += days;
  for (; time.day < 1; time.day += days_in_month(time.year, time.month)) {
    if (--time.month < 1) time.month = 12, --time.year;
  }
  for (; time.day > days_in_month(time.year, time.month);) {
    time.day -= days_in_month(time.year, time.month);
    if (++time.month > 12) time.month = 1, ++time.year;
  }
  return time;
}

bool has_form(const std::string& text, const std::string& form) {
  return std::equal(text.begin(), text.end(), form.begin(), form.end(),
                    [](char c, char f) { return f == '0' ? c >= '0' && c <= '9' : c == f; });
}

}  // namespace vegard::sim
