// Sensor sizes of cameras, from the database of Lensfun (https://lensfun.github.io). It is read where it is
// installed (Debian's package liblensfun-data-v1; CC BY-SA 3.0); nothing of it is part of vegard.
//
// Its files hold elements <camera> with <maker>, <model> and <cropfactor>: the diagonal of 36 mm x 24 mm over
// the sensor's.
#pragma once

#include <optional>
#include <string>

namespace vegard::fit {

/// The folder of VEGARD_LENSFUN, or the first that there is of /usr/local/share/lensfun and
/// /usr/share/lensfun with version_1 or version_2 in it; empty if there is none.
std::string lensfun_folder();

struct CameraBody {
  std::string maker, model;  ///< as the database has them
  double crop_factor = 1.0;
};

/// The body with this EXIF Model, and a Make that begins with the same word, letters of either case and runs
/// of blanks being the same; none if the folder's files (*.xml, in the order of their names) have none. Files
/// that are no XML, or larger than 16 MB, and crop factors outside of 0.1 to 20 are passed over.
std::optional<CameraBody> find_camera_body(const std::string& folder, const std::string& make,
                                           const std::string& model);

}  // namespace vegard::fit
