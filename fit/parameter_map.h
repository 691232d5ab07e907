// From the numbers that the solver moves to the numbers of one photograph's scene.
//
// Most free numbers are numbers of the scene themselves. The map is the one place that knows of others.
#pragma once

#include <vector>

#include "fit/free_parameters.h"
#include "sim/scene/scene.h"

namespace vegard::fit {

class ParameterMap {
 public:
  /// `free` must outlive the map; `scene` is any with the sheets that the map is to be used with.
  ParameterMap(const sim::Scene& scene, const std::vector<FreeNumber>& free);

  /// Writes all values, in the order of `free`, into a scene.
  void put(const std::vector<double>& values, sim::Scene& scene) const;

  /// What changes in the scene when some of the free numbers (indices into `free`) do.
  struct Motion {
    std::vector<const double*> numbers;  ///< addresses inside the scene
    /// d number / d free, row-major [number][moved]; empty stands for the identity.
    std::vector<double> slopes;
  };
  Motion motion(const std::vector<double>& values, const std::vector<int>& moved,
                const sim::Scene& scene) const;

 private:
  const std::vector<FreeNumber>& free_;
};

}  // namespace vegard::fit
