// Whether a camera stood still from one frame to the next, by the stars of both.
//
// The points of light of the earlier frame are turned with the sky about the celestial pole, by 360.9856
// degrees a day, and put where the camera would show them in the later one. If it stood still, they meet
// points there within kStillPx, in numbers that a shifted picture does not have. If it was moved, another
// turn brings them there: each pair of points of the one frame and each pair of the other that are equally
// far apart give a turn (the triad method: Black 1964, doi:10.2514/3.2555), and that with the most agreement
// is improved by least squares (Kabsch 1976, doi:10.1107/S0567739476001873). It counts if chance would give
// so many in less than one search of 10^8, and at least twice as many agree with it as with a camera that
// stood still and as have stayed at their pixels. Lamps and hot pixels are left out once the sky has moved on
// by 2 kStillPx; before, they look like the stars of a camera that stood still.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/photo/pointing/star_finder.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit {

/// The points of light in a frame, the brightest first (find_stars()).
struct FramePoints {
  std::string name;
  double time_s = 0.0;
  std::vector<FoundStar> points;
};

struct CameraMove {
  double angle_deg = 0.0;  ///< of the turn from the old to the new orientation
  int stars = 0;           ///< that agree with it
};

/// What the points of two frames say.
struct StarsOfTwoFrames {
  int expected = 0;        ///< points of the earlier frame that the later should show
  int still = 0;           ///< those found, if the camera stood still
  double by_chance = 0.0;  ///< those found in a shifted picture
  bool stood_still = false;
  std::optional<CameraMove> move;
  /// The stars' median brightness in the later frame over that in the earlier, and its standard error; NaN
  /// unless the camera stood still.
  double brightness = 0.0, brightness_error = 0.0;
};

/// Compares two frames of a camera at a latitude, the earlier first.
StarsOfTwoFrames stars_of_two_frames(const sim::Camera& camera, double latitude_deg,
                                     const FramePoints& before, const FramePoints& after);

/// Watches a camera through its frames.
class CameraWatch {
 public:
  struct OtherBrightness {
    std::string name, as_in;  ///< of the frame, and of that with which it was compared
    double brightness = 0.0;  ///< of its stars, over that in the other
  };
  /// A turn of the camera that errors of the times, the site or the camera, or drifting clouds, may explain.
  struct Drift {
    std::string from, to;  ///< names of frames
    double angle_deg = 0.0;
  };

  CameraWatch(const sim::Camera& camera, double latitude_deg)
      : camera_(camera), latitude_deg_(latitude_deg) {}

  /// The next frame, compared with the last and the earliest of the ten minutes before. Throws
  /// sim::Error(unreadable_input) about the frame before it if in that the camera was turned, by more than a
  /// sky that turns otherwise than was thought explains, and if this frame is turned as much: clouds move on.
  void add(FramePoints frame);

  int frames() const { return frames_; }
  /// Frames in which the stars are where they are in an earlier frame if the camera stood still.
  int told() const { return told_; }
  /// Changes of the stars' brightness to more than 1.25 or less than 0.8, beyond five errors.
  const std::vector<OtherBrightness>& other_brightness() const { return other_; }
  const std::optional<Drift>& drift() const { return drift_; }  ///< the largest
  /// Sentences: "By the stars the camera stood still in 9 of the 10 frames; of the others it is not known.",
  /// "The stars of B.png are 0.52 times as bright as in A.png: ..."; none for fewer than two frames.
  std::vector<std::string> words() const;

 private:
  /// A frame in which the camera seems to have been turned.
  struct Suspect {
    FramePoints before;  ///< the frame before it
    std::string name;
    double time_s = 0.0;
    int still = 0;
    CameraMove move;
  };

  void confirm(const FramePoints& frame);
  void note_brightness(const FramePoints& earlier, const FramePoints& frame, const StarsOfTwoFrames& said);
  void note_drift(const FramePoints& earlier, const FramePoints& frame, const CameraMove& move);

  sim::Camera camera_;
  double latitude_deg_;
  std::optional<FramePoints> last_, first_;  ///< of the ten minutes before; first_ agrees with another
  int frames_ = 0, told_ = 0;
  std::vector<OtherBrightness> other_;
  std::optional<Drift> drift_;
  std::optional<Suspect> suspect_;
};

}  // namespace vegard::fit
