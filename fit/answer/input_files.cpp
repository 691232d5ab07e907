#include "fit/answer/input_files.h"

#include <filesystem>

#include "sim/base/file/number_text.h"

namespace vegard::fit {

std::vector<InputFile> inputs_of(const std::string& scene_file, const std::string& scene_sha256,
                                 const std::vector<Photo>& photos) {
  std::vector<InputFile> inputs = {
      {"scene", std::filesystem::path(scene_file).filename().string(), scene_sha256}};
  for (const Photo& photo : photos) {
    if (photo.filters.empty()) inputs.push_back({"photo", photo.file_name, photo.sha256});
    for (const PhotoPart& part : photo.filters)
      if (part.wavelength_nm > 0.0)
        inputs.push_back(
            {"photo " + sim::short_number(part.wavelength_nm) + " nm", part.file_name, part.sha256});
    if (!photo.mask_name.empty()) inputs.push_back({"mask", photo.mask_name, photo.mask_sha256});
  }
  return inputs;
}

}  // namespace vegard::fit
