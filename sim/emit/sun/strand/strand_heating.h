// Flares that heat the strands of a loop at random: loops that brighten and fade one after the other.
//
// The source has loops brighter here and there "based on a random sequence of macroflare heating", after F.
// Reale (1998, Mem. S. A. It. 69, 669). Here flares come to each strand by itself, as a Poisson process with
// the mean interval heating_interval_s (E. N. Parker's nanoflares, 1988, ApJ 330, 474): the time is cut into
// cells of one interval, in each of which their number is Poisson's of mean 1 and their times are even. That
// is a pure function of seed, name of the loop, strand and cell, for all times, before 0 too.
//
// A strand of a scene stands for many thin ones: every flare heats some of them, which cool as
// cooling_strand.h has it, and what several flares have heated adds up. The light of line l at the time t is
// that of the steady strand times
//   sum over the flares i before t of interval n²(t - t_i) R_l(T(t - t_i)) / integral of n² over a life,
// R_l the line's response to temperature (solar_lines.h; 1 of a line without). By N. Campbell's theorem
// (1909) its mean over a long time is the integral of n² R_l over a life over that of n²: of R_l = 1 it is 1,
// so that the mean emission measure is that of the scene's density.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/emit/sun/strand/strand.h"
#include "sim/light/emitter.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// When flares heat strand number `strand` of a loop: all in the cells of the scene's clock that have a part
/// between the two times, in order of the cells.
std::vector<double> flare_times_s(const Loop& loop, std::uint64_t seed, int strand, double from_s,
                                  double to_s);

/// Sets the strands' factors per line (Strand::line_gain): means over instants of the scene's clock. The
/// strands are those of the loop, all in their order. The half length is that of each strand.
template <class T>
void heat_strands(const Scene& scene, const Loop& loop, const std::vector<double>& instants_s,
                  const NumberAs<T>& number, Strands<T>& strands);

extern template void heat_strands(const Scene&, const Loop&, const std::vector<double>&,
                                  const NumberAs<double>&, Strands<double>&);
extern template void heat_strands(const Scene&, const Loop&, const std::vector<double>&,
                                  const NumberAs<FreeDual>&, Strands<FreeDual>&);

}  // namespace vegard::sim
