// Where a line of sight passes the Earth's limb.
//
// Seen from the height H above a sphere of radius R, a line of sight at the elevation e below the horizontal
// comes closest to the Earth's centre at (R + H) cos e from it: at the tangent point, (R + H) sin(-e) away
// from the observer, the line's *tangent altitude* (R + H) cos e - R above the sphere. The usual coordinate
// of limb sounding, e.g. C. D. Rodgers, "Inverse Methods for Atmospheric Sounding" (2000), chapter 1.
// Straight lines: nothing is refracted.
#pragma once

namespace vegard::sim {

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
