#include "sim/emit/sun/strand/flux_rope.h"

#include <algorithm>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/base/number/gauss_quadrature.h"
#include "sim/base/number/vec3.h"
#include "sim/emit/sun/solar_rotation.h"
#include "sim/emit/sun/sun_frame.h"

namespace vegard::sim {
namespace {

constexpr double kFootShare = 0.3;  ///< radius at the feet, of that at the top at age 0
constexpr double kBulge = 0.6;      ///< of the angle, once the arch is much higher than wide
/// Pieces of a winding, rounded down. The odd share keeps the steps off round numbers of turns, which scenes
/// have.
constexpr double kPiecesPerTurn = 12.0, kMinPieces = 16.37;

template <class T>
struct RopePoint {
  Vec3<T> place;
  T radius;  ///< of a strand
};

/// The rope as it is while its front is at one height.
template <class T>
class Rope {
 public:
  Rope(const Sun& sun, const Ejection& ejection, const T& longitude_deg, const T& front,
       const NumberAs<T>& number)
      : sun_radius_(number(sun.radius)),
        half_angle_(number(ejection.width_deg) * (0.5 * kRadiansPerDegree)),
        turns_(number(ejection.turns)),
        strand_share_(number(ejection.strand_radius)) {
    const SunPlace<T> place = sun_place(number(ejection.latitude_deg), longitude_deg);
    const T bearing = number(ejection.bearing_deg) * kRadiansPerDegree;
    for (int i = 0; i < 3; ++i) {
      up_[i] = place.up[i];
      forth_[i] = place.north[i] * cosine(bearing) + place.west[i] * sine(bearing);
    }
    across_ = cross3(forth_, up_);
    const T aspect = number(ejection.aspect);
    top_radius_ = aspect * front;
    foot_radius_ = aspect * number(ejection.start_height) * kFootShare;
    height_ = front - top_radius_;
    bulge_ = height_ * kBulge / (height_ + sun_radius_ * half_angle_);
  }

  /// Returns the point at the parameter e of a strand at (share of the disc's radius, phase).
  RopePoint<T> at(double e, double share, double phase) const {
    const double c = std::cos(e), s = std::sin(e);
    const T distance = sun_radius_ - foot_radius_ + (height_ + foot_radius_) * c,
            angle = half_angle_ * s * (bulge_ * c + 1.0);
    const Vec3<T> outward = along3(times3(up_, cosine(angle)), sine(angle), forth_),
                  onward = along3(times3(forth_, cosine(angle)), T(0.0) - sine(angle), up_);
    // The axis' own direction is (d distance / d e) outward + distance (d angle / d e) onward; at right
    // angles to it in its plane is `side`.
    const T rise = T(0.0) - (height_ + foot_radius_) * s,
            pass = distance * half_angle_ * (bulge_ * std::cos(2.0 * e) + c);
    const Vec3<T> side = unit3(along3(times3(outward, pass), T(0.0) - rise, onward));
    const T disc = foot_radius_ + (top_radius_ - foot_radius_) * c;
    const T turned = turns_ * (2.0 * kPi * (e / kPi + 0.5)) + phase;
    Vec3<T> place = times3(outward, distance);
    place = along3(place, disc * share * cosine(turned), side);
    place = along3(place, disc * share * sine(turned), across_);
    return {place, disc * strand_share_};
  }

 private:
  T sun_radius_, half_angle_, turns_, strand_share_, top_radius_, foot_radius_, height_, bulge_;
  Vec3<T> up_, forth_, across_;
};

constexpr double kKmPerM = 1e-3;

/// All pieces, without density.
template <class T>
std::vector<Strand<T>> pieces_of(const Rope<T>& rope, int strands, int pieces) {
  const double golden = kPi * (3.0 - std::sqrt(5.0));
  std::vector<Strand<T>> all;
  for (int k = 0; k < strands; ++k) {
    std::vector<RopePoint<T>> points;
    for (int j = 0; j <= pieces; ++j)
      points.push_back(
          rope.at(kPi * (static_cast<double>(j) / pieces - 0.5), std::sqrt((k + 0.5) / strands), golden * k));
    // Through all points, with the direction of the chord of a point's neighbours (Catmull and Rom 1974).
    const auto third = [&](int j) {
      const int before = std::max(j - 1, 0), after = std::min(j + 1, pieces);
      return times3(minus3(points[after].place, points[before].place), 1.0 / (3.0 * (after - before)));
    };
    for (int j = 0; j < pieces; ++j) {
      Strand<T> strand;
      strand.points = {points[j].place, along3(points[j].place, 1.0, third(j)),
                       along3(points[j + 1].place, -1.0, third(j + 1)), points[j + 1].place};
      strand.radius_first = points[j].radius;
      strand.radius_last = points[j + 1].radius;
      all.push_back(std::move(strand));
    }
  }
  return all;
}

/// Sum of ∫ radius² dl.
template <class T>
T volume(const std::vector<Strand<T>>& all) {
  static const GaussLegendre<3> nodes;  // of |dB / du|
  T sum(0.0);
  for (const Strand<T>& strand : all)
    for (int n = 0; n < 3; ++n) {
      const double u = nodes.place[n], v = 1.0 - u;
      Vec3<T> speed = times3(minus3(strand.points[1], strand.points[0]), 3.0 * v * v);
      speed = along3(speed, 6.0 * u * v, minus3(strand.points[2], strand.points[1]));
      speed = along3(speed, 3.0 * u * u, minus3(strand.points[3], strand.points[2]));
      const T radius = strand.radius_first * v + strand.radius_last * u;
      sum = sum + length3(speed) * radius * radius * nodes.weight[n];
    }
  return sum;
}

}  // namespace

template <class T>
T front_height(const Sun& sun, double instant_s, const Ejection& ejection, const NumberAs<T>& number) {
  const T start = number(ejection.start_height);
  T age = number(ejection.age_s) + T(instant_s);
  if (!(value_of(age) > 0.0)) return start;
  const T speed = number(ejection.speed_km_s), acceleration = number(ejection.acceleration_m_s2) * kKmPerM;
  // Slowed down, it comes to rest.
  if (value_of(acceleration) < 0.0 && value_of(speed + acceleration * age) < 0.0)
    age = T(0.0) - speed / acceleration;
  return start + (speed + acceleration * age * 0.5) * age * (1.0 / sun.unit_km);
}

template <class T>
T ejection_longitude_deg(const Sun& sun, double instant_s, const Ejection& ejection,
                         const NumberAs<T>& number) {
  const T longitude = number(ejection.longitude_deg);
  const SolarTurn turn(sun, instant_s);
  if (!turn.turns()) return longitude;
  const T north = sine(number(ejection.latitude_deg) * kRadiansPerDegree);
  return longitude + turn.angle_rad(north * north) * (1.0 / kRadiansPerDegree);
}

template <class T>
Strands<T> rope_strands(const Sun& sun, double instant_s, const Ejection& ejection,
                        const NumberAs<T>& number) {
  const int pieces = static_cast<int>(kMinPieces + kPiecesPerTurn * std::abs(ejection.turns));
  const T longitude_deg = ejection_longitude_deg(sun, instant_s, ejection, number);
  const auto rope = [&](const T& front) {
    return pieces_of(Rope<T>(sun, ejection, longitude_deg, front, number), ejection.strands, pieces);
  };
  Strands<T> strands;
  strands.falloff = RadialFalloff::smooth;
  strands.all = rope(front_height(sun, instant_s, ejection, number));
  const T density =
      number(ejection.density) * (volume(rope(number(ejection.start_height))) / volume(strands.all));
  for (Strand<T>& strand : strands.all) strand.along = {density, density};
  return strands;
}

template double front_height(const Sun&, double, const Ejection&, const NumberAs<double>&);
template FreeDual front_height(const Sun&, double, const Ejection&, const NumberAs<FreeDual>&);
template double ejection_longitude_deg(const Sun&, double, const Ejection&, const NumberAs<double>&);
template FreeDual ejection_longitude_deg(const Sun&, double, const Ejection&, const NumberAs<FreeDual>&);
template Strands<double> rope_strands(const Sun&, double, const Ejection&, const NumberAs<double>&);
template Strands<FreeDual> rope_strands(const Sun&, double, const Ejection&, const NumberAs<FreeDual>&);

}  // namespace vegard::sim
