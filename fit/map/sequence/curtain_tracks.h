// Curtains with an identity: the same curtain from frame to frame.
//
// A curtain of one frame, moved by the drift, is that of the next frame which it lies along. Where two lie
// along one, the longer goes on and the other has merged into it; where one lies along two, it goes on as the
// longer and the other has split from it. A curtain may be missed in up to two frames. What is there in fewer
// than three frames, or splits from a track and goes back into it, is none of its own.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fit/map/curtains/curtains.h"
#include "fit/map/sequence/map_sequence.h"

namespace vegard::fit {

/// A curtain in one frame.
struct TrackedCurtain {
  std::size_t frame = 0;    ///< number in MapFrames
  std::size_t curtain = 0;  ///< among those of the frame
  double length_km = 0.0;
  sim::EastNorth nearest_km;  ///< foot of the nearest point with its lower border in view
  WithError distance_km;      ///< of this
  double azimuth_deg = 0.0;
  // Means along the curtain by energy flux, whose errors are taken to be common to all points.
  WithError lower_border_km, energy_kev, flux_mw_m2;
  /// Of its light: to the east, to the north, across (positive to the left of its course, which leads from
  /// its western end to the eastern one: northwards for an arc) and along it (eastwards).
  WithError east_km_s, north_km_s, across_km_s, along_km_s;
};

struct CurtainTrack {
  int number = 0;  ///< from 1, by the first frame
  std::vector<TrackedCurtain> frames;
  int split_from = 0, merged_into = 0;         ///< numbers of tracks; 0: none
  bool seen_first = false, seen_last = false;  ///< there in the first or last frame of all
};

class CurtainTracker {
 public:
  /// Takes the frames in their order. `seconds`: since the frame before.
  void add(const MapOfFrame& frame, const std::vector<Curtain>& curtains, double seconds);
  /// The tracks, once there are no more frames.
  std::vector<CurtainTrack> tracks() const;

 private:
  struct Live {
    CurtainTrack track;
    std::vector<sim::EastNorth> course_km;  ///< of the curtain, where it is to be now
    std::size_t missed = 0;                 ///< frames
    bool ended = false;
  };
  void drop_passing(std::vector<CurtainTrack>& tracks) const;

  std::vector<Live> all_;
  std::size_t frames_ = 0;
};

}  // namespace vegard::fit
