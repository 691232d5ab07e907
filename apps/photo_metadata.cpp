#include "apps/photo_metadata.h"

#include <cstdio>
#include <set>
#include <utility>

#include "fit/photo/photo.h"
#include "fit/photo/photo_defaults.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::apps {
namespace {

std::set<std::string> paths_of(const std::vector<std::string>& changes) {
  std::set<std::string> paths;
  for (const std::string& words : changes) {
    std::string path = words.substr(0, words.find('='));
    path.erase(path.find_last_not_of(' ') + 1);
    path.erase(0, path.find_first_not_of(' '));
    paths.insert(path);
  }
  return paths;
}

}  // namespace

void add_no_metadata_option(CLI::App& command, bool& off) {
  command.add_flag("--no-metadata", off,
                   "Do not take what the scene leaves out (place, time, size, field of view, exposure) from "
                   "the photograph's own words");
}

sim::PictureMetadata metadata_of(const std::string& photo) {
  sim::PictureMetadata metadata = sim::read_picture_metadata(photo);
  if (!metadata.width_px || !metadata.height_px) {
    const fit::Photo pixels = fit::read_photo(photo, fit::Decoding::automatic);
    metadata.width_px = pixels.linear.width;
    metadata.height_px = pixels.linear.height;
  }
  return metadata;
}

std::vector<fit::PhotoFact> take_from_photograph(sim::Scene& scene, const std::string& photo,
                                                 const std::vector<std::string>& changes) {
  const std::set<std::string> given = paths_of(changes);
  // To decode a large picture only for a size that is given already would be a waste.
  const bool size_given = scene.lines.count("camera.width") + given.count("camera.width") > 0 ||
                          scene.lines.count("camera.height") + given.count("camera.height") > 0;
  const sim::PictureMetadata metadata = size_given ? sim::read_picture_metadata(photo) : metadata_of(photo);
  fit::PhotoDefaults defaults = fit::with_photo_defaults(scene, metadata, given);
  sim::validate(defaults.scene);
  for (const fit::PhotoFact& fact : defaults.taken)
    std::printf("from the photograph: %s\n", fit::fact_text(fact).c_str());
  for (const std::string& note : defaults.notes) std::printf("note: %s\n", note.c_str());
  std::fflush(stdout);  // before a long fit
  scene = std::move(defaults.scene);
  return defaults.taken;
}

}  // namespace vegard::apps
