#include "sim/scene/structs/scene.h"

namespace vegard::sim {

StatisticWeights::StatisticWeights() {
  for (const StatisticFacts& facts : kStatistics) weights_.push_back(facts.usual_weight);
}

Scene::Scene() = default;
Scene::Scene(const Scene& other) = default;
Scene::Scene(Scene&& other) noexcept = default;
Scene& Scene::operator=(const Scene& other) = default;
Scene& Scene::operator=(Scene&& other) noexcept = default;
Scene::~Scene() = default;

}  // namespace vegard::sim
