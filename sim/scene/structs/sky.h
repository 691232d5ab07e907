// What else is in the picture: [sky], [air], [airglow], [twilight], [light_pollution], [stars], [moon],
// [ground], [composite].
#pragma once

#include <array>
#include <string>

namespace vegard::sim {

/// Light behind the aurora, in linear sensor values per channel: level + gradient p + curvature (p^2 - 1/12),
/// where p runs from -1/2 at the top of the picture to 1/2 at its bottom.
struct Sky {
  std::array<double, 3> level{0.0, 0.0, 0.0};
  std::array<double, 3> gradient{0.0, 0.0, 0.0};
  std::array<double, 3> curvature{0.0, 0.0, 0.0};
  double lights_gain = 1.0;  ///< factor on airglow, twilight and light pollution
};

enum class AirModel { none, standard };

/// The extinction of light in the lower atmosphere.
struct LowerAir {
  AirModel model = AirModel::none;
  double aerosol_optical_depth = 0.1;  ///< of the whole vertical column from sea level, at 550 nm
  double angstrom_exponent = 1.3;      ///< aerosol optical depth ~ wavelength^-angstrom_exponent
  double aerosol_height_km = 2.0;      ///< scale height
  double ozone_dobson = 300.0;
};

/// The airglow at the zenith, above the lower atmosphere; 0: none.
struct Airglow {
  double green_rayleigh = 0.0;   ///< 557.7 nm, at 97 km
  double red_rayleigh = 0.0;     ///< 630.0 nm, at 250 km
  double sodium_rayleigh = 0.0;  ///< 589.3 nm, at 92 km
};

/// The origin of the sun's position for twilight.
enum class TwilightSun {
  given,
  of_time  ///< computed for the site and its time
};

/// The scattered light of a sun below the horizon.
struct Twilight {
  bool shown = false;
  TwilightSun sun = TwilightSun::given;
  double sun_elevation_deg = -12.0;
  double sun_azimuth_deg = 0.0;
  double contrast = 10.0;  ///< luminance of the horizon below the sun over that of the zenith
};

/// The glow of a town beyond the horizon.
struct LightPollution {
  double luminance_mcd_m2 = 0.0;  ///< at the horizon towards the town; 0: none
  double azimuth_deg = 180.0;
  double height_deg = 12.0;  ///< at which it has fallen to 1 / e
  double spread_deg = 40.0;  ///< in azimuth, standard deviation
  double colour_temperature_k = 3000.0;
};

enum class StarSource {
  random,    ///< random, with the real number of stars per magnitude
  catalogue  ///< from a catalogue, for the site and its time
};

/// Stars, planets and the Milky Way behind the aurora.
struct Stars {
  bool shown = false;
  StarSource source = StarSource::random;
  bool planets = false;    ///< the naked-eye planets, at the site and its time
  bool milky_way = false;  ///< at the site and its time
  double faintest_magnitude = 6.5;
  double width_deg = 0.02;  ///< standard deviation of a star's image
  double gain = 1.0;        ///< factor on the photometric brightness
  /// Of a grid's: distance of the spheres by which it has the picture's stars, in distances of the Sun; 0:
  /// none.
  double sphere_distance = 0.0;
};

/// The Moon at the site and its time.
struct Moon {
  bool shown = false;     ///< its disc
  bool skylight = false;  ///< moonlight scattered by the air
};

/// The ground below the horizon, lit by everything above it.
struct Ground {
  bool shown = false;
  double albedo = 0.85;  ///< fresh snow: 0.8 to 0.9
};

/// Pictures behind and in front of the aurora, as files relative to the scene's file.
struct Composite {
  std::string background;        ///< empty: none
  double background_gain = 1.0;  ///< factor in linear light
  std::string foreground;        ///< empty: none
  double foreground_gain = 1.0;
  std::string mask;  ///< white where the foreground hides the sky; empty: the foreground's alpha
};

}  // namespace vegard::sim
