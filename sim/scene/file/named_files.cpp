#include "sim/scene/file/named_files.h"

#include <filesystem>

#include "sim/base/error.h"
#include "sim/base/picture/image_io.h"
#include "sim/scene/emitters/emitter_kinds.h"
#include "sim/scene/table/parameter_declarations.h"

namespace vegard::sim {
namespace {

constexpr std::string_view kFace = "{face}";

/// Calls use(path, name) for every name that is not empty.
template <class Use>
void for_each_name(Scene& scene, const Use& use) {
  for (const Declaration& d : declarations()) {
    if (!d.names_file) continue;
    for (int e = 0; e < element_count(d, scene); ++e) {
      std::string& name = *std::get<std::string*>(d.at(scene, e, 0));
      if (!name.empty()) use(key_path(d, scene, e), name);
    }
  }
}

}  // namespace

std::vector<NamedFile> named_files(const Scene& scene) {
  std::vector<NamedFile> files;
  // Only read through: the accessors take a Scene they could change.
  for_each_name(const_cast<Scene&>(scene), [&](const std::string& path, const std::string& name) {
    files.push_back({path, name});
  });
  return files;
}

std::vector<std::string> files_of_name(const std::string& name) {
  const std::size_t at = name.find(kFace);
  if (at == std::string::npos) return {name};
  std::vector<std::string> files;
  for (const char* face : {"px", "nx", "py", "ny", "pz", "nz"})
    files.push_back(name.substr(0, at) + face + name.substr(at + kFace.size()));
  return files;
}

void rename_files(Scene& scene, const std::function<std::string(const std::string&)>& renamed) {
  for_each_name(scene, [&](const std::string&, std::string& name) { name = renamed(name); });
}

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
    const std::string& hint = error.details().hint;
    throw Error(error).key(key).hint(hint.empty() ? "its name is relative to the scene's file" : hint);
  }
}

}  // namespace

std::vector<std::string> picture_files(const Footprint& f, const std::string& name) {
  if (name.empty() || (f.source != FootprintSource::image && f.source != FootprintSource::cube)) return {};
  return f.source == FootprintSource::cube ? files_of_name(name) : std::vector<std::string>{name};
}

std::map<std::string, Image> read_scene_pictures(const Scene& scene) {
  std::map<std::string, Image> pictures;
  for (const EmitterKind& kind : emitter_kinds()) {
    if (kind.pictures == nullptr) continue;
    for (const PictureOfScene& picture : kind.pictures(scene))
      for (const std::string& name :
           picture.is_cube ? files_of_name(picture.name) : std::vector<std::string>{picture.name})
        read(scene, picture.path, name, pictures);
  }
  return pictures;
}

}  // namespace vegard::sim
