#include "fit/photo/frames/array_times.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "sim/base/text.h"
#include "sim/base/utc_time.h"

namespace vegard::fit {
namespace {

using sim::ArrayClock;
using sim::ArrayKind;
using sim::StoredArray;

constexpr double kDay_s = 86400.0;
constexpr double kDays1970 = 719528.0;                                   // from 0000-01-01 to 1970-01-01
constexpr double kDatenum1970 = kDays1970 + 1;                           // MATLAB counts 0000-01-01 as day 1
constexpr double kEarliest_s = -2208988800.0, kLatest_s = 7258118400.0;  // 1900, 2200

std::optional<double> in_range(double seconds) {
  return std::isfinite(seconds) && seconds >= kEarliest_s && seconds < kLatest_s
             ? std::optional<double>(seconds)
             : std::nullopt;
}

bool is_named_for_times(const std::string& name) {
  const std::string plain = sim::lowered(name.substr(name.rfind('/') + 1));
  return plain == "t" || plain == "datenum" || plain.find("time") != std::string::npos ||
         plain.find("epoch") != std::string::npos;
}

bool may_tell_times(const StoredArray& array, std::uint64_t frames) {
  const bool is_line =
      std::count_if(array.dims.begin(), array.dims.end(), [](std::uint64_t n) { return n != 1; }) <= 1;
  if (!is_line || array.count() != frames) return false;
  if (array.clock != ArrayClock::none) return true;
  return (array.kind == ArrayKind::text || array.kind == ArrayKind::f64 || sim::size_of(array.kind) >= 4) &&
         array.kind != ArrayKind::f32 && is_named_for_times(array.name);
}

/// The first that may, of those with a clock of their own before all others.
const StoredArray* times_of(const sim::ArrayFile& file, std::size_t images, std::uint64_t frames) {
  const StoredArray* found = nullptr;
  for (std::size_t i = 0; i < file.arrays().size(); ++i) {
    const StoredArray& array = file.arrays()[i];
    if (i == images || !may_tell_times(array, frames)) continue;
    if (array.clock != ArrayClock::none) return &array;
    if (found == nullptr) found = &array;
  }
  return found;
}

ImagerTime time_at(double seconds, const std::string& source) {
  ImagerTime time;
  time.seconds = seconds;
  // Milliseconds, or as many digits as a double has of them.
  time.utc = sim::utc_text(seconds);
  time.source = source;
  return time;
}

std::optional<double> seconds_of_number(double number) {
  constexpr double kEarliestDay = 693962.0, kLatestDay = 803534.0;  // MATLAB's of 1900 and 2200
  if (number >= kEarliestDay && number < kLatestDay) return in_range((number - kDatenum1970) * kDay_s);
  constexpr double kFirst_s = 3e8;  // 1979: before there were such images
  return number >= kFirst_s ? in_range(number) : std::nullopt;
}

std::optional<ImagerTime> time_of_text(std::string text, const std::string& source) {
  constexpr std::string_view kZone = " UTC";
  if (sim::ends_with(text, kZone)) text.erase(text.size() - kZone.size());
  const auto seconds = sim::utc_seconds(text);
  if (!seconds) return std::nullopt;
  ImagerTime time = time_at(*seconds, source);
  // As it stands there, to the last digit.
  if (const auto civil = sim::civil_time(text)) time.utc = sim::iso_text(*civil) + "Z";
  return time;
}

/// Days of 1972 to 2017, since 1970, from which so many seconds more were added to UTC: TAI - UTC (IERS
/// Bulletin C).
struct Leap {
  int day;
  int tai_less_utc_s;
};
constexpr std::array<Leap, 28> kLeaps{
    {{730, 10},   {912, 11},   {1096, 12},  {1461, 13},  {1826, 14},  {2191, 15},  {2557, 16},
     {2922, 17},  {3287, 18},  {3652, 19},  {4199, 20},  {4564, 21},  {4929, 22},  {5660, 23},
     {6574, 24},  {7305, 25},  {7670, 26},  {8217, 27},  {8582, 28},  {8947, 29},  {9496, 30},
     {10043, 31}, {10592, 32}, {13149, 33}, {14245, 34}, {15522, 35}, {16617, 36}, {17167, 37}}};

}  // namespace

std::optional<double> cdf_epoch_seconds(double milliseconds) {
  constexpr double kMilliseconds = 1e-3;
  return in_range((milliseconds - kDays1970 * kDay_s * 1e3) * kMilliseconds);
}

std::optional<double> tt2000_seconds(std::int64_t nanoseconds) {
  // J2000 is 2000-01-01T12:00:00 of terrestrial time, which is 32.184 s before TAI.
  constexpr double kJ2000_s = 946728000.0, kTtLessTai_s = 32.184, kNanoseconds = 1e-9;
  const double tai_s = static_cast<double>(nanoseconds) * kNanoseconds + kJ2000_s - kTtLessTai_s;
  double utc_s = tai_s - kLeaps.front().tai_less_utc_s;
  for (const Leap& leap : kLeaps)
    if (tai_s - leap.tai_less_utc_s >= leap.day * kDay_s) utc_s = tai_s - leap.tai_less_utc_s;
  return in_range(utc_s);
}

bool has_times(const sim::ArrayFile& file, std::size_t images, std::uint64_t frames) {
  return times_of(file, images, frames) != nullptr;
}

std::vector<std::optional<ImagerTime>> array_times(sim::ArrayFile& file, std::size_t images,
                                                   std::size_t frames) {
  const StoredArray* array = times_of(file, images, frames);
  if (array == nullptr) return {};
  const std::string source = std::string(file.format()) + " array \"" + array->name + "\"";
  std::vector<std::optional<ImagerTime>> times;
  if (array->kind == ArrayKind::text) {
    for (std::string& text : file.read_texts(*array)) times.push_back(time_of_text(std::move(text), source));
    return times;
  }
  const std::string block = file.read(*array);
  for (std::size_t i = 0; i < frames; ++i) {
    const double number = sim::number_of(block, array->kind, i);
    std::optional<double> seconds;
    if (array->clock == ArrayClock::cdf_epoch) {
      seconds = cdf_epoch_seconds(number);
    } else if (array->clock == ArrayClock::tt2000 && array->kind == ArrayKind::i64) {
      std::int64_t nanoseconds = 0;
      std::memcpy(&nanoseconds, block.data() + i * sizeof nanoseconds, sizeof nanoseconds);
      seconds = tt2000_seconds(nanoseconds);
    } else {
      seconds = seconds_of_number(number);
    }
    times.push_back(seconds ? std::optional<ImagerTime>(time_at(*seconds, source)) : std::nullopt);
  }
  return times;
}

}  // namespace vegard::fit
