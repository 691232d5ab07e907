// When a FITS image was exposed (FITS standard 4.0, 4.4.2.3 and section 9).
//
// The beginning is DATE-BEG, or DATE-OBS with a time of day in it or in TIME-OBS, or OBSDATE with OBSSTART as
// from the cameras at Poker Flat, or the same as Modified Julian Dates (MJD-BEG, MJD-OBS); without them it
// follows from DATE-AVG or DATE-END and the exposure (EXPTIME, EXPOSURE, XPOSURE, TELAPSE; in seconds, or in
// the unit at the beginning of the comment, "[ms]"). DATE-OBS means the middle where it equals DATE-AVG and
// the end where it equals DATE-END. The middle is DATE-AVG, or half way to DATE-END, or half the exposure
// after the beginning. TIMESYS may be UTC, TAI, TT (TDT, ET, TDB) or GPS.
//
// The header is that of the first image: of the first header where it has none, that of the extension, with
// what it lacks from the first header.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace vegard::sim {

struct FitsTime {
  std::string utc;  ///< beginning of the exposure, "2015-10-07T08:23:51.743Z"
  std::string key;  ///< source of the time: "DATE-OBS", "OBSDATE and OBSSTART"
  std::optional<double> exposure_s;
  std::string exposure_key;
  std::optional<double> middle_after_s;  ///< from the beginning to the middle of the exposure; none: unknown
  double resolution_s = 1.0;             ///< unit of the last digit of the time
  std::string contradiction;  ///< between keywords, as a sentence without a full stop; may be empty
};

/// Returns the time from the bytes of a file, of which the header is enough. Returns nothing for another
/// TIMESYS, for a date without a time, an invalid date, or bytes that are not FITS. Never throws.
std::optional<FitsTime> fits_time(std::string_view bytes);

}  // namespace vegard::sim
