#include "sim/scene/file/volume_grid_file.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <map>
#include <utility>

#include "sim/base/error.h"
#include "sim/base/grid/vdb_io.h"
#include "sim/base/grid/volumegrid_text.h"
#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/table/table_files.h"

namespace vegard::sim {
namespace {

constexpr const char *kDensity = "density", *kSunFrame = "sun";
constexpr std::uint64_t kGridMaxBytes = std::uint64_t{8} << 30;
/// What a brick made ready for rays, with the voxels next to it, takes for a line at least.
constexpr std::uint64_t kBytesForRays = 9 * 9 * 9 * sizeof(float);

bool is_emission(const std::string& name) { return name.rfind("emission_", 0) == 0; }

bool wants_density(const Scene& scene, const Volume& volume) {
  if (volume.extinction_per_km > 0.0) return true;
  const std::string path = "volume." + volume.name + ".extinction_per_km";
  return std::any_of(scene.fit.free.begin(), scene.fit.free.end(),
                     [&](const FreeParameter& free) { return free.path == path; }) ||
         std::any_of(scene.fit.tied.begin(), scene.fit.tied.end(),
                     [&](const TiedParameter& tied) { return tied.path == path; });
}

std::string words(const std::vector<std::string>& names) {
  std::string all;
  for (std::size_t i = 0; i < names.size() && i < 20; ++i) all += (i > 0 ? ", " : "") + names[i];
  return names.size() > 20 ? all + ", ..." : all;
}

std::string range_text(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", x);
  return text;
}

/// There is no density below nothing: such numbers come of resampling and would make light.
void clamp_density(SparseGrid& grid, int channel) {
  for (auto& [at, brick] : grid.bricks)
    for (int v = 0; v < SparseGrid::kVoxels; ++v) {
      float& number = brick[static_cast<std::size_t>(channel) * SparseGrid::kVoxels + v];
      number = std::max(number, 0.0f);
    }
}

/// A volumegrid that says each line's light of density 1, as the grids of an OpenVDB file with this light.
void split_lines(const std::string& place, const std::vector<std::string>& wanted,
                 const std::map<std::string, double>& numbers, VdbFile& file) {
  std::vector<double> light;
  SparseGrid lines = SparseGrid();
  for (const auto& [name, number] : numbers)
    if (is_emission(name)) file.names.push_back(name);
  for (const std::string& name : wanted) {
    const auto found = numbers.find(name);
    if (!is_emission(name) || found == numbers.end()) continue;
    light.push_back(found->second);
    lines.channels.push_back({name, "photons cm^-3 s^-1"});
  }
  if (light.empty()) return;
  lines.channels.push_back({kDensity, ""});
  light.push_back(1.0);
  const std::size_t bytes = light.size() * SparseGrid::kVoxels * sizeof(float);
  if (file.grid.bricks.size() * bytes > kGridMaxBytes)
    throw unreadable(place, "its lines would take more than 8 GB").expected("fewer lines or voxels");
  lines.voxel = file.grid.voxel;
  lines.origin = file.grid.origin;
  for (auto& [at, brick] : file.grid.bricks) {
    SparseGrid::Brick& all = lines.bricks[at];
    all.resize(light.size() * SparseGrid::kVoxels);
    for (std::size_t c = 0; c < light.size(); ++c)
      for (std::size_t v = 0; v < SparseGrid::kVoxels; ++v)
        all[c * SparseGrid::kVoxels + v] = static_cast<float>(light[c] * brick[v]);
  }
  file.grid = std::move(lines);
}

/// An OpenVDB file, or a volumegrid by its name.
VdbFile read_any(const std::string& place, const std::vector<std::string>& wanted,
                 std::uint64_t bytes_beside) {
  if (!is_volumegrid_name(place)) return read_vdb(place, wanted, kGridMaxBytes, bytes_beside);
  VdbFile file;
  VolumegridFile read = read_volumegrid(place, kGridMaxBytes);
  file.grid = std::move(read.grid);
  file.names = {kDensity};
  split_lines(place, wanted, read.numbers, file);
  return file;
}

template <class ErrorAbout>
void scale_to_unit(SparseGrid& grid, double ratio, const ErrorAbout& error_about) {
  if (!(ratio >= 1e-9 && ratio <= 1e9))
    throw error_about("its metadata unit_km is out of range")
        .expected("a number such as the scene's sun.unit_km");
  grid.voxel *= ratio;
  for (double& x : grid.origin) x *= ratio;
}

}  // namespace

std::string emission_grid_name(double line_nm) { return "emission_" + line_name(line_nm); }

VolumeGridFile read_volume_grid(const Scene& scene, const Volume& volume) {
  VolumeGridFile out;
  out.place = table_place(scene, volume.file);
  const std::string key = "volume." + volume.name + ".file";
  const auto error_about = [&](const std::string& problem) {
    return unreadable(out.place, problem).key(key);
  };
  const bool by_density = !volume.density_rayleigh.empty();
  std::vector<std::string> wanted;
  if (!by_density)
    for (const double nm : scene.emission.lines) wanted.push_back(emission_grid_name(nm));
  VdbFile file;
  try {
    wanted.emplace_back(kDensity);
    file = read_any(out.place, wanted, kBytesForRays * scene.emission.lines.size());
  } catch (const Error& error) {
    throw Error(error).key(error.details().key.empty() ? key : error.details().key);
  }
  out.grid = std::move(file.grid);
  for (const double nm : scene.emission.lines)
    out.emission.push_back(out.grid.channel(emission_grid_name(nm)));
  out.density = out.grid.channel(kDensity);
  if (out.density >= 0) clamp_density(out.grid, out.density);
  if (std::all_of(out.emission.begin(), out.emission.end(), [](int c) { return c < 0; })) {
    const bool others = !by_density && std::any_of(file.names.begin(), file.names.end(), is_emission);
    if (by_density && out.density < 0)
      throw error_about("it has no grid of a density for density_rayleigh" +
                        (file.names.empty() ? std::string() : ", but " + words(file.names)))
          .expected("a grid \"density\"");
    if (out.density < 0 || others)
      throw error_about(file.names.empty() ? "it has no grid of floats"
                                           : "it has no grid for the scene's lines, but " + words(file.names))
          .expected("a grid such as " + wanted.front())
          .hint(others ? "emission.lines may name the lines that it has" : "");
    std::fill(out.emission.begin(), out.emission.end(), out.density);
  }
  if (!wants_density(scene, volume)) out.density = -1;
  const auto number = [&](const char* name, double otherwise) {
    const auto found = file.metadata.numbers.find(name);
    return found == file.metadata.numbers.end() ? otherwise : found->second;
  };
  const auto frame = file.metadata.texts.find("frame");
  const bool of_sun = frame != file.metadata.texts.end() && frame->second == kSunFrame;
  const bool of_site = file.metadata.numbers.count("site_latitude_deg") > 0;
  if (of_sun != (volume.frame == VolumeFrame::sun) && (of_sun || of_site))
    throw error_about(of_sun ? "it stands on the Sun, and the volume's frame is \"site\""
                             : "it stands on the ground, and the volume's frame is \"sun\"")
        .expected(of_sun ? "frame = \"sun\"" : "frame = \"site\"")
        .hint("its metadata say where it is at home");
  if (of_sun) {
    scale_to_unit(out.grid, number("unit_km", scene.sun.unit_km) / scene.sun.unit_km, error_about);
    out.site = scene.site;
    return out;
  }
  if (const double cm = number("unit_cm", 1e5); !(std::abs(cm / 1e5 - 1.0) <= 1e-9))
    throw error_about("it holds a nebula in a frame of its own")
        .expected("a grid in km about an observer")
        .hint("Such a file is for other programs; [[nebula]] is how vegard shows it");
  out.site = volume.home.value_or(scene.site);
  const auto in_range = [&](const char* name, double otherwise, double least, double most) {
    const double here = number(name, otherwise);
    if (!(here >= least && here <= most))
      throw error_about(std::string("its metadata ") + name + " is out of range")
          .expected("a number from " + range_text(least) + " to " + range_text(most));
    return here;
  };
  // As in a scene (rows/place.cpp).
  out.site.latitude_deg = in_range("site_latitude_deg", out.site.latitude_deg, -90.0, 90.0);
  out.site.longitude_deg = in_range("site_longitude_deg", out.site.longitude_deg, -180.0, 360.0);
  out.site.altitude_m = in_range("site_altitude_m", out.site.altitude_m, -500.0, 1e9);
  return out;
}

}  // namespace vegard::sim
