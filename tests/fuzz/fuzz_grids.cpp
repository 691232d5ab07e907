// Any bytes as a file of voxels: OpenVDB if they begin so, else pbrt's volumegrid. What is read is asked for
// as a scene's volume as well, with the metadata that say where it stands.
#include <cmath>
#include <string_view>

#include "sim/base/grid/vdb_io.h"
#include "sim/base/grid/volumegrid_text.h"
#include "sim/scene/file/volume_grid_file.h"
#include "tests/fuzz/input_file.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/target.h"

namespace {

using namespace vegard;
using tests::require;

constexpr std::uint64_t kMaxBytes = 64 << 20;

void check(const sim::SparseGrid& grid) {
  require(grid.voxel > 0.0 && std::isfinite(grid.voxel));
  for (const double place : grid.origin) require(std::isfinite(place));
  for (const auto& [at, brick] : grid.bricks) {
    require(brick.size() == grid.channels.size() * sim::SparseGrid::kVoxels);
    for (const float number : brick) require(std::isfinite(number));
  }
}

/// As a volume of the site and of the Sun, with grids of lines and by its density.
void read_as_volume(const tests::InputFile& file, const std::string& name) {
  for (const sim::VolumeFrame frame : {sim::VolumeFrame::site, sim::VolumeFrame::sun})
    for (const bool by_density : {false, true}) {
      sim::Scene scene;
      scene.file = file.path("scene.toml");
      sim::Volume volume;
      volume.name = "it";
      volume.file = name;
      volume.frame = frame;
      volume.extinction_per_km = 0.1;
      if (by_density) volume.density_rayleigh = {1.0};
      tests::read_or_refused([&] { check(sim::read_volume_grid(scene, volume).grid); });
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const std::string name = bytes.substr(0, 4) == " BDV" ? "it.vdb" : "it.pbrt";
  const tests::InputFile file(bytes, name);
  const bool read = tests::read_or_refused([&] {
    if (name == "it.vdb")
      check(sim::read_vdb(file.path(name), {"density", "emission_5577", "emission_6300"}, kMaxBytes).grid);
    else
      check(sim::read_volumegrid(file.path(name), kMaxBytes).grid);
  });
  if (read) read_as_volume(file, name);
  return 0;
}
