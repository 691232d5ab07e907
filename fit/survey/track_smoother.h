// A number followed through frames: a smooth track with its velocity, and the frames that jump out of it.
//
// The track: position and velocity, driven by white noise of acceleration of the intensity q, that is, over
// a time t the state goes to (x + v t, v), with a covariance of q (t^3/3, t^2/2; t^2/2, t) (Bar-Shalom, Li
// and Kirubarajan 2001, "Estimation with applications to tracking and navigation", section 6.2.2). Each frame
// measures the position with an error of its own. Nothing is known beforehand of position and velocity: of
// the first two numbers the filter starts as section 5.5.3 there, with q taken into account, and likelihoods
// are of the third and later ones. q is where the likelihood of the innovations is largest (Schweppe 1965,
// IEEE Transactions on Information Theory 11, 61). Smoothed by Rauch, Tung and Striebel 1965, AIAA Journal 3,
// 1445.
#pragma once

#include <vector>

namespace vegard::fit {

struct TrackPoint {
  double time_s = 0.0;
  double value = 0.0;
  double sigma = 0.0;  ///< value or sigma not finite (or beyond 1e100), or sigma not above 0: no measurement
};

enum class TrackFlag {
  none,
  outlier,  ///< does not belong to the track, and is left out of it
  broken,   ///< here and in the next two the number is elsewhere: a track of its own begins
};
/// "outlier", "break"; "" of none.
const char* track_flag_name(TrackFlag flag);

struct SmoothedPoint {
  /// In the points' unit and in that per second, at every time, also where nothing is measured. NaN where its
  /// piece has fewer than two numbers, and everywhere if no piece has three.
  double position = 0.0, position_sigma = 0.0;
  double velocity = 0.0, velocity_sigma = 0.0;
  TrackFlag flag = TrackFlag::none;
  double chi2 = 0.0;  ///< of a flagged one: the square of its innovation over that one's variance; else NaN
};

struct SmoothedTrack {
  std::vector<SmoothedPoint> points;  ///< one for each
  double process_noise = 0.0;         ///< the likeliest q, in the square of the unit per s^3; 0: unknown
  int used = 0;                       ///< numbers that the track is of
  int outliers = 0, breaks = 0;
  double innovation_chi2 = 0.0;  ///< mean over the innovations of the filter; near 1 if errors are as stated
};

/// `points` in the order of time, each later than the one before. A frame jumps where the square of its
/// innovation over that one's variance is larger than what a share of `false_alarms` of sound frames exceeds
/// (chi-squared of one degree of freedom). It is asked twice: as the frame after those before it, and as the
/// one between all others; so up to twice the share is flagged of a track that is as above. Three in a row
/// that jump and agree with one another are a break. The same points give the same numbers.
SmoothedTrack smooth_track(const std::vector<TrackPoint>& points, double false_alarms);

/// The limit of that test.
double jump_limit(double false_alarms);

}  // namespace vegard::fit
