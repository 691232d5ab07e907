// Curls: small vortices that gather a layer's beams and wind them up.
//
// Source: Baranoski et al. 2000, section 2.2 and figure 6b (curls 2 to 10 km apart, living for 0.25 to 0.75
// s, electron beams evolving into rays) and section 3.1 (a beam represents a curl); row B9 of
// docs/physics.md. The map is ours. Beams are first gathered along the sheet about the curl's centre, x → x
// (1 - g exp(-x²/R²)), which keeps their order and puts them 1 - g of their spacing apart at the centre: a
// cluster of beams. Then they are turned about the centre by an angle that falls off as exp(-r²/R²): that
// preserves areas, as a flow without sources does. Sense as for folds, counter-clockwise seen against B.
//
// Spirals are the same map without gathering, larger and of the other sense, shared by all layers of an arc:
// they turn about a point of the arc's middle line. Source: T. J. Hallinan, J. Geophys. Res. 81, 3959 (1976):
// field lines twisted by an upward current, which winds a sheet up counter-clockwise seen along B
// (docs/physics.md has the derivation); all spirals that Viking saw are wound so (J. S. Murphree, L. L.
// Cogger, R. D. Elphinstone, IEEE Trans. Plasma Sci. 17, 109, 1989).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "sim/base/number/dual.h"
#include "sim/base/number/smooth_step.h"
#include "sim/emit/aurora/fold.h"
#include "sim/scene/structs/sheet.h"

namespace vegard::sim {

/// One curl at an instant.
struct Curl {
  double center_km = 0.0;  ///< along the sheet, as defined by StretchOfSheet
  double radius_km = 1.0;
  double gather = 0.0;
  double turn_rad = 0.0;

  /// Returns the place to which a beam at `along_km` is moved by gathering.
  double gathered(double along_km) const {
    const double x = along_km - center_km, q = x / radius_km;
    return center_km + x * (1.0 - gather * std::exp(-q * q));
  }
};

/// The curls of one layer at an instant, or the spirals of an arc.
class Curls {
 public:
  /// No curls.
  Curls() = default;
  Curls(const Sheet& sheet, std::uint32_t layer_address, std::uint64_t seed, double instant_s,
        double drifted_km);

  /// Returns the spirals that all layers of an arc share. Their turn_rad is negative where they wind
  /// counter-clockwise seen along B.
  static Curls spirals(const Sheet& sheet, std::uint32_t arc_address, std::uint64_t seed, double instant_s,
                       double drifted_km);

  bool any() const { return spacing_km_ > 0.0; }

  /// Calls see(curl) for every curl that reaches to a place along the sheet, from start to end.
  template <class See>
  void near(double along_km, const See& see) const {
    const double reach = kReach * radius_km_;
    const std::int64_t last = slot_at(along_km - moved_km_ + reach, spacing_km_);
    for (std::int64_t slot = slot_at(along_km - moved_km_ - reach, spacing_km_); slot <= last; ++slot) {
      const Curl curl = of_slot(slot);
      if (std::abs(along_km - curl.center_km) < reach) see(curl);
    }
  }

  /// Returns the factor on the turn of a beam laid out at this distance from a curl: 1 within five radii,
  /// decreasing to 0 at six. On an even sheet the turn is negligible there anyway, but a fold may bring such
  /// beams near the curl.
  static double hold(double from_center_km, double radius_km) {
    return smooth_step(kReach - std::abs(from_center_km) / radius_km);
  }

 private:
  static constexpr double kReach = 6.0;  // in radii

  Curl of_slot(std::int64_t slot) const;

  Stream stream_ = Stream::curl;
  std::uint64_t seed_ = 0;
  std::uint32_t address_ = 0;
  double spacing_km_ = 0.0, radius_km_ = 1.0, gather_ = 0.0, turn_rad_ = 0.0, lifetime_s_ = 0.0,
         instant_s_ = 0.0, moved_km_ = 0.0;
};

/// Turns the point (x, aside) about a curl's centre: clockwise in (x, aside), which seen from below is
/// counter-clockwise.
template <class T>
void turn_about(const T& center_x, const T& center_aside, double radius_km, double turn_rad, T& x, T& aside) {
  const T dx = x - center_x, dy = aside - center_aside;
  const T angle = exponential((dx * dx + dy * dy) * (-1.0 / (radius_km * radius_km))) * turn_rad;
  const T c = cosine(angle), s = sine(angle);
  x = center_x + dx * c + dy * s;
  aside = center_aside + dy * c - dx * s;
}

}  // namespace vegard::sim
