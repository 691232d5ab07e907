#include "apps/options/scene_grid_options.h"

#include <algorithm>

#include <fmt/format.h>

#include "apps/options/memory_limit.h"
#include "apps/options/refusals.h"
#include "sim/scene/emitters/emitter_kinds.h"
#include "sim/scene/table/parameter_declarations.h"

namespace vegard::apps {

std::vector<Option> add_voxel_options(const Command& command, const std::string& names,
                                      const std::string& default_voxel, VoxelOptions& options) {
  std::vector<Option> added;
  added.push_back(command
                      .option(names, options.voxel,
                              "Edge of a voxel, in km; of a nebula or on the Sun, in its unit (default: " +
                                  default_voxel + ")")
                      .finite_range(1e-6, 1e6)
                      .type_name("LENGTH"));
  added.push_back(command
                      .option("--box", options.box,
                              "Fill only this box, in km from the observer (of a nebula: right, up, near, in "
                              "its unit; of the Sun: x, y, z of its frame)")
                      .delimiter(',')
                      .expected(6)
                      .type_name("WEST,EAST,SOUTH,NORTH,LOW,HIGH"));
  added.push_back(command
                      .option("--of", options.of,
                              "Only the sheets, footprints, nebulae, volumes and objects on the Sun with "
                              "these names, or stars")
                      .delimiter(',')
                      .type_name("NAME,..."));
  added.push_back(add_memory_option(command, options.memory_limit,
                                    "Memory for the voxels: 500M, 8G, or a number of GB (default: 4G)"));
  return added;
}

sim::SceneGridOptions scene_grid_options(const VoxelOptions& options, int threads) {
  sim::SceneGridOptions grid;
  grid.voxel = options.voxel;
  grid.memory_limit = static_cast<std::uint64_t>(memory_limit_bytes(options.memory_limit));
  grid.threads = threads;
  if (options.box.empty()) return grid;
  sim::Box3 box;
  for (int a = 0; a < 3; ++a) {
    box.low[a] = options.box[2 * a];
    box.high[a] = options.box[2 * a + 1];
    if (!(box.low[a] < box.high[a]))
      throw usage_error("--box", fmt::format("{} is not below {}", box.low[a], box.high[a]),
                        "WEST,EAST,SOUTH,NORTH,LOW,HIGH");
  }
  grid.box = box;
  return grid;
}

void keep_named(sim::Scene& scene, const std::vector<std::string>& names) {
  if (names.empty()) return;
  constexpr const char* kStars = "stars";  // the only ones without a name of their own
  const bool with_stars = std::find(names.begin(), names.end(), kStars) != names.end();
  if (!with_stars) scene.stars.sphere_distance = 0.0;
  const bool has_stars = scene.stars.sphere_distance > 0.0;
  // What shines; nodes do not.
  std::vector<const sim::RepeatedTable*> tables = {sim::repeated_table(sim::sheet_table)};
  for (const sim::EmitterKind& kind : sim::emitter_kinds())
    if (!kind.repeated.empty()) tables.push_back(&kind.repeated.front());
  for (const std::string& name : names) {
    const auto has_one = [&](const sim::RepeatedTable* table) {
      for (std::size_t e = 0; e < table->count(scene); ++e)
        if (table->name(scene, static_cast<int>(e)) == name) return true;
      return false;
    };
    if (std::none_of(tables.begin(), tables.end(), has_one) && !(has_stars && name == kStars))
      throw usage_error("--of", "nothing that shines is called '" + name + "'",
                        "the name of a sheet, footprint, nebula, volume, or of a thing on the Sun, or stars");
  }
  const auto is_named = [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  // Sheets come last: it depends on the others whether they stay.
  std::rotate(tables.begin(), tables.begin() + 1, tables.end());
  for (const sim::RepeatedTable* table : tables)
    if (table->table != sim::sheet_table || !sim::has_emitters_of_sheets(scene)) table->keep(scene, is_named);
}

}  // namespace vegard::apps
