// Marks a movie as spherical, so that players show it in all directions: with Google's "Spherical Video"
// metadata of version 1 (an XML text in a box of its own in the track) and version 2 (boxes st3d and sv3d in
// the description of the samples; both in https://github.com/google/spatial-media, docs). The pictures are
// unchanged.
#pragma once

#include <string>

namespace vegard::apps {

/// Returns the box "moov" of an MP4 file with both kinds of metadata added to its video track; `moov` begins
/// with the box's own size and type. Chunks of the file that precede the box keep their places. Throws
/// Error(unreadable_input), with the movie's name, if it is not such a box or has no video.
std::string spherical_moov(const std::string& moov, const std::string& name);

/// Adds both to the file of an equirectangular movie whose last box is "moov". Throws
/// Error(unreadable_input), Error(unwritable_output).
void mark_as_spherical(const std::string& path, const std::string& name);

}  // namespace vegard::apps
