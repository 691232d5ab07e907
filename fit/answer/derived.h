// Derived numbers: the quantities that people publish, computed from a scene's parameters.
#pragma once

#include <string>
#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/parameters/free_parameters.h"
#include "fit/uncertainty/delta_method.h"

namespace vegard::fit {

/// Distance along the tangent plane from the observer to the nearest point of a sheet's line from start to
/// end, km, where it has drifted to at an instant; of a system of arcs, to the nearest of them.
double nearest_distance_km(const sim::Sheet& sheet, double instant_s = 0.0);

/// Its azimuth from the observer, 0 to 360, clockwise from the north.
double nearest_azimuth_deg(const sim::Sheet& sheet, double instant_s = 0.0);

/// Of a line's light along the field: what sim/light/line_light.h says.
double lower_border_km(double wavelength_nm, const sim::Scene& scene, int sheet);
double peak_altitude_km(double wavelength_nm, const sim::Scene& scene, int sheet);

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

/// Of every sheet, with error bars by the delta method: distance and azimuth, E0 and mean energy, lower
/// border, peak altitudes and half-widths, ratios of lines along the field, shape, bearing and sine where
/// they were free, and the geographic and
/// geomagnetic coordinates of its feet. docs/fitting.md, "Derived numbers", has the list. A number that
/// is unconstrained is there all the same and says why.
std::vector<DerivedNumber> derived_numbers(const sim::Scene& best, const std::vector<FreeNumber>& free,
                                           const std::vector<double>& values, const ValueUncertainty& known);

/// How far each sheet's line may be off.
std::vector<sim::FootBand> foot_bands(const sim::Scene& best, const std::vector<FreeNumber>& free,
                                      const std::vector<double>& values, const ValueUncertainty& known);

}  // namespace vegard::fit
