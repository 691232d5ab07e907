// From linear light to the numbers of a display file and back: the scene's sensor.tone, or whatever curve a
// photograph is said to have.
//
// "srgb" is IEC 61966-2-1 (sim/view/sensor/transfer_curve.h), "gamma" a power, "file" a measured curve: a CSV
// with the columns linear, from 0 to 1, and encoded, within 0 to 1, both increasing; straight between its
// rows. A bent one is of the family of sim/view/sensor/transfer_curve.h.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/structs/scene.h"
#include "sim/view/sensor/transfer_curve.h"

namespace vegard::sim {

class ToneCurve {
 public:
  /// Of a valid scene. Throws Error(unreadable_input), with file and line, for a measured curve that is none.
  explicit ToneCurve(const Scene& scene);

  /// Numbers are linear light to the power of 1 / gamma, which must be above 0.
  static ToneCurve of_gamma(double gamma);
  /// A measured curve from a table's text; messages name `file`. Throws as above.
  static ToneCurve of_table(const std::string& text, const std::string& file);
  static ToneCurve of_bent(const BentSrgb& bent);

  /// Encoded value of linear light; both are 0 to 1, and "file" limits its input to that. Increasing.
  double encode(double linear) const;

  /// Its inverse. What lies beside a measured curve's ends is taken for the ends.
  double decode(double encoded) const;

  /// "sRGB", "linear", "gamma 2.2", "my_camera.csv", "sRGB^1.3", "sRGB^1.3 to 0.8".
  const std::string& name() const { return name_; }

 private:
  ToneCurve() = default;
  void be_gamma(double gamma);
  void be_table(const std::string& text, const std::string& file);

  enum class Kind { srgb, linear, gamma, file, bent } kind_ = Kind::linear;
  double gamma_ = 1.0;
  BentSrgb bent_;
  std::vector<double> linear_, encoded_;
  std::string name_;
};

}  // namespace vegard::sim
