// The photosphere, chromospheres and the corona at large.
#include <memory>
#include <utility>

#include "sim/emit/sun/chromosphere_emitter.h"
#include "sim/emit/sun/corona_emitter.h"
#include "sim/emit/sun/photosphere_emitter.h"
#include "sim/emit/sun/sun_fields.h"
#include "sim/render/emitters/emitter_makers.h"
#include "sim/render/emitters/mean_of_instants.h"
#include "sim/render/emitters/volume_files.h"

namespace vegard::sim {
namespace {

template <class T>
void add_photosphere(const EmitterInputs<T>& in, Emitters<T>& all) {
  all.push_back(std::make_unique<PhotosphereEmitter<T>>(in.scene, in.number));
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

}  // namespace

EmitterMaker photosphere_maker() { return {"sun", add_photosphere<double>, add_photosphere<FreeDual>}; }

EmitterMaker chromosphere_maker() {
  return {"chromosphere", add_chromospheres<double>, add_chromospheres<FreeDual>, add_chromosphere_fields};
}

EmitterMaker corona_maker() {
  return {"corona", add_coronae<double>, add_coronae<FreeDual>, add_corona_fields};
}

}  // namespace vegard::sim
