// The time at which a FITS image was taken, from its first header (FITS standard 4.0, 4.4.2.3 and 9).
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace vegard::sim {

struct FitsTime {
  std::string utc;  ///< "2015-10-07T08:23:51.743Z"
  std::string key;  ///< source of the time: "DATE-OBS", "OBSDATE and OBSSTART"
};

/// Returns the time from the bytes of a file, of which the first header is enough: DATE-OBS with a time of
/// day in it or in TIME-OBS; else OBSDATE with OBSSTART, as from the cameras at Poker Flat. Returns nothing
/// if TIMESYS is not UTC, for a date without a time, an invalid date, or bytes that are not FITS. Never
/// throws.
std::optional<FitsTime> fits_time(std::string_view bytes);

}  // namespace vegard::sim
