// Random heating of a loop's strands by flares, which makes loops brighten and fade one after the other.
//
// The source has loops brighter here and there "based on a random sequence of macroflare heating", after F.
// Reale (1998, Mem. S. A. It. 69, 669). Here each strand has its own flares, a Poisson process with the mean
// interval heating_interval_s (E. N. Parker's nanoflares, 1988, ApJ 330, 474): time is divided into cells of
// one mean interval, in each of which their number has a Poisson distribution of mean 1 and their times are
// uniform. The flares are a pure function of seed, name of the loop, strand and cell, for all times, also
// before 0.
//
// A strand of a scene represents many thin ones: every flare heats some of them, which cool according to
// CoolingStrand, and the light from several flares adds up. The light of line l at the time t is that of
// the steady strand times
//   sum over the flares i before t of interval n²(t - t_i) R_l(T(t - t_i)) / integral of n² over a life,
// with R_l the line's response to temperature (solar_lines.h; 1 for a line without one). By N. Campbell's
// theorem (1909) its mean over a long time is the integral of n² R_l over a life divided by that of n². For
// R_l = 1 it is 1, so the mean emission measure is that of the scene's density.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/emit/sun/strand/strand.h"
#include "sim/light/emitter.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Returns the times of the flares of strand number `strand` of a loop: all in the cells of the scene's clock
/// that overlap the range between the two times, in order of the cells.
std::vector<double> flare_times_s(const Loop& loop, std::uint64_t seed, int strand, double from_s,
                                  double to_s);

/// Sets the strands' factors per line (Strand::line_gain): means over instants of the scene's clock. The
/// strands are all those of the loop, in their order. Each strand cools with its own half length.
template <class T>
void heat_strands(const Scene& scene, const Loop& loop, const std::vector<double>& instants_s,
                  const NumberAs<T>& number, Strands<T>& strands);

extern template void heat_strands(const Scene&, const Loop&, const std::vector<double>&,
                                  const NumberAs<double>&, Strands<double>&);
extern template void heat_strands(const Scene&, const Loop&, const std::vector<double>&,
                                  const NumberAs<FreeDual>&, Strands<FreeDual>&);

// The cooling of a strand after impulsive heating by a flare: first by conduction, then by radiation.
//
// After P. J. Cargill (1994, ApJ 422, 381) and Cargill, Mariska and Antiochos (1995, ApJ 439, 1034), with the
// constants of Cargill (2014, ApJ 784, 49): Spitzer's conductivity kappa0 T^(5/2), kappa0 = 1e-6, and
// radiation chi n² T^(-1/2), chi = 6e-20, in erg, cm, s and K (both as in synthesizAR's copy of equation A2).
// chi is uncertain by a factor of 2 to 3: the losses that EBTEL takes (Klimchuk, Patsourakos and Cargill
// 2008, ApJ 682, 1351) are 3.2, 2.0 and 2.9 times as large at 1, 3 and 10 MK, with which radiation cools
// faster by these factors. For a strand of the half length L with n0 electrons per cm^3, heated to T0,
//   tau_c = 3 k n0 L² / (kappa0 T0^(5/2)),   tau_r = 3 k T0^(3/2) / (chi n0).
// Conduction takes the heat down to the chromosphere, which evaporates into the strand at constant pressure
// (S. K. Antiochos and P. A. Sturrock 1978, ApJ 220, 1137):
//   T = T0 (1 + t / tau_c)^(-2/7),   n = n0 (1 + t / tau_c)^(2/7),
// until radiation is as fast as conduction, which is, with q = tau_r / tau_c (above 1), at
//   t' = tau_c (q^(7/12) - 1),   T' = T0 q^(-1/6),   n' = n0 q^(1/6),   tau' = 3 k T'^(3/2) / (chi n').
// Then it radiates and drains, n as T^(1/2) (S. Serio et al. 1991, A&A 241, 197):
//   T = T' (1 - 3/2 (t - t') / tau')^(2/3),   n = n' (T / T')^(1/2),
// and is cold after t' + 2/3 tau', which is Cargill's (2014, equation A2) total of 5/3 tau' less tau_c. If q
// is below 1, it cools by radiation from the beginning.

template <class T>
class CoolingStrand {
 public:
  /// Temperature in K, electrons per cm^3, and the half length in cm, all above 0.
  CoolingStrand(const T& temperature_k, const T& density_cm3, const T& half_length_cm);

  struct State {
    T temperature_k, density_cm3;
  };
  /// Returns the state at a time after the flare, from 0 to below lifetime_s().
  State at(const T& since_s) const;

  const T& lifetime_s() const { return lifetime_s_; }  ///< time until it is cold
  const T& conduction_s() const { return until_s_; }   ///< t'
  /// Returns the integral of the squared density over its life, cm^-6 s: the emission measure per cm^3,
  /// integrated over time.
  const T& square_density_s() const { return square_density_s_; }

 private:
  T hot_k_, hot_cm3_, tau_c_, until_s_, cooler_k_, denser_cm3_, tau_r_, lifetime_s_, square_density_s_;
};

extern template class CoolingStrand<double>;
extern template class CoolingStrand<FreeDual>;

}  // namespace vegard::sim
