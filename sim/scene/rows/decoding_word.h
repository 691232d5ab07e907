// The values of fit.decoding and --decoding: how the numbers of a photograph become linear light.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "sim/scene/rows/complaint.h"

namespace vegard::sim {

inline constexpr std::string_view kCurveWord = "curve:";

/// A parsed value: "auto" (sRGB for integers, linear for floats), "srgb", "srgb:1.3" and "srgb:1.3:0.8" (sRGB
/// with one exponent, or with exponents at black and at white: sim/view/sensor/tone_curve.h), "linear",
/// "gamma:2.2", "curve:FILE.csv" (columns linear and encoded, as in sensor.tone_file), "sensor", "unknown"
/// and "unknown:2" (sRGB with one or two exponents that are fitted together with the scene).
struct DecodingWord {
  enum class Kind { automatic, srgb, bent, linear, gamma, curve, sensor, unknown } kind = Kind::automatic;
  double gamma = 1.0;               ///< exponent of `gamma`
  double black = 1.0, white = 1.0;  ///< exponents of `bent`
  std::string file;                 ///< of `curve`
  int unknowns = 0;                 ///< number of exponents of `unknown`: 1 or 2
};

/// Returns a complaint about an invalid text, or nothing.
std::optional<Complaint> decoding_complaint(const std::string& text);

/// Parses a text that has no complaint.
DecodingWord decoding_word(const std::string& text);

}  // namespace vegard::sim
