// A plane incompressible flow that winds up a footprint.
//
// Source: the electrons of a sheet charge its place; across the magnetic field that charge drives the drift
// E × B, whose vorticity is proportional to the charge, so that a sheet is a vortex sheet and rolls up into
// curls (T. J. Hallinan and T. N. Davis, "Small-scale auroral arc distortions", Planet. Space Sci. 18, 1970);
// the field lines that carry its upward current are twisted around it, which winds the sheet up into spirals,
// in the other sense (T. J. Hallinan, "Auroral spirals 2", J. Geophys. Res. 81, 1976). Lawlor and Genetti
// 2011 feed their splines to a fluid solver in the same way. Here: Euler's equation of a plane in vorticity
// form,
//   dω/dt = 0 along the flow,  ∇²ψ = ω,  velocity = (-∂ψ/∂north, ∂ψ/∂east),
// ω being proportional to the energy flux (less its mean). Seen along B, down from above in the northern
// magnetic hemisphere, it turns counter-clockwise as spirals do, or clockwise as charged sheets do
// (flow_sense; docs/physics.md). The twist of field lines is not a flow: its law is the charge's with the
// other sign, which is ours. ψ is computed by Fourier transform on a periodic plane around the box, and
// interpolated between the cells by cubic convolution; the velocities are the derivatives of this interpolant
// (central differences at the cells), so the divergence is 0 everywhere. The code follows back along the flow
// the place where each point came from (the characteristic mapping of X.-Y. Yin, O. Mercier, B. Yadav, K.
// Schneider, J.-C. Nave, J. Comput. Phys. 424, 2021), so that the footprint is interpolated once and not at
// every step; as in that paper, this is done in successive short stretches of time, each of which deforms the
// plane only little.
#pragma once

#include <complex>
#include <cstdint>
#include <vector>

#include "sim/emit/footprint/map/flow_cubic.h"
#include "sim/emit/footprint/map/footprint_map.h"
#include "sim/scene/structs/footprint.h"

namespace vegard::sim {

/// Returns the number of turns of the flow's fastest part at an instant of the scene's clock: flow_turns plus
/// flow_turns_per_s times the instant, limited to 0 to 10.
double flow_turns_at(const Footprint& footprint, double instant_s);

/// Computes the flow of a footprint until its fastest part has made `turns` turns: a round patch of vorticity
/// ω turns once in 4π/ω. `stands_north` is true if the footprint is in the northern magnetic hemisphere;
/// `index` is the footprint's number in its scene. The charge has ripples: it is proportional to flux (1 +
/// flow_ripple noise), with noise on the scale of flow_scale_km.
PlaneFlow wind_up(const PlaneFootprint<double>& plane, const Footprint& footprint, double turns,
                  std::uint64_t seed, int index, bool stands_north, int threads);

/// Moves the footprint with the flow; each cell is the mean of four places in it. ln E is moved with the
/// flux. Flux that leaves the box is lost. T is double or FreeDual, whose derivatives are moved by the same
/// flow: they are correct for parameters on which the flow itself does not depend.
template <class T>
void carry(const PlaneFlow& flow, PlaneFootprint<T>& plane, int threads);

/// Returns the smallest even number of at least `least` whose only prime factors are 2, 3 and 5.
int transform_size(int least);

/// Transforms values, [row][column], in place; `backwards` gives the inverse transform, with its factor 1 /
/// (rows columns). The result does not depend on the number of threads.
void transform_plane(std::vector<std::complex<double>>& values, int columns, int rows, bool backwards,
                     int threads);

/// Returns the wave number of a transform's element i of n, in waves over the whole length: from -n/2 to n/2.
inline int wave_number(int i, int n) { return i <= n / 2 ? i : i - n; }

}  // namespace vegard::sim
