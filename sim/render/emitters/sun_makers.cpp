// What is on a scene's Sun: the photosphere, chromospheres and the corona at large; and what is made of
// strands: loops, bundles and ejections (whose shells are none). Loops with voxels are drawn by a grid of
// their own.
#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>

#include "sim/base/error.h"
#include "sim/emit/sun/chromosphere_emitter.h"
#include "sim/emit/sun/corona_emitter.h"
#include "sim/emit/sun/line_light.h"
#include "sim/emit/sun/photosphere_emitter.h"
#include "sim/emit/sun/strand/bundle.h"
#include "sim/emit/sun/strand/ejection_shell.h"
#include "sim/emit/sun/strand/flux_rope.h"
#include "sim/emit/sun/strand/macro_loop.h"
#include "sim/emit/sun/strand/strand_emitter.h"
#include "sim/emit/sun/strand/strand_field.h"
#include "sim/emit/sun/strand/strand_heating.h"
#include "sim/emit/sun/sun_fields.h"
#include "sim/render/emitters/emitter_makers.h"
#include "sim/render/emitters/loop_grid.h"
#include "sim/render/emitters/mean_of_instants.h"
#include "sim/render/emitters/star_spheres.h"
#include "sim/render/emitters/volume_files.h"

namespace vegard::sim {
namespace {

template <class T>
void add_photosphere(const EmitterInputs<T>& in, Emitters<T>& all) {
  all.push_back(std::make_unique<PhotosphereEmitter<T>>(in.scene, in.number));
}

/// The photosphere itself is a surface.
void add_star_fields(const FieldInputs& in, std::vector<NamedField>& all) {
  if (has_star_spheres(in.scene))
    all.push_back({"stars", std::make_unique<StarField>(star_field(in.scene)), FieldFrame::sun});
}

ThinPart thinnest_star(const Scene& scene) {
  if (!has_star_spheres(scene)) return {};
  return {"stars", star_sphere_radius(scene)};
}

template <class T>
void add_chromospheres(const EmitterInputs<T>& in, Emitters<T>& all) {
  const std::vector<double> instants = instants_of(in.scene, in.scene.sun.rotation != SolarRotation::none);
  for (std::size_t c = 0; c < in.scene.chromospheres.size(); ++c)
    add_mean<T>(
        instants,
        [&](double instant) {
          return std::make_unique<ChromosphereEmitter<T>>(in.scene, static_cast<int>(c),
                                                          bias_map(in.files, in.scene.chromospheres[c]),
                                                          in.number, instant);
        },
        all);
}

void add_chromosphere_fields(const FieldInputs& in, std::vector<NamedField>& all) {
  for (std::size_t c = 0; c < in.scene.chromospheres.size(); ++c) {
    const Chromosphere& chromosphere = in.scene.chromospheres[c];
    all.push_back(
        {"chromosphere '" + chromosphere.name + "'",
         std::make_unique<ChromosphereField>(in.scene, static_cast<int>(c), bias_map(in.files, chromosphere)),
         FieldFrame::sun});
  }
}

template <class T>
void add_coronae(const EmitterInputs<T>& in, Emitters<T>& all) {
  for (const Corona& corona : in.scene.coronae)
    all.push_back(std::make_unique<CoronaEmitter<T>>(in.scene, corona, in.number));
}

void add_corona_fields(const FieldInputs& in, std::vector<NamedField>& all) {
  for (const Corona& corona : in.scene.coronae)
    all.push_back(
        {"corona '" + corona.name + "'", std::make_unique<CoronaField>(in.scene, corona), FieldFrame::sun});
}

/// Returns the temperature that sets the lines' light; none (0) for a loop that is heated by flares.
template <class Element>
const double& temperature_of(const Element& of) {
  return of.temperature_mk;
}
const double& temperature_of(const Loop& loop) {
  static const double none = 0.0;
  return loop.heating_interval_s > 0.0 ? none : loop.temperature_mk;
}

template <class T, class Element>
std::unique_ptr<Emitter<T>> strand_emitter(const EmitterInputs<T>& in, const Strands<T>& strands,
                                           const Element& of) {
  return std::make_unique<StrandEmitter<T>>(
      strands, in.scene.sun, SunFrame<T>(in.scene.sun, in.number),
      line_light<T>(in.scene, of.rayleigh, temperature_of(of), in.number));
}

template <class Element>
std::unique_ptr<const LightField> strand_field(const FieldInputs& in, const Strands<double>& strands,
                                               const Element& of) {
  try {
    return std::make_unique<StrandField>(
        strands, in.scene.sun, line_light<double>(in.scene, of.rayleigh, temperature_of(of), plain_number),
        static_cast<int>(in.scene.emission.lines.size()), in.memory_limit);
  } catch (const Error& error) {
    throw Error(error)
        .problem("'" + of.name + "': " + error.details().problem)
        .key("--memory-limit")
        .hint("Leave it out with --of NAME");
  }
}

/// Returns the strands with their shape at one instant of the scene's clock and their mean light over others.
template <class T>
Strands<T> loop_strands(const Scene& scene, const Loop& loop, const NumberAs<T>& number, double stands_s,
                        const std::vector<double>& shines_s) {
  Strands<T> strands = strands_of<T>(scene.sun, loop, scene.seed, number, stands_s);
  if (loop.heating_interval_s > 0.0) heat_strands<T>(scene, loop, shines_s, number, strands);
  return strands;
}

template <class T>
void add_loops(const EmitterInputs<T>& in, Emitters<T>& all) {
  const bool turns = in.scene.sun.rotation != SolarRotation::none;
  const std::vector<double> instants = instants_of(in.scene, turns),
                            all_instants = instants_of(in.scene, true);
  for (const Loop& loop : in.scene.loops)
    if (loop.voxel == 0.0)
      add_mean<T>(
          instants,
          [&](double instant) {
            return strand_emitter(in,
                                  loop_strands<T>(in.scene, loop, in.number, instant,
                                                  turns ? std::vector<double>{instant} : all_instants),
                                  loop);
          },
          all);
}

template <class T>
void add_gridded_loops(const EmitterInputs<T>& in, Emitters<T>& all) {
  const std::vector<double> instants = instants_of(in.scene, in.scene.sun.rotation != SolarRotation::none);
  for (std::size_t i = 0; i < in.scene.loops.size(); ++i)
    if (in.scene.loops[i].voxel > 0.0)
      add_mean<T>(
          instants,
          [&](double instant) {
            return loop_grid_emitter<T>(in.scene, static_cast<std::uint32_t>(i), instant, in.number,
                                        in.threads);
          },
          all);
}

void add_loop_fields(const FieldInputs& in, std::vector<NamedField>& all) {
  for (std::size_t i = 0; i < in.scene.loops.size(); ++i) {
    const Loop& loop = in.scene.loops[i];
    std::unique_ptr<const LightField> field;
    if (loop.voxel > 0.0)
      field = loop_grid_field(in.scene, static_cast<std::uint32_t>(i), in.threads, in.memory_limit);
    else
      field = strand_field(
          in,
          loop_strands<double>(in.scene, loop, plain_number, in.scene.time.start_s, {in.scene.time.start_s}),
          loop);
    all.push_back({"loop '" + loop.name + "'", std::move(field), FieldFrame::sun});
  }
}

ThinPart thinnest_loop(const Scene& scene) {
  ThinPart thinnest;
  for (const Loop& loop : scene.loops)
    if (loop.strand_radius < thinnest.radius) thinnest = {"loop '" + loop.name + "'", loop.strand_radius};
  return thinnest;
}

template <class T>
void add_bundles(const EmitterInputs<T>& in, Emitters<T>& all) {
  const std::vector<double> instants = instants_of(in.scene, in.scene.sun.rotation != SolarRotation::none);
  for (const Bundle& bundle : in.scene.bundles)
    add_mean<T>(
        instants,
        [&](double instant) {
          return strand_emitter(in, strands_of<T>(in.scene.sun, bundle, in.scene.seed, in.number, instant),
                                bundle);
        },
        all);
}

void add_bundle_fields(const FieldInputs& in, std::vector<NamedField>& all) {
  for (const Bundle& bundle : in.scene.bundles)
    all.push_back(
        {"bundle '" + bundle.name + "'",
         strand_field(
             in, strands_of<double>(in.scene.sun, bundle, in.scene.seed, plain_number, in.scene.time.start_s),
             bundle),
         FieldFrame::sun});
}

/// A line counts with the thinner of its ends.
ThinPart thinnest_bundle(const Scene& scene) {
  ThinPart thinnest;
  for (const Bundle& bundle : scene.bundles)
    if (const double radius = std::min(bundle.foot_radius, bundle.top_radius); radius < thinnest.radius)
      thinnest = {"bundle '" + bundle.name + "'", radius};
  return thinnest;
}

template <class T>
void add_ejections(const EmitterInputs<T>& in, Emitters<T>& all) {
  const Scene& scene = in.scene;
  const std::vector<double> instants = instants_of(scene, true);
  for (const Ejection& ejection : scene.ejections)
    add_mean<T>(
        instants,
        [&](double instant) -> std::unique_ptr<Emitter<T>> {
          if (ejection.kind == EjectionKind::rope)
            return strand_emitter(in, rope_strands<T>(scene.sun, instant, ejection, in.number), ejection);
          return std::make_unique<EjectionShellEmitter<T>>(
              EjectionShell<T>(scene.sun, instant, ejection, in.number), scene.sun,
              SunFrame<T>(scene.sun, in.number),
              line_light<T>(scene, ejection.rayleigh, ejection.temperature_mk, in.number));
        },
        all);
}

void add_ejection_fields(const FieldInputs& in, std::vector<NamedField>& all) {
  for (const Ejection& ejection : in.scene.ejections) {
    std::unique_ptr<const LightField> field;
    if (ejection.kind == EjectionKind::rope)
      field = strand_field(
          in, rope_strands<double>(in.scene.sun, in.scene.time.start_s, ejection, plain_number), ejection);
    else
      field = std::make_unique<EjectionShellField>(in.scene, ejection);
    all.push_back({"ejection '" + ejection.name + "'", std::move(field), FieldFrame::sun});
  }
}

/// Strands of a rope are all as thick. Its feet may be points at age 0: a strand counts with the larger
/// radius of its pieces.
ThinPart thinnest_rope(const Scene& scene) {
  ThinPart thinnest;
  for (const Ejection& ejection : scene.ejections) {
    if (ejection.kind != EjectionKind::rope) continue;
    Ejection one = ejection;
    one.strands = 1;
    for (const Strand<double>& piece :
         rope_strands<double>(scene.sun, scene.time.start_s, one, plain_number).all)
      if (const double radius = std::max(piece.radius_first, piece.radius_last); radius < thinnest.radius)
        thinnest = {"ejection '" + ejection.name + "'", radius};
  }
  return thinnest;
}

}  // namespace

EmitterMaker photosphere_maker() {
  return {"sun", add_photosphere<double>, add_photosphere<FreeDual>, add_star_fields, nullptr, thinnest_star};
}

EmitterMaker chromosphere_maker() {
  return {"chromosphere", add_chromospheres<double>, add_chromospheres<FreeDual>, add_chromosphere_fields};
}

EmitterMaker corona_maker() {
  return {"corona", add_coronae<double>, add_coronae<FreeDual>, add_corona_fields};
}

EmitterMaker loop_maker() {
  return {"loop", add_loops<double>, add_loops<FreeDual>, add_loop_fields, nullptr, thinnest_loop};
}

EmitterMaker gridded_loop_maker() { return {"loop", add_gridded_loops<double>, add_gridded_loops<FreeDual>}; }

EmitterMaker bundle_maker() {
  return {"bundle", add_bundles<double>, add_bundles<FreeDual>, add_bundle_fields, nullptr, thinnest_bundle};
}

EmitterMaker ejection_maker() {
  return {"ejection", add_ejections<double>, add_ejections<FreeDual>, add_ejection_fields,
          nullptr,    thinnest_rope};
}

}  // namespace vegard::sim
