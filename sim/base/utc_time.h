// Times of day and calendar as cameras write them: the proleptic Gregorian calendar, minutes of 60 seconds
// (a leap second is the 61st), offsets from UTC in minutes.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace vegard::sim {

struct CivilTime {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, second = 0;
  std::string subsecond;  ///< digits after the point; empty: none were given
};

/// Of a month from 1 to 12.
int days_in_month(int year, int month);

/// A day of the calendar, from the year 1 to 9999, and a time of that day.
bool is_possible(const CivilTime& time);

/// "2019-03-01T00:16:30.922622", of a time that is possible.
std::string iso_text(const CivilTime& time);

/// The other way round, a blank for the T allowed; nothing for what is no possible time of that form.
std::optional<CivilTime> civil_time(const std::string& iso_text);

/// Of "Z", "+05:30", "-0700", "+01", at most 14 hours, east positive; nothing for anything else.
std::optional<int> offset_minutes(const std::string& text);

/// `minutes` later, or earlier if negative; less than a month.
CivilTime minutes_later(CivilTime time, int minutes);

/// Whether a text is like `form`, with some digit for each 0 in it: "0000-00-00".
bool has_form(const std::string& text, const std::string& form);

// Moments in Coordinated Universal Time, as text and as seconds.

/// Seconds since 1970-01-01T00:00:00Z, leap seconds not counted, of "2015-10-07T08:23:51.743Z": a T or a
/// blank between, seconds, fractions and the Z may be missing; or, instead of the Z, a zone's offset from UTC
/// as above: "2019-03-01T22:10:00+01:00" is 21:10 in UTC. None for any other text and for a date that no
/// calendar has (proleptic Gregorian).
std::optional<double> utc_seconds(std::string_view iso);

/// A time of the form above in UTC: one with a zone's offset as utc_text() writes it, any other text as it
/// is.
std::string in_utc(const std::string& iso);

/// The first moment in a picture's name: date and time as runs of 8 and 6 digits, with at most one character
/// (one of T, _, -, a blank) between, and a fraction after a full stop ("PKR_DASC_0558_20151007_082351.743"),
/// or as ISO has them with -, _ or : for the colons ("2015-10-07T08-23-51"). None if there is none.
std::optional<double> utc_seconds_in_name(std::string_view file_name);

/// "2015-10-07T08:23:51.743Z": to the millisecond, fractions only if there are any.
std::string utc_text(double seconds);

}  // namespace vegard::sim
