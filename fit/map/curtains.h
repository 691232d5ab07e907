// The curtains of a map: the ridges of its energy flux, as curves with what stands along them.
//
// A ridge point is where the smoothed flux has its maximum along the direction in which it bends most
// (Steger 1998, doi:10.1109/34.659930). Points are joined from the brightest on, in the direction across
// that, as long as the next one is bright enough (hysteresis), and taken again every few kilometres.
#pragma once

#include <vector>

#include "fit/map/map_fit.h"
#include "fit/map/map_raster.h"

namespace vegard::fit {

/// A value and its standard error; NaN where there is none.
struct WithError {
  double value = 0.0, error = 0.0;
};

struct CurtainPoint {
  sim::EastNorth foot_km;
  double distance_km = 0.0, azimuth_deg = 0.0;  ///< of the foot, from the site
  double lateral_error_km = 0.0;                ///< standard error of the foot's place, across the curtain
  double distance_error_km = 0.0;  ///< of the distance from the site, with that of the border's altitude
  WithError flux_mw_m2;            ///< at the ridge, with the width given
  WithError energy_kev;            ///< mean over the curtain's width
  WithError width_km;              ///< standard deviation across, as the map has it: an upper limit
  WithError lower_border_km;   ///< where the light of 557.7 nm, or of the scene's brightest line, has half of
                               ///< its peak, below it
  bool border_in_view = true;  ///< its lower border is in a used part of a picture
};

struct Curtain {
  std::vector<CurtainPoint> points;  ///< from one end to the other
  double length_km = 0.0;
};

/// That which carries most energy first.
std::vector<Curtain> find_curtains(const MapResult& result);

/// Ridges that are no curtains since they are too faint: some are ghosts of the bright ones. Likewise sorted.
std::vector<Curtain> find_faint_curtains(const MapResult& result);

/// Lower border of the light of electrons of an energy (Maxwellian), and its derivative by ln(energy), in km.
struct LowerBorder {
  double altitude_km = 0.0, by_ln_energy = 0.0;
};
LowerBorder lower_border(const sim::Scene& scene, double energy_kev);

}  // namespace vegard::fit
