// Reads and writes Astrometry.net's lists of stars, which are FITS binary tables: `.axy` with the points of
// light in a picture (X, Y, FLUX), and `.corr` with those that are stars of its index (field_*: as seen,
// index_*: as in the catalogue and the solution). Pixels are those of sip_wcs.h. star_table.h reads `.corr`.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fit/photo/pointing/calibration.h"
#include "fit/photo/pointing/star_finder.h"
#include "fit/photo/pointing/star_table.h"

namespace vegard::fit {

struct StarPoints {
  std::vector<FoundStar> points;  ///< the brightest first if the file says so, else in its order
  Frame frame;                    ///< by IMAGEW and IMAGEH; unknown without them
};

/// True for an `.axy`: a FITS table with X and Y, and without field_x.
bool is_star_list(std::string_view bytes, const std::string& file);

/// Reads an `.axy`. Throws sim::Error(unreadable_input) for invalid places and for more than 100000 rows.
StarPoints read_star_list(std::string_view bytes, const std::string& file);

/// Returns the bytes of an `.axy` with X, Y and FLUX of the points and the picture's size.
std::string encode_star_list(const std::vector<FoundStar>& points, const Frame& frame,
                             const std::string& name = {});

/// Returns the bytes of a `.corr` with a row for each star in use: field_x, field_y, field_ra, field_dec,
/// index_x, index_y, index_ra, index_dec. Time and site must be known.
std::string encode_star_pairs(const Calibration& calibration, const SkyOfPicture& sky,
                              const std::string& name = {});

}  // namespace vegard::fit
