// Astrometry.net's lists of stars, FITS binary tables: `.axy`, points of light that a picture shows (X, Y,
// FLUX), and
// `.corr`, those that are stars of its index (field_*: as seen, index_*: as the catalogue and the solution
// have them). Pixels as in sip_wcs.h. `.corr` is read as a table of recognised stars (star_table.h).
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
  std::vector<FoundStar> points;  ///< the brightest first, if the file says so; else in its order
  Frame frame;                    ///< of IMAGEW and IMAGEH; not known without them
};

/// Whether it is such a list: a FITS table with X and Y, and without field_x.
bool is_star_list(std::string_view bytes, const std::string& file);

/// Throws sim::Error(unreadable_input) for places that are none, and more than 100000 rows.
StarPoints read_star_list(std::string_view bytes, const std::string& file);

/// X, Y, FLUX of the points, with the picture's size.
std::string encode_star_list(const std::vector<FoundStar>& points, const Frame& frame,
                             const std::string& name = {});

/// A row for each star in use: field_x, field_y, field_ra, field_dec, index_x, index_y, index_ra, index_dec.
/// Of time and site both must be known.
std::string encode_star_pairs(const Calibration& calibration, const SkyOfPicture& sky,
                              const std::string& name = {});

}  // namespace vegard::fit
