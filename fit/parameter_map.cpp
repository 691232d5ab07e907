#include "fit/parameter_map.h"

namespace vegard::fit {

ParameterMap::ParameterMap(const sim::Scene& scene, const std::vector<FreeNumber>& free,
                           const PhotoFrame& frame)
    : frame_(frame), places_(frame.places(scene, free)) {}

void ParameterMap::put(const std::vector<double>& values, sim::Scene& scene) const {
  frame_.go_home(scene);
  for (std::size_t j = 0; j < places_.size(); ++j)
    if (places_[j]) *sim::real_value(scene, *places_[j]) = values[j];
  frame_.carry(scene);
}

ParameterMap::Motion ParameterMap::motion(const std::vector<double>& values, const std::vector<int>& moved,
                                          const sim::Scene& scene) const {
  Motion motion;
  std::vector<std::size_t> column;  // of each number
  for (std::size_t k = 0; k < moved.size(); ++k) {
    const auto& place = places_[static_cast<std::size_t>(moved[k])];
    if (!place) continue;
    motion.numbers.push_back(sim::real_value(scene, *place));
    column.push_back(k);
  }
  if (motion.numbers.size() < moved.size()) {
    motion.slopes.assign(motion.numbers.size() * moved.size(), 0.0);
    for (std::size_t i = 0; i < column.size(); ++i) motion.slopes[i * moved.size() + column[i]] = 1.0;
  }
  motion.moved = moved.size();
  if (frame_.station.is_elsewhere()) {
    sim::Scene at_home = scene;
    frame_.go_home(at_home);
    for (std::size_t j = 0; j < places_.size(); ++j)
      if (places_[j]) *sim::real_value(at_home, *places_[j]) = values[j];
    frame_.carry(at_home, scene, motion.numbers, motion.slopes);
  }
  return motion;
}

}  // namespace vegard::fit
