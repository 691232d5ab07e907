// The Sun of a scene and the objects on it: plain numbers, as in sim/scene/structs/scene.h (docs/corona.md).
//
// Lengths without a unit in their names are in units of `sun.unit_km`, by default a megametre. Places on the
// Sun are heliographic: latitude to the north of the solar equator, longitude to the west; the middle of the
// disc has the longitude `sun.longitude_deg`. "The source" is Chang and Jiang (docs/corona.md).
#pragma once

#include <array>
#include <string>
#include <vector>

namespace vegard::sim {

/// How the objects on the Sun rotate about its axis with the scene's clock (sim/emit/sun/solar_rotation.h).
enum class SolarRotation {
  none,
  rigid,        ///< everything at Carrington's rate
  differential  ///< slower towards the poles, as observed for the magnetic field of the surface
};

/// The direction from which the rotation is measured.
enum class RotationFrame {
  synodic,  ///< that of the Earth, which orbits the Sun in a year
  sidereal  ///< that of the stars
};

/// The Sun's position in the sky, and its photosphere: a luminous, opaque sphere.
struct Sun {
  bool shown = false;
  double azimuth_deg = 0.0, elevation_deg = 45.0;  ///< of its middle
  double distance_km = 149597870.7;
  double position_angle_deg = 0.0;           ///< of its north pole, anticlockwise in the picture
  double latitude_deg = 0.0;                 ///< heliographic, of the middle of the disc (B0)
  double longitude_deg = 0.0;                ///< heliographic, of the middle of the disc (L0)
  double unit_km = 1000.0;                   ///< unit of lengths on the Sun
  double radius = 695.7;                     ///< of the photosphere
  std::vector<double> photosphere_rayleigh;  ///< per line, at the middle of the disc; empty: dark
  /// Coefficients u and v of I = 1 - u (1 - mu) - v (1 - mu)^2, mu the cosine of the angle to the vertical.
  double limb_darkening = 0.0, limb_darkening_square = 0.0;
  SolarRotation rotation = SolarRotation::none;  ///< longitudes are those at time 0 of the scene's clock
  RotationFrame rotation_frame = RotationFrame::synodic;
};

/// Noise between two concentric spheres: the source's CloudRegion, with its names for eleven numbers.
struct Chromosphere {
  std::string name = "chromosphere";
  double innerradius = 695.7, outerradius = 705.7;
  double roughness = 0.5;  ///< amplitude of an octave over that of the previous one
  int octaves = 6;
  double scale = 20.0;                                      ///< length of the largest waves
  std::array<double, 3> shift{0.0, 0.0, 0.0};               ///< of the noise, in lengths of the largest waves
  double coverage = 0.2, sharpness = 5.0, amplitude = 1.0;  ///< of the cutoff
  std::string biasmap;           ///< a picture by latitude and longitude; empty: none
  double peak = 0.0;             ///< added to the noise where biasmap is white
  bool cutoff = true;            ///< false: the noise without cutoff
  std::vector<double> rayleigh;  ///< per line, of density 1, per unit of path; empty: dark
  double extinction = 0.0;       ///< of density 1, to a unit of path
  double step = 1.0;             ///< of the march
};

/// Density across a strand; q is the distance from its axis over its radius. All are 0 beyond q = 1.
enum class RadialFalloff {
  smooth,   ///< (1 - q²)²
  linear,   ///< 1 - q
  gaussian  ///< exp(-4.5 q²)
};

/// Density along a strand as a function of the height above its feet.
enum class HeightFalloff {
  none,
  grow,         ///< linearly
  fade,         ///< linearly
  logarithmic,  ///< it falls with the logarithm of the height
  inverse_square
};

/// A coronal loop: a bundle of strands over one pair of feet.
struct Loop {
  std::string name = "loop";
  double latitude_deg = 0.0, longitude_deg = 0.0;  ///< of the midpoint between its feet
  double bearing_deg = 90.0;           ///< from the first foot to the second, from north to the west
  double height = 60.0;                ///< of its top over the midpoint between the feet
  double width = 80.0;                 ///< from foot to foot
  double sharpness = 0.0;              ///< 0: round; 1: pointed, the control points coincide
  double skew = 0.0;                   ///< shift of the control points across, in opposite directions
  double tilt_deg = 0.0;               ///< of its plane from the vertical, to the right of the bearing
  double tilt_per_distance_deg = 0.0;  ///< additional tilt of a strand per unit of its distance
  int strands = 100;
  double spread = 10.0;        ///< largest distance of strands from the loop's plane, to either side
  double strand_radius = 1.0;  ///< radius beyond which a strand is dark
  RadialFalloff density_falloff = RadialFalloff::smooth;
  HeightFalloff height_falloff = HeightFalloff::none;
  double falloff_least = 0.0;  ///< minimum of the height falloff
  double foot_fade = 0.0;      ///< share of the height over which strands brighten from their feet
  double base_density = 1.0;
  double root_noise = 0.0;    ///< standard deviation of the positions of the feet
  double height_noise = 0.0;  ///< standard deviation, fraction of the height
  double tilt_noise_deg = 0.0;
  double density_noise = 0.0;       ///< standard deviation of ln(density) of the strands
  int filaments = 0;                ///< number of bunches of strands near the top; 0: none
  double filament_pull = 0.7;       ///< how far a strand's top moves to that of its bunch: 0 to 1
  double brightening = 0.0;         ///< density added at brightening_at, in base_density
  double brightening_at = 1.0;      ///< height of the brightening, fraction of the loop's
  double brightening_width = 0.15;  ///< standard deviation, fraction of the loop's height
  std::vector<double> rayleigh;     ///< per line: of density 1, to a unit of path
  double temperature_mk = 0.0;      ///< if not 0: lines with a temperature response use it
  /// Mean time between the flares that heat a strand; 0: no flares, steady light.
  double heating_interval_s = 0.0;
  double heating_temperature_mk = 10.0;  ///< temperature to which a flare heats a strand
  double heating_density_cm3 = 1e9;      ///< electron density of a strand at the flare
  double voxel = 0.0;                    ///< if not 0: the loop is rendered as a grid of voxels of this size
  int blur = 0, sharpen = 0;             ///< number of times that grid is blurred, and then sharpened
};

enum class CoronaLight {
  density,
  square,    ///< of the density
  scattered  ///< photospheric light scattered by electrons
};

/// The global corona: density = sum of share (r / R)^-power around the Sun, R the photosphere's radius.
struct Corona {
  std::string name = "corona";
  double density = 1.0;  ///< at the photosphere, if the shares add up to 1
  std::vector<double> share{1.0};
  std::vector<double> power{6.0};
  double polar = 1.0;  ///< density above the poles over that above the equator
  double reach = 5.0;  ///< outer radius, in radii of the photosphere
  CoronaLight light = CoronaLight::density;
  std::vector<double> rayleigh;  ///< per line: of density 1, to a unit of path
  double temperature_mk = 0.0;   ///< as a loop's
};

/// Bundles of straight strands on the Sun: rays of the corona, streaks above the limb.
struct Bundle {
  std::string name = "bundle";
  int count = 200;
  double length = 700.0;
  double gradient_deg = 0.0;        ///< tilt of a strand from the vertical, away from the nearer pole
  double slope_noise_deg = 5.0;     ///< standard deviation of a strand's tilt
  double position_noise_deg = 0.0;  ///< standard deviation of a foot from evenly spaced places
  double density_noise = 0.5;       ///< standard deviation of ln(density)
  double density = 1.0;             ///< at a foot
  double falloff_length = 200.0;    ///< length over which the density falls to 1 / e
  double foot_radius = 2.0, top_radius = 10.0;
  RadialFalloff density_falloff = RadialFalloff::gaussian;
  int filaments = 0;  ///< number of places to which feet are attracted; 0: none
  double filament_pull = 0.7;
  double lowest_latitude_deg = -90.0, highest_latitude_deg = 90.0;  ///< of feet
  double horizon_deg = 90.0;     ///< largest distance of feet from the limb, as seen by the observer
  std::vector<double> rayleigh;  ///< as a loop's
  double temperature_mk = 0.0;
  double foot_fade = 0.0;  ///< length over which lines brighten from their feet
};

enum class EjectionKind { rope, shell };

/// A coronal mass ejection: an expanding flux rope of twisted strands, or a shell. Not from the source.
struct Ejection {
  std::string name = "ejection";
  EjectionKind kind = EjectionKind::rope;
  double latitude_deg = 0.0, longitude_deg = 0.0;
  double bearing_deg = 90.0;       ///< of its axis, from foot to foot
  double width_deg = 40.0;         ///< angle between the feet, or angular width of the shell
  double speed_km_s = 500.0;       ///< of its front at age 0
  double acceleration_m_s2 = 0.0;  ///< of its front
  double start_height = 20.0;      ///< height of the front at age 0
  double age_s = 600.0;            ///< at time 0 of the scene's clock
  double aspect = 0.25;  ///< radius of the rope's top, or thickness of the shell, over the front's height
  double turns = 2.0;    ///< turns of a strand about the rope's axis, from foot to foot
  int strands = 60;
  double strand_radius = 0.1;    ///< fraction of the rope's local radius
  double density = 1.0;          ///< at age 0; it falls as the volume grows
  std::vector<double> rayleigh;  ///< as a loop's
  double temperature_mk = 0.0;
};

}  // namespace vegard::sim
