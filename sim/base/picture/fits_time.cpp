#include "sim/base/picture/fits_time.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "sim/base/leap_seconds.h"
#include "sim/base/picture/fits_cards.h"
#include "sim/base/utc_time.h"

namespace vegard::sim {
namespace {

constexpr double kSame_s = 1.0;

struct Moment {
  double utc_s = 0.0;
  std::string key;
  double resolution_s = 1.0;
};

class ImageTimes {
 public:
  explicit ImageTimes(FitsValues values) : values_(std::move(values)) {}

  /// Whether the clock of the keywords is known.
  bool has_known_clock() const {
    const std::string scale = text("TIMESYS");
    for (const char* known : {"", "UTC", "UT", "UT1", "GMT", "TAI", "IAT", "TT", "TDT", "ET", "TDB", "GPS"})
      if (scale == known) return true;
    return false;
  }

  std::optional<Moment> moment(const std::string& which) const {
    const std::string date = "DATE-" + which;
    if (const auto found = by_text(date, "TIME-" + which)) return found;
    if (which == "OBS")
      if (const auto found = by_text("OBSDATE", "OBSSTART")) return found;
    return by_days("MJD-" + which);
  }

  std::optional<Moment> by_days(const std::string& key) const {
    constexpr double kMjdOf1970 = 40587.0, kDay_s = 86400.0, kEarliest = 15020.0, kLatest = 125000.0;
    const std::optional<double> days = fits_number(values_, key);
    if (!days || *days < kEarliest || *days > kLatest) return std::nullopt;
    const std::string digits = text(key);
    const std::size_t point = digits.find('.');
    const double decimals = point == digits.npos ? 0.0 : static_cast<double>(digits.size() - point - 1);
    return Moment{in_utc((*days - kMjdOf1970) * kDay_s), key, kDay_s * std::pow(10.0, -decimals)};
  }

  void take_exposure(FitsTime& time) const {
    for (const char* key : {"EXPTIME", "EXPOSURE", "XPOSURE", "TELAPSE"}) {
      const std::optional<double> number = fits_number(values_, key);
      if (!number || !(*number > 0.0)) continue;
      const std::string unit = values_.find(key)->second.unit;
      const double unit_s = unit == "ms" ? 1e-3 : unit == "us" ? 1e-6 : unit == "min" ? 60.0 : 1.0;
      constexpr double kLongest_s = 1e6;
      if (*number * unit_s > kLongest_s) continue;
      time.exposure_s = *number * unit_s;
      time.exposure_key = key;
      return;
    }
  }

 private:
  std::string text(const std::string& key) const {
    const auto found = values_.find(key);
    return found == values_.end() ? std::string() : found->second.text;
  }

  /// From the clock of TIMESYS.
  double in_utc(double clock_s) const {
    const std::string scale = text("TIMESYS");
    if (scale == "TAI" || scale == "IAT") return utc_of_tai(clock_s);
    if (scale == "GPS") return utc_of_tai(clock_s + kTaiLessGps_s);
    if (scale == "TT" || scale == "TDT" || scale == "ET" || scale == "TDB")
      return utc_of_tai(clock_s - kTtLessTai_s);
    return clock_s;
  }

  std::string quoted(const std::string& key) const {
    const auto found = values_.find(key);
    return found != values_.end() && found->second.is_quoted ? found->second.text : "";
  }

  std::optional<Moment> by_text(const std::string& day, const std::string& clock) const {
    const std::string whole = quoted(day), both = whole + "T" + quoted(clock);
    if (const auto seconds = utc_seconds(whole))
      return Moment{in_utc(*seconds), day, sim::resolution_s(whole)};
    if (const auto seconds = utc_seconds(both))
      return Moment{in_utc(*seconds), day + " and " + clock, sim::resolution_s(both)};
    return std::nullopt;
  }

  const FitsValues values_;
};

std::string said(const Moment& moment) { return moment.key + " " + utc_text(moment.utc_s); }

/// The beginning by whatever tells it.
std::optional<Moment> beginning(const ImageTimes& times, const FitsTime& time) {
  const auto begins = times.moment("BEG"), observed = times.moment("OBS"), middle = times.moment("AVG"),
             ends = times.moment("END");
  if (begins) return begins;
  const double exposure_s = time.exposure_s.value_or(0.0);
  const auto earlier = [](const Moment& moment, double by_s) {
    return Moment{moment.utc_s - by_s, moment.key, moment.resolution_s};
  };
  const auto same = [&](const std::optional<Moment>& one) {
    return one && observed && std::abs(one->utc_s - observed->utc_s) < 1e-3;
  };
  if (same(middle)) return earlier(*middle, 0.5 * exposure_s);
  if (same(ends)) return earlier(*ends, exposure_s);
  if (observed) return observed;
  if (middle) return earlier(*middle, 0.5 * exposure_s);
  if (ends && time.exposure_s) return earlier(*ends, exposure_s);
  return std::nullopt;
}

/// The middle, and what contradicts the beginning and the exposure.
void take_middle(const ImageTimes& times, const Moment& begin, FitsTime& time) {
  const auto middle = times.moment("AVG"), ends = times.moment("END");
  if (time.exposure_s) time.middle_after_s = 0.5 * *time.exposure_s;
  const std::string used = begin.key + (time.exposure_s ? " and " + time.exposure_key : "") + " used";
  constexpr double kLongest_s = 86400.0;
  if (ends) {
    const double lasts_s = ends->utc_s - begin.utc_s;
    if (lasts_s >= time.exposure_s.value_or(0.0) - kSame_s - begin.resolution_s && lasts_s <= kLongest_s &&
        lasts_s >= 0.0)
      time.middle_after_s = 0.5 * std::max(lasts_s, time.exposure_s.value_or(0.0));
    else
      time.contradiction = "FITS " + said(*ends) + " is not the end of what begins at " + said(begin) +
                           (time.exposure_s ? " with " + time.exposure_key : "") + "; " + used;
  }
  if (middle) {
    const double after_s = middle->utc_s - begin.utc_s;
    const double most_s = 2.0 * time.middle_after_s.value_or(0.5 * kLongest_s);
    if (after_s >= -kSame_s && after_s <= most_s + kSame_s)
      time.middle_after_s = std::max(0.0, after_s);
    else
      time.contradiction = "FITS " + said(*middle) + " is not the middle of what begins at " + said(begin) +
                           (time.exposure_s ? " with " + time.exposure_key : "") + "; " + used;
  }
  const auto days = times.by_days("MJD-OBS");
  if (!days || begin.key.rfind("MJD", 0) == 0) return;
  const double off_s = days->utc_s - begin.utc_s;
  const double slack_s = kSame_s + days->resolution_s + begin.resolution_s;
  if (off_s < -slack_s || off_s > 2.0 * time.middle_after_s.value_or(0.0) + slack_s)
    time.contradiction = "FITS " + said(*days) + ", but " + said(begin) + "; " + used;
}

}  // namespace

std::optional<FitsTime> fits_time(std::string_view bytes) {
  const ImageTimes times(fits_image_values(bytes));
  if (!times.has_known_clock()) return std::nullopt;
  FitsTime time;
  times.take_exposure(time);
  const std::optional<Moment> begin = beginning(times, time);
  if (!begin) return std::nullopt;
  time.utc = utc_text(begin->utc_s);
  time.key = begin->key;
  time.resolution_s = begin->resolution_s;
  take_middle(times, *begin, time);
  return time;
}

}  // namespace vegard::sim
