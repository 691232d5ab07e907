// What files of other programs, and netCDF, say of themselves: text for `vegard describe`.
#pragma once

#include <optional>
#include <string>

namespace vegard::apps {

/// Of Astrometry.net's solution (`.wcs`), its lists of stars (`.axy`, `.corr`), a camera of AIDA_tools
/// (`.acc`, by the name's ending) and a netCDF file by the CF conventions; nothing for any other file. Throws
/// sim::Error(unreadable_input) for one of these that is damaged.
std::optional<std::string> other_file_text(const std::string& path);

}  // namespace vegard::apps
