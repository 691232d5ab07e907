#include "apps/photographs.h"

#include <filesystem>

#include "apps/decoding.h"
#include "sim/base/error.h"
#include "sim/base/file/number_text.h"
#include "sim/scene/table/photo_scene.h"

namespace vegard::apps {
namespace {

std::string beside(const std::string& scene_file, const std::string& name) {
  return (std::filesystem::path(scene_file).parent_path() / name).string();
}

fit::Photo photograph_of(const sim::Scene& scene, const sim::PhotoEntry& entry) {
  const sim::Scene own = sim::scene_of_photo(scene, entry);
  const fit::Decoding decoding = entry.decoding.empty()
                                     ? decoding_of("", scene.fit.decoding, &scene)
                                     : decoding_of("", entry.decoding, nullptr, beside(scene.file, ""));
  fit::Photo photo = fit::read_photo(beside(scene.file, entry.file), decoding, &own);
  if (!entry.mask.empty()) fit::apply_mask(photo, beside(scene.file, entry.mask));
  return photo;
}

}  // namespace

std::vector<fit::Photo> photographs_of(const sim::Scene& scene) {
  std::vector<fit::Photo> photos;
  for (const sim::PhotoEntry& entry : scene.fit.photos) {
    try {
      photos.push_back(photograph_of(scene, entry));
    } catch (const sim::Error& error) {
      sim::ErrorDetails details = error.details();
      details.problem = "photograph '" + entry.name + "': " + details.problem;
      if (details.hint.empty() && error.kind() == sim::ErrorKind::unreadable_input)
        details.hint = "its name is relative to the scene's file";
      throw sim::Error(error.kind(), details);
    }
  }
  return photos;
}

std::vector<fit::InputFile> inputs_of(const std::string& scene_file, const std::string& scene_sha256,
                                      const std::vector<fit::Photo>& photos) {
  std::vector<fit::InputFile> inputs = {
      {"scene", std::filesystem::path(scene_file).filename().string(), scene_sha256}};
  for (const fit::Photo& photo : photos) {
    if (photo.filters.empty()) inputs.push_back({"photo", photo.file_name, photo.sha256});
    for (const fit::PhotoPart& part : photo.filters)
      if (part.wavelength_nm > 0.0)
        inputs.push_back(
            {"photo " + fit::short_number(part.wavelength_nm) + " nm", part.file_name, part.sha256});
    if (!photo.mask_name.empty()) inputs.push_back({"mask", photo.mask_name, photo.mask_sha256});
  }
  return inputs;
}

}  // namespace vegard::apps
