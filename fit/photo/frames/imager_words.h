// Parses the comments that the imagers of THEMIS, REGO and TREx write into a frame's PGM: #"Key" value.
//
// The first frame of a file says everything, those after it what has changed since; keys are spelt with
// capitals here and without there.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/base/picture/picture_metadata.h"

namespace vegard::fit {

/// Keys and values as they stand there, in their order.
using ImagerWords = std::vector<std::pair<std::string, std::string>>;

/// What the words are that stand in a PGM.
inline constexpr const char* kPgmComment = "PGM comment";

/// Of the header of a PGM or PPM; comments of another form are passed over.
ImagerWords imager_words(std::string_view header);

/// `own`, and what only `first`, the words of the file's first frame, say.
ImagerWords with_words_of_file(const ImagerWords& own, const ImagerWords& first);

struct ImagerTime {
  std::string utc;       ///< "2014-03-10T06:05:33.029314Z", when the exposure began
  double seconds = 0.0;  ///< the same since 1970 (sim/base/utc_time.h)
  std::string source;    ///< the word that says it
};

/// Nothing where no word gives it, or one that no calendar has. `kind`: what the words are, for its source.
std::optional<ImagerTime> imager_time(const ImagerWords& words, const std::string& kind = kPgmComment);

/// What was asked of the camera, in seconds; nothing where no word gives it.
std::optional<double> imager_exposure_s(const ImagerWords& words);

/// Why the size that "Exposure options" give cannot be that of the picture: they give the sensor's pixels
/// that were read, or what binning has made of them, or a whole multiple of the latter where the file was
/// made smaller. Empty if it can.
std::string contradicted_size(const ImagerWords& words, int width_px, int height_px);

/// Time, place, exposure and camera, with the words that say them, and the size.
sim::PictureMetadata imager_metadata(const ImagerWords& words, int width_px, int height_px,
                                     const std::string& kind = kPgmComment);

}  // namespace vegard::fit
