// Rays from the observer: through the middles of a film's cells, to the ground of a body, past the Earth's
// limb.
#pragma once

#include <cmath>
#include <limits>

#include "sim/base/number/constants.h"
#include "sim/view/camera/camera.h"

namespace vegard::sim {

/// The direction, of length 1, of a film's cell; false where the lens sees nothing.
template <class T>
bool enu_of_cell(const CameraView<T>& view, const FilmGeometry& film, int row, int column, T enu[3]) {
  return enu_of_pixel(view, film.x0_px + (column + 0.5) * film.cell_width_px,
                      film.y0_px + (row + 0.5) * film.cell_height_px, enu);
}

/// Where a ray from the observer meets the ground, in km; infinity if nowhere. `up` is the direction's third
/// component.
inline double ground_km(double observer_altitude_km, double up, double sphere_km = kEarthRadiusKm) {
  const double radius = sphere_km + observer_altitude_km;
  const double along = radius * up;  // of the observer's place, from the Earth's centre
  const double square = along * along - (radius * radius - sphere_km * sphere_km);
  if (along >= 0.0 || square < 0.0) return std::numeric_limits<double>::infinity();
  return std::max(0.0, -along - std::sqrt(square));
}

/// From there upwards an observer is above what scatters light, and below the aurora: an edge of the Earth
/// below the horizontal is a limb.
inline constexpr double kLimbObserverKm = 60.0;

/// Negative where the line strikes the Earth (so deep would it pass below its surface). NaN for elevations
/// from 0 up, along which there is no lower point than the observer.
double tangent_altitude_km(double observer_km, double elevation_deg);

/// The inverse: at most 0. NaN unless -R <= tangent altitude <= observer.
double elevation_of_tangent_deg(double observer_km, double tangent_km);

/// From the observer to the tangent point; NaN from the horizontal upwards.
double tangent_distance_km(double observer_km, double elevation_deg);

}  // namespace vegard::sim
