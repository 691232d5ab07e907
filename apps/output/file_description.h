// Describes files of other programs, and netCDF files: text for `vegard describe`.
#pragma once

#include <optional>
#include <string>

namespace vegard::apps {

/// Describes a solution of Astrometry.net (`.wcs`), its lists of stars (`.axy`, `.corr`), a camera of
/// AIDA_tools (`.acc`, by the name's ending) or a netCDF file by the CF conventions; none for any other file.
/// Throws sim::Error(unreadable_input) if such a file is damaged.
std::optional<std::string> other_file_text(const std::string& path);

}  // namespace vegard::apps
