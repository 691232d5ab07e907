// Parses the comments that the imagers of THEMIS, REGO and TREx write into a frame's PGM: #"Key" value. This
// code calls keys and values of all such metadata "words".
//
// The first frame of a file has all keys, later frames only those whose value has changed. The case of the
// keys differs between imagers. The files' names say some of it too: 20140310_0603_gill_themis19_full.pgm.gz
// has a minute of frames, 20211030_060500_149606_gill_rgb-04_320ms_burst.png is one picture, at
// 06:05:00.149606 UTC.
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

/// What a file's name says.
struct ImagerName {
  double begin_s = 0.0;  ///< since 1970, UTC
  double lasts_s = 0.0;  ///< an hour or a minute; 0 for one picture
  std::string utc;       ///< beginning of the exposure, for one picture
  std::string site, imager, mode;
  std::optional<double> exposure_s;
};

/// Parses a file's name without its folder; none for a name of another form.
std::optional<ImagerName> imager_name(const std::string& file_name);

/// Adds to the metadata what the name says and the metadata lack; nothing if the name is of another form.
void add_imager_name(const std::string& file_name, sim::PictureMetadata& metadata);

/// Returns "its name says 06:03, the frame itself ..." if the times of the name and of the header contradict
/// each other; empty if they do not, or if one of them is unknown. The first frame of a minute may begin, and
/// the last end, some seconds outside of it.
std::string contradicted_time(const std::string& file_name, const sim::PictureMetadata& metadata);

}  // namespace vegard::fit
