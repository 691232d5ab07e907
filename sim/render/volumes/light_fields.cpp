#include "sim/render/volumes/light_fields.h"

#include "sim/base/error.h"
#include "sim/emit/grid/grid_field.h"
#include "sim/emit/nebula/nebula_field.h"
#include "sim/emit/sun/line_light.h"
#include "sim/emit/sun/strand/bundle.h"
#include "sim/emit/sun/strand/ejection_shell.h"
#include "sim/emit/sun/strand/flux_rope.h"
#include "sim/emit/sun/strand/macro_loop.h"
#include "sim/emit/sun/strand/strand_field.h"
#include "sim/emit/sun/sun_fields.h"
#include "sim/light/emitter.h"
#include "sim/render/volumes/bias_map.h"
#include "sim/render/volumes/footprint_volumes.h"
#include "sim/render/volumes/loop_grid.h"

namespace vegard::sim {
namespace {

/// Of everything on the Sun but the photosphere, which is a surface.
void add_sun_fields(const Scene& scene, const VolumeFiles& files, int threads, std::uint64_t memory_limit,
                    std::vector<NamedField>& all) {
  const Sun& sun = scene.sun;
  const NumberAs<double> number = plain_number;
  const auto add = [&](const char* kind, const std::string& name, std::unique_ptr<const LightField> field) {
    all.push_back({kind + (" '" + name + "'"), std::move(field), FieldFrame::sun});
  };
  const auto of_strands = [&](const Strands<double>& strands, const auto& thing) {
    try {
      return std::make_unique<StrandField>(
          strands, sun, line_light<double>(scene, thing.rayleigh, thing.temperature_mk, number),
          static_cast<int>(scene.emission.lines.size()), memory_limit);
    } catch (const Error& error) {
      ErrorDetails details = error.details();
      details.problem = "'" + thing.name + "': " + details.problem;
      details.key = "--memory-limit";
      details.hint = "Leave it out with --of NAME";
      throw Error(error.kind(), details);
    }
  };
  for (std::size_t c = 0; c < scene.chromospheres.size(); ++c)
    add("chromosphere", scene.chromospheres[c].name,
        std::make_unique<ChromosphereField>(scene, static_cast<int>(c),
                                            bias_map(files, scene.chromospheres[c])));
  for (const Corona& corona : scene.coronae)
    add("corona", corona.name, std::make_unique<CoronaField>(scene, corona));
  for (std::size_t i = 0; i < scene.loops.size(); ++i) {
    const Loop& loop = scene.loops[i];
    const auto index = static_cast<std::uint32_t>(i);
    if (loop.voxel > 0.0)
      add("loop", loop.name, loop_grid_field(scene, index, threads, memory_limit));
    else
      add("loop", loop.name, of_strands(strands_of<double>(sun, loop, scene.seed, number), loop));
  }
  for (std::size_t i = 0; i < scene.bundles.size(); ++i)
    add("bundle", scene.bundles[i].name,
        of_strands(strands_of<double>(sun, scene.bundles[i], scene.seed, number), scene.bundles[i]));
  for (const Ejection& ejection : scene.ejections)
    if (ejection.kind == "rope")
      add("ejection", ejection.name,
          of_strands(rope_strands<double>(sun, scene.time, ejection, number), ejection));
    else
      add("ejection", ejection.name, std::make_unique<EjectionShellField>(scene, ejection));
}

}  // namespace

std::vector<NamedField> light_fields(const Scene& scene, const VolumeFiles& files, int threads,
                                     std::uint64_t memory_limit) {
  std::vector<NamedField> all;
  for (const Footprint& footprint : scene.footprints)
    all.push_back({"footprint '" + footprint.name + "'", footprint_field(scene, footprint, files, threads)});
  for (const Nebula& nebula : scene.nebulae)
    all.push_back(
        {"nebula '" + nebula.name + "'", std::make_unique<NebulaField>(scene, nebula), FieldFrame::nebula});
  for (std::size_t v = 0; v < scene.volumes.size(); ++v)
    all.push_back({"volume '" + scene.volumes[v].name + "'",
                   std::make_unique<GridField>(*files.grids[v], scene.volumes[v], &scene.sun),
                   scene.volumes[v].frame == "sun" ? FieldFrame::sun : FieldFrame::ground});
  if (scene.sun.shown) add_sun_fields(scene, files, threads, memory_limit, all);
  return all;
}

}  // namespace vegard::sim
