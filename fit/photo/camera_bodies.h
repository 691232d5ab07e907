// Sensor sizes of cameras, from the database of Lensfun (https://lensfun.github.io). The database is used if
// it is installed (Debian's package liblensfun-data-v1; CC BY-SA 3.0); no part of it is in vegard.
//
// Its files hold elements <camera> with <maker>, <model> and <cropfactor>: the diagonal of 36 mm x 24 mm
// divided by the sensor's.
#pragma once

#include <optional>
#include <string>

namespace vegard::fit {

/// Returns the database's folder: that of the environment variable VEGARD_LENSFUN, or the first that exists
/// of version_1 and version_2 in /usr/local/share/lensfun and /usr/share/lensfun; empty if there is none.
std::string lensfun_folder();

struct CameraBody {
  std::string maker, model;  ///< as the database has them
  double crop_factor = 1.0;
};

/// Returns the body with this EXIF Model and a maker whose first word is that of EXIF Make; the comparison
/// ignores case and the length of blanks. None if the folder's files (*.xml, in the order of their names) do
/// not have it. Files that are not XML, or larger than 16 MB, and crop factors outside of 0.1 to 20 are
/// ignored.
std::optional<CameraBody> find_camera_body(const std::string& folder, const std::string& make,
                                           const std::string& model);

}  // namespace vegard::fit
