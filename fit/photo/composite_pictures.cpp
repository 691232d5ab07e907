#include "fit/photo/composite_pictures.h"

#include <filesystem>

#include "sim/base/error.h"
#include "sim/base/picture/image_io.h"
#include "sim/scene/file/named_files.h"
#include "sim/scene/structs/line_of.h"

namespace vegard::fit {
namespace {

std::string beside_scene(const sim::Scene& scene, const std::string& name) {
  return (std::filesystem::path(scene.file).parent_path() / name).string();
}

sim::PictureFile read_named(const sim::Scene& scene, const std::string& key, const std::string& name) {
  try {
    return sim::read_picture(beside_scene(scene, name));
  } catch (const sim::Error& error) {
    const std::string& hint = error.details().hint;
    throw sim::Error(error).key(key).hint(hint.empty() ? "its name is relative to the scene's file" : hint);
  }
}

sim::Image read_foreground(const sim::Scene& scene) {
  const sim::Composite& composite = scene.composite;
  if (composite.foreground.empty() && composite.mask.empty()) return {};
  sim::Image coverage, foreground;
  if (!composite.mask.empty())
    coverage = sim::coverage_of(read_named(scene, "composite.mask", composite.mask));
  if (composite.foreground.empty()) {
    foreground = sim::Image(coverage.width, coverage.height, {"R", "G", "B", "A"});
  } else {
    const sim::PictureFile file = read_named(scene, "composite.foreground", composite.foreground);
    if (coverage.empty() && file.image.channel_names.back() != "A") {
      throw sim::with_place(
          sim::Error(sim::ErrorKind::scene,
                     "'" + composite.foreground + "' has no alpha: it would hide the whole sky")
              .key("composite.foreground")
              .hint("give a composite.mask, white where it hides the sky"),
          scene);
    }
    foreground = sim::linear_picture(file);
  }
  return coverage.empty() ? foreground : sim::with_coverage(foreground, coverage);
}

}  // namespace

sim::CompositePictures read_composite_pictures(const sim::Scene& scene) {
  const auto filled = [&](const sim::Image& picture) {
    return picture.empty() ? sim::Image() : sim::fill_frame(picture, scene.camera.width, scene.camera.height);
  };
  sim::CompositePictures pictures;
  if (!scene.composite.background.empty())
    pictures.background =
        filled(sim::linear_picture(read_named(scene, "composite.background", scene.composite.background)));
  pictures.foreground = filled(read_foreground(scene));
  return pictures;
}

std::vector<std::string> picture_files(const sim::Scene& scene) {
  std::vector<std::string> files;
  for (const sim::NamedFile& named : sim::named_files(scene))
    for (const std::string& name : sim::files_of_name(named.name)) files.push_back(beside_scene(scene, name));
  return files;
}

}  // namespace vegard::fit
