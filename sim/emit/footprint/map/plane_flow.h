// A plane incompressible flow that winds a footprint up.
//
// Source: the electrons of a sheet charge its place; across the magnetic field that charge drives the drift
// E × B, whose vorticity is proportional to the charge, so that a sheet is a vortex sheet and rolls up into
// curls (T. J. Hallinan and T. N. Davis, "Small-scale auroral arc distortions", Planet. Space Sci. 18, 1970);
// the field lines that carry its upward current are twisted about it, which winds the sheet up into spirals,
// the other way round (T. J. Hallinan, "Auroral spirals 2", J. Geophys. Res. 81, 1976). Lawlor and Genetti
// 2011 feed their splines to a fluid solver in the same way. Here: Euler's equation of a plane in vorticity
// form,
//   dω/dt = 0 along the flow,  ∇²ψ = ω,  velocity = (-∂ψ/∂north, ∂ψ/∂east),
// ω being proportional to the energy flux (less its mean). Seen along B, down from above in the northern
// magnetic hemisphere, it turns counter-clockwise as spirals do, or clockwise as charged sheets do
// (flow_sense; docs/physics.md). The twist of field lines is not a flow: its law is the charge's with the
// other sign, which is ours. ψ by Fourier transform on a
// periodic plane around the box, between its cells by cubic convolution; the velocities are that function's
// own derivatives, central differences on the cells, so that there is no divergence anywhere. What is
// followed back along the flow is the place where each point came from (the characteristic mapping of X.-Y.
// Yin, O. Mercier, B. Yadav, K. Schneider, J.-C. Nave, J. Comput. Phys. 424, 2021), so that the footprint is
// interpolated once and not at every step; as there, in short stretches of time one after the other, each of
// which bends the plane but little.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/emit/footprint/map/footprint_map.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Where everything came from over a stretch of time: [row][column], what is added to a cell's place, in
/// cells.
struct FlowStretch {
  std::vector<double> columns, rows;
};

/// The flow's grid, periodic, and its stretches in the order of time.
struct PlaneFlow {
  int columns = 0, rows = 0;  ///< 0: nothing has moved
  double west_km = 0.0, south_km = 0.0, cell_km = 1.0;
  std::vector<FlowStretch> stretches;
  /// [row][column], at the end, in the flow's own units of time (1 / its largest vorticity at the start)
  std::vector<double> velocity_east, velocity_north;
  double energy_first = 0.0, energy_last = 0.0;  ///< half the squares of the velocities, summed over cells
};

/// How often the flow's fastest part has turned at an instant of the scene's clock: flow_turns and
/// flow_turns_per_s times that, from 0 to 10.
double flow_turns_at(const Footprint& footprint, double instant_s);

/// The flow of a footprint until its fastest part has turned so many times: a round patch of vorticity ω
/// turns once in 4π/ω. `stands_north` says whether it is in the northern magnetic hemisphere; `index` is the
/// footprint's number in its scene. The charge is uneven by ripples: flux (1 + flow_ripple noise), noise on
/// the scale of flow_scale_km.
PlaneFlow wind_up(const PlaneFootprint<double>& plane, const Footprint& footprint, double turns,
                  std::uint64_t seed, int index, bool stands_north, int threads);

/// The footprint where the flow has brought it: mean of four places in each cell. ln E goes with the flux.
/// What leaves the box is lost. T is double or FreeDual, whose derivatives go with the flow as it is: they
/// are right for numbers that the flow itself does not depend on.
template <class T>
void carry(const PlaneFlow& flow, PlaneFootprint<T>& plane, int threads);

}  // namespace vegard::sim
