// Ion pairs that mono-energetic electrons and protons make on their way down.
//
// Source: Fang et al. 2010, Geophys. Res. Lett. 37, L22106, doi:10.1029/2010GL045406, equations (1) to (5)
// and table 1: electrons of 0.1 keV to 1 MeV that come isotropically out of the upper half-space,
//
//     q(z) = f(y) Q / (35 eV H),    y = (2 keV/E) (rho H / 6e-6 g cm^-2)^0.7,
//     f(y) = C1 y^C2 exp(-C3 y^C4) + C5 y^C6 exp(-C7 y^C8),    C_i = exp(sum over j of P_ij ln(E/keV)^j).
//
// The integral of f dz/H over all altitudes is 0.84 at 0.1 keV, 0.93 to 0.97 from 0.3 to 2 keV and 0.98
// to 1.02 from 2 to 300 keV: the paper's formula deviates so far from 35 eV per ion pair.
//
// Protons: Fang et al. 2013, J. Geophys. Res. 118, 5369, doi:10.1002/jgra.50484, equations (3) to (7), of the
// same energies and directions, with y = (7.5 keV/E) (rho H / 1e-4 g cm^-2)^0.9, three terms of f, and the
// same 35 eV. Protons really spend 22 eV (at 0.1 keV) to 33 eV (at 1 MeV) on an ion pair, so that the
// integral of f dz/H is 1.60 to 1.05.
#pragma once

namespace vegard::sim {

/// The logarithm of a rate, and its derivative by the logarithm of the electrons' energy.
struct LogRate {
  double value = 0.0;
  double slope = 0.0;
};

/// The properties of the air at an altitude that determine how it stops electrons.
struct StoppingAir {
  double mass_column_g_cm2 = 0.0;  ///< rho H
  double scale_height_cm = 0.0;    ///< H = kT/(m g)
};

/// Returns them for air of these densities, cm^-3, and this temperature. The mean mass is that of N2, O2 and
/// O; gravity falls with the square of the distance from the Earth's centre.
StoppingAir stopping_air(double altitude_km, double temperature_k, double n2_cm3, double o2_cm3,
                         double o_cm3);

/// Returns ln of the ion pairs cm^-3 s^-1 for an energy flux of 1 mW m^-2. Below 0.05 keV, where the paper's
/// polynomials would diverge, the coefficients C are those of 0.05 keV.
LogRate log_ionisation(const StoppingAir& air, double energy_kev);

/// Returns f(y) of the paper.
double energy_dissipation(double y, double energy_kev);

/// Return the same for protons. Below 0.1 keV the coefficients are those of 0.1 keV.
LogRate log_proton_ionisation(const StoppingAir& air, double energy_kev);
double proton_energy_dissipation(double y, double energy_kev);

}  // namespace vegard::sim
