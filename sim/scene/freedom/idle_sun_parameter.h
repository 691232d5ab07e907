// Parameters of the Sun, and of what stands on it, that a scene has no use for.
//
// For the files of this folder only.
#pragma once

#include <optional>

#include "sim/scene/table/parameter_declarations.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::sim {

/// Why the light does not depend on a number of [sun], [[chromosphere]], [[loop]], [[corona]], [[bundle]] or
/// [[ejection]]; none if it does, or for any other number.
std::optional<Complaint> why_sun_number_counts_for_nothing(const Scene& scene, const ParameterPath& path);

}  // namespace vegard::sim
