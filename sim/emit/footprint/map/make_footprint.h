// Makes the map of energy flux and energy of a scene's footprint, of every kind.
//
// docs/volumes.md, "Footprints", describes how each kind is made.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "sim/base/image.h"
#include "sim/emit/footprint/map/footprint_map.h"
#include "sim/light/emitter.h"
#include "sim/light/sample.h"
#include "sim/scene/file/precipitation_file.h"
#include "sim/scene/structs/footprint.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

// Footprints of fractal noise in a box: winding bands, like a sky full of arcs.
//
// Source: the second approach of "Rendering volume nebulae and aurorae" (Gaia Sky), a bounded box with
// fractal Brownian motion for a footprint. The law is ours: ridges of gradient noise, (1 - |noise|)², each
// octave weighted by the one before (F. K. Musgrave in D. Ebert et al., "Texturing and modeling", 1994), at
// places displaced by noise.

/// Share of a box's half extent over which its footprint fades towards the edges.
inline constexpr double kNoiseFade = 0.25;

/// Returns the map in units of energy_flux_mw_m2, from 0 to 1, dark at the box's edges. `index` is the
/// footprint's number in its scene; each has its own noise. The threshold below which the map is dark is
/// chosen so that the share noise_coverage of the box is above it, before the edges fade. The pattern is
/// fixed in the box; with a lifetime it changes: the plane through the noise moves by one node in this time.
PlaneFootprint<double> noise_plane(const Footprint& footprint, std::uint64_t seed, int index,
                                   double instant_s, int threads);

// Footprints of a scene's sheets: the energy flux of their beams as a map.

/// Returns all sheets of the scene on the footprint's grid, in mW m^-2: the energy flux of every beam is
/// distributed linearly to the four cells around its foot and divided by the area of a cell. There are many
/// more beams than those of the sheets, so that the map is close to the mean over draws; folds, curls, rays
/// (their light, not their lengths) and patches are those of the sheets. For an exposure the map is the mean
/// over its instants. Where sheets overlap, the flux adds up, and ln E is the mean weighted by flux. A sheet
/// of given brightness has the flux of the Maxwellian electrons of its energy that produce it. The grid's
/// energy is ln(E / footprint.energy_kev). For T = FreeDual `number` may give tangents to the sheets'
/// parameters. All instants are shifted back by `age_s`.
template <class T>
PlaneFootprint<T> sheet_plane(const Scene& scene, const Footprint& footprint, const NumberAs<T>& number,
                              int threads, double age_s = 0.0);

/// Returns the number of beams per layer of a sheet, for cells with this edge.
int footprint_beams(const Sheet& sheet, double cell_km);

// One sheet as a map, with what its beams say of heights: for a view that marches it
// (sim/render/live/live_view.h).

/// Where a sheet's feet are: in the plane of columns along `along` (the sheet's bearing; of a curve, the
/// east) and rows to the left of it, without the sheet's drift since the scene's start. Both corners are in
/// km, as EastNorth of that plane.
struct SheetMapWindow {
  EastNorth along{1.0, 0.0}, first, last;
};

/// Returns the window that holds a sheet at all these instants, with a margin.
SheetMapWindow sheet_map_window(const Scene& scene, int sheet, const std::vector<double>& instants_s,
                                double margin_km);

/// Energy flux, in mW m^-2 (for a sheet of given brightness over the flux of its electrons), logarithm of the
/// energy over the sheet's energy_kev, and means, weighted by flux, of the beams' altitude shift and of the
/// logarithm of the stretch above the profile's peak (BeamLight); the last three are empty where they are 0
/// everywhere.
struct SheetMap {
  PlaneFootprint<double> plane;
  std::vector<double> shift_km, ln_stretch;
};

/// Returns the map of all arcs and layers at an instant. `tube_km` is the standard deviation of the tube
/// around each beam.
SheetMap sheet_map(const Scene& scene, int sheet, const SheetMapWindow& window, double instant_s,
                   double cell_km, double tube_km, int threads);

// Footprints of a curve: light along it, with a Gaussian across.
//
// After Lawlor and Genetti, "Interactive Volume Rendering Aurora on the GPU", Journal of WSCG 19 (2011),
// whose footprints begin as splines. The law is ours: every stretch ds of the curve contributes
//   flux ds / (sqrt(2 pi) width) exp(-r² / (2 width²)),
// so that across a straight curve the sum is the Gaussian of standard deviation `width_km` with the peak
// `flux`, and the integral is flux × length × sqrt(2 pi) width for every course of the curve. Where arms
// cross or come near each other the flux adds up; this is physical, and the map stays smooth, unlike the
// larger of the two. At an open end the flux falls to a half at the last point. The energy is the mean of ln
// E, weighted by the contributions of the stretches.

/// Distance from the curve up to which there is light, in standard deviations: at 3e-7 of the peak.
inline constexpr double kGaussianReach = 5.5;

/// Returns the map of a box, with exact derivatives with respect to every parameter to which `number` gives a
/// tangent. With respect to center_km there are derivatives only if `centre_moves`: the curve then moves on a
/// fixed grid, otherwise the grid moves with it.
template <class T>
PlaneFootprint<T> spline_plane(const Footprint& footprint, const NumberAs<T>& number, int threads,
                               bool centre_moves = true);

/// Returns the map of a shell, on the sphere of the feet at 110 km altitude. Neighbouring points must be less
/// than 90 degrees apart; across the curve the profile is exp(-chord² / (2 width²)), which is Fisher's
/// distribution on the sphere.
/// A substorm's bulge (sim/emit/footprint/map/bulge.h) is that of the instant.
CubeFootprint<double> spline_cube(const Footprint& footprint, double sphere_km, int threads,
                                  const Substorm& substorm = {}, double instant_s = 0.0);

// Noise and flow around the Earth. Both are a box's, in other coordinates: noise in space rather than in a
// plane, and the flow in the plane about a pole in which areas are true (J. H. Lambert 1772), so that it is
// without sources on the sphere too. There shapes are true near the pole, and within 7 % at 30° from it.

/// Returns a shell's map with the flux times the noise's 0 to 1; it is evaluated where there is flux.
/// noise_coverage is the share of the whole sphere. With a lifetime, a pattern passes into the next in it.
CubeFootprint<double> noise_cube(const Footprint& footprint, double sphere_km, CubeFootprint<double> lit,
                                 std::uint64_t seed, int index, double instant_s, int threads);

/// Winds up the map about the pole of the hemisphere with more of its flux, as wind_up() and carry() do with
/// a box. What lies more than 128° from that pole stays.
void wind_up_shell(const Footprint& footprint, double sphere_km, double turns, std::uint64_t seed, int index,
                   int threads, CubeFootprint<double>& cube);

// Footprints from pictures: over a box, around the Earth, or on the faces of a cube.
//
// Source of the projections: "Rendering volume nebulae and aurorae" (Gaia Sky), as read in docs/volumes.md,
// "Footprints": u = 1/2 - atan2(-z, -x) / 2π, v = 1/2 + asin(-y) / π, with y to the north pole.

/// The pictures of a footprint from files: one channel each, as read_picture() returns it, top row first.
/// Null: none.
struct FootprintPictures {
  const Image* flux = nullptr;
  const Image* energy = nullptr;
  std::array<const Image*, 6> face{};  ///< px, nx, py, ny, pz, nz
  std::array<const Image*, 6> energy_face{};
};

/// A place on a picture, as a fraction of its width from the left and of its height from the top.
struct PicturePlace {
  double u, v;
};

/// Returns the place of a direction on an equirectangular picture of the Earth: north is up, east to the
/// right, longitude 0 in the middle, 180 degrees at both edges.
PicturePlace equirectangular_place(const double direction[3]);

/// Which of six pictures contains a direction, and where: 0 to 5 for px, nx, py, ny, pz, nz in the layout of
/// OpenGL's cube maps, whose y is the north pole and whose -x is longitude 0 (so that z is 90 degrees east).
struct CubePlace {
  int picture;
  PicturePlace at;
};
CubePlace cube_place(const double direction[3]);

/// Returns the map of a picture stretched over a box, north up, in units of energy_flux_mw_m2.
PlaneFootprint<double> picture_plane(const Footprint& footprint, const FootprintPictures& pictures,
                                     int threads);

/// Returns the map around the Earth from one picture or from six, in mW m^-2.
CubeFootprint<double> picture_cube(const Footprint& footprint, const FootprintPictures& pictures,
                                   int threads);

// A footprint from a map of precipitation.

/// Returns the footprint with the parameters of its map: energy_kev and energy_flux_mw_m2 are means over the
/// map's cells, weighted by energy flux (for the energy of its logarithm, over the cells that have one), and
/// home is the site in the map's file, or else the footprint's own. For a dark map it returns the footprint
/// unchanged.
Footprint with_map(const Footprint& footprint, const PrecipitationMap& map);

/// Returns the map as a grid, with energies over the energy_kev of with_map(). A cell without energy gets
/// that of its neighbours, so that light fades out by its flux alone, or else the mean. The grid does not
/// depend on any free parameter. T is double or FreeDual.
template <class T>
PlaneFootprint<T> precipitation_plane(const Footprint& footprint, const PrecipitationMap& map);

extern template PlaneFootprint<double> precipitation_plane(const Footprint&, const PrecipitationMap&);
extern template PlaneFootprint<FreeDual> precipitation_plane(const Footprint&, const PrecipitationMap&);

/// Returns the drift of a footprint since the clock's zero.
inline EastNorth drifted_km(const Footprint& footprint, double instant_s) {
  return {footprint.drift_km_s.east * instant_s, footprint.drift_km_s.north * instant_s};
}

/// Returns the rotation of a shell to the east.
double turned_deg(const Scene& scene, const Footprint& footprint, double instant_s);

/// Makes the map of a footprint of shape "box" at an instant of the scene's clock (none: the scene's start).
/// A footprint of the sheets is the mean over all instants of an exposure that begins at this instant, with
/// the flow of this instant. The map's flux is in mW m^-2; energies are over footprint.energy_kev. For T =
/// FreeDual it has the derivatives with respect to every parameter to which `number` gives a tangent:
/// east_km, north_km, center_km, width_km, energy_flux_mw_m2, point_flux and point_energy; for a footprint
/// with a flow only center_km, energy_flux_mw_m2 and point_energy, on which the flow does not depend. The
/// grid itself stays at center_km. The map does not depend on the number of threads. Throws Error(scene)
/// where derivatives need more memory than kMaxMapBytes (sim/scene/structs/footprint.h).
template <class T>
PlaneFootprint<T> make_plane_footprint(const Scene& scene, const Footprint& footprint,
                                       const FootprintPictures& pictures, const NumberAs<T>& number,
                                       int threads, std::optional<double> instant_s = {});

extern template PlaneFootprint<double> make_plane_footprint(const Scene&, const Footprint&,
                                                            const FootprintPictures&, const NumberAs<double>&,
                                                            int, std::optional<double>);
extern template PlaneFootprint<FreeDual> make_plane_footprint(const Scene&, const Footprint&,
                                                              const FootprintPictures&,
                                                              const NumberAs<FreeDual>&, int,
                                                              std::optional<double>);

/// Makes the map of a footprint of shape "shell".
CubeFootprint<double> make_cube_footprint(const Scene& scene, const Footprint& footprint,
                                          const FootprintPictures& pictures, int threads,
                                          std::optional<double> instant_s = {});

}  // namespace vegard::sim
