#include "sim/base/utc_time.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace vegard::sim {
namespace {

constexpr std::int64_t kUtcSecondsPerDay = 86400;

/// Days from year 1 to the beginning of a year.
std::int64_t days_before_year(std::int64_t year) {
  const std::int64_t past = year - 1;
  return past * 365 + past / 4 - past / 100 + past / 400;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Reads on through a text; every step fails for good once one has.
struct TimeReader {
  std::string_view text;
  std::size_t at = 0;
  bool good = true;

  int number(int digits) {
    int value = 0;
    for (int i = 0; i < digits; ++i, ++at) {
      if (!good || at >= text.size() || !is_digit(text[at])) return good = false, 0;
      value = 10 * value + (text[at] - '0');
    }
    return value;
  }
  bool next_is(std::string_view any) const {
    return good && at < text.size() && any.find(text[at]) != std::string_view::npos;
  }
  void one_of(std::string_view any) { (good = next_is(any)) ? ++at : at; }
  bool digit_next() const { return at < text.size() && is_digit(text[at]); }

  /// Digits behind a full stop; 0 without any.
  double fraction() {
    double value = 0.0, place = 0.1;
    if (!next_is(".") || at + 1 >= text.size() || !is_digit(text[at + 1])) return 0.0;
    for (++at; digit_next(); ++at, place *= 0.1) value += place * (text[at] - '0');
    return value;
  }
};

std::optional<double> seconds_of(int year, int month, int day, int hour, int minute, int second,
                                 double fraction) {
  if (year < 1900 || year > 2200 || month < 1 || month > 12 || day < 1 || day > days_in_month(year, month))
    return std::nullopt;
  if (hour > 23 || minute > 59 || second > 60) return std::nullopt;
  std::int64_t days = days_before_year(year) - days_before_year(1970) + day - 1;
  for (int m = 1; m < month; ++m) days += days_in_month(year, m);
  return static_cast<double>(days * kUtcSecondsPerDay + hour * 3600 + minute * 60 + second) + fraction;
}

/// Date and time from the reader's place on; with separators as in ISO, or as two runs of digits.
std::optional<double> read_moment(TimeReader& in, bool separated, std::string_view between,
                                  std::string_view colons) {
  const int year = in.number(4);
  if (separated) in.one_of("-");
  const int month = in.number(2);
  if (separated) in.one_of("-");
  const int day = in.number(2);
  if (separated || in.next_is(between)) in.one_of(between);
  const int hour = in.number(2);
  if (separated) in.one_of(colons);
  const int minute = in.number(2);
  if (separated && !in.next_is(colons))
    return in.good ? seconds_of(year, month, day, hour, minute, 0, 0.0) : std::nullopt;
  if (separated) in.one_of(colons);
  const int second = in.number(2);
  if (!in.good) return std::nullopt;
  const double fraction = in.fraction();
  return seconds_of(year, month, day, hour, minute, second, fraction);
}

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
  if (text.empty() || (text[0] != '+' && text[0] != '-')) return std::nullopt;
  const std::string size = text.substr(1);
  const bool hours_alone = has_form(size, "00");
  if (!hours_alone && !has_form(size, "00:00") && !has_form(size, "0000")) return std::nullopt;
  const int hours = std::stoi(size.substr(0, 2));
  const int minutes = hours_alone ? 0 : std::stoi(size.substr(size.size() - 2));
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

std::optional<double> utc_seconds(std::string_view iso) {
  TimeReader in{iso};
  const std::optional<double> seconds = read_moment(in, true, "T ", ":");
  if (!seconds || in.at == iso.size()) return seconds;
  const std::optional<int> east = offset_minutes(std::string(iso.substr(in.at)));
  return east ? std::optional<double>(*seconds - 60.0 * *east) : std::nullopt;
}

std::string in_utc(const std::string& iso) {
  const std::size_t time = iso.find_first_of("T ");
  if (time == std::string::npos || iso.find_first_of("+-", time) == std::string::npos) return iso;
  const std::optional<double> seconds = utc_seconds(iso);
  return seconds ? utc_text(*seconds) : iso;
}

std::optional<double> utc_seconds_in_name(std::string_view file_name) {
  for (std::size_t begin = 0; begin < file_name.size(); ++begin) {
    if (begin > 0 && is_digit(file_name[begin - 1])) continue;
    for (const bool separated : {false, true}) {
      TimeReader in{file_name, begin};
      const std::optional<double> seconds = read_moment(in, separated, "T_- ", ":-_");
      if (seconds && !in.digit_next()) return seconds;
    }
  }
  return std::nullopt;
}

std::string utc_text(double seconds) {
  const auto milliseconds = static_cast<std::int64_t>(std::llround(seconds * 1000.0));
  const auto floored = [](std::int64_t a, std::int64_t b) { return a / b - (a % b < 0 ? 1 : 0); };
  const std::int64_t whole = floored(milliseconds, 1000), days = floored(whole, kUtcSecondsPerDay);
  const std::int64_t day_of_era = days + days_before_year(1970);
  std::int64_t year = 1 + day_of_era * 400 / 146097;  // at most a year off
  while (days_before_year(year) > day_of_era) --year;
  while (days_before_year(year + 1) <= day_of_era) ++year;
  auto day = static_cast<int>(day_of_era - days_before_year(year));
  int month = 1;
  for (; day >= days_in_month(static_cast<int>(year), month); ++month)
    day -= days_in_month(static_cast<int>(year), month);
  const auto of_day = static_cast<int>(whole - days * kUtcSecondsPerDay);
  char text[64];
  std::snprintf(text, sizeof text, "%04d-%02d-%02dT%02d:%02d:%02d", static_cast<int>(year), month, day + 1,
                of_day / 3600, of_day / 60 % 60, of_day % 60);
  std::string out = text;
  const auto fraction = static_cast<int>(milliseconds - whole * 1000);
  if (fraction != 0) {
    std::snprintf(text, sizeof text, ".%03d", fraction);
    out += text;
    while (out.back() == '0') out.pop_back();
  }
  return out + "Z";
}

}  // namespace vegard::sim
