// Inert parameters: parameters that have no effect with the scene's other settings.
#pragma once

#include <optional>

#include "sim/scene/rows/declaration.h"

namespace vegard::sim {

struct Scene;

/// Returns a complaint about a parameter that cannot be fitted: the light of this scene does not depend on
/// it, another parameter replaces it, or its derivative is not available. Empty if it can be fitted.
std::optional<Complaint> inert_parameter_complaint(const Scene& scene, const ParameterPath& path);

/// Returns a complaint about a number that was set although nothing, or less than its name says, depends on
/// it; else nothing.
std::optional<Complaint> inert_number_complaint(const Scene& scene, const ParameterPath& path);

}  // namespace vegard::sim
