// Parameters that a scene has no use for.
//
// For the files of this folder only.
#pragma once

#include <optional>

#include "sim/scene/rows/declaration.h"

namespace vegard::sim {

/// A complaint about a parameter that the light does not depend on in this scene, or that another stands for:
/// nobody can fit it.
std::optional<Complaint> why_it_counts_for_nothing(const Scene& scene, const ParameterPath& path);

}  // namespace vegard::sim
