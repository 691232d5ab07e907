// What a picture says of itself: as text, and as a scene to begin with.
#pragma once

#include <string>

#include "fit/photo/frames/frame_file.h"
#include "fit/photo/photo_facts.h"
#include "fit/photo/sky_map_file.h"
#include "sim/base/picture/picture_metadata.h"

namespace vegard::apps {

/// A scene file of the keys that one will want to look at. Behind every value stands where it comes from:
/// the picture, or that it is assumed. What the picture says outside of a key's limits stands in a comment.
std::string start_scene(const std::string& photo_name, const fit::PhotoFacts& facts);

/// `words` as a comment may hold them: printable ASCII, '?' for the rest.
std::string comment_words(std::string words);

/// What is known, line by line, and what follows from it in a scene's keys.
std::string description_text(const std::string& photo_name, const sim::PictureMetadata& metadata);

/// The same of a file with many frames: what its first says but for the time, and the frames with their
/// times.
std::string frames_description_text(const std::string& file_name, const fit::FrameIndex& index);

/// Of a skymap: its size, how much of it looks at the sky and where, its place, and who takes it.
std::string sky_map_description_text(const std::string& file_name, const fit::SkyMapFile& map);

/// The three as JSON: what is known, with units in the names.
std::string description_json(const std::string& photo_name, const sim::PictureMetadata& metadata);
std::string frames_description_json(const std::string& file_name, const fit::FrameIndex& index);
std::string sky_map_description_json(const std::string& file_name, const fit::SkyMapFile& map);

}  // namespace vegard::apps
