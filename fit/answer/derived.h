// Derived numbers: quantities for publication, computed from a scene's parameters.
#pragma once

#include <string>
#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/parameters/free_parameters.h"
#include "fit/uncertainty/delta_method.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// Distance along the tangent plane, km, from the observer to the nearest point of a sheet's line between its
/// start and end, at the place to which it has drifted at an instant; of a system of arcs, to the nearest
/// arc.
double nearest_distance_km(const sim::Sheet& sheet, double instant_s = 0.0);

/// Azimuth of that nearest point from the observer, 0 to 360, clockwise from north.
double nearest_azimuth_deg(const sim::Sheet& sheet, double instant_s = 0.0);

/// Lower border, peak altitude and half-widths of a line's light along the field, as sim/light/line_light.h
/// defines them.
double lower_border_km(double wavelength_nm, const sim::Scene& scene, int sheet);
double peak_altitude_km(double wavelength_nm, const sim::Scene& scene, int sheet);

struct HalfWidths {
  double below_km = 0.0, above_km = 0.0;
};
HalfWidths half_widths_km(double wavelength_nm, const sim::Scene& scene, int sheet);

/// Largest distance between the first and the last layer, km: 2 w |sin(Phi/2)|. It is less than twice the
/// amplitude w, which the source paper calls the thickness (docs/physics.md, row B2).
double boundary_separation_km(const sim::Sheet& sheet);

/// Returns a sentence for each sheet whose lambda / (2 w) lies outside 5.2 to 31.4, the range that is usual
/// in nature (the source paper, section 3.1.1; row B5). These are notes; they do not count against a fit.
std::vector<std::string> unusual_sheets(const sim::Scene& scene);

/// Returns the derived numbers of every sheet, with error bars by the delta method: distance and azimuth, E0
/// and mean energy, lower border, peak altitudes and half-widths, ratios of lines along the field, shape,
/// bearing and sine where they were free, and the geographic and geomagnetic coordinates of its feet. The
/// list is in docs/fitting.md, "Derived numbers". A number that is unconstrained is included, with the
/// reason.
std::vector<DerivedNumber> derived_numbers(const sim::Scene& best, const std::vector<FreeNumber>& free,
                                           const std::vector<double>& values, const ValueUncertainty& known);

/// Returns the error band of each sheet's line of feet.
std::vector<sim::FootBand> foot_bands(const sim::Scene& best, const std::vector<FreeNumber>& free,
                                      const std::vector<double>& values, const ValueUncertainty& known);

// Names of a scene's light sources for the messages of a fit.

/// "aurora", "nebula" or "solar light". Grids in a scene with neither nebula nor Sun are taken as aurora; so
/// is a scene of which only a part is aurora.
std::string light_noun(const sim::Scene& scene);

/// The kinds of light sources, for "no light of the scene's ...": "sheets", "volumes", "Sun", "sheets and
/// volumes".
std::string sources_of(const sim::Scene& scene);

}  // namespace vegard::fit
