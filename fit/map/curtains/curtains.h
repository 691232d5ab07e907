// Finds the curtains of a map: the ridges of its energy flux, as curves with the quantities along them.
//
// A ridge point is where the smoothed flux has its maximum along the direction of its strongest curvature
// (Steger 1998, doi:10.1109/34.659930). Points are joined at right angles to that direction, starting from
// the brightest, as long as the next one is bright enough (hysteresis); pieces that go on in each other's
// course become one (fit/map/curtains/ridge_evidence.h). The curve is then resampled every few kilometres.
//
// Not every ridge is a curtain. A point counts only if nearly all perturbed solutions have a ridge there,
// within the error of its place; the ridge's height must be more than chance makes, by the ridges along the
// same course in differences of two perturbed solutions; and a wide maximum that is not long is a diffuse
// patch.
#pragma once

#include <vector>

#include "fit/map/map_result.h"
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
  bool at_edge = false;        ///< the map's ground ends there, or within two standard errors: its light may
                               ///< come from anywhere beyond
  int energy_limit = 0;   ///< 1: the energy is the largest of the map's, thus a lower limit; -1: the least
  double found_in = 0.0;  ///< share of the perturbed solutions with a ridge there; NaN without any
};

struct Curtain {
  std::vector<CurtainPoint> points;  ///< from one end to the other
  double length_km = 0.0;
  double probability = 0.0;       ///< of being no work of chance; NaN if it was not tested
  double width_at_half_km = 0.0;  ///< full width of the smoothed ridge, in the median
  bool is_diffuse_patch = false;
  bool is_branch = false;  ///< begins at a curtain that is more than twice as bright
};

/// From this probability on a ridge is a curtain.
inline constexpr double kCurtainProbability = 0.95;

/// Returns the curtains, by decreasing energy. Without perturbed solutions they are not tested against
/// chance.
std::vector<Curtain> find_curtains(const MapResult& result);

/// Returns the ridges that are no curtains, in the same order: too faint, or perhaps a work of chance, or
/// diffuse patches, or branches of a curtain. Some are artefacts of the bright ones.
std::vector<Curtain> find_faint_curtains(const MapResult& result);

/// Whether a foot is so near to the end of the map's ground that light from beyond would be put there.
bool is_at_edge(const MapResult& result, sim::EastNorth foot_km);

}  // namespace vegard::fit
