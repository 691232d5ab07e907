#include "sim/render/emitters/footprint_pictures.h"

#include <string>
#include <vector>

#include "sim/scene/file/scene_pictures.h"

namespace vegard::sim {

FootprintPictures footprint_pictures(const VolumeFiles& files, const Footprint& f) {
  FootprintPictures pictures;
  const auto set = [&](const std::string& key, const Image*& one, std::array<const Image*, 6>& six) {
    const std::vector<std::string> names = picture_files(f, key);
    const auto find = [&](const std::string& name) -> const Image* {
      const auto found = files.pictures.find(name);
      return found == files.pictures.end() ? nullptr : &found->second;
    };
    if (names.size() == 1) one = find(names[0]);
    if (names.size() == six.size())
      for (std::size_t face = 0; face < six.size(); ++face) six[face] = find(names[face]);
  };
  set(f.image, pictures.flux, pictures.face);
  set(f.energy_image, pictures.energy, pictures.energy_face);
  return pictures;
}

}  // namespace vegard::sim
