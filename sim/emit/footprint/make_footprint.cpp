#include "sim/emit/footprint/make_footprint.h"

#include "sim/emit/aurora/sheet_shape.h"
#include "sim/emit/footprint/noise_footprint.h"
#include "sim/emit/footprint/picture_footprint.h"
#include "sim/emit/footprint/plane_flow.h"
#include "sim/emit/footprint/plane_grid.h"
#include "sim/emit/footprint/sheet_footprint.h"
#include "sim/emit/footprint/spline_footprint.h"

namespace vegard::sim {
namespace {

/// Its number in the scene, which its random numbers go by; 0 for one that is not of it.
int index_of(const Scene& scene, const Footprint& footprint) {
  for (std::size_t i = 0; i < scene.footprints.size(); ++i)
    if (&scene.footprints[i] == &footprint) return static_cast<int>(i);
  return 0;
}

template <class T>
PlaneFootprint<T> at_rest(const Scene& scene, const Footprint& f, const FootprintPictures& pictures,
                          const NumberAs<T>& number, int threads) {
  if (f.source == "spline") return spline_plane(f, number, threads);
  if (f.source == "sheets") return sheet_plane(scene, f, number, threads);
  if (f.source == "noise") return as_free(noise_plane(f, scene.seed, index_of(scene, f), threads), f, number);
  return as_free(picture_plane(f, pictures, threads), f, number);
}

PlaneFootprint<double> values(const PlaneFootprint<double>& plane) { return plane; }
PlaneFootprint<double> values(const PlaneFootprint<FreeDual>& plane) {
  PlaneFootprint<double> of;
  of.west_km = plane.west_km;
  of.south_km = plane.south_km;
  of.cell_km = plane.cell_km;
  of.grid.columns = plane.grid.columns;
  of.grid.rows = plane.grid.rows;
  of.grid.flux_mw_m2.reserve(plane.grid.flux_mw_m2.size());
  for (const FreeDual& flux : plane.grid.flux_mw_m2) of.grid.flux_mw_m2.push_back(flux.v);
  return of;
}

}  // namespace

template <class T>
PlaneFootprint<T> make_plane_footprint(const Scene& scene, const Footprint& f,
                                       const FootprintPictures& pictures, const NumberAs<T>& number,
                                       int threads) {
  PlaneFootprint<T> plane = at_rest(scene, f, pictures, number, threads);
  if (f.flow_turns > 0.0)
    carry(wind_up(values(plane), f, scene.seed, index_of(scene, f), falls_along_field(scene), threads), plane,
          threads);
  return plane;
}

template PlaneFootprint<double> make_plane_footprint(const Scene&, const Footprint&, const FootprintPictures&,
                                                     const NumberAs<double>&, int);
template PlaneFootprint<FreeDual> make_plane_footprint(const Scene&, const Footprint&,
                                                       const FootprintPictures&, const NumberAs<FreeDual>&,
                                                       int);

CubeFootprint<double> make_cube_footprint(const Scene&, const Footprint& f, const FootprintPictures& pictures,
                                          int threads) {
  return f.source == "spline" ? spline_cube(f, threads) : picture_cube(f, pictures, threads);
}

}  // namespace vegard::sim
