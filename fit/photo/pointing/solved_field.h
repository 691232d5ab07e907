// Stars that Astrometry.net's solve-field has recognised in a picture, or in a crop of one.
//
// Beside its solution it writes a file FIELD.corr: a FITS binary table with a row for every point of light
// that it took for a star of its index. field_x and field_y say where the point was seen, in pixels, the
// centre of the first at (1, 1), rows counted from the top of a JPEG or PNG; index_ra and index_dec where
// the star stands, in degrees, J2000. The other columns (and the solution itself, a tangent plane that no
// wide lens has) are not asked.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fit/photo/pointing/star_sighting.h"
#include "fit/photo/pointing/star_table.h"

namespace vegard::fit {

/// True for bytes that begin as FITS does, which no table of text does.
bool is_fits_table(std::string_view bytes);

/// The stars of such a file, named by their rows, in the pixels of the picture that was solved, the centre of
/// the first at (0.5, 0.5). `first_pixel`: where the file has it. Throws sim::Error(unreadable_input) about
/// `file` for bytes that are no such table, have no rows, or numbers that are none; Error(usage) if the time
/// or the site is wanting.
std::vector<StarSighting> solved_field(std::string_view bytes, const std::string& file,
                                       const SkyOfPicture& sky, double first_pixel = 1.0);

}  // namespace vegard::fit
