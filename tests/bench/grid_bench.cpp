// How fast a grid of light is marched, and how two pictures differ; scripts/compare_with_cycles.sh puts it
// beside Blender.
//
//   grid_bench march SCENE [--threads N] [--repeat N] [--rays N] [-o OUT.exr]
//     The scene's volumes on a film of the camera's pixels: median of the march alone, without reading the
//     file, and samples per second. --rays N: N x N rays to a pixel, whose mean is written.
//   grid_bench difference A.exr B.exr
//     Of their first channels: what scripts and docs/openvdb.md say of agreement.
//   grid_bench sweep SCENE [--threads N]
//     How the time grows with pixels and step.
//   grid_bench tiny
//     A check that it still runs, on a ball of its own.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "apps/options/command.h"
#include "sim/base/grid/vdb_io.h"
#include "sim/base/picture/image_io.h"
#include "sim/render/volumes/volumes.h"
#include "sim/scene/file/scene_toml.h"

namespace vegard::bench {
namespace {

using namespace sim;

FilmGeometry film_of(const Scene& scene, int rays) {
  FilmGeometry film;
  film.columns = scene.camera.width * rays;
  film.rows = scene.camera.height * rays;
  film.cell_width_px = film.cell_height_px = 1.0 / rays;
  return film;
}

Scene scene_at(const std::string& file, int width) {
  Scene scene = read_scene(file);
  if (width > 0) {
    scene.camera.height = scene.camera.height * width / scene.camera.width;
    scene.camera.width = width;
  }
  return scene;
}

struct Timed {
  VolumeLight light;
  double median_s = 0.0, min_s = 0.0, max_s = 0.0;
};

Timed march(const Volumes& volumes, const Scene& scene, int rays, int repeat) {
  Timed out;
  std::vector<double> seconds;
  for (int n = 0; n < repeat; ++n) {
    const auto start = std::chrono::steady_clock::now();
    out.light = volumes.light(scene, film_of(scene, rays));
    seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::sort(seconds.begin(), seconds.end());
  out.median_s = seconds[seconds.size() / 2];
  out.min_s = seconds.front();
  out.max_s = seconds.back();
  return out;
}

/// Means over rays x rays cells, of the first line.
Image picture(const Scene& scene, const VolumeLight& light, int rays) {
  Image image(scene.camera.width, scene.camera.height, {"rayleigh"});
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      double sum = 0.0;
      for (int j = 0; j < rays; ++j)
        for (int i = 0; i < rays; ++i)
          sum += light.rayleigh[(static_cast<std::size_t>(y) * rays + j) * image.width * rays + x * rays + i];
      image.at(x, y, 0) = static_cast<float>(sum / (rays * rays));
    }
  return image;
}

Image first_channel(const std::string& path) {
  const ExrFile file = read_exr(path);
  const Image& from = file.image;
  Image out(from.width, from.height, {"first"});
  for (int y = 0; y < from.height; ++y)
    for (int x = 0; x < from.width; ++x) out.at(x, y, 0) = from.at(x, y, 0);
  return out;
}

int difference(const std::string& a_path, const std::string& b_path) {
  const Image a = first_channel(a_path), b = first_channel(b_path);
  if (a.width != b.width || a.height != b.height) {
    std::fprintf(stderr, "%s and %s are of different sizes\n", a_path.c_str(), b_path.c_str());
    return 2;
  }
  double peak = 0.0, sum_a = 0.0, sum_b = 0.0;
  for (std::size_t i = 0; i < b.data.size(); ++i) {
    peak = std::max(peak, static_cast<double>(b.data[i]));
    sum_a += a.data[i];
    sum_b += b.data[i];
  }
  double square = 0.0, relative = 0.0;
  std::size_t lit = 0, bright = 0;
  for (std::size_t i = 0; i < b.data.size(); ++i) {
    const double off = static_cast<double>(a.data[i]) - b.data[i];
    if (std::max(a.data[i], b.data[i]) > 0.01 * peak) {
      square += off * off;
      ++lit;
    }
    if (b.data[i] > 0.1 * peak) {
      relative += std::abs(off) / b.data[i];
      ++bright;
    }
  }
  fmt::print(
      "total {:.6f}  rms_of_peak {:.6f}  mean_relative_where_bright {:.6f}  ({} pixels above 1 % of {:.0f}, "
      "{} above "
      "10 %)\n",
      sum_a / sum_b, std::sqrt(square / std::max<std::size_t>(lit, 1)) / peak,
      relative / std::max<std::size_t>(bright, 1), lit, peak, bright);
  return 0;
}

int sweep(const std::string& file, int threads) {
  Scene scene = scene_at(file, 0);
  const Volumes volumes(scene, threads);
  fmt::print("| pixels | step, voxels | time, ms | ns per pixel |\n|---|---|---|---|\n");
  for (const int width : {320, 640, 1280})
    for (const double step : {0.25, 0.5, 1.0, 2.0}) {
      Scene at = scene_at(file, width);
      for (Volume& volume : at.volumes) volume.step_voxels = step;
      const Timed timed = march(volumes, at, 1, 7);
      fmt::print("| {} x {} | {} | {:.1f} | {:.0f} |\n", at.camera.width, at.camera.height, step,
                 timed.median_s * 1e3, timed.median_s * 1e9 / (at.camera.width * at.camera.height));
    }
  return 0;
}

int tiny() {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() /
      fmt::format("vegard-grid-bench-{}", std::chrono::steady_clock::now().time_since_epoch().count());
  std::filesystem::create_directory(folder);
  SparseGrid grid;
  grid.channels = {{"emission_5577", ""}};
  for (int i = -12; i < 12; ++i)
    for (int j = 38; j < 62; ++j)
      for (int k = 88; k < 112; ++k)
        if (i * i + (j - 50) * (j - 50) + (k - 100) * (k - 100) < 144)
          grid.brick({i >> 3, j >> 3, k >> 3})[SparseGrid::within(i & 7, j & 7, k & 7)] = 1.0f;
  write_vdb((folder / "ball.vdb").string(), std::move(grid), {}, {});
  Scene scene;
  scene.file = (folder / "scene.toml").string();
  scene.camera.width = scene.camera.height = 64;
  scene.camera.elevation_deg = 63.4;
  scene.volumes.resize(1);
  scene.volumes[0].file = "ball.vdb";
  const Timed timed = march(Volumes(scene, 1), scene, 1, 3);
  std::filesystem::remove_all(folder);
  const double peak = *std::max_element(timed.light.rayleigh.begin(), timed.light.rayleigh.end());
  fmt::print("{:.3f} ms, peak {:.2f} R\n", timed.median_s * 1e3, peak);
  return std::abs(peak - 2.4) < 0.2 ? 0 : 1;  // a diameter of 24 km of 1 photon cm^-3 s^-1
}

int run(int argc, char** argv) {
  apps::Program program("grid_bench", "Grids of light: time of the march, and differences of pictures", {},
                        argc, argv);
  std::string scene_file, output, a, b;
  int threads = 2, repeat = 15, rays = 1;
  const apps::Command one = program.add("march", "");
  one.option("SCENE", scene_file).required();
  one.option("--threads", threads);
  one.option("--repeat", repeat);
  one.option("--rays", rays);
  one.option("-o", output);
  one.runs([&] {
    const Scene scene = scene_at(scene_file, 0);
    const Volumes volumes(scene, threads);
    const Timed timed = march(volumes, scene, rays, repeat);
    fmt::print("march_s {:.5f}  least {:.5f}  most {:.5f}\n", timed.median_s, timed.min_s, timed.max_s);
    if (!output.empty()) write_exr(output, picture(scene, timed.light, rays), {}, true);
    return 0;
  });
  const apps::Command two = program.add("difference", "");
  two.option("A", a).required();
  two.option("B", b).required();
  two.runs([&] { return difference(a, b); });
  const apps::Command three = program.add("sweep", "");
  three.option("SCENE", scene_file).required();
  three.option("--threads", threads);
  three.runs([&] { return sweep(scene_file, threads); });
  program.add("tiny", "").runs([] { return tiny(); });
  return program.run();
}

}  // namespace
}  // namespace vegard::bench

int main(int argc, char** argv) { return vegard::bench::run(argc, argv); }
