#include "apps/output/grid_file.h"

#include <filesystem>

#include <fmt/format.h>

#include "apps/options/refusals.h"
#include "sim/base/grid/volumegrid_text.h"
#include "sim/base/text.h"

namespace vegard::apps {
namespace {

std::string listed(const std::vector<std::string>& names) {
  return names.empty() ? "none" : sim::joined(names);
}

void refuse_channel(const std::string& path, const std::string& name, const std::vector<std::string>& known) {
  throw usage_error("--channel", path + " has no grid '" + name + "'", "one of its grids: " + listed(known));
}

}  // namespace

bool is_vdb_name(const std::string& path) { return sim::lowered_extension(path) == ".vdb"; }

void check_grid_name(const std::string& key, const std::string& path) {
  if (!is_vdb_name(path) && !sim::is_volumegrid_name(path))
    throw usage_error(key, "'" + path + "' names no kind of grid",
                      "a name that ends in .vdb (OpenVDB), or in .pbrt, .volumegrid or .txt (volumegrid)");
}

GridFile read_grid_file(const std::string& path, const std::vector<std::string>& channels,
                        std::uint64_t max_bytes) {
  GridFile file;
  if (sim::is_volumegrid_name(path)) {
    for (const std::string& name : channels)
      if (name != "density") refuse_channel(path, name, {"density"});
    sim::VolumegridFile read = sim::read_volumegrid(path, max_bytes);
    file.grid = std::move(read.grid);
    file.size = read.size;
    file.colours = std::move(read.colours);
    return file;
  }
  std::vector<std::string> wanted = channels;
  if (wanted.empty()) wanted = sim::read_vdb(path, {}, max_bytes).names;
  sim::VdbFile read = sim::read_vdb(path, wanted, max_bytes);
  for (const std::string& name : wanted)
    if (read.grid.channel(name) < 0) refuse_channel(path, name, read.names);
  if (read.grid.channels.empty())
    throw sim::Error(sim::ErrorKind::unreadable_input, "it has no grid of floats")
        .file(path)
        .expected("a grid such as density");
  file.grid = std::move(read.grid);
  file.metadata = std::move(read.metadata);
  return file;
}

int usual_channel(const sim::SparseGrid& grid) {
  const int density = grid.channel("density");
  return density >= 0 ? density : grid.channels.size() == 1 ? 0 : -1;
}

std::string channel_names(const sim::SparseGrid& grid) {
  std::vector<std::string> names;
  for (const sim::GridChannel& channel : grid.channels) names.push_back(channel.name);
  return listed(names);
}

std::string length_words(const sim::VdbMetadata& metadata) {
  const auto number = [&](const char* name) {
    const auto found = metadata.numbers.find(name);
    return found == metadata.numbers.end() ? 0.0 : found->second;
  };
  double km = number("unit_km");
  if (km <= 0.0) km = 1e-5 * number("unit_cm");
  if (km <= 0.0) return "units";
  return km == 1.0 ? "km" : fmt::format("units of {:g} km", km);
}

}  // namespace vegard::apps
