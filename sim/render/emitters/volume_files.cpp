#include "sim/render/emitters/volume_files.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <new>

#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/base/picture/image_io.h"
#include "sim/base/text.h"
#include "sim/scene/file/named_files.h"
#include "sim/scene/file/volume_grid_file.h"
#include "sim/view/camera/camera.h"

namespace vegard::sim {
namespace {

constexpr const char* kDepthKey = "march.depth";

std::vector<std::shared_ptr<const GridBricks>> read_grids(const Scene& scene) {
  std::vector<std::shared_ptr<const GridBricks>> grids;
  for (const Volume& volume : scene.volumes) {
    const VolumeGridFile file = read_volume_grid(scene, volume);
    const std::string key = "volume." + volume.name + ".file";
    try {
      const auto grid =
          std::make_shared<GridBricks>(file.grid, file.emission, file.density, file.place, file.site,
                                       scene.site, kMaxGridBytes, scene.body.radius_km);
      if (volume.home) grid->set_home(*volume.home, scene.site);
      grids.push_back(grid);
    } catch (const Error& error) {
      throw Error(error).kind(ErrorKind::unreadable_input).key(key);
    } catch (const std::bad_alloc&) {
      throw Error(ErrorKind::unreadable_input, "there is not enough memory for its grids")
          .file(file.place)
          .key(key);
    }
  }
  return grids;
}

bool is_depth(const std::string& channel) {
  return channel == "Z" || (channel.size() > 2 && ends_with(channel, ".Z"));
}

/// The one channel that counts.
Image depth_channel(const std::string& path) {
  const Image all = lowered_extension(path) == ".exr" ? read_exr(path).image : read_picture(path).image;
  const auto& names = all.channel_names;
  const auto found = std::find_if(names.begin(), names.end(), is_depth);
  const int channel = found != names.end() ? static_cast<int>(found - names.begin()) : 0;
  Image one(all.width, all.height, {"Z"});
  for (std::size_t i = 0; i < one.data.size(); ++i) one.data[i] = all.data[i * names.size() + channel];
  return one;
}

}  // namespace

VolumeFiles read_volume_files(const Scene& scene) {
  VolumeFiles files;
  files.depth = read_depth(scene);
  files.pictures = read_scene_pictures(scene);
  files.maps = read_precipitation_maps(scene);
  files.grids = read_grids(scene);
  return files;
}

DepthImage read_depth(const Scene& scene) {
  if (scene.march.depth.empty()) return {};
  const std::string path = (std::filesystem::path(scene.file).parent_path() / scene.march.depth).string();
  Image values;
  try {
    values = depth_channel(path);
  } catch (const Error& error) {
    const std::string& hint = error.details().hint;
    throw Error(error).key(kDepthKey).hint(hint.empty() ? "its name is relative to the scene's file" : hint);
  }
  const auto size = [](int width, int height) {
    return std::to_string(width) + " x " + std::to_string(height) + " pixels";
  };
  if (values.width != scene.camera.width || values.height != scene.camera.height)
    throw Error(ErrorKind::unreadable_input, "the depths have " + size(values.width, values.height))
        .file(path)
        .key(kDepthKey)
        .expected(size(scene.camera.width, scene.camera.height) + ", as the camera has");
  if (!std::all_of(values.data.begin(), values.data.end(), [](float value) { return value >= 0.0f; }))
    throw Error(ErrorKind::unreadable_input, "a depth is negative or no number")
        .file(path)
        .key(kDepthKey)
        .expected("0 or above; infinity where there is nothing");
  return depth_image(scene.march, values);
}

double ray_end_km(const CameraView<double>& view, const Scene& scene, const DepthImage& depth, double x_px,
                  double y_px, const double direction[3]) {
  const double* forward = view.camera_from_enu[2];
  const double cosine = forward[0] * direction[0] + forward[1] * direction[1] + forward[2] * direction[2];
  return std::min(ground_km(scene.site.altitude_m * 1e-3, direction[2], scene.body.radius_km),
                  depth.end_km(x_px, y_px, cosine));
}

std::vector<float> ray_ends_km(const Scene& scene, const FilmGeometry& film, const DepthImage& depth,
                               int threads) {
  const CameraView<double> view = camera_view(scene.camera);
  std::vector<float> ends(static_cast<std::size_t>(film.rows) * film.columns);
  parallel_for(static_cast<std::size_t>(film.rows), threads, [&](std::size_t row, int) {
    const double y = film.y0_px + (static_cast<double>(row) + 0.5) * film.cell_height_px;
    for (int column = 0; column < film.columns; ++column) {
      const double x = film.x0_px + (column + 0.5) * film.cell_width_px;
      double enu[3];
      ends[row * film.columns + column] = enu_of_pixel(view, x, y, enu)
                                              ? static_cast<float>(ray_end_km(view, scene, depth, x, y, enu))
                                              : std::numeric_limits<float>::quiet_NaN();
    }
  });
  return ends;
}

}  // namespace vegard::sim
