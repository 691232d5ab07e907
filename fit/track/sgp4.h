// Where a satellite is, by its two-line elements: SGP4 for orbits near the Earth.
//
// Source: F. R. Hoots and R. L. Roehrich, "Models for propagation of NORAD element sets", Spacetrack Report
// 3, 1980, with the corrections of D. A. Vallado, P. Crawford, R. Hujsak and T. S. Kelso, "Revisiting
// Spacetrack Report 3", AIAA 2006-6753, and its constants of WGS 72. Orbits with a period of 225 minutes or
// more (navigation, geostationary), for which the Sun and the Moon matter, are refused.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace vegard::fit {

/// Elements as they are in the two lines. Angles in degrees.
struct OrbitalElements {
  std::string satellite;  ///< its number
  double epoch_s = 0.0;   ///< seconds since 1970 in UTC
  double drag = 0.0;      ///< B*, per Earth radius
  double inclination_deg = 0.0, node_deg = 0.0, perigee_deg = 0.0, anomaly_deg = 0.0;
  double eccentricity = 0.0, turns_per_day = 0.0;
};

/// Reads the elements of a file: pairs of lines that begin with 1 and 2, names between them. Throws
/// sim::Error(unreadable_input), with the line, for a checksum that does not fit, a field that is no number,
/// a pair that is not one, or a file without elements.
std::vector<OrbitalElements> read_orbital_elements(const std::string& text, const std::string& name);

/// Place and velocity in the true equator and mean equinox of the instant, km and km/s.
struct OrbitState {
  std::array<double, 3> km{}, km_s{};
};

class Sgp4 {
 public:
  /// Throws sim::Error(unreadable_input) for an orbit that is none or of 225 minutes or more.
  Sgp4(const OrbitalElements& elements, const std::string& name);

  /// `minutes` since the epoch. Throws sim::Error(unreadable_input) where the satellite has come down, or the
  /// elements lead to no ellipse.
  OrbitState at(double minutes) const;

 private:
  std::string name_;
  // Radians, radians per minute and Earth radii, as in the report.
  double drag_, inclination_, node_, perigee_, anomaly_, eccentricity_, motion_;
  bool is_low_ = false;  ///< its perigee is below 220 km: drag to the first powers of time
  double axis_ = 1.0, eta_ = 0.0;
  double by_cosine_ = 0.0, by_sine_square_ = 0.0, by_seven_cosine_ = 0.0;
  double c1_ = 0.0, c4_ = 0.0, c5_ = 0.0, d2_ = 0.0, d3_ = 0.0, d4_ = 0.0;
  double anomaly_rate_ = 0.0, perigee_rate_ = 0.0, node_rate_ = 0.0, node_drag_ = 0.0;
  double perigee_drag_ = 0.0, anomaly_drag_ = 0.0, anomaly_cube_ = 0.0, anomaly_sine_ = 0.0;
  double t2_ = 0.0, t3_ = 0.0, t4_ = 0.0, t5_ = 0.0;
  double long_longitude_ = 0.0, long_y_ = 0.0;
};

}  // namespace vegard::fit
