#include "fit/photo/taken_time.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "sim/base/utc_time.h"

namespace vegard::fit {
namespace {

namespace clocks {

constexpr double kDay_s = 86400.0, kMinute_s = 60.0, kQuarter_s = 900.0;
constexpr double kWest_s = -12.0 * 3600.0, kEast_s = 14.0 * 3600.0;
/// Clocks that differ by less agree: 10 s turn the sky by 0.04 degrees.
constexpr double kLoose_s = 10.0;
constexpr double kWeeksOfReceiver_days = 1024.0 * 7.0;
/// There was no GPS in EXIF before 1998 (version 2.1).
constexpr double kFirstGps_s = 883612800.0;

/// The zones that are in use, in minutes (tz database, 2024): the nearest is looked for among them where no
/// clock tells it exactly.
constexpr int kZones[] = {-720, -660, -600, -570, -540, -480, -420, -360, -300, -240, -210, -180, -150, -120,
                          -60,  0,    60,   120,  180,  210,  240,  270,  300,  330,  345,  360,  390,  420,
                          480,  525,  540,  570,  600,  630,  660,  720,  765,  780,  825,  840};

double error_of(double resolution_s) { return resolution_s / std::sqrt(12.0); }

std::string duration_text(double seconds) {
  const double size = std::abs(seconds);
  if (size < 120.0) return fmt::format("{:.0f} s", size);
  return fmt::format("{:.0f} min {:.0f} s", std::floor(size / 60.0), std::fmod(size, 60.0));
}

/// A zone, and the GPS's date so many days later, by which clock and GPS differ by `late_s`.
struct Pairing {
  int zone_minutes = 0;
  double days = 0.0;
  double late_s = 0.0;  ///< the clock less the zone, less the GPS's time
};

/// The clock of a camera, without its zone, and the time of the GPS, both in seconds since 1970.
class ClockAndGps {
 public:
  ClockAndGps(double clock_s, double gps_s, std::optional<double> longitude_deg)
      : clock_s_(clock_s), gps_s_(gps_s), longitude_deg_(longitude_deg) {}

  /// The pairings that agree within so many seconds, for every date by which the zone is possible.
  std::vector<Pairing> agreeing(double loose_s) const {
    std::vector<Pairing> found;
    for (const double days : dates(loose_s)) {
      const double apart_s = clock_s_ - gps_s_ - days * kDay_s;
      const double zone_s = std::round(apart_s / kQuarter_s) * kQuarter_s;
      const int zone = static_cast<int>(zone_s / kMinute_s);
      if (sim::is_zone(zone) && std::abs(apart_s - zone_s) <= loose_s)
        found.push_back({zone, days, apart_s - zone_s});
    }
    return found;
  }

  /// The one of them that is likely: of the zone that the picture names; of the GPS's own date; of the zone
  /// that is nearest to the longitude. (About the date line two zones a day apart are possible.)
  Pairing likely(const std::vector<Pairing>& agreeing, std::optional<int> offset) const {
    return *std::min_element(agreeing.begin(), agreeing.end(), [&](const Pairing& a, const Pairing& b) {
      if (offset && (a.zone_minutes == *offset) != (b.zone_minutes == *offset))
        return a.zone_minutes == *offset;
      if (longitude_deg_) return hours_off(a) < hours_off(b);
      return std::abs(a.days) < std::abs(b.days);
    });
  }

  /// The nearest zone in use. A GPS that is late (its last position is old) is likelier than one that is
  /// before the clock.
  Pairing nearest() const {
    constexpr double kLikelier = 4.0;
    Pairing best;
    double least = std::numeric_limits<double>::infinity();
    for (const double days : dates(kQuarter_s))
      for (const int zone : kZones) {
        const double late_s = clock_s_ - zone * kMinute_s - gps_s_ - days * kDay_s;
        // Zones that are a day apart fit as well as each other.
        constexpr double kTie = 1e-3;
        const Pairing pair{zone, days, late_s};
        const double cost = (late_s >= 0.0 ? late_s : -kLikelier * late_s) +
                            kTie * (longitude_deg_ ? hours_off(pair) : std::abs(days));
        if (cost >= least) continue;
        least = cost;
        best = pair;
      }
    return best;
  }

 private:
  std::vector<double> dates(double loose_s) const {
    std::vector<double> days;
    const double first = std::ceil((clock_s_ - gps_s_ - kEast_s - loose_s) / kDay_s);
    const double last = std::floor((clock_s_ - gps_s_ - kWest_s + loose_s) / kDay_s);
    for (double day = first; day <= last; day += 1.0) days.push_back(day);
    return days;
  }
  double hours_off(const Pairing& one) const {
    constexpr double kDegreesOfHour = 15.0;
    return std::abs(one.zone_minutes / 60.0 - *longitude_deg_ / kDegreesOfHour);
  }

  double clock_s_, gps_s_;
  std::optional<double> longitude_deg_;
};

std::string date_words(double days) {
  const double weeks = days / kWeeksOfReceiver_days;
  if (weeks != 0.0 && weeks == std::round(weeks))
    return "its date is off by 1024 weeks, after which receivers count anew";
  if (std::abs(days) == 1.0) return "its date is a day off";
  return fmt::format("its date is {:.0f} days off", std::abs(days));
}

class Judge {
 public:
  explicit Judge(const sim::PictureMetadata& metadata) : m_(metadata) {
    if (m_.taken_local) clock_s_ = sim::utc_seconds(*m_.taken_local);
    if (m_.gps_time_utc) gps_s_ = sim::utc_seconds(*m_.gps_time_utc);
    if (m_.utc_offset) offset_ = sim::offset_minutes(*m_.utc_offset);
    if (!offset_ || sim::is_zone(*offset_)) return;
    time_.notes.push_back("EXIF OffsetTimeOriginal " + *m_.utc_offset +
                          " is the offset of no time zone, and is not used");
    offset_.reset();
  }

  TakenTime judge() {
    if (m_.header_time_utc) {
      use(*m_.header_time_utc, m_.sources.header_time,
          error_of(m_.header_time_resolution_s > 0.0 ? m_.header_time_resolution_s
                                                     : sim::resolution_s(*m_.header_time_utc)));
    } else if (clock_s_ && gps_s_) {
      compare();
    } else if (clock_s_ && offset_) {
      use_clock(*offset_, kOwnZone);
    } else if (gps_s_) {
      take_gps_alone();
    }
    return time_;
  }

 private:
  static constexpr const char* kOwnZone = "EXIF DateTimeOriginal and OffsetTimeOriginal";
  static constexpr const char* kGps = "EXIF GPSDateStamp and GPSTimeStamp, of the last position";

  void use(const std::string& utc, const std::string& source, double error_s) {
    time_.utc = utc;
    time_.source = source;
    time_.error_s = error_s;
  }
  double clock_error_s() const { return error_of(sim::resolution_s(*m_.taken_local)); }

  void use_clock(int zone, const std::string& source, double off_s = 0.0) {
    const auto civil = sim::civil_time(*m_.taken_local);
    use(civil ? sim::iso_text(sim::minutes_later(*civil, -zone)) + "Z" : "", source,
        std::hypot(clock_error_s(), off_s));
  }
  void use_gps(double days, const std::string& source, double off_s) {
    use(days == 0.0 ? *m_.gps_time_utc : sim::utc_text(*gps_s_ + days * kDay_s), source,
        std::hypot(error_of(1.0), off_s));
    time_.by_gps = true;
  }

  void note(const std::string& why) {
    time_.notes.push_back("the camera's clock says " + *m_.taken_local +
                          (offset_ ? m_.utc_offset.value_or("") : "") + ", its GPS " + *m_.gps_time_utc +
                          ": " + why + "; used: " + (time_.utc.empty() ? "none" : time_.utc));
  }

  void compare() {
    // A clock may be read at the beginning of an exposure or at its end.
    const double loose_s = kLoose_s + m_.exposure_s.value_or(0.0);
    const ClockAndGps both(*clock_s_, *gps_s_, m_.longitude_deg);
    const std::vector<Pairing> agreeing = both.agreeing(loose_s);
    if (agreeing.empty()) return compare_apart(both);
    const Pairing pair = both.likely(agreeing, offset_);
    if (offset_ && pair.zone_minutes == *offset_) {
      use_clock(*offset_, kOwnZone);
      if (pair.days != 0.0) note(date_words(pair.days) + ", its time of day agrees");
      return;
    }
    const std::string zone = sim::zone_text(pair.zone_minutes);
    if (pair.days == 0.0) {
      use_gps(0.0, kGps, pair.late_s);
      if (offset_) note("the clock is right in the zone " + zone);
      return;
    }
    use_gps(pair.days,
            std::string("EXIF GPSTimeStamp, with the date of the camera's clock in the zone ") + zone,
            pair.late_s);
    note(date_words(pair.days) + ", its time of day agrees in the zone " + zone);
  }

  /// The two do not agree in any zone.
  void compare_apart(const ClockAndGps& both) {
    const double late_s = offset_ ? *clock_s_ - *offset_ * kMinute_s - *gps_s_ : 0.0;
    if (offset_ && (late_s > 0.0 || late_s < -kQuarter_s)) {
      use_clock(*offset_, kOwnZone);
      return note("these differ by " + duration_text(late_s) + ", and the GPS's position may be old");
    }
    const Pairing pair = offset_ ? Pairing{*offset_, 0.0, late_s} : both.nearest();
    const bool has_gps_date =
        std::abs(pair.days) <= 1.0 || std::fmod(std::abs(pair.days), kWeeksOfReceiver_days) == 0.0;
    if (!has_gps_date) return note("neither the date nor the time of day agrees in any zone");
    const std::string zone = sim::zone_text(pair.zone_minutes);
    if (pair.late_s > 0.0) {
      use_clock(pair.zone_minutes,
                "EXIF DateTimeOriginal in the zone " + zone + ", the nearest to the GPS's time", pair.late_s);
      time_.by_gps = true;
      return note("no time zone lies between them; the nearest is " + zone + ", in which the GPS's time is " +
                  duration_text(pair.late_s) + " old");
    }
    use_gps(pair.days, kGps, pair.late_s);
    note("no time zone lies between them; the nearest is " + zone + ", in which the clock is slow by " +
         duration_text(pair.late_s));
  }

  void take_gps_alone() {
    if (*gps_s_ < kFirstGps_s) {
      time_.notes.push_back("the GPS says " + *m_.gps_time_utc +
                            ", when there was no such camera: its time is not used");
      return;
    }
    use_gps(0.0, kGps, 0.0);
  }

  const sim::PictureMetadata& m_;
  std::optional<double> clock_s_, gps_s_;
  std::optional<int> offset_;
  TakenTime time_;
};

}  // namespace clocks

}  // namespace

TakenTime taken_time(const sim::PictureMetadata& metadata) { return clocks::Judge(metadata).judge(); }

std::optional<double> middle_after_s(const sim::PictureMetadata& metadata) {
  if (metadata.middle_after_s) return metadata.middle_after_s;
  return metadata.exposure_s ? std::optional<double>(0.5 * *metadata.exposure_s) : std::nullopt;
}

std::string contradicted_by_name(const std::string& file_name, const sim::PictureMetadata& metadata) {
  const std::optional<sim::TimeInName> name = sim::time_in_name(file_name);
  const TakenTime taken = taken_time(metadata);
  const std::optional<double> utc_s = sim::utc_seconds(taken.utc);
  if (!name || !utc_s) return {};
  // A name tells when the file was written, after the exposure.
  const double loose_s = clocks::kMinute_s + metadata.exposure_s.value_or(0.0);
  const double apart_s = (name->offset_minutes ? name->utc_s() : name->clock_s) - *utc_s;
  const double zone_s =
      name->offset_minutes ? 0.0 : std::round(apart_s / clocks::kQuarter_s) * clocks::kQuarter_s;
  if (std::abs(apart_s - zone_s) <= loose_s && sim::is_zone(static_cast<int>(zone_s / clocks::kMinute_s)))
    return {};
  return "the file's name says " + sim::utc_text(name->utc_s()).substr(0, 19) +
         (name->offset_minutes ? "Z" : " (no zone)") + ", but " + taken.source + " " + taken.utc +
         (name->offset_minutes ? "" : ": no time zone lies between them") + "; the latter is used";
}

}  // namespace vegard::fit
