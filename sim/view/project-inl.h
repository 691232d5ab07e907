// Samples on their way to the film: where a point of space appears, how bright, and at which altitude it is.
#if defined(VEGARD_SIM_VIEW_PROJECT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VEGARD_SIM_VIEW_PROJECT_INL_H_
#undef VEGARD_SIM_VIEW_PROJECT_INL_H_
#else
#define VEGARD_SIM_VIEW_PROJECT_INL_H_
#endif

#include "sim/base/dual-inl.h"
#include "sim/base/earth.h"
#include "sim/base/lanes-inl.h"
#include "sim/view/camera.h"

HWY_BEFORE_NAMESPACE();
namespace vegard::sim {
namespace HWY_NAMESPACE {

/// A point as the camera has it.
template <class P>
struct SeenPoint {
  P column, row;         ///< in cells, so that (0, 0) is the centre of the first cell
  P per_steradian_cell;  ///< 1 / (r^2 Omega): what a volume in km^3 counts for in its cell, km^-2
};

template <class L, class C>
struct FilmView {
  PinholeView<C> camera;
  L column_scale, column_offset, row_scale,
      row_offset;   ///< column = x in pixels from the axis * scale + offset
  L per_cell_area;  ///< 1 / px^2
};

/// Pinhole: Omega = cos^3(theta) / f^2 per pixel, so 1 / (r^2 Omega) = f^2 r / Z^3 (docs/physics.md).
template <class L, class P, class C>
HWY_INLINE SeenPoint<P> see_point(const FilmView<L, C>& film, const P enu_km[3],
                                  decltype(L() < L())& in_front) {
  P in_camera[3];
  for (int i = 0; i < 3; ++i)
    in_camera[i] = enu_km[0] * film.camera.camera_from_enu[i][0] +
                   enu_km[1] * film.camera.camera_from_enu[i][1] +
                   enu_km[2] * film.camera.camera_from_enu[i][2];
  in_front = L(1e-3f) < value_of(in_camera[2]);
  const P& depth = in_camera[2];
  const P inverse = L(1.0f) / depth;
  const P scale = inverse * film.camera.focal_px;
  const P range = square_root(in_camera[0] * in_camera[0] + in_camera[1] * in_camera[1] + depth * depth);
  SeenPoint<P> seen;
  seen.column = in_camera[0] * scale * film.column_scale + film.column_offset;
  seen.row = in_camera[1] * scale * film.row_scale + film.row_offset;
  seen.per_steradian_cell = scale * scale * (range * inverse) * film.per_cell_area;
  return seen;
}

/// Altitude above the sphere of a point in the observer's frame. Written so that nothing large cancels.
template <class L, class P>
HWY_INLINE P altitude_km(const P enu_km[3], L observer_altitude_km) {
  const P up = enu_km[2] + observer_altitude_km;
  const P level2 = enu_km[0] * enu_km[0] + enu_km[1] * enu_km[1];
  const L radius(static_cast<float>(kEarthRadiusKm));
  const P distance = square_root((up + radius) * (up + radius) + level2);
  return (up * (up + radius * L(2.0f)) + level2) / (distance + radius);
}

}  // namespace HWY_NAMESPACE
}  // namespace vegard::sim
HWY_AFTER_NAMESPACE();

#endif
