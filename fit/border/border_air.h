// How much the air dims the light of aurora in each row of the sky's cells.
//
// Towards the horizon the air dims so fast that a border's place hangs on it: at 4 degrees its transmission
// falls by two fifths to the degree. What a photograph's air was is not known, so there are three: that of
// the scene's [air], or of its standard values where the scene has none, and air with half and with twice as
// much aerosol, which is how the Arctic's clear and hazy days differ (Tomasi et al. 2007,
// doi:10.1029/2006JD008432).
#pragma once

#include <vector>

#include "fit/border/sky_cells.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// Optical depths along the line of sight, [row]. Light falls by exp(-depth).
struct BorderAir {
  std::vector<double> usual, clear, hazy;
};

/// The air of a picture whose channel (0 red, 1 green, 2 blue) has the light of 630.0, 557.7 or 427.8 nm.
BorderAir air_of_rows(const sim::Scene& scene, const SkyCells& cells, int channel);

/// No air at all.
BorderAir no_air(const SkyCells& cells);

/// What is not known of the refraction at an apparent elevation, in degrees: the formula is for 10 °C, and at
/// -30 °C the air is denser, and bends light more, by 16 %.
double refraction_error_deg(double apparent_elevation_deg, double site_altitude_m);

}  // namespace vegard::fit
