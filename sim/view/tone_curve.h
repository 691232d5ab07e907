// From linear light to the numbers of a display file and back: the scene's sensor.tone.
//
// "srgb" is IEC 61966-2-1 (sim/view/transfer_curve.h), "gamma" a power, "file" a measured curve: a CSV with
// the columns linear, from 0 to 1, and encoded, within 0 to 1, both increasing; straight between its rows.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/scene.h"

namespace vegard::sim {

class ToneCurve {
 public:
  /// Of a valid scene. Throws Error(unreadable_input), with file and line, for a measured curve that is none.
  explicit ToneCurve(const Scene& scene);

  /// Encoded value of linear light; both are 0 to 1, and "file" limits its input to that. Increasing.
  double encode(double linear) const;

  /// Its inverse. What lies beside a measured curve's ends is taken for the ends.
  double decode(double encoded) const;

  /// "sRGB", "linear", "gamma 2.2", "my_camera.csv".
  const std::string& name() const { return name_; }

 private:
  enum class Kind { srgb, linear, gamma, file } kind_;
  double gamma_ = 1.0;
  std::vector<double> linear_, encoded_;
  std::string name_;
};

}  // namespace vegard::sim
