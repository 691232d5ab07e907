// The free parameters of a fit: which numbers of the scene they are, and how the solver steps them.
//
// Ceres sees one unbounded coordinate u per parameter. A bounded parameter is transformed, never clamped
// (Ceres' own bounds are known to stall): between two limits a logistic curve, in the logarithm for a
// logarithmic parameter.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/scene/parameter_table.h"
#include "sim/scene/scene.h"

namespace vegard::fit {

struct FreeNumber {
  sim::ParameterPath path;
  double start = 0.0;
  double min = 0.0, max = 0.0;  ///< the user's limits, else the table's; +-infinity where there is none
  std::optional<sim::Prior> prior;
  std::string photo;  ///< the photograph that it belongs to alone; empty: shared by all

  /// The path, and of which photograph if of one alone: "camera.roll_deg of south".
  std::string label() const { return photo.empty() ? path.text : path.text + " of " + photo; }
  bool logarithmic() const { return path.row->scale == sim::ParameterScale::logarithmic && min > 0.0; }
  /// The solver's coordinate of a value strictly inside the limits, and back; a value at or beyond a limit is
  /// first moved inside by a millionth of the range.
  double coordinate(double value) const;
  double value(double coordinate) const;
  double slope(double coordinate) const;  ///< d value / d coordinate
  /// Within a thousandth of the range (of its logarithm for a logarithmic one) of a limit that the user or
  /// the table set.
  bool at_limit(double value) const;
};

/// scene.fit.free, vectors taken apart, in the order of the scene file. `start` is the entry's, else the
/// scene's value. Throws sim::Error(scene) when there is none.
std::vector<FreeNumber> free_numbers(const sim::Scene& scene);

/// Writes values into a scene, and finds where they live in it.
void put_values(sim::Scene& scene, const std::vector<FreeNumber>& free, const std::vector<double>& values);
std::vector<const double*> addresses(const sim::Scene& scene, const std::vector<FreeNumber>& free);

}  // namespace vegard::fit
