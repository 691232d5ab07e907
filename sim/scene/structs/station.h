// Transforms a sheet into the frame of another observer.
//
// Sheets are given in the tangent plane of a scene's site: east and north of their feet at 110 km altitude. A
// photograph taken elsewhere needs the same sheet in the plane of its own site. The foot of the centre is
// transformed exactly on the body's sphere (latitudes are taken as spherical); bearing, length, wavelength
// and drift follow from the directions of the sheet at that foot. A straight line of one plane is slightly
// curved in another, which is neglected: at a distance t from the centre it is off by b t^2 / (2 R (R + 110
// km)), where b is the component of the distance between the sites across the line. For sites 100 km apart
// that is 0.01 km at t = 100 km and 0.05 km at 200 km. The points of a curve are transformed one by one,
// exactly; its drift is transformed at their mean.
#pragma once

#include <array>

#include "sim/base/number/constants.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

class Station {
 public:
  /// Returns the numbers of a sheet that depend on the observer: centre (east, north), bearing, length,
  /// wavelength, drift (east, north).
  static constexpr int kNumbers = 7;
  static std::array<double*, kNumbers> numbers(Sheet& sheet);

  /// No transformation: both sites are the same.
  Station() = default;
  /// Transforms from the frame of `home` into the frame of `there`, on a sphere of this radius.
  Station(const Site& home, const Site& there, double sphere_km = kEarthRadiusKm);

  bool is_elsewhere() const { return elsewhere_; }

  /// Transforms a sheet from the frame of `home` to the other. Its centre, or all points of its curve, must
  /// be nearer to the origin than the sphere's radius.
  void carry(Sheet& sheet) const;

  /// Return a foot of home's frame in the other frame, and its derivatives by east and north at home,
  /// row-major [there][home].
  EastNorth carry(EastNorth foot_km) const;
  std::array<double, 4> slopes(EastNorth foot_km) const;

  /// Return the drift, in the other frame, of a sheet whose course is a curve, and its derivatives by the
  /// mean east and north of the points at home, row-major.
  EastNorth drift_of_curve(const Sheet& at_home) const;
  std::array<double, 4> drift_slopes(const Sheet& at_home) const;

  /// Returns the derivatives of numbers() in the other frame by those at home, row-major [there][home], for a
  /// sheet in home's frame whose course is a sine.
  std::array<double, kNumbers * kNumbers> slopes(const Sheet& at_home) const;

 private:
  bool elsewhere_ = false;
  double foot_radius_km_ = kEarthRadiusKm + kFootAltitudeKm;
  double turn_[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};  ///< axes of home to axes there
};

}  // namespace vegard::sim
