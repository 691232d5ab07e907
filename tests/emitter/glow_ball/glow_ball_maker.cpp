#include <algorithm>
#include <cmath>
#include <memory>

#include "tests/emitter/glow_ball/glow_ball.h"

namespace vegard::tests {
namespace {

constexpr double kPi = 3.14159265358979323846, kReach = 6.0;  // standard deviations

/// A ball as it is at the time of a scene.
template <class T>
struct BallNow {
  T middle[3], width;
  std::vector<T> rayleigh;

  BallNow(const sim::Scene& scene, const GlowBall& ball, const sim::NumberAs<T>& number)
      : width(number(ball.width_km)) {
    for (int axis = 0; axis < 3; ++axis) middle[axis] = number(ball.place_km[axis]);
    middle[2] = middle[2] + number(ball.rise_km_s) * scene.time.start_s;
    for (const double& light : ball.rayleigh) rayleigh.push_back(number(light));
  }
};

template <class T>
class GlowBallEmitter : public sim::Emitter<T> {
 public:
  explicit GlowBallEmitter(BallNow<T> ball) : ball_(std::move(ball)) {}

  /// The integral along a line is that through the middle, times a Gaussian of its distance from it.
  void march(const sim::RayBundle<T>& rays, const sim::BundleLight<T>& out) const override {
    using sim::value_of;
    for (std::size_t i = 0; i < rays.count; ++i) {
      T along(0.0), square(0.0);
      for (int axis = 0; axis < 3; ++axis) {
        along = along + ball_.middle[axis] * rays.direction[axis][i];
        square = square + ball_.middle[axis] * ball_.middle[axis];
      }
      const double reach = kReach * value_of(ball_.width);
      if (value_of(along) < 0.0 || value_of(along) > rays.end_km[i]) continue;
      const T aside = square - along * along;
      if (value_of(aside) > reach * reach) continue;
      const T share = sim::exponential(T(0.0) - aside / (ball_.width * ball_.width * 2.0));
      for (int l = 0; l < out.lines; ++l)
        out.rayleigh[static_cast<std::size_t>(l) * rays.count + i] =
            share * ball_.rayleigh[static_cast<std::size_t>(l)];
      out.entry_km[i] = std::max(0.0, value_of(along) - reach);
      out.depth_km[i] = value_of(along);
    }
  }

 private:
  BallNow<T> ball_;
};

class GlowBallField : public sim::LightField {
 public:
  GlowBallField(const sim::Scene& scene, const GlowBall& ball)
      : ball_(scene, ball, [](const double& number) { return number; }) {}

  sim::Box3 bounds() const override {
    sim::Box3 box;
    for (int axis = 0; axis < 3; ++axis) {
      box.low[axis] = ball_.middle[axis] - kReach * ball_.width;
      box.high[axis] = ball_.middle[axis] + kReach * ball_.width;
    }
    return box;
  }

  bool is_dark(const sim::Box3& box) const override {
    double square = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double nearest = std::clamp(ball_.middle[axis], box.low[axis], box.high[axis]);
      square += (nearest - ball_.middle[axis]) * (nearest - ball_.middle[axis]);
    }
    return square > kReach * ball_.width * kReach * ball_.width;
  }

  void sample(std::size_t count, const double* const point[3], float* const emission[],
              float* density) const override {
    const double column = sim::kRayleighsPerKm * ball_.width * std::sqrt(2.0 * kPi);
    for (std::size_t i = 0; i < count; ++i) {
      double square = 0.0;
      for (int axis = 0; axis < 3; ++axis) {
        const double off = point[axis][i] - ball_.middle[axis];
        square += off * off;
      }
      const double share = std::exp(-0.5 * square / (ball_.width * ball_.width)) / column;
      for (std::size_t l = 0; l < ball_.rayleigh.size(); ++l)
        emission[l][i] = static_cast<float>(ball_.rayleigh[l] * share);
      density[i] = 0.0f;
    }
  }

 private:
  BallNow<double> ball_;
};

template <class T>
void add_balls(const sim::EmitterInputs<T>& in, sim::Emitters<T>& all) {
  for (const GlowBall& ball : glow_balls().in(in.scene))
    all.push_back(std::make_unique<GlowBallEmitter<T>>(BallNow<T>(in.scene, ball, in.number)));
}

void add_ball_fields(const sim::FieldInputs& in, std::vector<sim::NamedField>& all) {
  for (const GlowBall& ball : glow_balls().in(in.scene))
    all.push_back({"glow_ball '" + ball.name + "'", std::make_unique<GlowBallField>(in.scene, ball),
                   sim::FieldFrame::ground});
}

sim::ThinPart thinnest_ball(const sim::Scene& scene) {
  sim::ThinPart thinnest;
  for (const GlowBall& ball : glow_balls().in(scene))
    if (ball.width_km < thinnest.radius) thinnest = {"glow_ball '" + ball.name + "'", ball.width_km};
  return thinnest;
}

/// The row: what a program that links the library does before anything else.
[[maybe_unused]] const bool kAdded = [] {
  sim::add_emitter(glow_ball_kind(), glow_ball_maker());
  return true;
}();

}  // namespace

sim::EmitterMaker glow_ball_maker() {
  return {"glow_ball", add_balls<double>, add_balls<sim::FreeDual>, add_ball_fields, nullptr, thinnest_ball};
}

}  // namespace vegard::tests
