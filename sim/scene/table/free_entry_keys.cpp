#include "sim/scene/table/free_entry_keys.h"

namespace vegard::sim {

const std::vector<FreeNumberKey>& free_number_keys() {
  static const std::vector<FreeNumberKey> keys = {
      {"start", "where the search starts; left out: the scene's own value", &FreeParameter::start},
      {"min", "lower limit of the search; left out: the parameter's own", &FreeParameter::min},
      {"max", "upper limit of the search; left out: the parameter's own", &FreeParameter::max},
  };
  return keys;
}

const std::vector<FreeTextKey>& free_text_keys() {
  static const std::vector<FreeTextKey> keys = {
      {"name",
       "for expressions; entries of one name are one number; without a path (but with start, min and max): a "
       "number that only expressions use",
       "a text", &FreeParameter::name},
      {"scale", "on which the parameter is moved; left out: the parameter's own",
       "\"linear\" or \"logarithmic\"", &FreeParameter::scale},
      {"photo", "the photograph that it belongs to alone; left out: all", "a name of fit.photos",
       &FreeParameter::photo},
  };
  return keys;
}

const std::vector<FreePriorKey>& free_prior_keys() {
  static const std::vector<FreePriorKey> keys = {
      {"mean", "centre of the prior (log-normal: of the logarithm, as its exponential)", &Prior::mean},
      {"sigma", "standard deviation of the prior (log-normal: of the logarithm, a fraction), above 0",
       &Prior::sigma},
  };
  return keys;
}

const std::vector<TiedKey>& tied_keys() {
  static const std::vector<TiedKey> keys = {
      {"path", "of the parameter that follows from others", "a text", true, &TiedParameter::path},
      {"equals", "what it is: numbers, paths, names of fit.free, + - * / ^, parentheses and functions",
       "an expression", true, &TiedParameter::equals},
      {"photo", "the photograph in which it is so; left out: all", "a name of fit.photos", false,
       &TiedParameter::photo},
  };
  return keys;
}

ParameterScale scale_of(const FreeParameter& free, const ParameterRow* row) {
  if (free.scale == logarithmic_scale) return ParameterScale::logarithmic;
  if (free.scale == linear_scale || row == nullptr) return ParameterScale::linear;
  return row->scale;
}

}  // namespace vegard::sim
