// What a movie says of itself so that players show it all around: Google's "Spherical Video", its first
// version (an XML text in a box of its own in the track) and its second (boxes st3d and sv3d in the
// description of the samples; both in https://github.com/google/spatial-media, docs). Nothing of the pictures
// changes.
#pragma once

#include <string>

namespace vegard::apps {

/// The box "moov" of an MP4 file with both added to its video track; `moov` begins with the box's own size
/// and type. Chunks of the file that lie before it stay where they are. Throws Error(unreadable_input), with
/// the movie's name, for what is no such box or has no video.
std::string spherical_moov(const std::string& moov, const std::string& name);

/// Writes both into the file of an equirectangular movie whose last box is "moov". Throws
/// Error(unreadable_input), Error(unwritable_output).
void mark_as_spherical(const std::string& path, const std::string& name);

}  // namespace vegard::apps
