// The free parameters of a fit: which numbers of the scene they are, and how the solver steps them.
//
// Ceres sees one unbounded coordinate u per parameter. A bounded parameter is transformed, never clamped
// (Ceres' own bounds are known to stall): between two limits a logistic curve, in the logarithm for a
// logarithmic parameter.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/scene/structs/scene.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::fit {

/// A parameter that a free number is, in one photograph (a name of fit.photos) or in all (empty).
struct FreePlace {
  sim::ParameterId id;
  std::string photo;
};

/// What fit.ratio_spread says of a sheet's wavelength over twice its amplitude, of which this number is one:
/// ln(ratio) = sign ln(value) + rest, where rest is that of the other number, if that is free too.
struct RatioPrior {
  double sign = 1.0;
  std::optional<sim::ParameterId> other;  ///< free too
  double rest = 0.0;
  double spread = 0.0;  ///< standard deviation of ln(ratio) beyond the range
};
/// The range that the source paper prefers (section 3.1; docs/physics.md row B5).
inline constexpr double kMinWavelengthRatio = 5.2, kMaxWavelengthRatio = 31.4;

struct FreeNumber {
  sim::ParameterId id;          ///< its first place; none for a number that only expressions use
  std::string path;             ///< of that place, as the report writes it
  std::string photo;            ///< of that place
  std::vector<FreePlace> also;  ///< further places, of entries with the same name
  std::string name;             ///< by which expressions call it, or empty
  bool in_expressions = false;  ///< whether any uses it
  double start = 0.0;
  double min = 0.0, max = 0.0;  ///< the user's limits, else the table's; +-infinity where there is none
  std::optional<sim::Prior> prior;
  std::optional<RatioPrior> ratio_prior;
  std::optional<sim::ParameterScale> scale;  ///< in place of the table's

  bool has_path() const { return id.any(); }
  const std::string& unit() const;     ///< empty if it has none
  const std::string& meaning() const;  ///< one line
  bool is_angle() const { return has_path() && id.row->scale == sim::ParameterScale::angle; }
  /// The path or the name, and of which photograph if of one alone: "camera.roll_deg of south".
  std::string label() const;

  /// Whether the user has set both limits.
  bool limited() const { return !has_path() || (min > id.row->min && max < id.row->max); }
  bool logarithmic() const;
  /// The solver's coordinate of a value strictly inside the limits, and back; a value at or beyond a limit is
  /// first moved inside by a millionth of the range.
  double coordinate(double value) const;
  double value(double coordinate) const;
  double slope(double coordinate) const;  ///< d value / d coordinate
  /// Within a thousandth of the range (of its logarithm for a logarithmic one) of a limit that the user or
  /// the table set.
  bool at_limit(double value) const;
};

/// Whether the number is one of a footprint, nebula, density node or grid, of the Sun or of what stands on
/// it.
bool is_of_volume(const FreeNumber& number);

/// scene.fit.free, vectors taken apart and entries of one name put together, in the order of the scene file.
/// `start` is the (first) entry's, else the scene's value. Throws sim::Error(scene) when there is none.
std::vector<FreeNumber> free_numbers(const sim::Scene& scene);

/// Makes `values` what a fit of this scene starts from: of fit.free, numbers without a path and those of one
/// photograph start there, the others from the scene's own values, which are to be the same.
void start_from(const std::vector<FreeNumber>& free, const std::vector<double>& values, sim::Scene& scene);

// Angle wrapping.

/// The period of an angle, 360 or 2 pi; 0 for any other number, and for an angle that expressions use.
double wrap_period(const FreeNumber& number);

/// The angle wrapped to one turn, from 0; unchanged if the user's own limits say which turn is meant, or if
/// the number is no angle.
double wrapped_angle(const FreeNumber& number, double value);

/// The absolute difference of two values; of angles the angular difference, at most half a turn.
double wrapped_difference(const FreeNumber& number, double a, double b);

}  // namespace vegard::fit
