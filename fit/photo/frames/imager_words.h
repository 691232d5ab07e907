// Parses the comments that the imagers of THEMIS, REGO and TREx write into a frame's PGM: #"Key" value. This
// code calls keys and values of all such metadata "words".
//
// The first frame of a file has all keys, later frames only those whose value has changed. The case of the
// keys differs between imagers.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/base/picture/picture_metadata.h"

namespace vegard::fit {

/// Keys and values as in the file, in the file's order.
using ImagerWords = std::vector<std::pair<std::string, std::string>>;

/// Name of the words of a PGM, for messages.
inline constexpr const char* kPgmComment = "PGM comment";

/// Parses the header of a PGM or PPM; ignores comments of another form.
ImagerWords imager_words(std::string_view header);

/// Returns the words `own` of a frame, and those of the file's first frame, `first`, that it lacks.
ImagerWords with_words_of_file(const ImagerWords& own, const ImagerWords& first);

struct ImagerTime {
  std::string utc;       ///< beginning of the exposure, "2014-03-10T06:05:33.029314Z"
  double seconds = 0.0;  ///< the same since 1970 (sim/base/utc_time.h)
  std::string source;    ///< the word that says it
};

/// Returns the frame's time; none if no word gives it, or if it is not a valid date. `kind`: name of the
/// words, for ImagerTime::source.
std::optional<ImagerTime> imager_time(const ImagerWords& words, const std::string& kind = kPgmComment);

/// Returns the exposure that was requested from the camera, in seconds; none if no word gives it.
std::optional<double> imager_exposure_s(const ImagerWords& words);

/// Returns why the size in "Exposure options" contradicts that of the picture; empty if it does not. The
/// options may give the number of sensor pixels before or after binning, or a whole multiple of the binned
/// size if the file was reduced.
std::string contradicted_size(const ImagerWords& words, int width_px, int height_px);

/// Returns time, place, exposure and camera from the words, each with its source, and the size.
sim::PictureMetadata imager_metadata(const ImagerWords& words, int width_px, int height_px,
                                     const std::string& kind = kPgmComment);

}  // namespace vegard::fit
