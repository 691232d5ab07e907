#include "sim/render/volumes/strand_emitters.h"

#include "sim/emit/sun/line_light.h"
#include "sim/emit/sun/strand/bundle.h"
#include "sim/emit/sun/strand/ejection_shell.h"
#include "sim/emit/sun/strand/flux_rope.h"
#include "sim/emit/sun/strand/macro_loop.h"
#include "sim/emit/sun/strand/strand_emitter.h"

namespace vegard::sim {

template <class T>
void add_strand_emitters(const Scene& scene, const NumberAs<T>& number,
                         std::vector<std::unique_ptr<Emitter<T>>>& all) {
  const Sun& sun = scene.sun;
  const SunFrame<T> frame(sun, number);
  const auto light = [&](const auto& thing) {
    return line_light<T>(scene, thing.rayleigh, thing.temperature_mk, number);
  };
  const auto add = [&](const Strands<T>& strands, const auto& of) {
    all.push_back(std::make_unique<StrandEmitter<T>>(strands, sun, frame, light(of)));
  };
  for (std::size_t i = 0; i < scene.loops.size(); ++i)
    if (scene.loops[i].voxel == 0.0)
      add(strands_of<T>(sun, scene.loops[i], scene.seed, number), scene.loops[i]);
  for (std::size_t i = 0; i < scene.bundles.size(); ++i)
    add(strands_of<T>(sun, scene.bundles[i], scene.seed, number), scene.bundles[i]);
  for (const Ejection& ejection : scene.ejections)
    if (ejection.kind == EjectionKind::rope)
      add(rope_strands<T>(sun, scene.time, ejection, number), ejection);
    else
      all.push_back(std::make_unique<EjectionShellEmitter<T>>(
          EjectionShell<T>(sun, scene.time, ejection, number), sun, frame, light(ejection)));
}

template void add_strand_emitters(const Scene&, const NumberAs<double>&,
                                  std::vector<std::unique_ptr<Emitter<double>>>&);
template void add_strand_emitters(const Scene&, const NumberAs<FreeDual>&,
                                  std::vector<std::unique_ptr<Emitter<FreeDual>>>&);

}  // namespace vegard::sim
