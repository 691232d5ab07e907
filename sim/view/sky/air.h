// What light loses on its way through the lower atmosphere: exp(-sum of vertical optical depth x airmass)
// over molecules, aerosol and ozone, each with its own airmass on a round Earth.
//
// Light comes from above the air, along a straight line: there is no refraction, and what is scattered into
// the line of sight is left out. An observer above 80 km, where the aurora begins, looks at it without any
// air between.
//
// Sources: docs/optics.md, "Air and sky".
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "sim/base/number/constants.h"
#include "sim/base/number/dual.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Vertical optical depth of the molecules above sea level (1013.25 hPa, 45 deg): Bodhaine et al. 1999,
/// doi:10.1175/1520-0426(1999)016<1854:ORODC>2.0.CO;2, equation (30).
double rayleigh_optical_depth(double wavelength_nm);

/// Vertical optical depth of ozone, with the cross-sections of Serdyuchenko et al. 2014 at 233 K
/// (doi:10.5194/amt-7-625-2014), means over 10 nm; 1 DU is 2.687e16 molecules cm^-2.
double ozone_optical_depth(double wavelength_nm, double ozone_dobson);

/// Pressure at an altitude over that at sea level: U.S. Standard Atmosphere 1976, its troposphere below 11 km
/// and its constant temperature at 11 km carried on above.
double pressure_share(double altitude_km);

/// Sine of the elevation of a body's horizon: below 0 for an observer above the ground.
double sine_of_horizon(double observer_altitude_km, double sphere_km = kEarthRadiusKm);

/// How a component's density goes with altitude, up to a factor.
struct AirShape {
  double centre_km = 0.0;  ///< of a Gaussian layer
  double width_km = 7.0;   ///< scale height, or the Gaussian's standard deviation
  bool gaussian = false;
};

/// The components as they are here. Molecules: exponential with 7.0 km, with which straight lines have the
/// airmass of Kasten and Young 1989 (doi:10.1364/AO.28.004735: standard atmosphere, bent rays) within 1.2 %
/// at every elevation; ozone: a Gaussian layer at 22 km, 5 km wide (ours; Robinson's shell of 1966 is at
/// 22 km too).
AirShape molecules_shape();
AirShape aerosol_shape(const LowerAir& air);
AirShape ozone_shape();

/// The column along a line of sight, by the sine of its elevation: the integral along a straight line of
/// density over density at the observer's altitude, in units of `unit_km`. By Gauss-Legendre quadrature at
/// knots, between which the logarithm is a cubic through values and slopes (good to 1e-6 of the column).
class AirColumn {
 public:
  AirColumn(const AirShape& shape, double observer_altitude_km, double unit_km);

  /// T is double or a dual number over it. Below the observer's horizon the horizon's own value.
  template <class T>
  T at(const T& sine_of_elevation) const {
    const double sine = value_of(sine_of_elevation);
    if (sine <= lowest_sine_) return T(std::exp(log_column_.front()));
    const double place = std::sqrt((sine - lowest_sine_) / (1.0 - lowest_sine_)) * intervals();
    const int i = std::min(static_cast<int>(place), intervals() - 1);
    const double step = sine_at(i + 1) - sine_at(i);
    const T t = (sine_of_elevation - sine_at(i)) * (1.0 / step);  // as a dual number divides
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

  double lowest_sine_ = 0.0;                // of the horizon, which lies lower for who stands higher
  std::vector<double> log_column_, slope_;  // by the sine, at the knots
};

/// Airmasses towards one direction, times the share of the vertical column that is above the observer.
template <class T>
struct Airmasses {
  T molecules, aerosol, ozone;
};

/// The air over a scene's observer.
class AirAbove {
 public:
  explicit AirAbove(const Scene& scene);

  /// Whether nothing is lost.
  bool none() const { return none_; }

  /// Not to be asked where none().
  template <class T>
  Airmasses<T> towards(const T& sine_of_elevation) const {
    return {molecules_->at(sine_of_elevation) * molecules_above_,
            aerosol_->at(sine_of_elevation) * aerosol_above_, ozone_->at(sine_of_elevation)};
  }

 private:
  bool none_;
  double molecules_above_ = 0.0, aerosol_above_ = 0.0;
  std::optional<AirColumn> molecules_, aerosol_, ozone_;  // where there is air
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

/// The share of light of a wavelength that arrives from an elevation above the air.
double air_transmission(const Scene& scene, double wavelength_nm, double elevation_deg);

}  // namespace vegard::sim
