// Dates and times as cameras write them: the proleptic Gregorian calendar, minutes of 60 seconds (a leap
// second is the 61st), offsets from UTC in minutes.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace vegard::sim {

struct CivilTime {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, second = 0;
  std::string subsecond;  ///< digits after the point; may be empty
};

/// Returns the number of days of a month from 1 to 12.
int days_in_month(int year, int month);

/// True for a valid date, from the year 1 to 9999, with a valid time of day.
bool is_possible(const CivilTime& time);

/// Returns a possible time as "2019-03-01T00:16:30.922622".
std::string iso_text(const CivilTime& time);

/// The inverse of iso_text(), also with a blank for the T; nothing for an impossible time or another form.
std::optional<CivilTime> civil_time(const std::string& iso_text);

/// Parses "Z", "+05:30", "-0700", "+01", at most 14 hours, east positive; nothing for any other text.
std::optional<int> offset_minutes(const std::string& text);

/// True for clock minus UTC of a time zone: a multiple of 15 minutes from -12 to +14 h.
bool is_zone(int minutes);

/// "+05:30", "-07:00"
std::string zone_text(int minutes);

/// Returns the time `minutes` later, or earlier if negative; less than a month.
CivilTime minutes_later(CivilTime time, int minutes);

/// True if a text matches `form`, in which each 0 stands for any digit: "0000-00-00".
bool has_form(const std::string& text, const std::string& form);

// Times in UTC as text and as seconds.

/// Parses "2015-10-07T08:23:51.743Z" to seconds since 1970-01-01T00:00:00Z, without leap seconds. A blank may
/// replace the T; seconds, fractions and the Z may be missing; instead of the Z there may be an offset from
/// UTC as above: "2019-03-01T22:10:00+01:00" is 21:10 in UTC. Nothing for any other text and for an invalid
/// date.
std::optional<double> utc_seconds(std::string_view iso);

/// Converts a time of this form with an offset to UTC, in the form of utc_text(); returns any other text
/// unchanged.
std::string in_utc(const std::string& iso);

/// Returns the unit of the last digit of such a time, in seconds: 60 of "2015-10-07T08:23", 1 of whole
/// seconds, 0.001 of milliseconds.
double resolution_s(std::string_view iso);

/// The time in a picture's name.
struct TimeInName {
  double clock_s = 0.0;               ///< as it is written, counted from 1970 as by utc_seconds()
  std::optional<int> offset_minutes;  ///< of the zone that the name gives: Z, UTC, +0100, -05:00
  std::string unclear;  ///< what may be a zone of unknown offset, or no time: "CET", "+0107", "22 h AM"

  /// By the zone in the name; taken for UTC without one.
  double utc_s() const { return clock_s - 60.0 * offset_minutes.value_or(0); }
};

/// Finds the first time in a picture's name: date and time as 8 and 6 digits, with at most one character (T,
/// _, - or a blank) between, and a fraction after a full stop ("PKR_DASC_0558_20151007_082351.743"), or in
/// ISO form with -, _ or : for the colons ("2015-10-07T08-23-51"). Behind it may stand AM or PM and a zone,
/// at once or after _, - or a blank: Z, UTC, GMT, "+0100", "+01:00", "+01", "-0500", "UTC+1". An offset
/// behind - needs four digits of a zone, and two are enough in ISO form with a T: what else follows a - is a
/// number of the picture. Nothing if there is no time.
std::optional<TimeInName> time_in_name(std::string_view file_name);

/// Returns "2015-10-07T08:23:51.743Z": to the millisecond, without a fraction of zero.
std::string utc_text(double seconds);

}  // namespace vegard::sim
