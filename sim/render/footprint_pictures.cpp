#include "sim/render/footprint_pictures.h"

#include <filesystem>
#include <string>

#include "sim/base/error.h"
#include "sim/base/image_io.h"

namespace vegard::sim {
namespace {

constexpr const char* kFaces[6] = {"px", "nx", "py", "ny", "pz", "nz"};
const std::string kPlace = "{face}";

bool is_pictured(const Footprint& f) { return f.source == "image" || f.source == "cube"; }

std::string of_face(std::string name, const char* face) {
  for (std::size_t at = name.find(kPlace); at != std::string::npos; at = name.find(kPlace))
    name.replace(at, kPlace.size(), face);
  return name;
}

bool is_of_faces(const Footprint& f, const std::string& name) {
  return f.source == "cube" && name.find(kPlace) != std::string::npos;
}

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

void read(const Scene& scene, const std::string& key, const std::string& name, VolumeFiles& files) {
  if (files.pictures.count(name) > 0) return;
  try {
    files.pictures[name] =
        one_channel(read_picture((std::filesystem::path(scene.file).parent_path() / name).string()));
  } catch (const Error& error) {
    files.pictures.erase(name);
    ErrorDetails details = error.details();
    details.key = key;
    if (details.hint.empty()) details.hint = "its name is relative to the scene's file";
    throw Error(error.kind(), details);
  }
}

void read_all(const Scene& scene, const Footprint& f, const std::string& key, const std::string& name,
              VolumeFiles& files) {
  if (name.empty()) return;
  if (!is_of_faces(f, name)) return read(scene, key, name, files);
  for (const char* face : kFaces) read(scene, key, of_face(name, face), files);
}

const Image* find(const VolumeFiles& files, const std::string& name) {
  const auto found = files.pictures.find(name);
  return found == files.pictures.end() ? nullptr : &found->second;
}

}  // namespace

void read_footprint_pictures(const Scene& scene, VolumeFiles& files) {
  for (const Footprint& f : scene.footprints) {
    if (!is_pictured(f)) continue;
    const std::string path = "footprint." + f.name + ".";
    read_all(scene, f, path + "image", f.image, files);
    read_all(scene, f, path + "energy_image", f.energy_image, files);
  }
}

FootprintPictures footprint_pictures(const VolumeFiles& files, const Footprint& f) {
  FootprintPictures pictures;
  if (!is_pictured(f)) return pictures;
  const auto set = [&](const std::string& name, const Image*& one, std::array<const Image*, 6>& six) {
    if (!is_of_faces(f, name)) {
      one = find(files, name);
      return;
    }
    for (int face = 0; face < 6; ++face) six[face] = find(files, of_face(name, kFaces[face]));
  };
  set(f.image, pictures.flux, pictures.face);
  if (!f.energy_image.empty()) set(f.energy_image, pictures.energy, pictures.energy_face);
  return pictures;
}

}  // namespace vegard::sim
