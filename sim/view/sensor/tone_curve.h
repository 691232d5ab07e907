// Conversion of linear light to the values of a display file and back, by the scene's sensor.tone or the
// curve that is given for a photograph.
//
// "srgb" is IEC 61966-2-1 (sim/view/sensor/transfer_curve.h), "gamma" a power, "file" a measured curve: a CSV
// with the columns linear, from 0 to 1, and encoded, within 0 to 1, both increasing; linear between its rows.
// "bent" is the family of curves BentSrgb of sim/view/sensor/transfer_curve.h.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/structs/scene.h"
#include "sim/view/sensor/transfer_curve.h"

namespace vegard::sim {

class ToneCurve {
 public:
  /// The curve of a valid scene. Throws Error(unreadable_input), with file and line, for an invalid table.
  explicit ToneCurve(const Scene& scene);

  /// Encoded values are linear light to the power of 1 / gamma; gamma must be above 0.
  static ToneCurve of_gamma(double gamma);
  /// A measured curve from the text of a table; messages name `file`. Throws as the constructor.
  static ToneCurve of_table(const std::string& text, const std::string& file);
  static ToneCurve of_bent(const BentSrgb& bent);

  /// Returns the encoded value of linear light, both 0 to 1; "file" clamps its input. An increasing function.
  double encode(double linear) const;

  /// The inverse of encode(). Values beyond the ends of a measured curve are clamped to the ends.
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
