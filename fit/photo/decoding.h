// The decoding of a photograph: how its numbers become linear light, by sRGB, linear, another curve or an
// unknown one.
#pragma once

#include <memory>
#include <string>

#include "sim/scene/structs/scene.h"
#include "sim/view/sensor/tone_curve.h"

namespace vegard::fit {

struct Decoding {
  /// "sensor": by the tone curve and the vignetting of a scene's sensor (sim/view/sensor/sensor.h).
  /// "unknown": taken as sRGB until a fit has found better (fit/measure/unknown_curve.h).
  enum class Kind { automatic, srgb, linear, curve, sensor, unknown };
  Kind kind = Kind::automatic;
  std::shared_ptr<const sim::ToneCurve> curve;  ///< of the kind curve
  std::string words;                            ///< of that curve, for whoever reads the results
  int unknowns = 0;                             ///< of the kind unknown: numbers to find, 1 or 2

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

/// Of a word of sim/scene/rows/decoding_word.h. A curve's table is the scene's own where the word is that of
/// `scene` (its fit.decoding), else a file in the folder `beside`; empty: where the program runs. Throws
/// sim::Error(usage) for what is no such word, and (unreadable_input) for a table that is none.
Decoding decoding_of_word(const std::string& word, const sim::Scene* scene = nullptr,
                          const std::string& beside = {});

}  // namespace vegard::fit
