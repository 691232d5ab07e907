#include "fit/answer/light_source_names.h"

#include <algorithm>
#include <vector>

#include "sim/base/text.h"
#include "sim/scene/emitters/emitter_kinds.h"

namespace vegard::fit {

namespace {

/// Whether the scene has emitters with such light.
bool has_light(const sim::Scene& scene, sim::LightKind light) {
  const std::vector<sim::EmitterKind>& kinds = sim::emitter_kinds();
  return std::any_of(kinds.begin(), kinds.end(), [&](const sim::EmitterKind& kind) {
    return kind.light == light && sim::is_in_scene(kind, scene);
  });
}

}  // namespace

std::string light_noun(const sim::Scene& scene) {
  using sim::LightKind;
  if (!scene.sheets.empty() || has_light(scene, LightKind::aurora)) return "aurora";
  if (scene.sun.shown) return "solar light";
  return has_light(scene, LightKind::any) || !has_light(scene, LightKind::nebula) ? "aurora" : "nebula";
}

std::string sources_of(const sim::Scene& scene) {
  using sim::LightKind;
  std::vector<std::string> sources;
  if (!scene.sheets.empty()) sources.emplace_back("sheets");
  if (has_light(scene, LightKind::aurora) || has_light(scene, LightKind::nebula) ||
      has_light(scene, LightKind::any))
    sources.emplace_back("volumes");
  if (scene.sun.shown) sources.emplace_back("Sun");
  return sources.empty() ? "sheets" : sim::joined(sources, ", ", " and ");
}

}  // namespace vegard::fit
