// When a picture was taken, by all that it says: the header's time, the camera's clock and its zone, the time
// of the GPS and that in the file's name. Times that contradict each other are told, with the one that is
// used.
//
// A clock less UTC is a time zone: a multiple of 15 minutes from -12 to +14 h. The GPS gives the time of its
// last position. Its date may be off where its time of day is right: by a day (written by the local
// calendar), or by 1024 weeks, after which receivers begin to count anew. It may be old: a receiver without
// satellites repeats its last time.
#pragma once

#include <string>
#include <vector>

#include "sim/base/picture/picture_metadata.h"

namespace vegard::fit {

struct TakenTime {
  std::string utc;     ///< beginning of the exposure, ISO 8601; empty: not known
  std::string source;  ///< "EXIF DateTimeOriginal and OffsetTimeOriginal"
  /// Standard error in s: of the last digit (its unit over the root of 12), and what clock and GPS differ by.
  double error_s = 0.0;
  std::vector<std::string> notes;  ///< contradictions, as sentences without a full stop
  bool by_gps = false;             ///< the time is the GPS's, or the zone follows from it
};

TakenTime taken_time(const sim::PictureMetadata& metadata);

/// Returns how long after its beginning the middle of the exposure was, at which the stars stood where the
/// picture shows them; none if the exposure is not known.
std::optional<double> middle_after_s(const sim::PictureMetadata& metadata);

/// Returns what is wrong with the time in a file's name beside the time that the picture tells, "the file's
/// name says ..."; empty if nothing is, or one of them is not known. A name without a zone may be in any.
std::string contradicted_by_name(const std::string& file_name, const sim::PictureMetadata& metadata);

}  // namespace vegard::fit
