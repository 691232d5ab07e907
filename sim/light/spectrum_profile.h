// Height profiles of electrons by their spectrum. A Maxwellian is the thermal spectrum of the plasma
// (maxwellian_profile()). An electric field along the field lines accelerates electrons to one energy, or to
// a narrow range of energies; a plasma without enough collisions has a kappa distribution, with a tail of
// fast electrons.
#pragma once

#include <string>
#include <vector>

#include "sim/light/height_profile.h"

namespace vegard::sim {

/// Returns the profile of mono-energetic electrons (sim/light/tables/mono_table.h). `by`: log_energy or
/// oxygen_factor.
HeightProfile mono_profile(const EmissionSource& source, const std::vector<double>& wavelengths_nm,
                           double energy_kev, SlopeBy by = SlopeBy::log_energy);

/// Returns the profile of electrons whose number flux is a Gaussian, cut at 0:
///
///     phi(E) = exp(-(E - Ec)^2/(2 s^2)),  E > 0,     s = spread Ec,
///
/// so that their energy flux is proportional to E phi(E), which begins at 0 without a step. The integral over
/// E is a sum over fixed, evenly spaced values of tau, E = Ec exp(spread tau). So it is smooth in Ec and
/// spread; and since the integrand is flat at both ends, the trapezoidal rule converges fast. `spread`: above
/// 0, up to 1. `by`: all but energy_flux.
HeightProfile gaussian_profile(const EmissionSource& source, const std::vector<double>& wavelengths_nm,
                               double energy_kev, double spread, SlopeBy by = SlopeBy::log_energy);

/// The range of kappa for which profiles are made.
inline constexpr double kMinKappa = 2.5, kMaxKappa = 100.0;

/// Returns the profile of electrons whose number flux is that of an isotropic kappa distribution (Vasyliunas
/// 1968, doi:10.1029/JA073i009p02839; Pierrard and Lazar 2010, doi:10.1007/s11207-010-9640-2):
///
///     phi(E) = E (1 + E/(kappa E0))^(-kappa - 1),
///
/// which becomes the Maxwellian E exp(-E/E0) as kappa grows. It is a sum over even steps of ln(E) between the
/// ends of the table of mono-energetic electrons (MonoEnergeticTable::min_energy_kev()); what is beyond is
/// cut off, and the rest has all of the energy flux. At a kappa near 2.5 that is a good part of it: a share
/// of kappa (kappa - 1)/2 (E/(kappa E0))^(2 - kappa) is above E, far above kappa E0. The steps do not depend
/// on E0, so that the cut is in the derivative too. `kappa`: kMinKappa to kMaxKappa. `by`: log_energy,
/// oxygen_factor or a mode.
HeightProfile kappa_profile(const EmissionSource& source, const std::vector<double>& wavelengths_nm,
                            double energy_kev, double kappa, SlopeBy by = SlopeBy::log_energy);

/// One term of the sum for a spectrum: its energy, its share of the energy flux, and the derivatives of the
/// logarithms of both by ln(E0) or, if that is asked for, by the spread.
struct ElectronPiece {
  double energy_kev = 0.0;
  double share = 0.0;
  double d_log_energy = 0.0;
  double d_log_share = 0.0;
};
std::vector<ElectronPiece> gaussian_pieces(double energy_kev, double spread,
                                           SlopeBy by = SlopeBy::log_energy);
std::vector<ElectronPiece> kappa_pieces(const EmissionSource& source, double energy_kev, double kappa,
                                        SlopeBy by = SlopeBy::log_energy);

/// Returns the mean energy per electron of such a Gaussian: that of a normal distribution cut at 0, which is
/// Ec to 1e-5 up to a spread of 0.25, 2.8 % above it at 0.5 and 29 % at 1.
double gaussian_mean_energy_kev(double energy_kev, double spread);

/// The spectrum of electrons, but for its characteristic energy E0: the central energy of a Gaussian, the
/// energy of electrons of one.
struct ElectronSpectrum {
  enum class Kind { maxwellian, gaussian, mono, kappa };

  Kind kind = Kind::maxwellian;
  double spread = 0.25;  ///< of a Gaussian
  double kappa = 5.0;    ///< of a kappa distribution
};

/// Returns the profile of electrons of such a spectrum per mW m^-2. The energy flux counts for a Maxwellian
/// alone, for which there is a flux law (sim/light/tables/flux_law.h).
HeightProfile electron_profile(const EmissionSource& source, const std::vector<double>& wavelengths_nm,
                               const ElectronSpectrum& spectrum, double energy_kev,
                               double energy_flux_mw_m2 = 1.0);

/// Returns the mean energy per electron over E0: 2 of a Maxwellian, 2 kappa/(kappa - 2) of a kappa
/// distribution that is not cut off.
double mean_energy_over_e0(const ElectronSpectrum& spectrum);

/// Return the word for a kind, such as "kappa"; the kind of such a word, a Maxwellian for any other; and "a
/// Gaussian, spread 0.25" or the like.
const char* spectrum_word(ElectronSpectrum::Kind kind);
ElectronSpectrum::Kind spectrum_kind(const std::string& word);
std::string spectrum_in_words(const ElectronSpectrum& spectrum);

}  // namespace vegard::sim
