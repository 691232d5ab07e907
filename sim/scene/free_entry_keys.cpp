#include "sim/scene/free_entry_keys.h"

namespace vegard::sim {

const std::vector<FreeNumberKey>& free_number_keys() {
  static const std::vector<FreeNumberKey> keys = {
      {"start", "where the search starts; left out: the scene's own value", &FreeParameter::start},
      {"min", "lower limit of the search; left out: the parameter's own", &FreeParameter::min},
      {"max", "upper limit of the search; left out: the parameter's own", &FreeParameter::max},
  };
  return keys;
}

const std::vector<FreePriorKey>& free_prior_keys() {
  static const std::vector<FreePriorKey> keys = {
      {"mean", "centre of a Gaussian prior; left out: no prior", &Prior::mean},
      {"sigma", "standard deviation of the prior, above 0", &Prior::sigma},
  };
  return keys;
}

}  // namespace vegard::sim
