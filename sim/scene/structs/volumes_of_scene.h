// What shines in a scene beside its sheets, marched along rays: plain numbers, as in
// sim/scene/structs/scene.h.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "sim/base/number/vec3.h"
#include "sim/scene/structs/sheet_kinds.h"
#include "sim/scene/structs/site.h"

namespace vegard::sim {

enum class FootprintShape {
  box,   ///< about a point of the observer's tangent plane
  shell  ///< around the Earth
};

enum class FootprintModel {
  volume,
  curtain  ///< upright walls without thickness along the splines
};

/// Where a footprint comes from: a curve, a picture, six of them, the scene's sheets, noise, or a map of
/// precipitation.
enum class FootprintSource { spline, image, cube, sheets, noise, precipitation };

enum class FootprintFall {
  field,    ///< along the scene's
  vertical  ///< a shell's always is
};

enum class FootprintLight {
  lines,
  colours  ///< two of them, between two altitudes
};

/// Which way a flow turns what is bright.
enum class FlowSense {
  spiral,  ///< as spirals are wound: counter-clockwise seen along the field
  charge   ///< as a charged sheet turns: counter-clockwise seen against the field
};

/// Aurora by its footprint: light = energy flux at the foot of the field line through a point, times the
/// height profile of the electrons that fall there (after Lawlor and Genetti 2011, docs/volumes.md).
struct Footprint {
  std::string name = "arc";
  FootprintShape shape = FootprintShape::box;
  FootprintModel model = FootprintModel::volume;
  FootprintSource source = FootprintSource::spline;
  FootprintFall fall = FootprintFall::field;
  EastNorth center_km{0.0, 200.0};  ///< middle of a box, of the feet at 110 km
  EastNorth size_km{800.0, 600.0};  ///< its whole extent
  double cell_km = 1.0;             ///< edge of a cell of a box's footprint
  int face_cells = 1024;  ///< of a shell's footprint: cells along an edge of each of the six cube faces

  /// Points of the spline, in their order: of a box by distance from its middle, of a shell on the globe.
  std::vector<double> east_km, north_km;
  std::vector<double> latitude_deg, longitude_deg;
  bool closed = false;    ///< the last point is followed by the first
  double width_km = 3.0;  ///< standard deviation of the Gaussian across the curve

  std::string
      image;  ///< of a picture: north up over a box; equirectangular or "NAME_{face}.png" around the Earth
  double image_gamma = 1.0;  ///< the energy flux goes as the picture's value to this power
  std::string energy_image;  ///< of the electrons' energy; empty: the same everywhere
  double energy_ratio =
      1.0;  ///< energy where that picture is white, over energy_kev, which is where it is black
  std::vector<double> point_energy;  ///< at the spline's points, over energy_kev; empty: 1
  std::vector<double> point_flux;    ///< at the spline's points, over energy_flux_mw_m2; empty: 1

  std::string file;  ///< a FITS map of energy flux and energy, beside the scene's (docs/volumes.md)

  double noise_scale_km = 120.0;  ///< of the largest waves of a noise footprint
  int noise_octaves = 5;
  double noise_coverage = 0.3;    ///< share of the box, roughly, that shines
  double noise_lifetime_s = 0.0;  ///< in which the noise becomes another; 0: it lasts

  double flow_turns = 0.0;        ///< by how many turns the flow winds the brightest part up; 0: none
  double flow_turns_per_s = 0.0;  ///< by how many turns more with every second of the scene's clock
  FlowSense flow_sense = FlowSense::spiral;
  double flow_scale_km = 20.0;  ///< of the ripples that it starts from
  double flow_ripple = 0.3;     ///< their strength, of that of the sheet's own shear

  EastNorth drift_km_s{0.0, 0.0};  ///< of a box; a shell turns about the Earth's axis, east at the equator

  FootprintLight light = FootprintLight::lines;
  std::array<double, 3> low_colour{0.1, 1.0, 0.3},
      high_colour{0.9, 0.1, 0.3};  ///< linear, of the sensor's primaries
  double low_km = 110.0, high_km = 220.0;

  double energy_kev = 3.0;
  double energy_flux_mw_m2 = 5.0;
  ProfileKind profile = ProfileKind::maxwellian;  ///< as a sheet's, of a spectrum or a form
  double energy_spread = 0.2;
  double peak_km = 110.0, lower_km = 4.0, upper_km = 20.0;
  double top_km = 300.0;  ///< above which there is no light

  /// The site that a box is given about, if that is not the scene's: of a scene that has been carried over to
  /// another station, or of a map that says where it was made. No key of a scene file.
  std::optional<Site> home;
};

enum class NebulaMethod {
  physical,  ///< emission and absorption along each ray, in rayleighs
  literal    ///< the march of the source with its constants, which gives colours only
};

/// Colour of the literal march's light.
enum class LiteralColour {
  two,   ///< colour_a and colour_b
  white  ///< the source's, which works a colour out and does not use it
};

/// A nebula, or any cloud beyond the air: emission and absorption of a few density maps (docs/nebulae.md).
/// Lengths are in units of `unit_pc`.
struct Nebula {
  std::string name = "nebula";
  NebulaMethod method = NebulaMethod::physical;
  double azimuth_deg = 0.0, elevation_deg = 45.0;  ///< of its middle
  double distance_pc = 1000.0;                     ///< of its middle
  double unit_pc = 1.0;
  double position_angle_deg = 0.0;    ///< how far it is turned anticlockwise in the picture
  double bound = 2.8284271247461903;  ///< radius of the sphere that holds it: the source's sqrt(8)
  double edge = 0.1;                  ///< over which density falls from 1 to 0 (h)
  double step = 0.02;                 ///< of the march

  std::string gas;   ///< the node of what shines by lines; empty: none
  std::string glow;  ///< the node of a second light
  std::string dust;  ///< the node of what absorbs
  std::vector<double>
      inner_rayleigh;  ///< per line: of the gas at density 1, to a unit of path, at the middle
  std::vector<double> outer_rayleigh;             ///< and far out
  std::vector<double> glow_rayleigh;              ///< of the glow
  double inner_radius = 0.3, outer_radius = 1.5;  ///< between which the one passes into the other
  double density_power = 1.0;                     ///< light goes as density to this power
  double brightness = 1.0;                        ///< times all light
  double dust_depth = 0.0;                        ///< optical depth at 550 nm of density 1, to a unit of path
  double dust_exponent = 1.3;                     ///< of wavelength, falling
  std::array<double, 3> colour_a{1.0, 0.5, 0.3}, colour_b{0.3, 0.6, 1.0};  ///< of the literal march
  LiteralColour literal_colour = LiteralColour::two;
};

/// A shape; noise upon another node; nodes combined; or another node in its place.
enum class NodeKind {
  sphere,
  shell,
  lobes,
  torus,
  tube,
  slab,
  filaments,
  turbulence,
  warp,
  unite,
  intersect,
  subtract,
  scale,
  rotate,
  move
};

/// One node of a density map: a signed distance, negative inside, in its nebula's units.
struct Node {
  std::string name = "node";
  NodeKind kind = NodeKind::sphere;
  std::string of;                                   ///< the nodes that it works on, separated by commas
  std::array<double, 3> center{0.0, 0.0, 0.0};      ///< right, up, towards the observer
  std::array<double, 3> angles_deg{0.0, 0.0, 0.0};  ///< turns about these axes, one after the other
  std::array<double, 3> stretch{1.0, 1.0, 1.0};     ///< along them
  double radius = 1.0;
  double thickness = 0.1;
  double length = 1.0;
  double waist = 0.2;
  double amplitude = 0.1;
  double frequency = 1.0;
  double gain = 0.5;  ///< from one octave to the next
  double blend = 0.0;
  int octaves = 5;
  int seed = 0;
};

/// Where a file is at home.
enum class VolumeFrame { site, sun };

/// What lights a volume that scatters.
enum class VolumeLamp {
  none,
  direction,  ///< parallel light from a direction of the sky
  point,      ///< a point, near or within it
  sun         ///< the scene's Sun
};

/// Light from an OpenVDB file, as vegard volume writes it (docs/openvdb.md).
struct Volume {
  std::string name = "volume";
  std::string file;  ///< beside the scene's
  VolumeFrame frame = VolumeFrame::site;
  std::array<double, 3> shift_km{0.0, 0.0, 0.0};  ///< east, north, up
  double gain = 1.0;
  double extinction_per_km = 0.0;        ///< of density 1 of its grid "density"
  std::vector<double> density_rayleigh;  ///< light of that density, per line, to a km of path; empty: none
  double step_voxels = 0.5;              ///< of the march
  double albedo = 0.0;     ///< share of the extinction that is scattering; 0: nothing is scattered
  double asymmetry = 0.0;  ///< mean cosine of the angle by which it scatters (Henyey and Greenstein's g)
  VolumeLamp lamp = VolumeLamp::none;
  double lamp_azimuth_deg = 180.0, lamp_elevation_deg = 45.0;  ///< of a direction
  std::array<double, 3> lamp_km{0.0, 0.0, 100.0};              ///< of a point: east, north, up
  /// Per line, in 10^6 photons cm^-2 s^-1: of a direction; of a point at a distance of 1 km (or 1 unit).
  std::vector<double> lamp_flux;
  /// The site whose frame the volume is given in, if that is not the scene's; as of a footprint.
  std::optional<Site> home;
};

/// Where rays begin.
enum class GhostRule {
  span,    ///< at the camera
  literal  ///< by the source's rule
};

/// What the values of a picture of depths are.
enum class DepthMeaning {
  distance,  ///< km along the ray
  forward,   ///< km along the axis
  log        ///< the source's
};

enum class BlendRule { alpha, add };

/// How volumes are marched and how they meet what else is in the picture.
struct March {
  double step_km = 2.0;     ///< of aurora by its footprint
  double step_cells = 2.0;  ///< by which a step moves the foot, at most
  bool skip = true;         ///< empty space by the distance to the footprint
  GhostRule ghosts = GhostRule::span;
  std::string depth;  ///< a picture of the distance to what stands before the sky; empty: none
  DepthMeaning depth_is = DepthMeaning::distance;
  double depth_gain = 1.0;    ///< km to a unit of that picture
  double depth_far_km = 1e6;  ///< of a logarithmic depth
  BlendRule blend = BlendRule::alpha;
  int shrink = 1;          ///< every so-many pixels across and down is marched, the others follow by depth
  double smooth_px = 0.0;  ///< blur of what was marched, to hide its grain
  double glow = 0.0;       ///< share of the light that is spread about
  double glow_deg = 1.0;   ///< how far
};

}  // namespace vegard::sim
