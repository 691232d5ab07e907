#include "sim/scene/emitters/emitter_kind.h"

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

}  // namespace vegard::sim
