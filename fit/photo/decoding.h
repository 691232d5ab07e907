// The decoding of a photograph: how its numbers are converted to linear light: as sRGB, as linear light, by
// another transfer curve, or by an unknown curve that the fit finds.
#pragma once

#include <memory>
#include <string>

#include "sim/scene/structs/scene.h"
#include "sim/view/sensor/tone_curve.h"

namespace vegard::fit {

struct Decoding {
  /// automatic: by the file's format, see read_photo().
  /// sensor: by the tone curve and the vignetting of a scene's sensor (sim/view/sensor/sensor.h).
  /// unknown: as sRGB at first; a fit then finds the curve (fit/measure/unknown_transfer_curve.h).
  enum class Kind { automatic, srgb, linear, curve, sensor, unknown };
  Kind kind = Kind::automatic;
  std::shared_ptr<const sim::ToneCurve> curve;  ///< for the kind curve
  std::string words;                            ///< for the kind curve: its description for reports
  int unknowns = 0;                             ///< for the kind unknown: numbers to find, 1 or 2

  static const Decoding automatic, srgb, linear, sensor, unknown;

  friend bool operator==(const Decoding& a, const Decoding& b) {
    return a.kind == b.kind && a.curve == b.curve && a.unknowns == b.unknowns;
  }
  friend bool operator!=(const Decoding& a, const Decoding& b) { return !(a == b); }
};

inline const Decoding Decoding::automatic{Decoding::Kind::automatic, {}, {}, 0};
inline const Decoding Decoding::srgb{Decoding::Kind::srgb, {}, {}, 0};
inline const Decoding Decoding::linear{Decoding::Kind::linear, {}, {}, 0};
inline const Decoding Decoding::sensor{Decoding::Kind::sensor, {}, {}, 0};
inline const Decoding Decoding::unknown{Decoding::Kind::unknown, {}, {}, 1};

/// Returns the decoding that a word of sim/scene/rows/decoding_word.h names. If the word is that of
/// scene.fit.decoding, a curve's table is relative to the scene's file; otherwise it is relative to the
/// folder `beside` (empty: the working directory). Throws sim::Error(usage) for an unknown word, and
/// (unreadable_input) for a table that cannot be read.
Decoding decoding_of_word(const std::string& word, const sim::Scene* scene = nullptr,
                          const std::string& beside = {});

}  // namespace vegard::fit
