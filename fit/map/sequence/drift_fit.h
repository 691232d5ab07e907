// Finds how light has moved between two frames, from the second picture itself.
//
// The map of the first frame, moved by a drift field, predicts the second picture. Velocities and growth at
// the net's nodes are those with which it does so best (Gauss and Newton; the sky is solved for with them).
// Before, each component of a velocity is a normal number, 0 ± 0.6 km/s for all light together and ± 0.3 of
// each place's own, which neighbours within some 300 km share (exponential correlation). Both are forgotten
// over 20 minutes (an Ornstein-Uhlenbeck process), so that frame after frame a Kalman filter results. A
// growth rate is drawn anew with each frame. As for the modes of a map, so many values as share a smooth
// error count as one.
//
// A picture says nothing of motion along a homogeneous arc; the covariance then has the prior's width there.
#pragma once

#include <cstdint>
#include <vector>

#include "fit/map/map_observation.h"
#include "fit/map/map_solver.h"
#include "fit/map/sequence/drift_field.h"

namespace vegard::fit {

/// The velocities before any picture is looked at.
DriftField drift_before(const DriftNet& net);

/// The velocities `seconds` later, as far as known then.
DriftField drift_later(const DriftField& drift, double seconds);

/// Cells (1) whose lower border is on a used part of the picture: of these the map is known. Others may have
/// light that no map has, which moves into the picture.
std::vector<std::uint8_t> cells_in_view(const MapObservation& picture, const sim::Site& home,
                                        const sim::GroundGrid& grid);

/// The velocities with which, on the coarse film, the map `before`, `seconds` earlier, best explains the
/// picture. `expected` is what is known of them before. If nothing was seen to move yet (`is_first`),
/// velocities up to 1.5 km/s are tried for the whole. `in_view`: cells_in_view() of the frame before; parts
/// of the picture where light may come from others are left out.
DriftField fitted_drift(MapObservation& picture, const CellPoints& points, const sim::GroundGrid& grid,
                        const MapNeighbours& near, const std::vector<std::uint8_t>& in_view,
                        const std::vector<float>& before, const DriftField& expected, double seconds,
                        bool is_first, int threads);

/// The velocities at a frame with what the frame after it says: `after` is smoothed already, and `seconds`
/// later (Rauch, Tung and Striebel 1965, doi:10.2514/3.3166).
DriftField smoothed_drift(const DriftField& drift, const DriftField& after, double seconds);

}  // namespace vegard::fit
