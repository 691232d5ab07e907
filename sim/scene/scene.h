// What is simulated and how it is seen: plain numbers, no behaviour.
//
// Every number a user can set is declared once more, with its unit, default, limits and meaning, in
// sim/scene/parameter_table.h, and nowhere else. Angles are in degrees unless the name says rad; lengths in
// km.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace vegard::sim {

/// A point or vector in the tangent plane of the observer: kilometres to the east and to the north.
struct EastNorth {
  double east = 0.0;
  double north = 0.0;
};

struct Site {
  double latitude_deg = 65.0;
  double longitude_deg = 0.0;
  double altitude_m = 0.0;
  std::string time_utc;  ///< ISO 8601, empty if unknown; goes into file headers, never the clock's time
};

/// The geomagnetic field, uniform over the scene and straight along every beam.
struct Field {
  double inclination_deg = 78.0;  ///< below the horizon in the north
  double declination_deg = 0.0;   ///< from north to the east
};

struct Camera {
  std::string model = "pinhole";
  int width = 720;
  int height = 480;
  double hfov_deg = 60.0;
  double azimuth_deg = 0.0;
  double elevation_deg = 30.0;
  double roll_deg = 0.0;
};

/// One sheet of precipitating electrons (rows B1-B7, B11-B16 of the source paper, docs/physics.md).
struct Sheet {
  std::string name = "main";
  EastNorth center_km{0.0, 200.0};  ///< of the line from start to end, at the foot's altitude of 110 km
  double bearing_deg = 90.0;        ///< from start to end, from north to the east
  double length_km = 400.0;         ///< from start to end (D)
  double thickness_km = 3.0;        ///< the amplitude w of the sine, as in the paper
  double wavelength_km = 60.0;      ///< of the sine
  double phase_rad = 0.0;           ///< of the first layer, counted from the start
  double phase_shift_rad = 0.5;     ///< between the first and the last layer
  int layers = 3;
  double width_km = 1.5;              ///< standard deviation of a layer's Gaussian cross-section
  int beams = 2000;                   ///< per layer
  double energy_kev = 3.0;            ///< Maxwellian characteristic energy E0
  double energy_flux_mw_m2 = 5.0;     ///< Q, the peak across a layer
  double path_spread = 0.0;           ///< random depth, fraction of the path (ΔL)
  double loss_cone_deg = 2.5;         ///< pitch angle at the lower end of the path (α_D)
  double pitch_step_rad = 0.015;      ///< reduction of the pitch angle along the path (Δα)
  std::string pitch_law = "reduced";  ///< the reading of equation (4)
  double path_step = 1.0 / 300.0;     ///< largest step between deflections, fraction of the path (d_t)
  double top_km = 500.0;              ///< altitude at which a beam starts
  double spacing_jitter = 0.5;        ///< of the beams along the arc, fraction of their spacing (j)
  std::string spacing_rule = "tied";  ///< "tied" (phase follows the jittered place) or "literal"
};

struct Emission {
  std::vector<double> lines = {630.0, 557.7, 427.8};  ///< wavelengths in nm
};

struct Blur {
  std::vector<double> width_deg = {0.43, 0.18,
                                   0.0};  ///< standard deviation per line, in the order of Emission::lines
  std::string kernel = "full";            ///< "full" (untruncated) or "paper" (truncated as in the paper)
};

struct Film {
  std::string splat = "bilinear";   ///< or "nearest", the paper's
  std::string weight = "rayleigh";  ///< or "unit": every point counts alike, the paper's forward map
};

struct Sensor {
  std::string primaries = "srgb";  ///< "srgb" or "smpte-c"
  double gain_per_kilorayleigh =
      0.05;  ///< linear sensor value (white = 1) of the luminance of 1 kR of 557.7 nm
};

/// Light behind the aurora, in linear sensor values per channel: level + gradient p + curvature (p^2 - 1/12),
/// where p runs from -1/2 at the top of the picture to 1/2 at its bottom.
struct Sky {
  std::array<double, 3> level{0.0, 0.0, 0.0};
  std::array<double, 3> gradient{0.0, 0.0, 0.0};
  std::array<double, 3> curvature{0.0, 0.0, 0.0};
};

struct Prior {
  double mean = 0.0;
  double sigma = 0.0;
};

/// One entry of fit.free as the user wrote it. A path to a vector stands for all its components.
struct FreeParameter {
  std::string path;
  std::optional<double> start, min, max;
  std::optional<Prior> prior;
  int line = 0;  ///< in the scene file, for messages
};

struct Fit {
  std::array<int, 4> roi_px{0, 0, 0, 0};  ///< x, y, width, height; all zero: the whole image
  int bands = 24;
  std::vector<FreeParameter> free;
  bool band_brightness = true;      ///< a brightness per band (rays are uneven), else one
  bool white_balance_known = true;  ///< else a gain per channel, and colour says nothing about E0
  int sky_terms = 3;                ///< solved per channel: 1 level, 2 and gradient, 3 and curvature
  std::string decoding = "auto";    ///< "auto", "srgb" or "linear"
  double model_error = 0.03;        ///< unmodelled structure, as a fraction of the local brightness
  int scan_points = 24;             ///< wavelengths tried before the descent; 0: no search, only a descent
  int scan_descents = 6;            ///< of which this many are followed downhill
};

struct Scene {
  std::uint64_t seed = 1;
  Site site;
  Field field;
  Camera camera;
  std::vector<Sheet> sheets;
  Emission emission;
  Blur blur;
  Film film;
  Sensor sensor;
  Sky sky;
  Fit fit;
  // For messages only: neither is written to an output, nor does a result depend on it.
  std::string file;                  ///< where it was read from
  std::map<std::string, int> lines;  ///< of the keys in that file, by path (sim/scene/line_of.h)
};

}  // namespace vegard::sim
