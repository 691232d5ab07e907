#include "fit/parameter_map.h"

namespace vegard::fit {

ParameterMap::ParameterMap(const sim::Scene&, const std::vector<FreeNumber>& free) : free_(free) {}

void ParameterMap::put(const std::vector<double>& values, sim::Scene& scene) const {
  put_values(scene, free_, values);
}

ParameterMap::Motion ParameterMap::motion(const std::vector<double>&, const std::vector<int>& moved,
                                          const sim::Scene& scene) const {
  Motion motion;
  for (const int j : moved) motion.numbers.push_back(sim::real_value(scene, free_[j].path));
  return motion;
}

}  // namespace vegard::fit
