// A picture's metadata as keys and values of a scene, each with its source.
#pragma once

#include <string>
#include <vector>

#include "sim/base/picture/picture_metadata.h"

namespace vegard::fit {

struct PhotoFact {
  std::string path;    ///< "camera.hfov_deg"
  std::string value;   ///< as TOML has it: "65.47", "\"2019-03-01T07:16:01Z\""
  std::string source;  ///< "EXIF FocalLengthIn35mmFilm 27 mm, by the diagonal"
};

struct PhotoFacts {
  std::vector<PhotoFact> facts;    ///< in the order of a scene file
  std::vector<std::string> notes;  ///< what the picture says and no key can take, or what it does not say
};

/// Site, time, the pinhole's field of view and size, exposure, ISO and f-number, as far as they are known.
/// The time is that of the camera's clock where its zone is known, else that of the GPS, else none.
PhotoFacts photo_facts(const sim::PictureMetadata& metadata);

/// "camera.hfov_deg = 65.47 (EXIF FocalLengthIn35mmFilm 27 mm, by the diagonal)"
std::string fact_text(const PhotoFact& fact);

}  // namespace vegard::fit
