// A map with few lit cells, and its form in a journal.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fit/search/journal.h"

namespace vegard::fit {

struct SparseMap {
  std::vector<double> place, value;  ///< indices of the numbers that are not 0, and these

  SparseMap() = default;
  explicit SparseMap(const std::vector<float>& map);
  std::vector<float> whole(std::size_t numbers) const;
  /// A number of the journal holds a place and, in its lower half, a value.
  void store(StepOutput& out, const std::string& name) const;
  /// Throws StepOutput::error_at() for what store() has not written.
  static SparseMap stored(const StepOutput& out, const std::string& name, std::size_t numbers);
};

}  // namespace vegard::fit
