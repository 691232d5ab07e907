// The frames of an animation: their names, their selection, and the scene of one.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/scene/structs/scene.h"

namespace vegard::apps {

/// A pattern for names, "frames/####.exr": the run of # stands for the frame's number, with leading zeros.
class FrameNames {
 public:
  /// Throws Error(usage) unless the file's name, without its folder, has exactly one run of #.
  explicit FrameNames(const std::string& pattern);

  /// The folder that the frames stand in; "." if the pattern names none.
  const std::string& folder() const { return folder_; }
  /// The pattern without its folder.
  std::string pattern() const { return before_ + std::string(digits_, '#') + after_; }

  std::string file(int frame) const;
  /// The number of a frame from its name without a folder; none if it is not a frame of this animation.
  std::optional<int> frame_of(const std::string& name) const;
  /// Throws Error(usage) if the number has more digits than there are #.
  void check_room_for(int frame) const;

  /// The name of a file for the whole animation, beside the frames: "frames/aurora_####.exr" gives
  /// "frames/aurora.animation.json", "frames/####.exr" gives "frames/animation.json".
  std::string companion(const std::string& kind) const;

 private:
  std::string folder_, before_, after_;
  int digits_ = 0;
};

/// "FIRST:LAST" or "FIRST:LAST:STEP", LAST included. Throws Error(usage).
std::vector<int> frames_from_words(const std::string& words);

/// The scene of frame n: time.start_s + n time.lapse / fps, in double precision, with all else unchanged.
/// Printed with enough digits to read the same number again, this time can be given to `vegard render --set
/// time.start_s`.
sim::Scene scene_of_frame(const sim::Scene& scene, int frame, double frames_per_second);

}  // namespace vegard::apps
