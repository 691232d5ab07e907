#include "fit/photo/star_instant.h"

#include <limits>

#include "sim/base/file/number_text.h"
#include "sim/base/utc_time.h"

namespace vegard::fit {

double StarInstant::utc_s() const {
  const std::optional<double> begin = sim::utc_seconds(begin_utc);
  return begin ? *begin + middle_after_s.value_or(0.0) : std::numeric_limits<double>::quiet_NaN();
}

std::string StarInstant::utc() const { return sim::utc_text(utc_s()); }

double StarInstant::turn_error_deg() const {
  constexpr double kTurn_deg = 360.0, kSiderealDay_s = 86164.0905;
  return error_s * kTurn_deg / kSiderealDay_s;
}

std::string words_of(const StarInstant& instant) {
  std::string words = "stars at " + instant.utc() + ", ";
  words += instant.middle_after_s
               ? "the middle of the exposure, " + sim::short_number(*instant.middle_after_s) +
                     " s after its beginning at " + instant.begin_utc + " (" + instant.source + ")"
               : "taken for the middle of an exposure that is not known (" + instant.source + ")";
  return words + "; its error of " + sim::short_number(instant.error_s, 2) + " s turns the camera by " +
         sim::short_number(instant.turn_error_deg(), 2) + " deg about the pole";
}

}  // namespace vegard::fit
