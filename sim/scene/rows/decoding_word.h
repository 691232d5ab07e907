// The words for how a photograph's numbers become linear light: fit.decoding, --decoding.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "sim/scene/rows/complaint.h"

namespace vegard::sim {

inline constexpr std::string_view kCurveWord = "curve:";

/// "auto" (sRGB for integers, linear for floats), "srgb", "srgb:1.3" and "srgb:1.3:0.8"
/// (sim/view/sensor/transfer_curve.h: exponents over sRGB's light, of all or of black and of white),
/// "linear", "gamma:2.2", "curve:FILE.csv" (columns linear and encoded, as sensor.tone_file), "sensor",
/// "unknown" and "unknown:2" (a curve of that family with one or two numbers, found together with the scene).
struct DecodingWord {
  enum class Kind { automatic, srgb, bent, linear, gamma, curve, sensor, unknown } kind = Kind::automatic;
  double gamma = 1.0;               ///< of gamma
  double black = 1.0, white = 1.0;  ///< of bent
  std::string file;                 ///< of curve
  int unknowns = 0;                 ///< of unknown: 1 or 2
};

/// What is wrong with a text that is none of them; nothing of a sound one.
std::optional<Complaint> decoding_complaint(const std::string& text);

/// Of a text without a complaint.
DecodingWord decoding_word(const std::string& text);

}  // namespace vegard::sim
