// A kind of emitter that the product does not have: a ball of haze that glows, Gaussian in all directions,
// and rises. Whatever a kind needs stands in this folder, and nothing elsewhere knows of it.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "sim/light/emitter.h"
#include "sim/render/emitters/emitter_makers.h"
#include "sim/scene/emitters/emitter_kinds.h"
#include "sim/scene/rows/row.h"

namespace vegard::tests {

/// The table [[glow_ball]].
struct GlowBall {
  std::string name = "ball";
  std::array<double, 3> place_km{0.0, 100.0, 40.0};  ///< of its middle at time 0: east, north, up
  double width_km = 5.0;                             ///< standard deviation
  std::vector<double> rayleigh;                      ///< per line, through the middle
  double rise_km_s = 0.0;
};

/// Its place in a scene.
inline const sim::AddedElements<GlowBall>& glow_balls() {
  static const sim::AddedElements<GlowBall> balls("glow_ball");
  return balls;
}

/// The two halves of its row.
sim::EmitterKind glow_ball_kind();
sim::EmitterMaker glow_ball_maker();

}  // namespace vegard::tests
