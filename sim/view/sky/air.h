// Transmission of the lower atmosphere: exp(-sum of vertical optical depth x airmass) over molecules, aerosol
// and ozone, each with its own airmass on a spherical Earth.
//
// Light comes from above the air, along a straight line: there is no refraction and no scattering into the
// line of sight. For an observer above 80 km, where the aurora begins, nothing is lost.
//
// Sources: docs/optics.md, "Air and sky".
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "sim/base/number/constants.h"
#include "sim/base/number/dual.h"
#include "sim/scene/structs/sky.h"

namespace vegard::sim {

struct Scene;

/// Vertical optical depth of the molecules above sea level (1013.25 hPa, 45 deg): Bodhaine et al. 1999,
/// doi:10.1175/1520-0426(1999)016<1854:ORODC>2.0.CO;2, equation (30).
double rayleigh_optical_depth(double wavelength_nm);

/// Vertical optical depth of ozone, with the cross-sections of Serdyuchenko et al. 2014 at 233 K
/// (doi:10.5194/amt-7-625-2014), means over 10 nm; 1 DU is 2.687e16 molecules cm^-2.
double ozone_optical_depth(double wavelength_nm, double ozone_dobson);

/// Returns the pressure at an altitude over that at sea level: U.S. Standard Atmosphere 1976, its troposphere
/// below 11 km and a constant temperature, that of 11 km, above.
double pressure_share(double altitude_km);

/// Returns the sine of the elevation of a body's horizon, negative for an observer above the ground.
double sine_of_horizon(double observer_altitude_km, double sphere_km = kEarthRadiusKm);

/// The density of a component as a function of altitude, except for a factor.
struct AirShape {
  double centre_km = 0.0;  ///< of a Gaussian layer
  double width_km = 7.0;   ///< scale height, or the Gaussian's standard deviation
  bool gaussian = false;
};

/// The shapes of the components. Molecules: exponential with 7.0 km, with which straight lines have the
/// airmass of Kasten and Young 1989 (doi:10.1364/AO.28.004735: standard atmosphere, bent rays) within 1.2 %
/// at every elevation; ozone: a Gaussian layer at 22 km, 5 km wide (ours; Robinson's shell of 1966 is at
/// 22 km too).
AirShape molecules_shape();
AirShape ozone_shape();

/// The column along a line of sight as a function of the sine of its elevation: the integral, along a
/// straight line, of density over density at the observer's altitude, in units of `unit_km`. Computed by
/// Gauss-Legendre quadrature at knots; between the knots the logarithm is a cubic through values and slopes,
/// with a relative error of 1e-6.
class AirColumn {
 public:
  AirColumn(const AirShape& shape, double observer_altitude_km, double unit_km);

  /// Returns the column; below the observer's horizon that of the horizon. T is double or a dual number over
  /// it.
  template <class T>
  T at(const T& sine_of_elevation) const {
    const double sine = value_of(sine_of_elevation);
    if (sine <= lowest_sine_) return T(std::exp(log_column_.front()));
    const double place = std::sqrt((sine - lowest_sine_) / (1.0 - lowest_sine_)) * intervals();
    const int i = std::min(static_cast<int>(place), intervals() - 1);
    const double step = sine_at(i + 1) - sine_at(i);
    const T t = (sine_of_elevation - sine_at(i)) * (1.0 / step);  // division of dual numbers
    const double y0 = log_column_[i], y1 = log_column_[i + 1];
    const double m0 = step * slope_[i], m1 = step * slope_[i + 1];
    const double c2 = 3.0 * (y1 - y0) - 2.0 * m0 - m1, c3 = 2.0 * (y0 - y1) + m0 + m1;
    return exponential(((t * c3 + c2) * t + m0) * t + y0);
  }

 private:
  int intervals() const { return static_cast<int>(log_column_.size()) - 1; }
  double sine_at(int knot) const {
    const double share = static_cast<double>(knot) / intervals();
    return lowest_sine_ + (1.0 - lowest_sine_) * share * share;
  }

  double lowest_sine_ = 0.0;                // of the observer's horizon
  std::vector<double> log_column_, slope_;  // at the knots; slope by the sine
};

/// Airmasses in one direction, times the fraction of the vertical column that is above the observer.
template <class T>
struct Airmasses {
  T molecules, aerosol, ozone;
};

/// The air above a scene's observer.
class AirAbove {
 public:
  explicit AirAbove(const Scene& scene);

  /// True if there is no extinction.
  bool none() const { return none_; }

  /// Returns the airmasses of a direction. Requires !none().
  template <class T>
  Airmasses<T> towards(const T& sine_of_elevation) const {
    return {molecules_->at(sine_of_elevation) * molecules_above_,
            aerosol_->at(sine_of_elevation) * aerosol_above_, ozone_->at(sine_of_elevation)};
  }

 private:
  bool none_;
  double molecules_above_ = 0.0, aerosol_above_ = 0.0;
  std::optional<AirColumn> molecules_, aerosol_, ozone_;  // set if there is air
};

/// A wavelength's vertical optical depths from sea level. T is double or a dual number over it.
template <class T>
struct LineDepths {
  double molecules, ozone;
  T aerosol;  ///< Angstrom 1929: depth at 550 nm x (wavelength / 550 nm)^-exponent

  LineDepths(double wavelength_nm, const T& aerosol_depth_550, const T& angstrom_exponent,
             double ozone_dobson)
      : molecules(rayleigh_optical_depth(wavelength_nm)),
        ozone(ozone_optical_depth(wavelength_nm, ozone_dobson)),
        aerosol(aerosol_depth_550 * exponential(angstrom_exponent * -std::log(wavelength_nm / 550.0))) {}

  T transmission(const Airmasses<T>& through) const {
    return exponential(-(through.molecules * molecules + through.aerosol * aerosol + through.ozone * ozone));
  }
};

/// Returns the transmission of the air at a wavelength for light from an elevation.
double air_transmission(const Scene& scene, double wavelength_nm, double elevation_deg);

}  // namespace vegard::sim
