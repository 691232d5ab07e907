// A fit's result for machines: result.json.
#pragma once

#include <cstddef>
#include <string>

#include "fit/answer/fit_result.h"

namespace vegard::fit {

/// Largest size of a result.json that is read; a few megabytes are already a large one.
constexpr std::size_t kMaxResultBytes = std::size_t{256} << 20;

/// JSON (RFC 8259) with a fixed order of keys, numbers at full precision, and null for what is unknown or not
/// finite. The same result gives the same bytes.
std::string result_json(const FitResult& result);

}  // namespace vegard::fit
