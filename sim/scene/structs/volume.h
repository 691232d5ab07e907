// [[volume]] and [march]: light from files of voxels, and how all volumes are marched.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "sim/scene/structs/site.h"

namespace vegard::sim {

/// The frame of a volume's file: the observer's or the Sun's.
enum class VolumeFrame { site, sun };

/// What lights a volume that scatters.
enum class VolumeLamp {
  none,
  direction,  ///< parallel light from a direction of the sky
  point,      ///< a point near or within the volume
  sun         ///< the scene's Sun
};

/// A volume from a file of voxels: OpenVDB (docs/openvdb.md) or pbrt's volumegrid.
struct Volume {
  std::string name = "volume";
  std::string file;  ///< relative to the scene's file
  VolumeFrame frame = VolumeFrame::site;
  std::array<double, 3> shift_km{0.0, 0.0, 0.0};  ///< east, north, up
  double gain = 1.0;
  double extinction_per_km = 0.0;        ///< of density 1 of its grid "density"
  std::vector<double> density_rayleigh;  ///< light of density 1, per line and km of path; empty: none
  double step_voxels = 0.5;              ///< of the march
  double albedo = 0.0;     ///< share of the extinction that is scattering; 0: nothing is scattered
  double asymmetry = 0.0;  ///< mean cosine of the scattering angle (g of Henyey and Greenstein)
  VolumeLamp lamp = VolumeLamp::none;
  double lamp_azimuth_deg = 180.0, lamp_elevation_deg = 45.0;  ///< of a direction
  std::array<double, 3> lamp_km{0.0, 0.0, 100.0};              ///< of a point: east, north, up
  /// Flux per line, in 10^6 photons cm^-2 s^-1; of a point lamp at a distance of 1 km (or 1 unit of the Sun).
  std::vector<double> lamp_flux;
  /// The site of the frame in which the volume is given, if not the scene's; as Footprint::home.
  std::optional<Site> home;
};

/// Where the integration along a ray begins.
enum class GhostRule {
  span,    ///< at the camera
  literal  ///< behind the camera too, as in the source
};

/// The meaning of the values of a depth picture.
enum class DepthMeaning {
  distance,  ///< km along the ray
  forward,   ///< km along the camera's axis
  log        ///< logarithmic, as in the source
};

enum class BlendRule { alpha, add };

/// How volumes are integrated along rays (marched) and combined with the rest of the picture.
struct March {
  double step_km = 2.0;     ///< step along a ray through a footprint
  double step_cells = 2.0;  ///< largest step across a footprint, in its cells
  bool skip = true;         ///< true: steps skip empty space, from distances to lit cells
  GhostRule ghosts = GhostRule::span;
  std::string depth;  ///< picture of the distance to objects in front of the sky; empty: none
  DepthMeaning depth_is = DepthMeaning::distance;
  double depth_gain = 1.0;    ///< km per unit of the depth picture
  double depth_far_km = 1e6;  ///< distance at a logarithmic depth of 1
  BlendRule blend = BlendRule::alpha;
  int shrink = 1;          ///< every n-th pixel across and down is marched, others are interpolated by depth
  double smooth_px = 0.0;  ///< standard deviation of a blur of the marched light, against grain
  double glow = 0.0;       ///< share of the marched light that is blurred as a glow
  double glow_deg = 1.0;   ///< standard deviation of the glow
};

}  // namespace vegard::sim
