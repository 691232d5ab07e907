#include "apps/output/grid_file.h"

#include <fmt/format.h>

#include "apps/options/refusals.h"
#include "sim/base/grid/volumegrid_text.h"
#include "sim/base/text.h"
#include "sim/base/version.h"
#include "sim/light/emitter.h"
#include "sim/render/emitters/star_spheres.h"
#include "sim/scene/emitters/emitter_kinds.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/view/colour/line_colours.h"

namespace vegard::apps {
namespace {

std::string listed(const std::vector<std::string>& names) {
  return names.empty() ? "none" : sim::joined(names);
}

sim::Error no_channel(const std::string& path, const std::string& name,
                      const std::vector<std::string>& known) {
  return usage_error("--channel", path + " has no grid '" + name + "'", "one of its grids: " + listed(known));
}

/// Rayleighs of a unit of length of 1 photon cm^-3 s^-1.
double rayleigh_per_unit(const sim::SceneGrid& made) { return sim::kRayleighsPerKm * made.unit_cm * 1e-5; }

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
      if (name != "density") throw no_channel(path, name, {"density"});
    sim::VolumegridFile read = sim::read_volumegrid(path, max_bytes);
    file.grid = std::move(read.grid);
    file.size = read.size;
    file.colours = std::move(read.colours);
    file.numbers = std::move(read.numbers);
    return file;
  }
  std::vector<std::string> wanted = channels;
  if (wanted.empty()) wanted = sim::read_vdb(path, {}, max_bytes).names;
  sim::VdbFile read = sim::read_vdb(path, wanted, max_bytes);
  for (const std::string& name : wanted)
    if (read.grid.channel(name) < 0) throw no_channel(path, name, read.names);
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

bool is_of_sun(const sim::Scene& scene) {
  const std::vector<sim::EmitterKind>& kinds = sim::emitter_kinds();
  return sim::has_star_spheres(scene) ||
         std::any_of(kinds.begin(), kinds.end(), [&](const sim::EmitterKind& kind) {
           return sim::what_is_on_sun(kind, scene) != sim::OnSun::nothing;
         });
}

sim::VdbMetadata volume_metadata(const sim::Scene& scene, const sim::SceneGrid& made) {
  sim::VdbMetadata out;
  const bool is_solar = is_of_sun(scene), in_km = !is_solar && made.unit_cm == 1e5;
  out.numbers["unit_cm"] = made.unit_cm;
  out.numbers["voxel_km"] = made.grid.voxel * made.unit_cm * 1e-5;
  out.numbers["rayleigh_per_unit"] = rayleigh_per_unit(made);
  if (in_km) {
    out.numbers["site_latitude_deg"] = scene.site.latitude_deg;
    out.numbers["site_longitude_deg"] = scene.site.longitude_deg;
    out.numbers["site_altitude_m"] = scene.site.altitude_m;
  }
  out.numbers["time_start_s"] = scene.time.start_s;
  out.texts["creator"] = "vegard " + sim::version();
  if (is_solar) {
    out.numbers["unit_km"] = scene.sun.unit_km;
    out.texts["axes"] =
        "x to latitude 0 and longitude 0, y to longitude 90 deg (west), z to the north pole of the Sun, its "
        "middle at the origin, in units of unit_km";
  }
  out.texts["frame"] =
      is_solar ? "sun"
      : in_km  ? "x east, y north, z up, in km, the observer at the origin"
               : "x right, y up, z towards the observer, in the nebula's unit, its middle at the origin";
  out.texts["density_is"] =
      made.absorbs ? "what absorbs" : "light of all lines over that of the brightest voxel";
  out.texts["voxel_centre"] =
      "the number of voxel (i, j, k) holds at the transform of (i + c, j + c, k + c), "
      "c = voxel_centre_index";
  out.texts["scene"] = sim::write_scene(scene);
  return out;
}

std::vector<std::array<float, 3>> colours_of_channels(const sim::Scene& scene, const sim::SceneGrid& made,
                                                      const std::vector<int>& lines) {
  const std::vector<sim::Vector3> per_kilorayleigh = sim::line_colours(scene);
  std::vector<std::array<float, 3>> out;
  for (std::size_t c = 0; c + 1 < made.grid.channels.size(); ++c) {
    const sim::Vector3& rgb = per_kilorayleigh[lines.empty() ? c : lines[c]];
    const double scale = rayleigh_per_unit(made) * 1e-3;
    out.push_back({static_cast<float>(rgb[0] * scale), static_cast<float>(rgb[1] * scale),
                   static_cast<float>(rgb[2] * scale)});
  }
  out.push_back({0.0f, 0.0f, 0.0f});
  return out;
}

}  // namespace vegard::apps
