// What electrons make of the ionosphere: ions and thermal electrons, conductivities and deposited energy by
// altitude.
//
// Ion pairs are those of the emission tables (the column ionisation_electron), so that light and ionosphere
// have the same electrons. Of the pairs the gases get shares that go by 0.92 N2, O2 and 0.56 O (M. H. Rees,
// "Physics and Chemistry of the Upper Atmosphere", Cambridge 1989, chapter 3); the states of O+ by the
// coefficients of fractional parentage of three 2p electrons, 1/3 4S, 5/12 2D, 1/4 2P, over their thresholds.
// An ion pair takes 35 eV (the same chapter). Ions follow by sim/light/chemistry/ion_balance.h.
//
// In another air than the tables' the electrons lose the same energy per mass at the same mass above:
// q(z)/rho(z) is a function of the mass column alone, as in Fang et al. 2010 (sim/light/tables/ionisation.h).
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "sim/light/ionosphere/conductivity.h"
#include "sim/light/spectrum_profile.h"
#include "sim/light/tables/emission_tables.h"
#include "sim/light/transport/field_air.h"

namespace vegard::sim {

inline constexpr double kEvPerIonPair = 35.0;

/// The air of the places of an ionosphere, from the bottom up, with the strength of the magnetic field.
struct IonosphereAir {
  std::vector<ReactingAir> places;
  std::vector<StoppingAir> stopping;
  std::vector<double> field_nt;
};

/// Where and when, for the magnetic field of IGRF-14.
struct FieldPlace {
  double latitude_deg = 65.0, longitude_deg = 212.0, year = 2014.0;
};

/// Returns the air of a table at these altitudes; what the table lacks is as field_air() has it.
IonosphereAir ionosphere_air(const AirTable& table, const std::vector<double>& altitudes_km,
                             const FieldPlace& place);

/// Returns the ion pairs, cm^-3 s^-1, of electrons at the tables' altitudes in the tables' own air, 0 where
/// the tables do not know them (less than 1.5e-6 of the most, which is taken off). `energy_kev`: inside the
/// tables' range.
std::vector<double> ion_pairs(const EmissionTables& tables, const ElectronSpectrum& spectrum,
                              double energy_kev, double energy_flux_mw_m2, double oxygen_factor = 1.0);

/// Returns the ion pairs of the same electrons in another air at the same altitudes (see above).
std::vector<double> moved_ion_pairs(const std::vector<double>& pairs, const IonosphereAir& from,
                                    const IonosphereAir& to);

/// The numbers of physics that an ionosphere follows.
struct IonospherePhysics {
  Reactions reactions = Reactions::standard();
  double seconds = std::numeric_limits<double>::infinity();  ///< since the electrons have begun to fall
  double night = 1.0;                                        ///< factor on the ions that a night has before
  CollisionFactors collisions = {};
  std::array<double, kGases> ionisation = {1.0, 1.0, 1.0};  ///< factors on the ion pairs of each gas
};

/// Returns the ions that these pairs make at a place.
IonProduction ion_production(double pairs_cm3_s, const ReactingAir& air, const IonospherePhysics& physics);

/// Electrons of the night before are assumed: fewer than so many times them tell nothing of the aurora's.
inline constexpr double kAboveNight = 3.0;

/// By altitude, and integrated. Densities in cm^-3, conductivities in S m^-1, conductances in S.
struct Ionosphere {
  std::vector<double> altitude_km, pairs_cm3_s;
  std::vector<IonDensities> ions;
  std::vector<Conductivity> conductivity;
  double pedersen_s = 0.0, hall_s = 0.0;  ///< integrated over altitude
  /// Largest density of electrons, where it is kAboveNight times the night's; 0, with a height of NaN, if
  /// there is none.
  double peak_cm3 = 0.0, peak_km = 0.0;

  /// Energy that the electrons leave, W m^-3, and over all altitudes, mW m^-2. Light and chemistry carry a
  /// part of it away; the rest heats the air.
  double deposited_w_m3(std::size_t place) const;
  double deposited_mw_m2() const;
};

Ionosphere ionosphere(const IonosphereAir& air, const std::vector<double>& pairs_cm3_s,
                      const IonospherePhysics& physics);

/// The largest of densities, by a parabola through the logarithms of three.
struct DensityPeak {
  double ln = 0.0, altitude_km = 0.0;
};
/// `ln`: logarithms of densities at increasing altitudes.
DensityPeak density_peak(const std::vector<double>& altitude_km, const std::vector<double>& ln);

/// Returns the integral over altitude, per metre times metres, by trapezoids.
double height_integral(const std::vector<double>& altitude_km, const std::vector<double>& per_m);

}  // namespace vegard::sim
