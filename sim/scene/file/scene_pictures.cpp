#include "sim/scene/file/scene_pictures.h"

#include <filesystem>

#include "sim/base/error.h"
#include "sim/base/picture/image_io.h"
#include "sim/scene/file/named_files.h"

namespace vegard::sim {
namespace {

Image one_channel(const PictureFile& file) {
  const Image& from = file.image;
  const bool has_alpha = from.channel_names.back() == "A";
  const int colours = from.channels() - (has_alpha ? 1 : 0);
  Image to(from.width, from.height, {"Y"});
  for (int y = 0; y < from.height; ++y)
    for (int x = 0; x < from.width; ++x) {
      float sum = 0.0f;
      for (int c = 0; c < colours; ++c) sum += from.at(x, y, c);
      if (has_alpha && !file.colour_times_alpha) sum *= from.at(x, y, colours);
      to.at(x, y, 0) = sum / static_cast<float>(colours);
    }
  return to;
}

void read(const Scene& scene, const std::string& key, const std::string& name,
          std::map<std::string, Image>& pictures) {
  if (pictures.count(name) > 0) return;
  try {
    pictures[name] =
        one_channel(read_picture((std::filesystem::path(scene.file).parent_path() / name).string()));
  } catch (const Error& error) {
    ErrorDetails details = error.details();
    details.key = key;
    if (details.hint.empty()) details.hint = "its name is relative to the scene's file";
    throw Error(error.kind(), details);
  }
}

}  // namespace

std::vector<std::string> picture_files(const Footprint& f, const std::string& name) {
  if (name.empty() || (f.source != FootprintSource::image && f.source != FootprintSource::cube)) return {};
  return f.source == FootprintSource::cube ? files_of_name(name) : std::vector<std::string>{name};
}

std::map<std::string, Image> read_scene_pictures(const Scene& scene) {
  std::map<std::string, Image> pictures;
  for (const Footprint& f : scene.footprints) {
    const std::string path = "footprint." + f.name + ".";
    for (const std::string& name : picture_files(f, f.image)) read(scene, path + "image", name, pictures);
    for (const std::string& name : picture_files(f, f.energy_image))
      read(scene, path + "energy_image", name, pictures);
  }
  for (const Chromosphere& c : scene.chromospheres)
    if (!c.biasmap.empty()) read(scene, "chromosphere." + c.name + ".biasmap", c.biasmap, pictures);
  return pictures;
}

}  // namespace vegard::sim
