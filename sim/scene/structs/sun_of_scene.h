// The Sun of a scene and what stands on it: plain numbers, as in sim/scene/structs/scene.h (docs/corona.md).
//
// Lengths without a unit in their names are in units of `sun.unit_km`, a megametre unless a scene says
// otherwise. Places on the Sun are heliographic: latitude from the solar equator to the north, longitude to
// the west, counted from the meridian that `sun.longitude_deg` gives the middle of the disc.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace vegard::sim {

/// How what stands on the Sun turns about its axis as the scene's clock runs (sim/emit/sun/solar_rotation.h).
enum class SolarRotation {
  none,
  rigid,        ///< everything at Carrington's rate
  differential  ///< slower towards the poles, as the magnetic field of the surface is seen to turn
};

/// Against what the turning is counted.
enum class RotationFrame {
  synodic,  ///< the direction to the Earth, which goes round the Sun in a year
  sidereal  ///< the stars
};

/// Where the Sun stands in the sky, and its photosphere: a ball that shines and hides what is behind it.
struct Sun {
  bool shown = false;
  double azimuth_deg = 0.0, elevation_deg = 45.0;  ///< of its middle
  double distance_km = 149597870.7;
  double position_angle_deg = 0.0;  ///< by how much its north pole is turned anticlockwise in the picture
  double latitude_deg = 0.0;        ///< heliographic, of the middle of the disc (B0)
  double longitude_deg = 0.0;       ///< the same (L0)
  double unit_km = 1000.0;          ///< of its lengths
  double radius = 695.7;            ///< of the photosphere
  std::vector<double> photosphere_rayleigh;  ///< per line, at the middle of the disc; empty: it is dark
  /// Linear and quadratic law: I = 1 - u (1 - mu) - v (1 - mu)^2.
  double limb_darkening = 0.0, limb_darkening_square = 0.0;
  SolarRotation rotation = SolarRotation::none;  ///< longitudes are those at time 0 of the scene's clock
  RotationFrame rotation_frame = RotationFrame::synodic;
};

/// Noise between two concentric spheres: the source's CloudRegion, whose eleven numbers have its names.
struct Chromosphere {
  std::string name = "chromosphere";
  double innerradius = 695.7, outerradius = 705.7;
  double roughness = 0.5;  ///< height of an octave over that of the one before
  int octaves = 6;
  double scale = 20.0;                                      ///< length of the largest waves
  std::array<double, 3> shift{0.0, 0.0, 0.0};               ///< of the noise, in lengths of its largest waves
  double coverage = 0.2, sharpness = 5.0, amplitude = 1.0;  ///< of the cutoff
  std::string biasmap;           ///< a picture by latitude and longitude; empty: none
  double peak = 0.0;             ///< what is added where that picture is white
  bool cutoff = true;            ///< false: the turbulence as it is
  std::vector<double> rayleigh;  ///< per line: of density 1, to a unit of path; empty: dark
  double extinction = 0.0;       ///< of density 1, to a unit of path
  double step = 1.0;             ///< of the march
};

/// Density across a strand, q the distance from its middle over its radius.
enum class RadialFalloff {
  smooth,   ///< (1 - q²)²
  linear,   ///< 1 - q
  gaussian  ///< exp(-4.5 q²); all are 0 beyond q = 1
};

/// Density along a strand, by the height over its feet.
enum class HeightFalloff {
  none,
  grow,         ///< linearly
  fade,         ///< linearly
  logarithmic,  ///< it fades as the logarithm of the height
  inverse_square
};

/// A macro-loop: strands side by side over one pair of feet.
struct Loop {
  std::string name = "loop";
  double latitude_deg = 0.0, longitude_deg = 0.0;  ///< of the middle between its feet
  double bearing_deg = 90.0;           ///< from the first foot to the second, from north to the west
  double height = 60.0;                ///< of its top over the middle between the feet
  double width = 80.0;                 ///< from foot to foot
  double sharpness = 0.0;              ///< 0: rounded; 1: pointed, the control points meet over the middle
  double skew = 0.0;                   ///< by which the control points are moved across, against each other
  double tilt_deg = 0.0;               ///< of its plane from the vertical, to the right of the bearing
  double tilt_per_distance_deg = 0.0;  ///< by which a strand is tilted more to a unit of its distance
  int strands = 100;
  double spread = 10.0;        ///< strands stand up to so far across, to either side
  double strand_radius = 1.0;  ///< beyond which a strand gives no light
  RadialFalloff density_falloff = RadialFalloff::smooth;
  HeightFalloff height_falloff = HeightFalloff::none;
  double falloff_least = 0.0;  ///< of the height falloff, where it is least
  double base_density = 1.0;
  double root_noise = 0.0;    ///< standard deviation of the feet's places
  double height_noise = 0.0;  ///< of the height, a fraction of it
  double tilt_noise_deg = 0.0;
  double density_noise = 0.0;       ///< of the logarithm of a strand's density
  int filaments = 0;                ///< bunches near the top; 0: none
  double filament_pull = 0.7;       ///< of a strand's top towards its bunch's
  double brightening = 0.0;         ///< added at its place, over the density there
  double brightening_at = 1.0;      ///< its height, of the loop's
  double brightening_width = 0.15;  ///< standard deviation, of the loop's height
  std::vector<double> rayleigh;     ///< per line: of density 1, to a unit of path
  double temperature_mk = 0.0;      ///< if not 0, lines with a temperature response have it
  /// Of each strand, the mean time between the flares that heat it; 0: none, it shines steadily.
  double heating_interval_s = 0.0;
  double heating_temperature_mk = 10.0;  ///< to which a flare heats a strand
  double heating_density_cm3 = 1e9;      ///< its electrons when the flare comes
  double voxel = 0.0;                    ///< if not 0, it is rendered by a grid of this edge
  int blur = 0, sharpen = 0;             ///< how often that grid is blurred, and then sharpened
};

enum class CoronaLight {
  density,
  square,    ///< of the density
  scattered  ///< from the photosphere
};

/// The corona at large: density = sum of shares (r / R)^-power about the whole Sun.
struct Corona {
  std::string name = "corona";
  double density = 1.0;  ///< at the photosphere, where shares add up to 1
  std::vector<double> share{1.0};
  std::vector<double> power{6.0};
  double polar = 1.0;  ///< density over the poles, of that over the equator
  double reach = 5.0;  ///< where it ends, in radii of the photosphere
  CoronaLight light = CoronaLight::density;
  std::vector<double> rayleigh;  ///< per line: of density 1, to a unit of path
  double temperature_mk = 0.0;   ///< as a loop's
};

/// Straight bundles of lines that stand on the Sun: rays of the corona, streaks over the horizon.
struct Bundle {
  std::string name = "bundle";
  int count = 200;
  double length = 700.0;
  double gradient_deg = 0.0;        ///< of a line from the vertical, from its nearer pole to the equator
  double slope_noise_deg = 5.0;     ///< standard deviations of a line's slope,
  double position_noise_deg = 0.0;  ///< of its foot, off places spread evenly,
  double density_noise = 0.5;       ///< and of the logarithm of its density
  double density = 1.0;             ///< at a foot
  double falloff_length = 200.0;    ///< over which the density falls to 1 / e
  double foot_radius = 2.0, top_radius = 10.0;
  RadialFalloff density_falloff = RadialFalloff::gaussian;
  int filaments = 0;  ///< feet are drawn together to so many places; 0: none
  double filament_pull = 0.7;
  double lowest_latitude_deg = -90.0, highest_latitude_deg = 90.0;  ///< of feet
  double horizon_deg = 90.0;     ///< feet are at most so far from the limb, as the observer sees it
  std::vector<double> rayleigh;  ///< as a loop's
  double temperature_mk = 0.0;
};

enum class EjectionKind { rope, shell };

/// A mass ejection: an expanding flux rope of twisted strands, or a shell. Ours: the source only names it.
struct Ejection {
  std::string name = "ejection";
  EjectionKind kind = EjectionKind::rope;
  double latitude_deg = 0.0, longitude_deg = 0.0;
  double bearing_deg = 90.0;       ///< of its axis, from foot to foot
  double width_deg = 40.0;         ///< angle between the feet, or that the shell spans
  double speed_km_s = 500.0;       ///< of its front at age 0
  double acceleration_m_s2 = 0.0;  ///< of its front
  double start_height = 20.0;      ///< of the front at age 0
  double age_s = 600.0;            ///< at the time 0 of the scene's clock
  double aspect = 0.25;  ///< radius of the rope at its top, or thickness of the shell, of the front's height
  double turns = 2.0;    ///< of a strand about the rope's axis, from foot to foot
  int strands = 60;
  double strand_radius = 0.1;    ///< of the rope's radius at the same place
  double density = 1.0;          ///< at age 0; it falls as the volume grows
  std::vector<double> rayleigh;  ///< as a loop's
  double temperature_mk = 0.0;
};

}  // namespace vegard::sim
