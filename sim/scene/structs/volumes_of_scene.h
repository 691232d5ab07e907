// The emitters of a scene that are integrated along rays: footprints, nebulae, volumes. Plain numbers, as in
// sim/scene/structs/scene.h. "The source" is the publication that an emitter follows.
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
  box,   ///< around a point of the observer's tangent plane
  shell  ///< around the Earth
};

enum class FootprintModel {
  volume,
  curtain  ///< vertical walls without thickness along the splines
};

/// The source of a footprint's map: a curve, a picture, six pictures of a cube, the scene's sheets, noise, or
/// a map of precipitation.
enum class FootprintSource { spline, image, cube, sheets, noise, precipitation };

/// The direction of a footprint's electrons.
enum class FootprintFall {
  field,    ///< along the scene's field
  vertical  ///< also for shells in a uniform field
};

enum class FootprintLight {
  lines,
  colours  ///< two colours, between two altitudes
};

/// The sense in which a flow turns bright parts.
enum class FlowSense {
  spiral,  ///< as auroral spirals: counter-clockwise seen along the field
  charge   ///< as a charged sheet: counter-clockwise seen against the field
};

/// Aurora from a map of its footprint: the light at a point is the energy flux at the foot of its field line
/// times the height profile of the electrons there (after Lawlor and Genetti 2011, docs/volumes.md).
struct Footprint {
  std::string name = "arc";
  FootprintShape shape = FootprintShape::box;
  FootprintModel model = FootprintModel::volume;
  FootprintSource source = FootprintSource::spline;
  FootprintFall fall = FootprintFall::field;
  EastNorth center_km{0.0, 200.0};  ///< middle of a box, at 110 km altitude
  EastNorth size_km{800.0, 600.0};  ///< full size of a box
  double cell_km = 1.0;             ///< edge of a cell of a box's footprint
  int face_cells = 1024;  ///< of a shell's footprint: cells along an edge of each of the six cube faces

  /// Points of the spline, in order: of a box relative to its middle, of a shell on the globe.
  std::vector<double> east_km, north_km;
  std::vector<double> latitude_deg, longitude_deg;
  bool closed = false;    ///< the last point is followed by the first
  double width_km = 3.0;  ///< standard deviation of the Gaussian across the curve

  std::string image;          ///< file: north up for a box; for a shell equirectangular or "NAME_{face}.png"
  double image_gamma = 1.0;   ///< the energy flux is proportional to the picture's value to this power
  std::string energy_image;   ///< picture of the energy; empty: the same everywhere
  double energy_ratio = 1.0;  ///< energy where energy_image is white over energy_kev, where it is black
  std::vector<double> point_energy;  ///< at the spline's points, relative to energy_kev; empty: 1
  std::vector<double> point_flux;    ///< at the spline's points, relative to energy_flux_mw_m2; empty: 1

  std::string file;  ///< FITS map of energy flux and energy, relative to the scene's file (docs/volumes.md)

  double noise_scale_km = 120.0;  ///< length of the largest waves of noise
  int noise_octaves = 5;
  double noise_coverage = 0.3;    ///< approximate share of the box that shines
  double noise_lifetime_s = 0.0;  ///< time in which the noise changes; 0: it does not

  double flow_turns = 0.0;        ///< turns by which the flow winds up the brightest part; 0: no flow
  double flow_turns_per_s = 0.0;  ///< additional turns per second of the scene's clock
  FlowSense flow_sense = FlowSense::spiral;
  double flow_scale_km = 20.0;  ///< length of the ripples from which the flow starts
  double flow_ripple = 0.3;     ///< strength of the ripples relative to the footprint's own shear

  EastNorth drift_km_s{0.0, 0.0};  ///< of a box; of a rotating shell: east at the equator

  FootprintLight light = FootprintLight::lines;
  std::array<double, 3> low_colour{0.1, 1.0, 0.3},
      high_colour{0.9, 0.1, 0.3};  ///< linear, in the sensor's primaries
  double low_km = 110.0, high_km = 220.0;

  double energy_kev = 3.0;
  double energy_flux_mw_m2 = 5.0;
  ProfileKind profile = ProfileKind::maxwellian;  ///< as of a sheet: of a spectrum or a form
  double energy_spread = 0.2;
  double peak_km = 110.0, lower_km = 4.0, upper_km = 20.0;
  double top_km = 300.0;  ///< altitude above which there is no light

  /// The site of the frame in which a box is given, if not the scene's: set when a scene is transformed to
  /// another station, or by a map that has a site. No key of a scene file.
  std::optional<Site> home;
};

enum class NebulaMethod {
  physical,  ///< emission and absorption along each ray, in rayleighs
  literal    ///< the source's algorithm with its constants, which gives colours only
};

/// The colours of NebulaMethod::literal.
enum class LiteralColour {
  two,   ///< colour_a and colour_b
  white  ///< as in the source, which computes a colour and does not use it
};

/// A nebula, or any cloud in space: emission and absorption by a few density maps (docs/nebulae.md).
/// Lengths are in units of `unit_pc`.
struct Nebula {
  std::string name = "nebula";
  NebulaMethod method = NebulaMethod::physical;
  double azimuth_deg = 0.0, elevation_deg = 45.0;  ///< of its middle
  double distance_pc = 1000.0;                     ///< of its middle
  double unit_pc = 1.0;
  double position_angle_deg = 0.0;    ///< anticlockwise in the picture
  double bound = 2.8284271247461903;  ///< radius of the sphere around it; the default is the source's sqrt(8)
  double edge = 0.1;                  ///< distance over which the density falls from 1 to 0 (h)
  double step = 0.02;                 ///< of the march

  std::string gas;   ///< node of the gas that emits lines; empty: none
  std::string glow;  ///< node of a second emission; empty: none
  std::string dust;  ///< node of the absorbing dust; empty: none
  std::vector<double>
      inner_rayleigh;  ///< per line: of the gas at density 1, per unit of path, within inner_radius
  std::vector<double> outer_rayleigh;             ///< the same beyond outer_radius
  std::vector<double> glow_rayleigh;              ///< the same of the glow
  double inner_radius = 0.3, outer_radius = 1.5;  ///< range of the transition from inner to outer
  double density_power = 1.0;                     ///< light is proportional to density to this power
  double brightness = 1.0;                        ///< factor on all light
  double dust_depth = 0.0;                        ///< optical depth at 550 nm of density 1 per unit of path
  double dust_exponent = 1.3;                     ///< optical depth ~ wavelength^-dust_exponent
  std::array<double, 3> colour_a{1.0, 0.5, 0.3}, colour_b{0.3, 0.6, 1.0};  ///< of the literal method
  LiteralColour literal_colour = LiteralColour::two;
};

/// A shape; noise added to another node; a combination of nodes; or a transformation of a node.
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
  std::string of;                                   ///< names of its operand nodes, separated by commas
  std::array<double, 3> center{0.0, 0.0, 0.0};      ///< right, up, towards the observer
  std::array<double, 3> angles_deg{0.0, 0.0, 0.0};  ///< rotations about these axes, one after the other
  std::array<double, 3> stretch{1.0, 1.0, 1.0};     ///< factors along these axes
  double radius = 1.0;
  double thickness = 0.1;
  double length = 1.0;
  double waist = 0.2;
  double amplitude = 0.1;
  double frequency = 1.0;
  double gain = 0.5;  ///< amplitude of an octave over that of the previous one
  double blend = 0.0;
  int octaves = 5;
  int seed = 0;
};

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
