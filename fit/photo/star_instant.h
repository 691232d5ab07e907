// The instant at which the stars of a picture stood where it shows them: the middle of its exposure.
#pragma once

#include <optional>
#include <string>

namespace vegard::fit {

struct StarInstant {
  std::string begin_utc;  ///< ISO 8601
  std::string source;     ///< what tells it: "--time", "FITS DATE-OBS"
  /// From the beginning to the middle; none: the exposure is not known, and the beginning is taken for it.
  std::optional<double> middle_after_s;
  double error_s = 0.0;  ///< standard error of the time

  /// Seconds since 1970 in UTC; NaN if begin_utc is no time.
  double utc_s() const;
  std::string utc() const;
  /// By how much the error turns the camera about the celestial pole: 15.04 seconds of arc in a second.
  double turn_error_deg() const;
};

/// Returns "stars at 2014-02-21T19:31:10Z, the middle of the exposure, 30 s after its beginning at
/// 2014-02-21T19:30:40Z (FITS DATE-OBS); its error of 0.29 s turns the camera by 0.0012 deg about the pole".
std::string words_of(const StarInstant& instant);

}  // namespace vegard::fit
