// Finds the curtains of a map: the ridges of its energy flux, as curves with the quantities along them.
//
// A ridge point is where the smoothed flux has its maximum along the direction of its strongest curvature
// (Steger 1998, doi:10.1109/34.659930). Points are joined at right angles to that direction, starting from
// the brightest, as long as the next one is bright enough (hysteresis). The curve is then resampled every few
// kilometres.
#pragma once

#include <vector>

#include "fit/map/map_fit.h"
#include "fit/map/raster_grid.h"

namespace vegard::fit {

/// A value and its standard error; NaN where there is none.
struct WithError {
  double value = 0.0, error = 0.0;
};

struct CurtainPoint {
  sim::EastNorth foot_km;
  double distance_km = 0.0, azimuth_deg = 0.0;  ///< of the foot, from the site
  double lateral_error_km = 0.0;                ///< standard error of the foot's position, across the curtain
  double distance_error_km = 0.0;  ///< error of distance_km, that of the border's altitude included
  WithError flux_mw_m2;            ///< peak flux at the ridge for the width given below
  WithError energy_kev;            ///< mean over the curtain's width
  WithError width_km;              ///< standard deviation across the curtain in the map: an upper limit
  WithError lower_border_km;   ///< where, below its peak, the light of 557.7 nm (or of the scene's brightest
                               ///< line) is half of the peak
  bool border_in_view = true;  ///< its lower border is in a used part of a picture
};

struct Curtain {
  std::vector<CurtainPoint> points;  ///< from one end to the other
  double length_km = 0.0;
};

/// Returns the curtains, by decreasing energy.
std::vector<Curtain> find_curtains(const MapResult& result);

/// Returns the ridges that are too faint for curtains, in the same order; some are artefacts of the bright
/// ones.
std::vector<Curtain> find_faint_curtains(const MapResult& result);

/// Lower border of the light of Maxwellian electrons of an energy, and its derivative by ln(energy), both in
/// km.
struct LowerBorder {
  double altitude_km = 0.0, by_ln_energy = 0.0;
};
LowerBorder lower_border(const sim::Scene& scene, double energy_kev);

}  // namespace vegard::fit
