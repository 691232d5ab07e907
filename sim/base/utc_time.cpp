#include "sim/base/utc_time.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <iterator>

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

/// What stands behind the time in a name, or before it.
namespace zone_in_name {

/// Zones whose offset depends on who wrote them, or on the season, and "local time".
constexpr std::string_view kUnclear[] = {
    "CET",  "CEST", "EET", "EEST", "WET",  "WEST",  "MET",   "MEST", "MEZ",  "MESZ", "MSK",
    "BST",  "IST",  "EST", "EDT",  "CST",  "CDT",   "MST",   "MDT",  "PST",  "PDT",  "AKST",
    "AKDT", "HST",  "AST", "ADT",  "NST",  "NDT",   "AEST",  "AEDT", "ACST", "ACDT", "AWST",
    "NZST", "NZDT", "JST", "KST",  "SAST", "YEKT",  "OMST",  "KRAT", "IRKT", "YAKT", "VLAT",
    "MAGT", "PETT", "LT",  "LST",  "LMT",  "LOCAL", "Local", "local"};

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

bool is_universal(std::string_view word) {
  for (const char* one : {"Z", "UTC", "UT", "GMT", "utc", "gmt", "Utc"})
    if (word == one) return true;
  return false;
}

bool is_unclear(std::string_view word) {
  return std::find(std::begin(kUnclear), std::end(kUnclear), word) != std::end(kUnclear);
}

struct Reader {
  std::string_view rest;
  bool is_iso = false;
  bool is_behind_utc = false;

  std::size_t digits(std::size_t from) const {
    std::size_t count = 0;
    while (from + count < rest.size() && is_digit(rest[from + count])) ++count;
    return count;
  }
  int number(std::size_t from, std::size_t count) const {
    int value = 0;
    for (std::size_t i = 0; i < count; ++i) value = 10 * value + (rest[from + i] - '0');
    return value;
  }

  /// An offset at the beginning of the rest. Returns false for what is none.
  bool read_offset(TimeInName& time) {
    const char sign = rest[0];
    const std::size_t count = digits(1);
    int hours = 0, minutes = 0;
    std::size_t end = 1 + count;
    if (count == 4) {
      hours = number(1, 2);
      minutes = number(3, 2);
    } else if (count == 2 || (count == 1 && is_behind_utc)) {
      hours = number(1, count);
      const bool goes_on = end + 1 < rest.size() && (rest[end] == ':' || (sign == '+' && rest[end] == '-')) &&
                           digits(end + 1) == 2;
      if (goes_on) {
        minutes = number(end + 1, 2);
        end += 3;
      } else if (sign == '-' && !is_iso && !is_behind_utc) {
        return false;
      }
    } else {
      return false;
    }
    const int offset = (sign == '-' ? -1 : 1) * (60 * hours + minutes);
    if (minutes < 60 && is_zone(offset)) {
      time.offset_minutes = offset;
    } else {
      // Behind a - it is the number of a picture.
      if (sign == '-' && !is_behind_utc) return false;
      time.unclear = std::string(rest.substr(0, end));
    }
    return true;
  }

  void read_half_of_day(std::string_view word, TimeInName& time) const {
    constexpr double kHour_s = 3600.0, kHalf_s = 12.0 * kHour_s;
    const double of_day = time.clock_s - std::floor(time.clock_s / kUtcSecondsPerDay) * kUtcSecondsPerDay;
    const int hour = static_cast<int>(of_day / kHour_s);
    const bool is_after_noon = word[0] == 'P' || word[0] == 'p';
    if (hour > 12 || hour == 0) {
      // 22 h PM is clear, 22 h AM and 0 h PM are not.
      if (is_after_noon != (hour > 12)) time.unclear = std::to_string(hour) + " h " + std::string(word);
      return;
    }
    if (is_after_noon && hour < 12) time.clock_s += kHalf_s;
    if (!is_after_noon && hour == 12) time.clock_s -= kHalf_s;
  }

  void read(TimeInName& time) {
    constexpr int kMostWords = 3;
    for (int word = 0; word < kMostWords && !time.offset_minutes.has_value(); ++word) {
      std::size_t skipped = 0;
      while (skipped < rest.size() && skipped < 2 &&
             std::string_view("_ .(").find(rest[skipped]) != rest.npos)
        ++skipped;
      rest.remove_prefix(skipped);
      if (rest.empty()) return;
      if ((rest[0] == '+' || rest[0] == '-') && read_offset(time)) return;
      if (rest[0] == '-') rest.remove_prefix(1);
      std::size_t letters = 0;
      while (letters < rest.size() && is_letter(rest[letters])) ++letters;
      const std::string_view text = rest.substr(0, letters);
      rest.remove_prefix(letters);
      if (text == "AM" || text == "PM" || text == "am" || text == "pm") {
        read_half_of_day(text, time);
      } else if (is_universal(text)) {
        is_behind_utc = text != "Z";
        if (is_behind_utc && !rest.empty() && (rest[0] == '+' || rest[0] == '-') && read_offset(time)) return;
        time.offset_minutes = 0;
      } else if (is_unclear(text)) {
        time.unclear = std::string(text);
        return;
      } else {
        return;
      }
    }
  }
};

/// "UTC_20190301_231003"
void read_before(std::string_view before, TimeInName& time) {
  while (!before.empty() && std::string_view("_-. ").find(before.back()) != before.npos)
    before.remove_suffix(1);
  std::size_t letters = 0;
  while (letters < before.size() && is_letter(before[before.size() - 1 - letters])) ++letters;
  const std::string_view word = before.substr(before.size() - letters);
  if (word.size() > 1 && is_universal(word)) time.offset_minutes = 0;
  if (is_unclear(word)) time.unclear = std::string(word);
}

}  // namespace zone_in_name

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

bool is_zone(int minutes) { return minutes % 15 == 0 && minutes >= -12 * 60 && minutes <= 14 * 60; }

std::string zone_text(int minutes) {
  char text[16];
  std::snprintf(text, sizeof text, "%c%02d:%02d", minutes < 0 ? '-' : '+', std::abs(minutes) / 60,
                std::abs(minutes) % 60);
  return text;
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

double resolution_s(std::string_view iso) {
  const std::size_t clock = iso.find_first_of("T ");
  if (clock == std::string_view::npos) return static_cast<double>(kUtcSecondsPerDay);
  std::string_view time = iso.substr(clock + 1);
  time = time.substr(0, time.find_first_of("Z+-"));
  if (std::count(time.begin(), time.end(), ':') < 2) return 60.0;
  const std::size_t point = time.find('.');
  return point == std::string_view::npos ? 1.0
                                         : std::pow(10.0, -static_cast<double>(time.size() - point - 1));
}

std::optional<TimeInName> time_in_name(std::string_view file_name) {
  for (std::size_t begin = 0; begin < file_name.size(); ++begin) {
    if (begin > 0 && is_digit(file_name[begin - 1])) continue;
    for (const bool separated : {false, true}) {
      TimeReader in{file_name, begin};
      const std::optional<double> seconds = read_moment(in, separated, "T_- ", ":-_");
      if (!seconds || in.digit_next()) continue;
      TimeInName time;
      time.clock_s = *seconds;
      const bool is_iso = file_name.substr(begin, in.at - begin).find('T') != std::string_view::npos;
      zone_in_name::Reader{file_name.substr(in.at), is_iso}.read(time);
      if (!time.offset_minutes && time.unclear.empty())
        zone_in_name::read_before(file_name.substr(0, begin), time);
      return time;
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
