// Maps the free numbers of a fit to the numbers of one photograph's scene.
//
// Most free numbers are single numbers of the scene. Some stand for several at once (entries of fit.free with
// one name), some only occur in expressions, and some numbers of the scene follow from others (fit.tied). The
// map resolves all of this in one place, including numbers that belong to one photograph alone and the frame
// of a station elsewhere (fit/parameters/photo_frame.h).
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
  /// `free` must outlive the map; `scene` may be any with the same sheets and fit.tied as the scenes to which
  /// the map is applied. `photo` is the name by which entries of fit.free and fit.tied refer to the
  /// photograph; entries of other photographs are left out.
  ParameterMap(const sim::Scene& scene, const std::vector<FreeNumber>& free, const std::string& photo = {});
  /// For a photograph with a frame of its own.
  ParameterMap(const sim::Scene& scene, const std::vector<FreeNumber>& free, const PhotoFrame& frame);

  /// Writes all values, in the order of `free`, and the tied numbers that follow from them into a scene. A
  /// tied number beyond the limits of its parameter is set to the limit, so that the scene stays valid; the
  /// function then returns false.
  bool put(const std::vector<double>& values, sim::Scene& scene) const;

  /// The numbers of the scene that change with some of the free numbers, and their derivatives.
  struct Motion {
    std::vector<sim::ParameterId> numbers;
    /// d number / d free, row-major [number][moved]; empty stands for the identity.
    std::vector<double> slopes;
    std::size_t moved = 0;  ///< how many free numbers vary
  };
  /// `moved` are indices into `free`; `scene` must contain the values.
  Motion motion(const std::vector<double>& values, const std::vector<int>& moved,
                const sim::Scene& scene) const;

  /// Whether each free number is one number of this scene, and no number is tied.
  bool is_plain() const;

  /// A number of the scene that follows from free ones.
  struct Dependent {
    sim::ParameterId id;
    std::string equals;          ///< an expression, or the path of the number that it equals
    std::vector<double> slopes;  ///< d number / d free, by all free numbers
  };
  /// All numbers that follow from free ones, in the order in which they are computed.
  std::vector<Dependent> dependents(const std::vector<double>& values, const sim::Scene& scene) const;

 private:
  struct Place {
    sim::ParameterId id;
    int number = 0;  ///< index into `free`
  };
  /// An input of a tie: a free number (`number`), given by its name or by a parameter in `places_`, or an
  /// earlier tie (`tie`); if both are -1, the parameter is fixed.
  struct Input {
    sim::ParameterId id;  ///< none for a number called by its name
    int number = -1, tie = -1;
  };
  struct Following {
    sim::Tie tie;
    std::vector<Input> inputs;
    std::vector<bool> uses;  ///< by free number: whether the tie depends on it, also through other ties
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
