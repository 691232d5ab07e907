// The free parameters of a fit: the numbers of the scene that they stand for, and their transforms to the
// solver's coordinates.
//
// Ceres sees one unbounded coordinate u per parameter. A bounded parameter is transformed, never clamped
// (Ceres' own bounds are known to stall): by a logistic curve between the two limits, in the logarithm for a
// logarithmic parameter.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/scene/structs/scene.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::fit {

/// A parameter of the scene for which a free number stands, in one photograph (a name of fit.photos) or in
/// all (empty).
struct FreePlace {
  sim::ParameterId id;
  std::string photo;
};

/// The prior fit.ratio_spread on the ratio of a sheet's wavelength to twice its amplitude, where this number
/// is one of the two: ln(ratio) = sign ln(value) + rest, less sign ln(other) if the other number is free too.
struct RatioPrior {
  double sign = 1.0;
  std::optional<sim::ParameterId> other;  ///< the other number, if it is free too
  double rest = 0.0;
  double spread = 0.0;  ///< standard deviation of ln(ratio) beyond the range
};
/// The preferred range of the ratio in the source paper (section 3.1; docs/physics.md row B5).
inline constexpr double kMinWavelengthRatio = 5.2, kMaxWavelengthRatio = 31.4;

struct FreeNumber {
  sim::ParameterId id;          ///< its first place; none for a number that only expressions use
  std::string path;             ///< path of the first place, as in reports
  std::string photo;            ///< photograph of the first place
  std::vector<FreePlace> also;  ///< further places: entries with the same name
  std::string name;             ///< its name in expressions, or empty
  bool in_expressions = false;  ///< whether an expression uses it
  double start = 0.0;
  double min = 0.0, max = 0.0;  ///< the user's limits, else the table's; +-infinity where there is none
  std::optional<sim::Prior> prior;
  std::optional<RatioPrior> ratio_prior;
  std::optional<sim::ParameterScale> scale;  ///< overrides that of the parameter table

  bool has_path() const { return id.any(); }
  bool has_role(sim::ParameterRole role) const { return id.role() == role; }
  const std::string& unit() const;     ///< empty if it has none
  const std::string& meaning() const;  ///< one line
  bool is_angle() const { return has_path() && id.row->scale == sim::ParameterScale::angle; }
  /// The path or the name, with the photograph if it belongs to one alone: "camera.roll_deg of south".
  std::string label() const;

  /// Whether the user has set both limits.
  bool limited() const { return !has_path() || (min > id.row->min && max < id.row->max); }
  bool logarithmic() const;
  /// Converts a value strictly inside the limits to the solver's coordinate, and back; a value at or beyond a
  /// limit is first moved inside by a millionth of the range.
  double coordinate(double value) const;
  double value(double coordinate) const;
  double slope(double coordinate) const;  ///< d value / d coordinate
  /// The value, moved inside the limits.
  double within_limits(double value) const { return this->value(coordinate(value)); }
  /// Whether the value is within a thousandth of the range (of its logarithm for a logarithmic parameter)
  /// from a limit that the user or the table set.
  bool at_limit(double value) const;
};

/// Whether the number belongs to a footprint, a nebula, a density node, a grid, the Sun or a structure on it.
bool is_of_volume(const FreeNumber& number);

/// Returns scene.fit.free with one number per component of a vector, and one for all entries of the same
/// name, in the order of the scene file. `start` is that of the (first) entry, else the scene's value. Throws
/// sim::Error(scene) when there is none.
std::vector<FreeNumber> free_numbers(const sim::Scene& scene);

/// Returns the starts of all numbers, inside their limits.
std::vector<double> start_values(const std::vector<FreeNumber>& free);

/// Makes a fit of this scene start from `values`. For numbers without a path and those of one photograph,
/// sets the start of the entry in fit.free. The others start from the scene's own values, which must already
/// equal `values`.
void start_from(const std::vector<FreeNumber>& free, const std::vector<double>& values, sim::Scene& scene);

// Angle wrapping.

/// The period of an angle, 360 or 2 pi; 0 for any other number, and for an angle that expressions use.
double wrap_period(const FreeNumber& number);

/// Returns the angle wrapped to one turn, from 0; unchanged if the user's own limits determine the turn, or
/// if the number is not an angle.
double wrapped_angle(const FreeNumber& number, double value);

/// Returns the absolute difference of two values; for angles the angular difference, at most half a turn.
double wrapped_difference(const FreeNumber& number, double a, double b);

}  // namespace vegard::fit
