// Beams, as the aurora hands them to the renderer, and the numbers on which the samples along them depend.
//
// A *sample* is a deflection point with its light. Samples are never stored: the renderer follows sixteen
// beams at once, in vector lanes, and adds their samples directly to the film.
#pragma once

#include "sim/base/number/dual.h"
#include "sim/scene/structs/sheet_kinds.h"

namespace vegard::sim {

/// The quantities on which a sample depends directly. The kernel computes derivatives with respect to these
/// few only; the derivatives with respect to the free parameters follow for each beam by the chain rule. The
/// first two differ from beam to beam; the rest are common to all beams.
enum LocalInput : int {
  foot_east,
  foot_north,
  inclination,
  declination,
  loss_cone,
  pitch_step,
  first_camera_input,  ///< the first of one input for every CameraNumber (sim/view/camera/camera.h)
  camera_inputs = 12,  ///< number of camera inputs
  local_inputs = first_camera_input + camera_inputs,  ///< number of all inputs
  beam_inputs = 2,                                    ///< number of inputs that differ from beam to beam
  place_inputs = 4,  ///< number of inputs (the first ones) on which the place of a beam depends
};

/// Largest number of local inputs by which one pass of the kernel computes derivatives.
inline constexpr int kMaxCarried = 10;

/// Number of free parameters by which one pass of the kernel computes derivatives: one vector register of
/// floats.
inline constexpr int kTangentWidth = 16;

/// With derivatives by the inputs on which the place of a beam depends.
using PlaceDual = Dual<double, Tangents<double, place_inputs>>;
using LocalDual = Dual<double, Tangents<double, local_inputs>>;
using FreeDual = Dual<double, Tangents<double, kTangentWidth>>;

/// A beam at its start. T is double, or PlaceDual for derivatives.
template <class T>
struct Beam {
  T start_in_enu_km[3];
  T length_km;  ///< along the field, from the start to the bottom of the height profile
  T vertical;   ///< cosine between the beam and the vertical at its foot; not positive if it does not descend
};

/// Unit vectors at a beam: along the field, and two perpendicular to it.
template <class T>
struct FallFrame {
  T along[3];
  T across1[3];
  T across2[3];
};

/// The axis of a dipole field: the unit vector towards its northern pole, in the observer's east, north and
/// up; and the radius of the sphere about the body's centre on which the feet of the field lines lie.
struct DipoleAxis {
  double in_enu[3];
  double foot_radius_km;
};

template <class T>
struct Deflection {
  PitchLaw law = PitchLaw::reduced;
  T loss_cone_rad;
  T pitch_step_rad;
  double path_step = 0.0;  ///< d_t, the largest step as a fraction of the path
  PathRule rule = PathRule::even;
};

/// The nodes of a quadrature along a path, an alternative to random steps: the remaining path plus `offset`
/// is multiplied by `shrink` from node to node. So nodes are denser towards the end, where most light is
/// emitted. Lengths are fractions of the path.
struct PathNodes {
  double shrink = 0.0;  ///< between 0 and 1; 0: there are no nodes, steps are random
  double offset = 0.0;  ///< above 0
  double spread = 0.0;  ///< length before the path's end over which the ends of the beams are spread evenly
  bool any() const { return shrink > 0.0; }
};

}  // namespace vegard::sim
