#include "fit/answer/input_files.h"

#include <filesystem>

#include "sim/base/file/number_text.h"

namespace vegard::fit {
namespace input_files {
namespace {

InputFile of_scene(const std::string& file, const std::string& sha256) {
  return {"scene", std::filesystem::path(file).filename().string(), sha256};
}

void add_photo(const Photo& photo, std::vector<InputFile>& inputs) {
  if (photo.filters.empty()) inputs.push_back({"photo", photo.file_name, photo.sha256});
  for (const PhotoPart& part : photo.filters)
    if (part.wavelength_nm > 0.0)
      inputs.push_back(
          {"photo " + sim::short_number(part.wavelength_nm) + " nm", part.file_name, part.sha256});
  if (!photo.mask_name.empty()) inputs.push_back({"mask", photo.mask_name, photo.mask_sha256});
}

}  // namespace
}  // namespace input_files

std::vector<InputFile> inputs_of(const std::string& scene_file, const std::string& scene_sha256,
                                 const std::vector<Photo>& photos) {
  std::vector<InputFile> inputs = {input_files::of_scene(scene_file, scene_sha256)};
  for (const Photo& photo : photos) input_files::add_photo(photo, inputs);
  return inputs;
}

std::vector<InputFile> inputs_of(const std::string& scene_file, const std::string& scene_sha256,
                                 const Photo& photo) {
  std::vector<InputFile> inputs = {input_files::of_scene(scene_file, scene_sha256)};
  input_files::add_photo(photo, inputs);
  return inputs;
}

void add_radar_files(FitResult& result) {
  for (const FittedRadar& radar : result.radars) result.inputs.push_back({"radar", radar.file, radar.sha256});
}

}  // namespace vegard::fit
