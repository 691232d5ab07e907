#include "apps/input_files.h"

#include "apps/composite_pictures.h"
#include "apps/output_files.h"
#include "apps/usage_error.h"
#include "sim/scene/rows/decoding_word.h"
#include "sim/scene/table/table_files.h"

namespace vegard::apps {

std::vector<NamedInput> inputs_of_scene(const SceneOptions& options, const sim::Scene& scene) {
  std::vector<NamedInput> inputs = {{options.file, "the scene"}, {options.camera_file, "the camera's file"}};
  for (const std::string& file : picture_files(scene))
    inputs.push_back({file, "a file that the scene reads"});
  for (const sim::TableFile& table : sim::table_files(scene))
    inputs.push_back({sim::table_place(scene, table.name), "a table of the scene"});
  for (const sim::PhotoEntry& photo : scene.fit.photos) {
    inputs.push_back({sim::table_place(scene, photo.file), "a photograph"});
    if (!photo.mask.empty()) inputs.push_back({sim::table_place(scene, photo.mask), "a mask"});
    const std::string curve = photo.decoding.empty() ? "" : sim::decoding_word(photo.decoding).file;
    if (!curve.empty()) inputs.push_back({sim::table_place(scene, curve), "a transfer curve"});
  }
  return inputs;
}

void spare_inputs(const std::string& key, const std::string& output, const std::vector<NamedInput>& inputs) {
  for (const NamedInput& input : inputs)
    if (same_file(output, input.file)) refuse_same_file(key, output, input.what);
}

void spare_inputs_inside(const std::string& key, const std::string& folder,
                         const std::vector<NamedInput>& inputs) {
  for (const NamedInput& input : inputs)
    if (is_inside(input.file, folder))
      throw usage_error(key, input.what + " '" + input.file + "' lies in it",
                        "another directory, or " + input.what + " elsewhere");
}

}  // namespace vegard::apps
