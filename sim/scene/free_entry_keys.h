// The keys of an entry of fit.free, each named once for the reader, the writer and the listings.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/scene/scene.h"

namespace vegard::sim {

inline const char* const free_table = "fit";
inline const char* const free_key = "free";
inline const char* const free_path_key = "path";
inline const char* const free_prior_key = "prior";

struct FreeNumberKey {
  std::string key, meaning;
  std::optional<double> FreeParameter::*place;
};
const std::vector<FreeNumberKey>& free_number_keys();

struct FreePriorKey {
  std::string key, meaning;
  double Prior::*place;
};
const std::vector<FreePriorKey>& free_prior_keys();

}  // namespace vegard::sim
