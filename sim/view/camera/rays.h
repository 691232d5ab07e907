// Rays from the observer: through the centres of a film's cells, to the ground of a body, past the Earth's
// limb.
#pragma once

#include <cmath>
#include <limits>

#include "sim/base/number/constants.h"
#include "sim/view/camera/camera.h"

namespace vegard::sim {

/// Computes the unit vector of the direction of a film's cell; returns false outside of the lens's picture.
template <class T>
bool enu_of_cell(const CameraView<T>& view, const FilmGeometry& film, int row, int column, T enu[3]) {
  return enu_of_pixel(view, film.x0_px + (column + 0.5) * film.cell_width_px,
                      film.y0_px + (row + 0.5) * film.cell_height_px, enu);
}

/// Returns the distance in km at which a ray from the observer meets the ground; infinity if it does not.
/// `up` is the third component of the direction.
inline double ground_km(double observer_altitude_km, double up, double sphere_km = kEarthRadiusKm) {
  const double radius = sphere_km + observer_altitude_km;
  const double along = radius * up;  // of the observer's place, from the Earth's centre
  const double square = along * along - (radius * radius - sphere_km * sphere_km);
  if (along >= 0.0 || square < 0.0) return std::numeric_limits<double>::infinity();
  return std::max(0.0, -along - std::sqrt(square));
}

/// From this altitude on, an observer is above the air that scatters light, and below the aurora: the edge of
/// the Earth below the horizontal is seen as a limb.
inline constexpr double kLimbObserverKm = 60.0;

/// Returns the lowest altitude of a line of sight in km, negative (below the surface) if the line hits the
/// Earth. NaN for elevations of 0 and above, where the observer is the lowest point.
double tangent_altitude_km(double observer_km, double elevation_deg);

/// The inverse of tangent_altitude_km(): at most 0. NaN unless -R <= tangent altitude <= observer.
double elevation_of_tangent_deg(double observer_km, double tangent_km);

/// Returns the distance from the observer to the lowest point; NaN for elevations of 0 and above.
double tangent_distance_km(double observer_km, double elevation_deg);

}  // namespace vegard::sim
