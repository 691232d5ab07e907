// Smooths a number through the frames of a night: a track with its velocity, and flags for frames that are
// not consistent with it.
//
// The state of the track is position and velocity, driven by white noise of acceleration of the intensity q:
// over a time t the state changes to (x + v t, v), with a covariance of q (t^3/3, t^2/2; t^2/2, t)
// (Bar-Shalom, Li and Kirubarajan 2001, "Estimation with applications to tracking and navigation",
// section 6.2.2). Each frame measures the position with its own error. There is no prior of position and
// velocity: the Kalman filter is initialised from the first two numbers as in section 5.5.3 there, with q
// taken into account, and the likelihood is that of the third and later ones. q maximises the likelihood of
// the innovations (Schweppe 1965, IEEE Transactions on Information Theory 11, 61). The smoother is that of
// Rauch, Tung and Striebel 1965, AIAA Journal 3, 1445.
#pragma once

#include <vector>

namespace vegard::fit {

struct TrackPoint {
  double time_s = 0.0;
  double value = 0.0;
  double sigma = 0.0;  ///< no measurement: value or sigma not finite or beyond 1e100, or sigma not above 0
};

enum class TrackFlag {
  none,
  outlier,  ///< is not consistent with the track, and is not used for it
  broken,   ///< this and the next two numbers jump together: a new piece of the track begins here
};
/// Returns "outlier" or "break"; "" for none.
const char* track_flag_name(TrackFlag flag);

struct SmoothedPoint {
  /// Position in the points' unit and velocity in this unit per second, at every time, also without a
  /// measurement. NaN in a piece with fewer than two numbers, and everywhere if no piece has three.
  double position = 0.0, position_sigma = 0.0;
  double velocity = 0.0, velocity_sigma = 0.0;
  TrackFlag flag = TrackFlag::none;
  double chi2 =
      0.0;  ///< of a flagged point: square of its innovation over the innovation's variance; else NaN
};

struct SmoothedTrack {
  std::vector<SmoothedPoint> points;  ///< one for each TrackPoint
  double process_noise = 0.0;         ///< the likeliest q, in the square of the unit per s^3; 0: unknown
  int used = 0;                       ///< numbers that were used for the track
  int outliers = 0, breaks = 0;
  double innovation_chi2 = 0.0;  ///< mean over the innovations of the filter; near 1 if errors are as stated
};

/// Smooths `points`, each of which must be later than the one before. A frame is flagged as a jump if the
/// square of its innovation over the innovation's variance exceeds the limit that a share `false_alarms` of
/// sound frames exceeds (chi-squared with one degree of freedom). Each frame is tested twice: against the
/// frames before it, and against all other frames; so up to twice this share of sound frames is flagged.
/// Three consecutive jumps that agree with each other are a break. The result is deterministic.
SmoothedTrack smooth_track(const std::vector<TrackPoint>& points, double false_alarms);

/// Returns the limit of this test.
double jump_limit(double false_alarms);

}  // namespace vegard::fit
