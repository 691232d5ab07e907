#include <cstdlib>
#include <limits>

#include "fit/photo/codec/picture_codes.h"
#include "sim/base/picture/fits_io.h"

namespace vegard::fit {
namespace {

/// A keyword's number, or that if there is none.
double number_of(const sim::FitsKeywords& keywords, const char* key, double if_absent) {
  const auto found = keywords.find(key);
  if (found == keywords.end()) return if_absent;
  char* end = nullptr;
  const double value = std::strtod(found->second.c_str(), &end);
  return end == found->second.c_str() ? if_absent : value;
}

}  // namespace

PictureCodes decode_fits(std::string_view bytes, const std::string& file) {
  sim::FitsImage fits = sim::read_fits_image(bytes, file);
  const int planes = fits.image.channels();
  if (planes != 1 && planes != 3)
    refuse_image(file, "this FITS image has " + std::to_string(planes) + " planes",
                 "one, or three for red, green and blue");
  PictureCodes codes;
  codes.width = fits.image.width;
  codes.height = fits.image.height;
  codes.channels = planes;
  codes.bits = fits.bits;
  codes.linear = true;
  codes.kind = std::to_string(fits.bits) + (fits.floating ? "-bit float FITS" : "-bit FITS");
  constexpr double kNone = std::numeric_limits<double>::infinity();
  // The standard's DATAMAX is the largest valid value; SATURATE is where it is none any more.
  double saturate = number_of(fits.keywords, "SATURATE", kNone);
  const double valid = number_of(fits.keywords, "DATAMAX", kNone);
  codes.floating = fits.floating || !(fits.largest > 0.0);
  codes.white = codes.floating ? 1.0 : fits.largest;
  codes.step = codes.floating ? 0.0 : fits.step;
  // Below the first step above zero nothing is white.
  if (!codes.floating && !(saturate >= codes.step)) saturate = kNone;
  if (!codes.floating && saturate < codes.white) codes.white = saturate;
  codes.usable = std::move(fits.known);
  for (std::size_t i = 0; i < codes.usable.size(); ++i) {
    const double value = fits.image.data[i];
    if (value >= saturate || value > valid) codes.usable[i] = 0;
  }
  codes.values = std::move(fits.image.data);
  codes.words = std::move(fits.keywords);
  return codes;
}

}  // namespace vegard::fit
