// From the numbers that the solver moves to the numbers of one photograph's scene.
//
// Most free numbers are numbers of the scene themselves. The map is the one place that knows of others, of
// those of other photographs, and of a station elsewhere (fit/photo_frame.h).
#pragma once

#include <optional>
#include <vector>

#include "fit/free_parameters.h"
#include "fit/photo_frame.h"
#include "sim/scene/scene.h"

namespace vegard::fit {

class ParameterMap {
 public:
  /// `free` must outlive the map; `scene` is any with the sheets that the map is to be used with.
  /// Without a frame: of the scene that a fit's photographs share.
  ParameterMap(const sim::Scene& scene, const std::vector<FreeNumber>& free, const PhotoFrame& frame = {});

  /// Writes all values, in the order of `free`, into a scene; those of other photographs go nowhere.
  void put(const std::vector<double>& values, sim::Scene& scene) const;

  /// What changes in the scene when some of the free numbers (indices into `free`) do.
  struct Motion {
    std::vector<const double*> numbers;  ///< addresses inside the scene
    /// d number / d free, row-major [number][moved]; empty stands for the identity.
    std::vector<double> slopes;
    std::size_t moved = 0;  ///< how many free numbers; there may be no number in the scene that they move
  };
  Motion motion(const std::vector<double>& values, const std::vector<int>& moved,
                const sim::Scene& scene) const;

 private:
  PhotoFrame frame_;
  std::vector<std::optional<sim::ParameterPath>> places_;  ///< by free number; none: not in this scene
};

}  // namespace vegard::fit
