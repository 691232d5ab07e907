// Parameters of footprints, nebulae and nodes that a scene has no use for, or whose derivative nobody has.
//
// For the files of this folder only.
#pragma once

#include <optional>

#include "sim/scene/table/parameter_declarations.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::sim {

/// As why_it_counts_for_nothing(), of which this is the part of volumes.
std::optional<Complaint> why_volume_number_counts_for_nothing(const Scene& scene, const ParameterPath& path);

}  // namespace vegard::sim
