// Moments in Coordinated Universal Time, as text and as seconds.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace vegard::sim {

/// Seconds since 1970-01-01T00:00:00Z, leap seconds not counted, of "2015-10-07T08:23:51.743Z": a T or a
/// blank between, seconds, fractions and the Z may be missing. None for any other text and for a date that no
/// calendar has (proleptic Gregorian).
std::optional<double> utc_seconds(std::string_view iso);

/// The first moment in a picture's name: date and time as runs of 8 and 6 digits, with at most one character
/// (one of T, _, -, a blank) between, and a fraction after a full stop ("PKR_DASC_0558_20151007_082351.743"),
/// or as ISO has them with -, _ or : for the colons ("2015-10-07T08-23-51"). None if there is none.
std::optional<double> utc_seconds_in_name(std::string_view file_name);

/// "2015-10-07T08:23:51.743Z": to the millisecond, fractions only if there are any.
std::string utc_text(double seconds);

}  // namespace vegard::sim
