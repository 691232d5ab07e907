#include "fit/photo/scene_photos.h"

#include <filesystem>

#include "fit/photo/photo_metadata.h"
#include "sim/base/error.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/scene/table/photo_scene.h"

namespace vegard::fit {
namespace {

std::string beside_scene_file(const sim::Scene& scene, const std::string& name) {
  return (std::filesystem::path(scene.file).parent_path() / name).string();
}

Averaging averaging_of_pixels(const sim::Scene& scene, PhotoPixels pixels) {
  return pixels == PhotoPixels::for_fit ? averaging_for_fit(scene) : Averaging();
}

Photo photograph_of_entry(const sim::Scene& scene, const sim::PhotoEntry& entry, PhotoPixels pixels) {
  const sim::Scene own = sim::scene_of_photo(scene, entry);
  const Decoding decoding = entry.decoding.empty()
                                ? decoding_for(scene, "")
                                : decoding_of_word(entry.decoding, nullptr, beside_scene_file(scene, ""));
  Photo photo =
      read_photo(beside_scene_file(scene, entry.file), decoding, &own, averaging_of_pixels(own, pixels));
  if (!entry.mask.empty()) apply_mask(photo, beside_scene_file(scene, entry.mask));
  return photo;
}

}  // namespace

Decoding decoding_for(const sim::Scene& scene, const std::string& word) {
  return word.empty() ? decoding_of_word(scene.fit.decoding, &scene) : decoding_of_word(word);
}

Photo photograph_for(const sim::Scene& scene, const std::string& file, const std::string& mask,
                     const std::string& decoding, PhotoPixels pixels) {
  Photo photo = read_photo(file, decoding_for(scene, decoding), &scene, averaging_of_pixels(scene, pixels));
  if (!mask.empty()) apply_mask(photo, mask);
  return photo;
}

std::vector<Photo> photographs_of(const sim::Scene& scene, PhotoPixels pixels) {
  std::vector<Photo> photos;
  for (const sim::PhotoEntry& entry : scene.fit.photos) {
    try {
      photos.push_back(photograph_of_entry(scene, entry, pixels));
    } catch (const sim::Error& error) {
      const sim::ErrorDetails& details = error.details();
      const bool needs_hint = details.hint.empty() && error.kind() == sim::ErrorKind::unreadable_input;
      throw sim::Error(error)
          .problem("photograph '" + entry.name + "': " + details.problem)
          .hint(needs_hint ? "its name is relative to the scene's file" : details.hint);
    }
  }
  return photos;
}

sim::PictureMetadata metadata_with_size(const std::string& photo) {
  sim::PictureMetadata metadata = photo_metadata(photo);
  if (!metadata.width_px || !metadata.height_px) {
    const Photo pixels = read_photo(photo, Decoding::automatic);
    metadata.width_px = pixels.linear.width;
    metadata.height_px = pixels.linear.height;
  }
  return metadata;
}

PhotoDefaults taken_from_photograph(const sim::Scene& scene, const std::string& photo,
                                    const std::set<std::string>& also_given) {
  // To decode a large picture only for a size that is given already would be a waste.
  const bool size_given = scene.lines.count("camera.width") + also_given.count("camera.width") > 0 ||
                          scene.lines.count("camera.height") + also_given.count("camera.height") > 0;
  const sim::PictureMetadata metadata = size_given ? photo_metadata(photo) : metadata_with_size(photo);
  PhotoDefaults defaults = with_photo_defaults(scene, metadata, also_given);
  sim::validate(defaults.scene);
  return defaults;
}

}  // namespace vegard::fit
