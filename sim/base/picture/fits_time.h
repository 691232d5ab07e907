// When a FITS image was taken, by the words of its first header (FITS standard 4.0, 4.4.2.3 and 9).
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace vegard::sim {

struct FitsTime {
  std::string utc;  ///< "2015-10-07T08:23:51.743Z"
  std::string key;  ///< "DATE-OBS", "OBSDATE and OBSSTART"
};

/// Of a file's bytes, of which the first header is enough: DATE-OBS with a time of day in it or in TIME-OBS;
/// else OBSDATE with OBSSTART, which the cameras at Poker Flat write. They are UTC unless TIMESYS says
/// another scale, and then nothing is known. Nothing either for a day without a time, for no FITS file and
/// for a date that no calendar has. Never throws.
std::optional<FitsTime> fits_time(std::string_view bytes);

}  // namespace vegard::sim
