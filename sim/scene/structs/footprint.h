// [[footprint]]: aurora by its footprint, and the sizes of its map and spline. "The source" is the
// publication that it follows.
#pragma once

#include <array>
#include <cstddef>
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

  double ray_contrast = 0.0;    ///< of a curtain: standard deviation of ln(light) along it
  double ray_width_km = 2.0;    ///< full width at half maximum of a ray, at the foot
  double ray_lifetime_s = 0.0;  ///< 0: they last

  // The bulge of a substorm in a shell's spline (sim/emit/footprint/map/bulge.h).
  double bulge_km = 0.0;             ///< how far it reaches towards the pole; 0: none
  double bulge_longitude_deg = 0.0;  ///< where it begins, at the substorm's onset
  double bulge_length_km = 300.0;    ///< of its front, and of its tail
  double bulge_speed_km_s = 1.5;     ///< of its front, to the west along the spline
  double bulge_gain = 3.0;           ///< factor on the flux in it

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

/// True if a flow winds the footprint up, now or later.
inline bool flows(const Footprint& f) { return f.flow_turns > 0.0 || f.flow_turns_per_s > 0.0; }

/// True if a curtain has rays.
inline bool has_rays(const Footprint& f) {
  return f.model == FootprintModel::curtain && f.ray_contrast > 0.0;
}

/// True if more than the clock's drift changes the map.
inline bool changes_in_place(const Footprint& f) {
  return f.flow_turns_per_s > 0.0 || (f.source == FootprintSource::noise && f.noise_lifetime_s > 0.0) ||
         (has_rays(f) && f.ray_lifetime_s > 0.0) || f.bulge_km > 0.0;
}

/// True if the footprint changes with the scene's clock by its own keys, whatever its source does.
inline bool moves_by_itself(const Footprint& f) {
  return f.drift_km_s.east != 0.0 || f.drift_km_s.north != 0.0 || changes_in_place(f);
}

/// True if the scene's clock only moves the footprint as a whole, if at all.
inline bool only_drifts(const Footprint& f) {
  return f.source != FootprintSource::sheets && !changes_in_place(f);
}

/// Smallest standard deviation, in cells, of the Gaussian across a spline as it is drawn. A narrower one is
/// drawn this wide and fainter in proportion: the sum of its samples would miss its integral.
inline constexpr double kNarrowestCells = 0.7;

/// Returns the standard deviation in km of the Gaussian as it is drawn: width_km or kNarrowestCells cells.
double drawn_width_km(const Footprint& footprint, double sphere_km);

/// Returns the largest length in km of a piece of a footprint's spline. Volumes: 0.8 of the drawn width,
/// since a sum of Gaussians at this spacing equals their integral to 1e-13. Curtains: 4 km in a box, 16 km in
/// a shell.
double longest_piece_km(const Footprint& footprint, double sphere_km);

/// Returns the number of pieces of the whole spline. Between two points there are at least 16, and enough for
/// a curve that is 1.5 times as long as its chord.
double spline_pieces(const Footprint& footprint, double sphere_km);
inline constexpr double kMaxSplinePieces = 1048576.0;

/// Return the number of cells of the map: along the longer side of a box, and in total.
double longest_side_cells(const Footprint& footprint);
double map_cells(const Footprint& footprint);
inline constexpr double kMaxBoxCells = 67108864.0;
/// Limit of the map of empty space: it has one cell per 8 x 8 cells, and squared distances in 32 bits.
inline constexpr double kMaxSideCells = 262000.0;

/// Returns the memory in bytes per cell while a map is made, with numbers of `number_bytes`: the flux, ln E
/// where it varies, four layers of sheets at a time, and copies of flux and ln E from before the flow.
double bytes_per_cell(const Footprint& footprint, std::size_t number_bytes);
inline constexpr double kMaxMapBytes = 4e9;

}  // namespace vegard::sim
