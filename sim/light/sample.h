// What passes from where light is born to where it becomes an image: beams ready to fall, and the samples
// along them.
//
// A *sample* is a deflection point with its light. Samples are never stored as such: sixteen beams fall side
// by side, in vector lanes, and their samples go straight to the film. This header holds the beams as they
// are handed over.
#pragma once

#include "sim/base/number/dual.h"
#include "sim/scene/structs/sheet_kinds.h"

namespace vegard::sim {

/// The quantities a sample depends on directly. The kernel carries derivatives with respect to these few
/// only; the derivatives with respect to the free parameters follow per beam by the chain rule. The first two
/// belong to the beam; the rest are common to all beams.
enum LocalInput : int {
  foot_east,
  foot_north,
  inclination,
  declination,
  loss_cone,
  pitch_step,
  first_camera_input,  ///< from here on one for every CameraNumber (sim/view/camera/camera.h)
  camera_inputs = 12,  ///< how many of those there are
  local_inputs = first_camera_input + camera_inputs,  ///< how many there are in all
  beam_inputs = 2,                                    ///< how many of them differ from beam to beam
  place_inputs = 4,  ///< how many the place of a beam depends on: the first ones
};

/// The most local inputs that one pass of the kernel carries.
inline constexpr int kMaxCarried = 10;

/// Free parameters that one pass of the kernel carries: one vector register of floats.
inline constexpr int kTangentWidth = 16;

/// Of what the place of a beam depends on alone.
using PlaceDual = Dual<double, Tangents<double, place_inputs>>;
using LocalDual = Dual<double, Tangents<double, local_inputs>>;
using FreeDual = Dual<double, Tangents<double, kTangentWidth>>;

/// A beam that starts to fall. T is double, or PlaceDual where derivatives are wanted.
template <class T>
struct Beam {
  T start_in_enu_km[3];
  T length_km;  ///< along the field, from the start to the bottom of the height profile
  T vertical;   ///< cosine between the beam and the vertical at its foot; not positive if it does not descend
};

/// Unit vectors of a falling beam: along the field, and two across.
template <class T>
struct FallFrame {
  T along[3];
  T across1[3];
  T across2[3];
};

/// Where the pole of a dipole field in the north is: a unit vector in the observer's east, north and up; and
/// the radius of the sphere of the feet about the body's centre.
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

/// The nodes of a quadrature along a path, in the place of drawn steps: what is left of the path, plus
/// `offset`, shrinks by the factor `shrink` from node to node. So nodes are denser where the light is born.
/// All are fractions of the path.
struct PathNodes {
  double shrink = 0.0;  ///< between 0 and 1; 0: there are no nodes, steps are drawn
  double offset = 0.0;  ///< above 0
  double spread = 0.0;  ///< over which beams end evenly, before the path's end
  bool any() const { return shrink > 0.0; }
};

}  // namespace vegard::sim
