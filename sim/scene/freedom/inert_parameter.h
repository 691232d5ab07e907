// Parameters that a scene has no use for.
//
#pragma once

#include <optional>

#include "sim/scene/rows/declaration.h"

namespace vegard::sim {

/// A complaint about a parameter that the light does not depend on in this scene, or that another stands for:
/// nobody can fit it.
/// Also about one that a fit has no derivative by.
std::optional<Complaint> inert_parameter_complaint(const Scene& scene, const ParameterPath& path);

/// The same of the numbers of sheets, camera, field, air and tables, whether anybody fits them or not.
std::optional<Complaint> inert_number_complaint(const Scene& scene, const ParameterPath& path);

}  // namespace vegard::sim
