// The International Geomagnetic Reference Field, IGRF-14: the main field of the Earth by place and time.
//
// Source: data/field/igrf14.csv, which names its own source; the expansion and Schmidt's normalisation as in
// P. Alken et al., Earth Planets Space 73, 49, 2021, equations 1 and 2; recurrences of the associated
// Legendre functions of R. A. Langel in J. A. Jacobs (ed.), Geomagnetism 1, 1987. Geodetic coordinates are
// those of the ellipsoid WGS 84. The coefficients are given every five years and interpolated linearly.
#pragma once

#include <array>

#include "sim/scene/rows/parameter_rules.h"

namespace vegard::sim {

inline constexpr int kIgrfDegree = 13;

struct FieldVector {
  double north_nt = 0.0, east_nt = 0.0, down_nt = 0.0;
};

/// The field at a time.
class Igrf {
 public:
  /// `year`: decimal, from kFirstIgrfYear to kLastIgrfYear.
  explicit Igrf(double year);

  /// Returns the field at a geodetic place; north, east and down are those of the ellipsoid.
  FieldVector at(double latitude_deg, double longitude_deg, double altitude_km) const;

 private:
  /// Returns the field at a geocentric place; north, east and down are those of the sphere.
  FieldVector on_sphere(double sin_latitude, double cos_latitude, double longitude_rad,
                        double radius_km) const;

  struct Coefficient {
    double g = 0.0, h = 0.0;
  };
  std::array<std::array<Coefficient, kIgrfDegree + 1>, kIgrfDegree + 1> by_degree_{};  ///< [degree][order]
};

}  // namespace vegard::sim
