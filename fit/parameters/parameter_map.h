// Maps the solver's numbers to the numbers of one photograph's scene.
//
// Most free numbers are numbers of the scene themselves. Some are several of them at once (entries of
// fit.free with one name), some are none and only stand in expressions, and some numbers of the scene follow
// from others (fit.tied). The map is the one place that knows, and of several photographs it knows whose each
// is, and of a station elsewhere (fit/parameters/photo_frame.h).
#pragma once

#include <string>
#include <vector>

#include "fit/parameters/free_parameters.h"
#include "fit/parameters/photo_frame.h"
#include "sim/scene/freedom/ties.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

class ParameterMap {
 public:
  /// `free` must outlive the map; `scene` is any with the sheets and the fit.tied that the map is to be used
  /// with. `photo` is the photograph's name, as entries of fit.free and fit.tied that belong to it alone say
  /// it; those of another are left out.
  ParameterMap(const sim::Scene& scene, const std::vector<FreeNumber>& free, const std::string& photo = {});
  /// The same for a photograph of a frame of its own.
  ParameterMap(const sim::Scene& scene, const std::vector<FreeNumber>& free, const PhotoFrame& frame);

  /// Writes all values, in the order of `free`, into a scene, and what follows from them. What would follow
  /// beyond the limits of its parameter is held at the limit, so that no nonsense is simulated;
  /// false is returned then.
  bool put(const std::vector<double>& values, sim::Scene& scene) const;

  /// What changes in the scene when some of the free numbers (indices into `free`) do.
  struct Motion {
    std::vector<sim::ParameterId> numbers;
    /// d number / d free, row-major [number][moved]; empty stands for the identity.
    std::vector<double> slopes;
    std::size_t moved = 0;  ///< how many free numbers move
  };
  /// `scene` is one with these values put into it.
  Motion motion(const std::vector<double>& values, const std::vector<int>& moved,
                const sim::Scene& scene) const;

  /// Whether each free number is one number of this scene, and nothing follows from any.
  bool is_plain() const;

  /// A number of the scene that follows from free ones.
  struct Dependent {
    sim::ParameterId id;
    std::string equals;          ///< an expression, or what it is the same as
    std::vector<double> slopes;  ///< d number / d free, of all free numbers
  };
  /// All of them, in the order in which they are worked out.
  std::vector<Dependent> dependents(const std::vector<double>& values, const sim::Scene& scene) const;

 private:
  struct Place {
    sim::ParameterId id;
    int number = 0;  ///< index into `free`
  };
  /// An input of a tie, of which at most one holds: a free number that is no parameter of this photograph, a
  /// place, an earlier tie; else the parameter is fixed.
  struct Input {
    sim::ParameterId id;  ///< none for a number called by its name
    int number = -1, tie = -1;
  };
  struct Following {
    sim::Tie tie;
    std::vector<Input> inputs;
    std::vector<bool> uses;  ///< by free number: whether it depends on it, through whatever else
  };

  bool put_in_site_frame(const std::vector<double>& values, sim::Scene& scene) const;
  Motion motion_in_site_frame(const std::vector<double>& values, const std::vector<int>& moved,
                              const sim::Scene& at_home) const;
  std::vector<double> input_values(const Following& following, const std::vector<double>& values,
                                   const sim::Scene& scene) const;
  /// d tie / d free, [tie][free].
  std::vector<std::vector<double>> tie_slopes(const std::vector<double>& values,
                                              const sim::Scene& scene) const;

  const std::vector<FreeNumber>& free_;
  PhotoFrame frame_;
  std::vector<Place> places_;  ///< in the order of `free`
  std::vector<Following> following_;
};

}  // namespace vegard::fit
