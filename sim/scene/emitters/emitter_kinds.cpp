#include "sim/scene/emitters/emitter_kinds.h"

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <utility>

namespace vegard::sim {

bool is_in_scene(const EmitterKind& kind, const Scene& scene) {
  return kind.repeated.empty() ? kind.is_drawn(scene) : kind.repeated.front().count(scene) > 0;
}

bool is_drawn(const EmitterKind& kind, const Scene& scene) {
  if (kind.is_drawn != nullptr) return kind.is_drawn(scene);
  return is_in_scene(kind, scene) && (kind.light != LightKind::sun || scene.sun.shown);
}

bool may_emit(const EmitterKind& kind, const Scene& scene) {
  return kind.may_emit != nullptr ? kind.may_emit(scene) : is_drawn(kind, scene);
}

bool moves(const EmitterKind& kind, const Scene& scene) { return kind.moves != nullptr && kind.moves(scene); }

bool is_made_of_sheets(const EmitterKind& kind, const Scene& scene) {
  return kind.made_of_sheets != nullptr && kind.made_of_sheets(scene);
}

OnSun what_is_on_sun(const EmitterKind& kind, const Scene& scene) {
  if (kind.on_sun != nullptr) return kind.on_sun(scene);
  return kind.light == LightKind::sun && is_drawn(kind, scene) ? OnSun::uneven : OnSun::nothing;
}

namespace {

const std::vector<EmitterKind>& built_in_kinds() {
  static const std::vector<EmitterKind> all = {footprint_kind(), nebula_kind(),       volume_kind(),
                                               sun_kind(),       chromosphere_kind(), loop_kind(),
                                               corona_kind(),    bundle_kind(),       ejection_kind()};
  return all;
}

/// What programs have added; of no use to anyone but the list, which closes it.
struct AddedKinds {
  std::vector<EmitterKind> all;
  std::atomic<bool> is_closed{false};
};

AddedKinds& added_kinds() {
  static AddedKinds added;
  return added;
}

bool has_table(const EmitterKind& kind, const std::string& table) {
  return kind.table == table ||
         std::any_of(kind.repeated.begin(), kind.repeated.end(),
                     [&](const RepeatedTable& repeated) { return repeated.table == table; });
}

std::vector<EmitterKind> all_kinds() {
  added_kinds().is_closed = true;
  std::vector<EmitterKind> all = built_in_kinds();
  all.insert(all.end(), added_kinds().all.begin(), added_kinds().all.end());
  return all;
}

bool any_kind(bool (*is)(const EmitterKind&, const Scene&), const Scene& scene) {
  return std::any_of(emitter_kinds().begin(), emitter_kinds().end(),
                     [&](const EmitterKind& kind) { return is(kind, scene); });
}

}  // namespace

const std::vector<EmitterKind>& emitter_kinds() {
  static const std::vector<EmitterKind> all = all_kinds();
  return all;
}

const EmitterKind* kind_of_table(const std::string& table) {
  for (const EmitterKind& kind : emitter_kinds())
    if (has_table(kind, table)) return &kind;
  return nullptr;
}

void add_emitter_kind(const EmitterKind& kind) {
  AddedKinds& added = added_kinds();
  if (added.is_closed) throw std::logic_error("the kinds of emitters are in use: " + kind.table);
  for (const std::vector<EmitterKind>* list : {&built_in_kinds(), &std::as_const(added.all)})
    for (const EmitterKind& other : *list)
      if (has_table(other, kind.table))
        throw std::logic_error("two kinds of emitters are called " + kind.table);
  added.all.push_back(kind);
}

bool has_drawn_emitters(const Scene& scene) { return any_kind(is_drawn, scene); }
bool has_emitters(const Scene& scene) { return any_kind(is_in_scene, scene); }
bool has_emitters_of_sheets(const Scene& scene) { return any_kind(is_made_of_sheets, scene); }
bool has_moving_emitters(const Scene& scene) { return any_kind(moves, scene); }

void remove_emitters(Scene& scene) {
  for (const EmitterKind& kind : emitter_kinds())
    for (const RepeatedTable& repeated : kind.repeated)
      repeated.keep(scene, [](const std::string&) { return false; });
  scene.sun.shown = false;
}

}  // namespace vegard::sim
