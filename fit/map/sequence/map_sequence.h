// Maps of the frames of one camera that stood still: one solution for all of them.
//
// Forward in time each frame's map is solved for from its picture and from the map before it, which has been
// moved by the drift (fit/map/sequence/drift_fit.h) and holds the new one near itself (the bond of
// fit/map/map_solver.h). How strongly it does is decided by the pictures: the weakest bond that predicts
// each next one nearly as well as the best does, as the gain of a Kalman filter makes innovations least
// (Mehra 1970, doi:10.1109/TAC.1970.1099422). Backward a share of what the frame after knows better is moved
// back, over a fixed number of frames (Rauch, Tung and Striebel 1965, doi:10.2514/3.3166). The maps of a few
// frames are in memory at once.
//
// Error bars are the spread of whole perturbed sequences: each keeps its physics, its prior and its smooth
// error of the model through all frames, and has noise of its own in each.
//
// The strength of the prior, the modes of the emission tables, and the spectra of perturbed sequences are
// those of the first frame's map, by itself (fit/map/map_fit.h).
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "fit/map/map_result.h"
#include "fit/map/sequence/coarse_pass.h"
#include "fit/map/sequence/drift_field.h"

namespace vegard::fit {

/// The pictures, in the order of time, one entry for each. `read` is called once for each but the first few,
/// and throws as read_photo().
struct MapFrames {
  std::vector<std::string> names;
  std::vector<double> time_s;  ///< on any clock
  std::function<Photo(std::size_t)> read;
};

/// One frame's part of the solution.
struct MapOfFrame {
  std::size_t number = 0;  ///< among MapFrames
  MapResult map;           ///< its photograph's model and chi2 are those of the pass forward
  DriftField drift;        ///< since the frame before; none for the first
};

struct FrameWithoutMap {
  std::size_t number = 0;
  std::string reason;
};

struct MapSequenceFacts {
  TimeBond bond;  ///< of the coarse film
  std::vector<FrameWithoutMap> without_map;
};

/// Maps the frames and gives them, in their order, to `done`. The scene's emitters are left out. Throws as
/// map_photos() does, sim::Error(usage) for times that do not increase, and sim::Error(scene) for a scene of
/// several photographs or one whose camera, air or field are not taken as known (fit.free).
MapSequenceFacts map_sequence(const sim::Scene& scene, const MapFrames& frames, const MapOptions& options,
                              const std::function<void(MapOfFrame)>& done);

}  // namespace vegard::fit
