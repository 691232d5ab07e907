// Reads tables of recognised stars.
//
// A table that a user writes is separated by commas, or by semicolons or tabs and then perhaps with decimal
// commas, with the names of columns in the first line, in small letters or capitals, and one star per line;
// blank lines and lines that begin with # are skipped. Every star has x_px and y_px, and its direction in one
// of these forms:
//   azimuth_deg and elevation_deg, or azimuth_deg and zenith_deg: as seen, with the air's refraction
//   ra_deg (or ra_hours) and dec_deg: J2000; needs time and site
//   star: a name, designation, "HIP 91262" or "HD 172167" of data/stars; needs time and site
// Further columns are name and magnitude; all others are ignored.
//
// A FITS file is a FIELD.corr, which Astrometry.net's solve-field writes beside its solution of a picture or
// of a crop of one: a binary table with a row for every point of light that it took for a star of its index.
// field_x and field_y are the point's place in pixels, the centre of the first at (1, 1), rows counted from
// the top of a JPEG or PNG; index_ra and index_dec are the star's place in degrees, J2000. The other columns,
// and the solution itself (a tangent plane, which no wide lens has), are not used.
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
/// the site is missing, without which their directions are unknown.
void require_sky(const SkyOfPicture& sky, const std::string& file);

/// Reads a table. `first_pixel`: the coordinate of the centre of the picture's first pixel in the table; 0.5
/// as here, 0 or 1 elsewhere. If it is not given, it is 0.5, and 1 for a FITS table. Throws
/// sim::Error(unreadable_input) with file and line; Error(usage) if a time or a site is missing.
std::vector<StarSighting> read_star_table(const std::string& file, const SkyOfPicture& sky,
                                          std::optional<double> first_pixel = {});
std::vector<StarSighting> parse_star_table(const std::string& text, const std::string& name,
                                           const SkyOfPicture& sky, double first_pixel = 0.5);

/// Reads a table with the numbers in ra_deg taken for hours. Returns nothing if there is no such column, or a
/// number in it is above 24.
std::optional<std::vector<StarSighting>> stars_with_hours(const std::string& file, const SkyOfPicture& sky,
                                                          std::optional<double> first_pixel = {});

/// True for bytes that begin as a FITS file does, unlike any table of text.
bool is_fits_table(std::string_view bytes);

/// Returns the stars of a FITS table, named by their rows, in the pixels of the picture that was solved, the
/// centre of the first at (0.5, 0.5). `first_pixel`: its coordinate in the file. Throws
/// sim::Error(unreadable_input) about `file` for bytes that are no such table, without rows, or with invalid
/// numbers; Error(usage) if the time or the site is missing.
std::vector<StarSighting> solved_field(std::string_view bytes, const std::string& file,
                                       const SkyOfPicture& sky, double first_pixel = 1.0);

}  // namespace vegard::fit
