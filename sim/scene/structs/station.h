// A sheet as it stands in the frame of another observer.
//
// Sheets are given in the tangent plane of a scene's site: feet at 110 km altitude by their east and north. A
// photograph taken elsewhere needs the same sheet in its own plane. The foot of the centre is carried over on
// the body's sphere (latitudes taken as those of the sphere), exactly; bearing, length, wavelength
// and drift follow from the directions of the sheet there. A line that is straight in one plane is a slightly
// bent one in another: at a distance t from the centre it lies aside by b t^2 / (2 R (R + 110 km)), b the
// part of the way between the sites across the line: 0.01 km at 100 km, 0.05 km at 200 km, for 100 km between
// the sites. The points of a curve are carried over one by one, exactly; its drift is that at their mean.
#pragma once

#include <array>

#include "sim/base/number/constants.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

class Station {
 public:
  /// The numbers of a sheet that depend on the observer: centre (east, north), bearing, length, wavelength,
  /// drift (east, north).
  static constexpr int kNumbers = 7;
  static std::array<double*, kNumbers> numbers(Sheet& sheet);

  /// The same place.
  Station() = default;
  /// From the frame of `home` into that of `there`, on a sphere of this radius.
  Station(const Site& home, const Site& there, double sphere_km = kEarthRadiusKm);

  bool is_elsewhere() const { return elsewhere_; }

  /// Turns a sheet of home's frame into one of the other's. The centre, or all points of its curve, must be
  /// closer than the sphere's radius.
  void carry(Sheet& sheet) const;

  /// East and north of a foot of home's frame, there; and the derivatives of both by east and north at home,
  /// row-major [there][home].
  EastNorth carry(EastNorth foot_km) const;
  std::array<double, 4> slopes(EastNorth foot_km) const;

  /// The drift there of a sheet whose course is a curve, and its derivatives by the mean east and north of
  /// its points at home, row-major.
  EastNorth drift_of_curve(const Sheet& at_home) const;
  std::array<double, 4> drift_slopes(const Sheet& at_home) const;

  /// d number there / d number at home, row-major [there][home], of a sheet in home's frame
  /// whose course is a sine.
  std::array<double, kNumbers * kNumbers> slopes(const Sheet& at_home) const;

 private:
  bool elsewhere_ = false;
  double foot_radius_km_ = kEarthRadiusKm + kFootAltitudeKm;
  double turn_[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};  ///< east, north, up from home's
};

}  // namespace vegard::sim
