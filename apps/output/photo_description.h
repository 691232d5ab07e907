// The metadata of a picture, as text and as a scene to start from.
#pragma once

#include <string>
#include <vector>

#include "fit/photo/frames/frame_file.h"
#include "fit/photo/photo_facts.h"
#include "fit/photo/sky_map_file.h"
#include "sim/base/picture/picture_metadata.h"

namespace vegard::apps {

/// Returns a scene file with the most important keys. Behind every value stands its source: the picture, or
/// an assumption. Values of the picture outside a key's limits stand in a comment.
std::string start_scene(const std::string& photo_name, const fit::PhotoFacts& facts);

/// Returns the known metadata, line by line, with what the file declares about its light (`declared`), and
/// the resulting values of a scene's keys. `light`: a note of fit::assumed_light(), or empty.
std::string description_text(const std::string& photo_name, const sim::PictureMetadata& metadata,
                             const std::vector<std::string>& declared = {}, const std::string& light = {});

/// Returns the same for a file with many frames: the metadata of the first frame except its time, and the
/// frames with their times.
std::string frames_description_text(const std::string& file_name, const fit::FrameIndex& index,
                                    const std::vector<std::string>& declared);

/// Returns a description of a skymap: its size, how much of it looks at the sky and where, its place, and the
/// commands that accept it.
std::string sky_map_description_text(const std::string& file_name, const fit::SkyMapFile& map);

/// The same three descriptions as JSON, with units in the keys.
std::string description_json(const std::string& photo_name, const sim::PictureMetadata& metadata,
                             const std::vector<std::string>& declared = {}, const std::string& light = {});
std::string frames_description_json(const std::string& file_name, const fit::FrameIndex& index,
                                    const std::vector<std::string>& declared);
std::string sky_map_description_json(const std::string& file_name, const fit::SkyMapFile& map);

}  // namespace vegard::apps
