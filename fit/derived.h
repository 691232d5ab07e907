// What follows from a scene's parameters and is what people publish.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/fit_result.h"
#include "fit/free_parameters.h"

namespace vegard::fit {

/// Distance along the tangent plane from the observer to the nearest point of a sheet's line from start to
/// end, km, where it has drifted to at an instant; of a system of arcs, to the nearest of them.
double nearest_distance_km(const sim::Sheet& sheet, double instant_s = 0.0);

/// Altitude below a line's peak where its volume emission rate has fallen to a tenth, and of the peak itself,
/// km; from the height profile of scene.sheets[sheet]. Source of the tenth: docs/physics.md, row B19.
double lower_border_km(double wavelength_nm, const sim::Scene& scene, int sheet);
double peak_altitude_km(double wavelength_nm, const sim::Scene& scene, int sheet);

/// How far below and above its peak a line's volume emission rate has fallen to half, km; to the ends of the
/// profile if it does not.
struct HalfWidths {
  double below_km = 0.0, above_km = 0.0;
};
HalfWidths half_widths_km(double wavelength_nm, const sim::Scene& scene, int sheet);

/// Largest distance between the first and the last layer, km: 2 w |sin(Phi/2)|, which is less than twice the
/// amplitude w that the source paper calls the thickness (docs/physics.md, row B2).
double boundary_separation_km(const sim::Sheet& sheet);

/// Sheets whose lambda / (2 w) lies outside of the 5.2 to 31.4 that nature prefers (the source paper, section
/// 3.1.1; row B5), a sentence each. Worth knowing, and nothing against a fit.
std::vector<std::string> unusual_sheets(const sim::Scene& scene);

/// What the error bars of derived numbers are made from, in the free numbers' own units.
struct ValueUncertainty {
  std::vector<std::vector<double>> covariance;    ///< inside what the data determine
  std::vector<std::vector<double>> undetermined;  ///< directions in which they say nothing
};

/// The error bar of a number with these slopes by the free numbers; none if it would change along an
/// undetermined direction, or does not depend on any.
std::optional<double> combined_sigma(const std::vector<double>& slopes, const ValueUncertainty& known);

/// Distances, mean energies, border and peak altitudes, half-widths and shapes of every sheet, with error
/// bars carried over by differences. A number that would change along an undetermined direction has none.
std::vector<DerivedNumber> derived_numbers(const sim::Scene& best, const std::vector<FreeNumber>& free,
                                           const std::vector<double>& values, const ValueUncertainty& known);

}  // namespace vegard::fit
