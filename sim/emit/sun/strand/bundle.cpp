#include "sim/emit/sun/strand/bundle.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/base/number/constants.h"
#include "sim/base/number/distributions.h"
#include "sim/base/number/random.h"
#include "sim/base/number/smooth_step.h"
#include "sim/base/number/vec3.h"
#include "sim/emit/sun/solar_rotation.h"
#include "sim/emit/sun/strand/macro_loop.h"
#include "sim/emit/sun/sun_frame.h"

namespace vegard::sim {
namespace {

constexpr std::uint32_t kMaxPlaces = 2000000;  ///< tried before there are fewer lines than asked for

double normal(std::uint32_t word) { return normal_quantile(uniform(word)); }

/// Chords of the exponential, straight from step to step, lie over it by (length / (32 falloff_length))²
/// / 12.
constexpr int kBundleSteps = 32;

enum class Which : std::uint32_t { line = 0, slope = 1, filament = 2 };

template <class T>
class BundleMaker {
 public:
  BundleMaker(const Sun& sun, const Bundle& bundle, std::uint64_t seed, const NumberAs<T>& number,
              double instant_s)
      : bundle_(bundle),
        turn_(sun, instant_s),
        number_(number),
        name_(name_number(bundle.name)),
        seed_(seed),
        position_noise_(number(bundle.position_noise_deg) * kRadiansPerDegree) {
    SunFrame<double>(sun, plain_number).observer(observer_.data());
    const double distance = length3(observer_);
    observer_ = times3(observer_, 1.0 / distance);
    limb_ = std::acos(std::min(sun.radius / distance, 1.0));
    radius_ = number(sun.radius);
  }

  struct Foot {
    Vec3<T> up;
    std::uint32_t number;  ///< of its place
  };

  /// The first `count` feet that stand.
  std::vector<Foot> feet(int count, Which which) const {
    std::vector<Foot> all;
    for (std::uint32_t i = 0; i < kMaxPlaces && static_cast<int>(all.size()) < count; ++i) {
      // Hardly any come after so many in vain.
      if (all.empty() && i > kMaxPlaces / 20) break;
      const Foot foot{place(i, which), i};
      if (stands(turned_by(turn_, values3(foot.up)))) all.push_back(foot);
    }
    return all;
  }

  void gather(std::vector<Foot>& feet) const {
    if (bundle_.filaments <= 0) return;
    const std::vector<Foot> places = this->feet(bundle_.filaments, Which::filament);
    if (places.empty()) return;
    const T pull = number_(bundle_.filament_pull);
    for (Foot& foot : feet) {
      const Foot* nearest = nullptr;
      double most = -2.0;
      for (const Foot& at : places) {
        const double cosine = dot3(values3(at.up), values3(foot.up));
        if (cosine <= most) continue;
        most = cosine;
        nearest = &at;
      }
      foot.up = unit3(along3(foot.up, pull, minus3(nearest->up, foot.up)));
    }
  }

  Strand<T> line(const Foot& foot) const {
    const Vec3<T> up = turned_by(turn_, foot.up);
    // West and north are of the foot as it stands: at the poles there are none, and any will do.
    Vec3<T> west = {T(0.0) - up[1], up[0], T(0.0)};
    west = value_of(dot3(west, west)) > 1e-12 ? unit3(west) : Vec3<T>{T(0.0), T(1.0), T(0.0)};
    const Vec3<T> north = cross3(up, west);
    const Vec3<T> equatorwards = times3(north, value_of(up[2]) > 0.0 ? -1.0 : 1.0);

    const Words words =
        random_words(seed_, Stream::bundle, foot.number, name_, static_cast<std::uint32_t>(Which::slope));
    const T noise = number_(bundle_.slope_noise_deg) * kRadiansPerDegree;
    const T down = number_(bundle_.gradient_deg) * kRadiansPerDegree + noise * normal(words[0]),
            aside = noise * normal(words[1]);
    Vec3<T> direction = times3(up, cosine(down) * cosine(aside));
    direction = along3(direction, sine(down) * cosine(aside), equatorwards);
    direction = along3(direction, sine(aside), west);

    const T length = number_(bundle_.length), foot_radius = number_(bundle_.foot_radius),
            top_radius = number_(bundle_.top_radius), falloff = number_(bundle_.falloff_length),
            spread = number_(bundle_.density_noise), fade = number_(bundle_.foot_fade);
    const T density =
        number_(bundle_.density) * exponential(spread * normal(words[2]) - spread * spread * 0.5);
    const T whole = length + foot_radius;
    Strand<T> strand;
    for (int i = 0; i < 4; ++i) {
      const T at = whole * (i / 3.0) - foot_radius;
      strand.points.push_back(along3(times3(up, radius_), at, direction));
    }
    strand.radius_first = foot_radius;
    strand.radius_last = top_radius;
    const T at_end = exponential(T(0.0) - length / falloff);
    for (int k = 0; k <= kBundleSteps; ++k) {
      const T at = whole * (static_cast<double>(k) / kBundleSteps) - foot_radius;
      const T share = value_of(fade) > 0.0 ? smooth_step(at / fade) : T(1.0);
      strand.along.push_back(density * (exponential(T(0.0) - at / falloff) - at_end) / (1.0 - at_end) *
                             share);
    }
    return strand;
  }

 private:
  Vec3<T> place(std::uint32_t i, Which which) const {
    constexpr double kRoot = 1.32471795724474602596;
    const double share = std::fmod((i + 1.0) / kRoot, 1.0);
    // Filaments are places of another sequence of the same kind.
    const double turn = std::fmod((i + 1.0) / (kRoot * kRoot) + (which == Which::filament ? 0.5 : 0.0), 1.0);
    const double low = std::sin(bundle_.lowest_latitude_deg * kRadiansPerDegree),
                 high = std::sin(bundle_.highest_latitude_deg * kRadiansPerDegree);
    const double latitude = std::asin(std::clamp(low + share * (high - low), -1.0, 1.0)) / kRadiansPerDegree;
    const SunPlace<double> at = sun_place(latitude, 360.0 * turn);
    const Words words = random_words(seed_, Stream::bundle, i, name_, static_cast<std::uint32_t>(which));
    const T north = position_noise_ * normal(words[0]), west = position_noise_ * normal(words[1]);
    Vec3<T> up;
    for (int axis = 0; axis < 3; ++axis)
      up[axis] = cosine(north) * cosine(west) * at.up[axis] + sine(north) * cosine(west) * at.north[axis] +
                 sine(west) * at.west[axis];
    return up;
  }

  bool stands(const Vec3<double>& up) const {
    if (bundle_.horizon_deg >= 90.0) return true;
    const double angle = std::acos(std::clamp(dot3(up, observer_), -1.0, 1.0));
    return std::abs(angle - limb_) <= bundle_.horizon_deg * kRadiansPerDegree;
  }

  const Bundle& bundle_;
  SolarTurn turn_;
  const NumberAs<T>& number_;
  std::uint32_t name_;
  std::uint64_t seed_;
  T position_noise_, radius_;
  Vec3<double> observer_;  ///< direction
  double limb_;
};

}  // namespace

template <class T>
Strands<T> strands_of(const Sun& sun, const Bundle& bundle, std::uint64_t seed, const NumberAs<T>& number,
                      double instant_s) {
  const BundleMaker<T> maker(sun, bundle, seed, number, instant_s);
  auto feet = maker.feet(bundle.count, Which::line);
  maker.gather(feet);
  Strands<T> strands;
  strands.falloff = bundle.density_falloff;
  for (const auto& foot : feet) strands.all.push_back(maker.line(foot));
  return strands;
}

template Strands<double> strands_of(const Sun&, const Bundle&, std::uint64_t, const NumberAs<double>&,
                                    double);
template Strands<FreeDual> strands_of(const Sun&, const Bundle&, std::uint64_t, const NumberAs<FreeDual>&,
                                      double);

}  // namespace vegard::sim
