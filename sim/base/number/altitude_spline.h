// Uniform cubic B-splines in a stretched altitude: smooth curves that are 0 at both ends.
#pragma once

namespace vegard::sim {

/// `count` basis functions between two altitudes, each over four of count + 3 equal intervals of z = ln(1 +
/// (h - bottom) / kStretchKm). They are narrow at low and wide at high altitudes, like layers of the
/// atmosphere: with 36 from 80 to 500 km an interval is 1.6 km at the bottom, 4 km at 110 km and 19 km at 280
/// km. The basis functions are positive. Their sum is 1, except in the three intervals at either end, in
/// which it falls smoothly to 0. Source: de Boor, "A Practical Guide to Splines", chapters IX and X.
class AltitudeSpline {
 public:
  static constexpr double kStretchKm = 20.0;

  /// bottom_km < top_km, count >= 1.
  AltitudeSpline(double bottom_km, double top_km, int count);

  int count() const { return count_; }
  double basis(int k, double altitude_km) const;
  /// The basis functions that are not 0 at an altitude, at most four: the index of the first, and their
  /// values.
  struct Local {
    int first = 0, count = 0;
    double value[4];
  };
  Local at(double altitude_km) const;
  /// Returns the altitude of the maximum of basis function k; its coefficient is about the curve's value
  /// there.
  double centre_km(int k) const;
  /// Returns the integral of basis function k over all altitudes in km.
  double integral_km(int k) const;

 private:
  double altitude_km(double interval) const;
  double bottom_km_, interval_;  // interval_ is in z
  int count_;
};

}  // namespace vegard::sim
