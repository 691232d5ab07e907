// Uniform cubic B-splines in a stretched altitude: smooth curves that are dark at both ends.
#pragma once

namespace vegard::sim {

/// `count` basis functions between two altitudes, each a bump over four of count + 3 equal intervals of
/// z = ln(1 + (h - bottom) / kStretchKm). So they are narrow low down and wide high up, as layers of the
/// atmosphere are: with 36 from 80 to 500 km an interval is 1.6 km at the bottom, 4 km at 110 km and 19 km at
/// 280 km. Every basis function is positive, they sum to 1 but for the three intervals at either end, and
/// there everything falls smoothly to 0. Source: de Boor, "A Practical Guide to Splines", chapters IX and X.
class AltitudeSpline {
 public:
  static constexpr double kStretchKm = 20.0;

  /// bottom_km < top_km, count >= 1.
  AltitudeSpline(double bottom_km, double top_km, int count);

  int count() const { return count_; }
  double basis(int k, double altitude_km) const;
  /// The basis functions that are not 0 at an altitude, four or fewer: their values, and the first of them.
  struct Local {
    int first = 0, count = 0;
    double value[4];
  };
  Local at(double altitude_km) const;
  /// Where basis function k is largest, and its coefficient about the curve's value.
  double centre_km(int k) const;
  /// Integral over all altitudes, km.
  double integral_km(int k) const;

 private:
  double altitude_km(double interval) const;
  double bottom_km_, interval_;  // the latter of z
  int count_;
};

}  // namespace vegard::sim
