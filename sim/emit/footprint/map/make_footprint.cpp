#include "sim/emit/footprint/map/make_footprint.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <utility>

#include "sim/base/number/constants.h"
#include "sim/emit/aurora/foot_field.h"
#include "sim/emit/footprint/map/footprint_map.h"
#include "sim/emit/footprint/map/plane_flow.h"
#include "sim/scene/rows/complaint.h"
#include "sim/scene/rows/value_words.h"
#include "sim/scene/structs/footprint.h"
#include "sim/scene/structs/footprint_spline.h"
#include "sim/scene/structs/line_of.h"

namespace vegard::sim {
namespace {

/// Its number in the scene, which its random numbers go by; 0 for one that is not of it.
int index_of(const Scene& scene, const Footprint& footprint) {
  for (std::size_t i = 0; i < scene.footprints.size(); ++i)
    if (&scene.footprints[i] == &footprint) return static_cast<int>(i);
  return 0;
}

/// A map of dual numbers may be asked for much more memory than the same scene's picture.
template <class T>
void check_memory(const Scene& scene, const Footprint& f) {
  const double cells = map_cells(f), each = bytes_per_cell(f, sizeof(T));
  if (cells * each <= kMaxMapBytes) return;
  const auto gigabytes = [](double bytes) { return short_real_text(std::round(bytes * 1e-8) * 0.1); };
  throw scene_error(
      {"the footprint's map of " + short_real_text(cells) + " cells would take " + gigabytes(cells * each) +
           " GB with its derivatives, " + short_real_text(each) + " bytes a cell",
       "at most " + short_real_text(std::floor(kMaxMapBytes / each)) + " cells in a fit",
       "raise cell_km for the fit, or make size_km smaller"},
      {scene.file, line_of(scene, "footprint." + f.name + ".cell_km"), "footprint." + f.name + ".cell_km"});
}

template <class T>
PlaneFootprint<T> at_rest(const Scene& scene, const Footprint& f, const FootprintPictures& pictures,
                          const NumberAs<T>& number, bool centre_moves, double instant_s, int threads) {
  switch (f.source) {
    case FootprintSource::spline:
      return spline_plane(f, number, threads, centre_moves);
    case FootprintSource::sheets:
      return sheet_plane(scene, f, number, threads, scene.time.start_s - instant_s);
    case FootprintSource::noise:
      return as_free(noise_plane(f, scene.seed, index_of(scene, f), instant_s, threads), f, number);
    case FootprintSource::precipitation:  // which precipitation_plane() makes
    case FootprintSource::image:
    case FootprintSource::cube:
      break;
  }
  return as_free(picture_plane(f, pictures, threads), f, number);
}

PlaneFootprint<double> values(const PlaneFootprint<double>& plane) { return plane; }
PlaneFootprint<double> values(const PlaneFootprint<FreeDual>& plane) {
  PlaneFootprint<double> plain;
  plain.west_km = plane.west_km;
  plain.south_km = plane.south_km;
  plain.cell_km = plane.cell_km;
  plain.grid.columns = plane.grid.columns;
  plain.grid.rows = plane.grid.rows;
  plain.grid.flux_mw_m2.reserve(plane.grid.flux_mw_m2.size());
  for (const FreeDual& flux : plane.grid.flux_mw_m2) plain.grid.flux_mw_m2.push_back(flux.v);
  return plain;
}

}  // namespace

double turned_deg(const Scene& scene, const Footprint& f, double instant_s) {
  const double radius = scene.body.radius_km + kFootAltitudeKm;
  return f.shape == FootprintShape::shell ? drifted_km(f, instant_s).east / (radius * kRadiansPerDegree)
                                          : 0.0;
}

template <class T>
PlaneFootprint<T> make_plane_footprint(const Scene& scene, const Footprint& f,
                                       const FootprintPictures& pictures, const NumberAs<T>& number,
                                       int threads, std::optional<double> instant_s) {
  if constexpr (!std::is_same_v<T, double>) check_memory<T>(scene, f);
  const double instant = instant_s.value_or(scene.time.start_s), turns = flow_turns_at(f, instant);
  // A spline knows where it goes with the centre to a point of the grid. What stands still in its box goes
  // with it, and so does all that the flow has wound up, ripples included.
  const bool goes_with_box =
      f.source != FootprintSource::sheets && (flows(f) || f.source != FootprintSource::spline);
  PlaneFootprint<T> plane = at_rest(scene, f, pictures, number, !goes_with_box, instant, threads);
  if (turns > 0.0)
    carry(wind_up(values(plane), f, turns, scene.seed, index_of(scene, f), falls_along_field(scene), threads),
          plane, threads);
  if (goes_with_box) move_with_centre(f, number, plane);
  const EastNorth drift = drifted_km(f, instant);
  plane.west_km += drift.east;
  plane.south_km += drift.north;
  return plane;
}

template PlaneFootprint<double> make_plane_footprint(const Scene&, const Footprint&, const FootprintPictures&,
                                                     const NumberAs<double>&, int, std::optional<double>);
template PlaneFootprint<FreeDual> make_plane_footprint(const Scene&, const Footprint&,
                                                       const FootprintPictures&, const NumberAs<FreeDual>&,
                                                       int, std::optional<double>);

CubeFootprint<double> make_cube_footprint(const Scene& scene, const Footprint& f,
                                          const FootprintPictures& pictures, int threads,
                                          std::optional<double> instant_s) {
  const double instant = instant_s.value_or(scene.time.start_s), sphere_km = scene.body.radius_km;
  const bool of_noise = f.source == FootprintSource::noise;
  CubeFootprint<double> cube;
  if (has_spline(f)) {
    cube = spline_cube(f, sphere_km, threads, scene.substorm, instant);
  } else if (of_noise) {
    cube = cube_grid<double>(f.face_cells, false);
    for (FootprintGrid<double>& face : cube.face)
      std::fill(face.flux_mw_m2.begin(), face.flux_mw_m2.end(), f.energy_flux_mw_m2);
  } else {
    cube = picture_cube(f, pictures, threads);
  }
  if (of_noise)
    cube = noise_cube(f, sphere_km, std::move(cube), scene.seed, index_of(scene, f), instant, threads);
  wind_up_shell(f, sphere_km, flow_turns_at(f, instant), scene.seed, index_of(scene, f), threads, cube);
  cube.turned_deg = turned_deg(scene, f, instant);
  return cube;
}

}  // namespace vegard::sim
