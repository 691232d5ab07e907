// Tables of recognised stars, as users write them.
//
// Comma-separated, names of columns in the first line, one star a line; blank lines and lines that begin with
// # are skipped. Every star has x_px and y_px and says where it stands in one of these ways:
//   azimuth_deg and elevation_deg, or azimuth_deg and zenith_deg   as seen: with the air's refraction in them
//   ra_deg (or ra_hours) and dec_deg                               J2000; needs time and site
//   star                                                           a name, designation, "HIP 91262" or "HD
//   172167" of
//                                                                  data/stars; needs time and site
// Further columns: name, magnitude. Others are ignored.
//
// A file that begins as FITS does is taken for stars that Astrometry.net's solve-field has recognised in a
// picture, or in a crop of one.
//
// Beside its solution it writes a file FIELD.corr: a FITS binary table with a row for every point of light
// that it took for a star of its index. field_x and field_y say where the point was seen, in pixels, the
// centre of the first at (1, 1), rows counted from the top of a JPEG or PNG; index_ra and index_dec where
// the star stands, in degrees, J2000. The other columns (and the solution itself, a tangent plane that no
// wide lens has) are not asked.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fit/photo/pointing/star_sighting.h"
#include "sim/view/sky/star_place.h"

namespace vegard::fit {

struct SkyOfPicture {
  std::optional<double> julian_date;
  std::optional<sim::Observer> observer;
};

/// Throws sim::Error(usage) about `file`, whose stars are given by name or right ascension, if the time or
/// the site is wanting without which they stand nowhere.
void require_sky(const SkyOfPicture& sky, const std::string& file);

/// `first_pixel`: where the table has the centre of the picture's first pixel; 0.5 as here, 0 or 1 elsewhere.
/// Where a file's is not given, it is 0.5, and 1 of a FITS table.
/// Throws sim::Error(unreadable_input) with file and line; Error(usage) if a time or a site is wanting.
std::vector<StarSighting> read_star_table(const std::string& file, const SkyOfPicture& sky,
                                          std::optional<double> first_pixel = {});
std::vector<StarSighting> parse_star_table(const std::string& text, const std::string& name,
                                           const SkyOfPicture& sky, double first_pixel = 0.5);

/// True for bytes that begin as FITS does, which no table of text does.
bool is_fits_table(std::string_view bytes);

/// The stars of such a file, named by their rows, in the pixels of the picture that was solved, the centre of
/// the first at (0.5, 0.5). `first_pixel`: where the file has it. Throws sim::Error(unreadable_input) about
/// `file` for bytes that are no such table, have no rows, or numbers that are none; Error(usage) if the time
/// or the site is wanting.
std::vector<StarSighting> solved_field(std::string_view bytes, const std::string& file,
                                       const SkyOfPicture& sky, double first_pixel = 1.0);

}  // namespace vegard::fit
