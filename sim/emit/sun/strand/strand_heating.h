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
// cooling_strand.h, and the light from several flares adds up. The light of line l at the time t is that of
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

}  // namespace vegard::sim
