#include "fit/answer/what_shines.h"

#include <vector>

namespace vegard::fit {

std::string light_noun(const sim::Scene& scene) {
  if (!scene.sheets.empty() || !scene.footprints.empty()) return "aurora";
  if (scene.sun.shown) return "solar light";
  return scene.nebulae.empty() || !scene.volumes.empty() ? "aurora" : "nebula";
}

std::string sources_of(const sim::Scene& scene) {
  std::vector<std::string> sources;
  if (!scene.sheets.empty()) sources.emplace_back("sheets");
  if (!scene.footprints.empty() || !scene.nebulae.empty() || !scene.volumes.empty())
    sources.emplace_back("volumes");
  if (scene.sun.shown) sources.emplace_back("Sun");
  if (sources.empty()) return "sheets";
  std::string text = sources.front();
  for (std::size_t i = 1; i < sources.size(); ++i)
    text += (i + 1 == sources.size() ? " and " : ", ") + sources[i];
  return text;
}

}  // namespace vegard::fit
