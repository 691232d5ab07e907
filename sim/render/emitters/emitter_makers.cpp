#include "sim/render/emitters/emitter_makers.h"

#include <stdexcept>
#include <type_traits>

namespace vegard::sim {
namespace {

/// What programs have added; add_emitter_kind() closes the list.
std::vector<EmitterMaker>& added_makers() {
  static std::vector<EmitterMaker> added;
  return added;
}

std::vector<EmitterMaker> all_makers() {
  emitter_kinds();  // from now on no kind is added
  std::vector<EmitterMaker> all = {
      footprint_maker(), nebula_maker(), volume_maker(), photosphere_maker(), chromosphere_maker(),
      corona_maker(),    loop_maker(),   bundle_maker(), ejection_maker(),    gridded_loop_maker()};
  all.insert(all.end(), added_makers().begin(), added_makers().end());
  return all;
}

bool is_drawn(const EmitterMaker& maker, const Scene& scene) {
  return is_drawn(*kind_of_table(maker.table), scene);
}

}  // namespace

const std::vector<EmitterMaker>& emitter_makers() {
  static const std::vector<EmitterMaker> all = all_makers();
  return all;
}

void add_emitter(const EmitterKind& kind, const EmitterMaker& maker) {
  if (kind.table != maker.table)
    throw std::logic_error("a kind of emitters called " + kind.table + " and " + maker.table);
  add_emitter_kind(kind);
  added_makers().push_back(maker);
}

template <class T>
Emitters<T> make_emitters(const Scene& scene, const VolumeFiles& files, const NumberAs<T>& number,
                          int threads) {
  const EmitterInputs<T> inputs{scene, files, number, threads};
  Emitters<T> all;
  for (const EmitterMaker& maker : emitter_makers()) {
    if (!is_drawn(maker, scene)) continue;
    if constexpr (std::is_same_v<T, double>)
      maker.emitters(inputs, all);
    else
      maker.emitters_with_derivatives(inputs, all);
  }
  return all;
}

template Emitters<double> make_emitters(const Scene&, const VolumeFiles&, const NumberAs<double>&, int);
template Emitters<FreeDual> make_emitters(const Scene&, const VolumeFiles&, const NumberAs<FreeDual>&, int);

std::vector<NamedField> light_fields(const Scene& scene, const VolumeFiles& files, int threads,
                                     std::uint64_t memory_limit) {
  std::vector<NamedField> all;
  for (const EmitterMaker& maker : emitter_makers())
    if (maker.fields != nullptr && is_drawn(maker, scene))
      maker.fields({scene, files, threads, memory_limit}, all);
  return all;
}

std::optional<Complaint> why_no_light_field(const Scene& scene) {
  for (const EmitterMaker& maker : emitter_makers())
    if (maker.why_no_field != nullptr)
      if (auto complaint = maker.why_no_field(scene)) return complaint;
  return std::nullopt;
}

ThinPart thinnest_part(const Scene& scene) {
  ThinPart thinnest;
  for (const EmitterMaker& maker : emitter_makers()) {
    if (maker.thinnest == nullptr || !is_drawn(maker, scene)) continue;
    ThinPart part = maker.thinnest(scene);
    if (part.radius < thinnest.radius) thinnest = std::move(part);
  }
  return thinnest;
}

}  // namespace vegard::sim
