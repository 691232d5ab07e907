#include <algorithm>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/scene/emitters/element_rules.h"
#include "tests/emitter/glow_ball/glow_ball.h"

namespace vegard::tests {
namespace {

template <class Value>
sim::Row<GlowBall> row(const char* key, Value GlowBall::*value) {
  return sim::Row(key, glow_balls(), value);
}

std::vector<sim::Declaration> rows() {
  using B = GlowBall;
  using sim::ParameterScale;
  // clang-format off
  return {
      row("name", &B::name).means("by which paths call the ball"),
      row("place_km", &B::place_km).of({"east", "north", "up"}).in("km").within(-5000, 5000).may_be_free(ParameterScale::linear).means("of its middle at time 0"),
      row("width_km", &B::width_km).called("girth").in("km").within(1e-3, 1000).may_be_free(ParameterScale::logarithmic).means("standard deviation of its light in space"),
      row("rayleigh", &B::rayleigh).by_line().in("R").within(0, 1e12).may_be_free(ParameterScale::linear).means("light through its middle, per emission line"),
      row("rise_km_s", &B::rise_km_s).in("km/s").within(-10, 10).may_be_free(ParameterScale::linear).means("of its middle, upwards")
          .inert_if([](const B&, const sim::Scene& scene) { return scene.time.start_s == 0.0; }, "the clock stands at 0", "set time.start_s"),
  };
  // clang-format on
}

void check(const sim::Scene& scene) {
  for (const GlowBall& ball : glow_balls().in(scene))
    sim::ElementCheck(scene, "glow_ball." + ball.name).check_lines(ball.rayleigh, false, "rayleigh");
}

bool any_moves(const sim::Scene& scene) {
  const std::vector<GlowBall>& balls = glow_balls().in(scene);
  return std::any_of(balls.begin(), balls.end(), [](const GlowBall& ball) { return ball.rise_km_s != 0.0; });
}

std::vector<sim::LightLocation> light_locations(const sim::Scene& scene) {
  std::vector<sim::LightLocation> all;
  for (const GlowBall& ball : glow_balls().in(scene)) {
    const auto& [east, north, up] = ball.place_km;
    all.push_back({sim::LightLocation::Known::direction,
                   "glowing ball '" + ball.name + "'",
                   {},
                   std::atan2(east, north) / sim::kRadiansPerDegree,
                   std::atan2(up, std::hypot(east, north)) / sim::kRadiansPerDegree});
  }
  return all;
}

}  // namespace

sim::EmitterKind glow_ball_kind() {
  sim::EmitterKind kind;
  kind.table = glow_balls().table();
  kind.repeated = {sim::repeated_table_of(glow_balls())};
  kind.rows = rows;
  kind.check = check;
  kind.moves = any_moves;
  kind.light_locations = light_locations;
  kind.spoken = "glowing ball";
  kind.place_in_preview = 0;
  return kind;
}

}  // namespace vegard::tests
