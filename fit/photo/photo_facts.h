// Converts a picture's metadata to keys and values of a scene, each with its source.
#pragma once

#include <string>
#include <vector>

#include "sim/base/picture/picture_metadata.h"

namespace vegard::fit {

struct PhotoFact {
  std::string path;    ///< "camera.hfov_deg"
  std::string value;   ///< in TOML's notation: "65.47", "\"2019-03-01T07:16:01Z\""
  std::string source;  ///< "EXIF FocalLengthIn35mmFilm 27 mm, by the diagonal"
};

struct PhotoFacts {
  std::vector<PhotoFact> facts;    ///< in the order of a scene file
  std::vector<std::string> notes;  ///< metadata for which there is no key, and what the metadata lack
};

/// Returns site, time, the pinhole's field of view and size, exposure, ISO and f-number, as far as the
/// metadata have them. The time is that of taken_time() (fit/photo/taken_time.h).
PhotoFacts photo_facts(const sim::PictureMetadata& metadata);

/// Returns a note on what light the numbers of a picture are taken for, where its file leaves that open and
/// it has more than eight bits (assume_light() of fit/photo/codec/picture_codes.h); empty for others, and for
/// what is no sound picture.
std::string assumed_light(const std::string& photo);

/// Returns a fact as "camera.hfov_deg = 65.47 (EXIF FocalLengthIn35mmFilm 27 mm, by the diagonal)".
std::string fact_text(const PhotoFact& fact);

}  // namespace vegard::fit
