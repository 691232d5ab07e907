// Nebulae of the physical march, and grids from files.
#include <memory>
#include <vector>

#include "sim/emit/aurora/motion.h"
#include "sim/emit/grid/grid_emitter.h"
#include "sim/emit/grid/grid_home.h"
#include "sim/emit/nebula/nebula_emitter.h"
#include "sim/render/emitters/emitter_makers.h"
#include "sim/render/emitters/mean_of_instants.h"

namespace vegard::sim {
namespace {

template <class T>
void add_nebulae(const EmitterInputs<T>& in, Emitters<T>& all) {
  for (const Nebula& nebula : in.scene.nebulae)
    if (nebula.method != NebulaMethod::literal)
      all.push_back(std::make_unique<NebulaEmitter<T>>(in.scene, nebula, in.number));
}

void add_nebula_fields(const FieldInputs& in, std::vector<NamedField>& all) {
  for (const Nebula& nebula : in.scene.nebulae)
    all.push_back({"nebula '" + nebula.name + "'", std::make_unique<NebulaField>(in.scene, nebula),
                   FieldFrame::nebula});
}

std::optional<Complaint> why_nebula_has_no_field(const Scene& scene) {
  for (const Nebula& nebula : scene.nebulae)
    if (nebula.method == NebulaMethod::literal)
      return Complaint{"the nebula '" + nebula.name + "' is marched literally and has no light in space",
                       "method = \"physical\"", ""};
  return std::nullopt;
}

/// Returns the substorm's factor on a volume's light: the mean over instants about a site (aurora), else 1.
double substorm_share(const Scene& scene, const Volume& volume, const std::vector<double>& instants) {
  if (volume.frame != VolumeFrame::site) return 1.0;
  double sum = 0.0;
  for (const double instant : instants) sum += substorm_level(scene.substorm, instant);
  return sum / static_cast<double>(instants.size());
}

template <class T>
void add_volumes(const EmitterInputs<T>& in, Emitters<T>& all) {
  for (std::size_t v = 0; v < in.scene.volumes.size(); ++v) {
    const Volume& volume = in.scene.volumes[v];
    const GridBricks& grid = *in.files.grids[v];
    const double share = substorm_share(in.scene, volume, instants_s(in.scene.time));
    const GridEmitter<T>* last = nullptr;
    add_mean<T>(
        instants_of(in.scene,
                    volume.frame == VolumeFrame::sun && in.scene.sun.rotation != SolarRotation::none),
        [&](double instant) {
          auto emitter = std::make_unique<GridEmitter<T>>(grid, volume, in.number, &in.scene.sun, share,
                                                          grid_turn_rad(grid, volume, &in.scene.sun, instant),
                                                          in.threads, last);
          last = emitter.get();
          return emitter;
        },
        all);
  }
}

void add_volume_fields(const FieldInputs& in, std::vector<NamedField>& all) {
  for (std::size_t v = 0; v < in.scene.volumes.size(); ++v) {
    const Volume& volume = in.scene.volumes[v];
    all.push_back({"volume '" + volume.name + "'",
                   std::make_unique<GridField>(
                       *in.files.grids[v], volume, &in.scene.sun,
                       substorm_share(in.scene, volume, {in.scene.time.start_s}),
                       grid_turn_rad(*in.files.grids[v], volume, &in.scene.sun, in.scene.time.start_s)),
                   volume.frame == VolumeFrame::sun ? FieldFrame::sun : FieldFrame::ground});
  }
}

}  // namespace

EmitterMaker nebula_maker() {
  return {"nebula", add_nebulae<double>, add_nebulae<FreeDual>, add_nebula_fields, why_nebula_has_no_field};
}

EmitterMaker volume_maker() {
  return {"volume", add_volumes<double>, add_volumes<FreeDual>, add_volume_fields};
}

}  // namespace vegard::sim
