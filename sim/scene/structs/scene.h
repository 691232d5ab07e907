// What is simulated and how it is seen: plain numbers, no behaviour.
//
// Every number a user can set is declared once more, with its unit, default, limits and meaning, in
// a row of sim/scene/rows or sim/scene/emitters, and nowhere else. Angles are in degrees unless the name says
// rad; lengths in km.
#pragma once

#include <any>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/base/number/vec3.h"
#include "sim/scene/structs/body.h"
#include "sim/scene/structs/own_line.h"
#include "sim/scene/structs/sheet_kinds.h"
#include "sim/scene/structs/site.h"
#include "sim/scene/structs/sun_of_scene.h"
#include "sim/scene/structs/table_folder.h"
#include "sim/scene/structs/volumes_of_scene.h"

namespace vegard::sim {

enum class FieldModel {
  uniform,  ///< the same everywhere
  dipole,   ///< that of a tilted dipole at each foot
  igrf      ///< that of the International Geomagnetic Reference Field at each foot, at the site's time
};

/// The geomagnetic field, straight along every beam: the same everywhere, or that of a tilted dipole or of
/// the reference field at each foot.
struct Field {
  FieldModel model = FieldModel::uniform;
  double inclination_deg = 78.0;       ///< of the uniform field, below the horizon in the north
  double declination_deg = 0.0;        ///< of the uniform field, from north to the east
  double pole_latitude_deg = 80.65;    ///< of the dipole's pole in the north
  double pole_longitude_deg = -72.68;  ///< of the same, east positive
};

/// When a picture is taken, on the scene's own clock. An exposure is the mean of its instants,
/// start_s + k exposure_s / instants.
struct Time {
  double start_s = 0.0;
  double exposure_s = 0.0;
  int instants = 1;
  double frames_per_second = 60.0;  ///< of an animation: its frame n is at start_s + n lapse / this
  int frames = 60;
  double lapse = 1.0;  ///< of an animation: seconds of the scene's clock to one of its own
};

/// The brightness of all aurora over a substorm, as a fraction of what its emitters say.
struct Substorm {
  double quiet = 1.0;  ///< before the growth phase and after the recovery; 1: no substorm
  double grown = 0.3;  ///< at the end of the growth phase, when the expansion sets in
  double onset_s = 3600.0;
  double growth_s = 3600.0;
  double expansion_s = 1200.0;
  double recovery_s = 3600.0;
};

/// The projection of a lens: a pinhole with Brown's distortion, a polynomial with terms of the angle off the
/// axis (sim/view/camera/lens.h); and the panoramas that hold all directions, a map by longitude and latitude
/// or the six faces of a cube.
enum class LensModel {
  pinhole,
  equidistant,
  equisolid,
  stereographic,
  orthographic,
  polynomial,
  equirectangular,
  cube
};

/// How a picture holds the six faces of a cube (sim/view/camera/cube_map.h).
enum class CubeLayout {
  cross,  ///< four by three
  strip,  ///< six by one
  grid    ///< three by two
};

/// A camera: a lens (sim/view/camera/lens.h) before pixels. Each lens has its own measure of scale: a pinhole
/// its field of view, panoramas the picture's size, all others focal_px.
struct Camera {
  LensModel model = LensModel::pinhole;
  int width = 720;
  int height = 480;
  double hfov_deg = 60.0;    ///< of a pinhole without distortion, across the picture's width
  double focal_px = 300.0;   ///< of the other lenses: pixels to a radian on the axis, across the picture
  double azimuth_deg = 0.0;  ///< of the lens's axis, which the principal point looks along
  double elevation_deg = 30.0;
  double roll_deg = 0.0;
  double principal_x_px = 0.0;  ///< of the principal point, to the right of the picture's middle
  double principal_y_px = 0.0;  ///< and below it
  double aspect = 1.0;          ///< scale down the picture over scale across it
  bool mirrored = false;        ///< left and right are exchanged
  /// Radial terms. Pinhole: of r^2, r^4, r^6 (Brown, as OpenCV has them); polynomial: of theta^2, theta^4,
  /// theta^6 over the equidistant lens.
  double k1 = 0.0, k2 = 0.0, k3 = 0.0;
  double p1 = 0.0, p2 = 0.0;  ///< decentring terms, as OpenCV has them
  /// How many of those pixels that focal_px and the principal point are in a pixel of the picture (width by
  /// height) is wide and high. No file says so: sim/view/camera/scaled_camera.h does.
  double pixel_width_px = 1.0, pixel_height_px = 1.0;
  CubeLayout cube_layout = CubeLayout::cross;  ///< of the model "cube"
};

/// One sheet of precipitating electrons, or a system of like ones side by side (rows B1-B17, B28-B29 of the
/// source paper, docs/physics.md).
struct Sheet {
  std::string name = "main";
  std::string form = "custom";      ///< the preset that its defaults come from
  EastNorth center_km{0.0, 200.0};  ///< of the line from start to end, at the foot's altitude of 110 km
  double bearing_deg = 90.0;        ///< from start to end, from north to the east
  double length_km = 400.0;         ///< from start to end (D)
  double thickness_km = 3.0;        ///< the amplitude w of the sine, as in the paper
  double wavelength_km = 60.0;      ///< of the sine
  double phase_rad = 0.0;           ///< of the first layer, counted from the start
  double phase_shift_rad = 0.5;     ///< between the first and the last layer
  SheetCourse course = SheetCourse::sine;
  std::vector<double> east_km, north_km;  ///< points of a curve in order, feet at 110 km
  std::vector<double> point_brightness;   ///< at the points, times energy_flux_mw_m2; empty: 1
  std::vector<double> point_energy_kev;   ///< at the points, in place of energy_kev; empty: that
  std::vector<double> point_width_km;     ///< at the points, in place of width_km; empty: that
  int layers = 3;
  double width_km = 1.5;                   ///< standard deviation of a layer's Gaussian cross-section
  int beams = 2000;                        ///< per layer
  double energy_kev = 3.0;                 ///< Maxwellian E0, or the energy of others
  double energy_flux_mw_m2 = 5.0;          ///< Q, the peak across a layer
  double path_spread = 0.0;                ///< random depth, fraction of the path (ΔL)
  double loss_cone_deg = 2.5;              ///< pitch angle at the lower end of the path (α_D)
  double pitch_step_rad = 0.015;           ///< reduction of the pitch angle along the path (Δα)
  PitchLaw pitch_law = PitchLaw::reduced;  ///< the reading of equation (4)
  double path_step = 1.0 / 300.0;          ///< largest step between deflections, fraction of the path (d_t)
  double top_km = 500.0;                   ///< altitude at which a beam starts
  double spacing_jitter = 0.5;             ///< of the beams along the arc, fraction of their spacing (j)
  SpacingRule spacing_rule = SpacingRule::stratified;
  double beams_per_km = 0.0;  ///< if not 0, the number of beams follows from the length
  PathStepRule step_rule = PathStepRule::given;
  PathRule path_rule = PathRule::even;
  double points_per_px =
      0.0;  ///< render() draws more beams where a layer has fewer deflection points a pixel

  int arcs = 1;                  ///< like sheets side by side
  double arc_spacing_km = 30.0;  ///< between them

  double brightness_kilorayleigh = 0.0;  ///< if not 0, of 557.7 nm along the field, in place of Q
  ProfileKind profile = ProfileKind::maxwellian;
  double energy_spread = 0.2;      ///< of a Gaussian spectrum: standard deviation over energy_kev
  std::string profile_file;        ///< CSV of a drawn or measured profile, beside the scene's file
  double peak_km = 110.0;          ///< of a form's light
  double lower_km = 4.0;           ///< below the peak a form's light has fallen to a tenth
  double upper_km = 20.0;          ///< above the peak a form's light has fallen to a tenth
  double spline_bottom_km = 80.0;  ///< where a free-form profile begins, dark
  double spline_top_km = 500.0;    ///< and ends, dark
  int spline_knots = 36;           ///< its coefficients per line
  /// Photons cm^-3 s^-1 per mW m^-2, [line][knot] (sim/scene/rows/spline_rates.h); empty without such a
  /// profile.
  std::vector<double> spline_rate;

  double fold_spacing_km = 0.0;      ///< mean distance of folds; 0: none
  double fold_spacing_jitter = 0.5;  ///< of their places, fraction of the spacing
  double fold_length_km = 8.0;       ///< of the sine that a fold replaces
  double fold_stage = 0.5;           ///< from 0, a ripple, by the overhang to 1, a horseshoe bend
  double fold_stage_spread = 0.5;    ///< how much less far gone the folds may be, fraction of the stage
  double fold_speed_km_s = 0.0;
  double fold_lifetime_s = 0.0;  ///< 0: they last

  double curl_spacing_km = 0.0;  ///< mean distance of curls; 0: none
  double curl_radius_km = 1.0;
  double curl_turn_rad = 3.0;  ///< by which a curl has wound its centre up
  double curl_gather = 0.5;  ///< how close together its beams stand: 1 - this is their spacing at the centre
  double curl_speed_km_s = 0.0;
  double curl_lifetime_s = 0.0;  ///< 0: they last

  double spiral_spacing_km = 0.0;  ///< mean distance of spirals; 0: none
  double spiral_radius_km = 25.0;
  double spiral_turn_rad = 6.0;  ///< by which a spiral has wound its centre up
  double spiral_speed_km_s = 0.0;
  double spiral_lifetime_s = 0.0;  ///< 0: they last

  double ray_contrast = 0.0;         ///< standard deviation of the logarithm of the light along the sheet
  double ray_width_km = 0.5;         ///< full width of a ray at half its height
  double ray_length_contrast = 0.0;  ///< standard deviation of the logarithm of a ray's height above the peak
  double ray_speed_km_s = 0.0;
  double ray_lifetime_s = 0.0;  ///< 0: they last

  double patch_size_km = 0.0;     ///< 0: no patches
  double patch_contrast = 1.0;    ///< standard deviation of the logarithm of the light
  double patch_lifetime_s = 0.0;  ///< 0: they last

  double border_amplitude_km = 0.0;  ///< of the undulation of the lower border
  double border_scale_km = 20.0;     ///< of its largest waves
  int border_octaves = 3;
  double border_lifetime_s = 0.0;  ///< 0: it lasts
  BorderRule border_rule = BorderRule::light;

  EastNorth drift_km_s{0.0, 0.0};  ///< of the whole sheet
  double sine_speed_km_s = 0.0;    ///< of the sine along the sheet
};

/// Light by energy flux.
enum class FluxLaw {
  column,  ///< as GLOW's columns have it
  linear
};

/// The emission tables of a scene that names none.
inline const char* const kDefaultEmissionTables = "vegard";

/// Limits of Emission::oxygen_factor, and of the factors that tables are made for.
inline constexpr double kMinOxygenFactor = 0.1, kMaxOxygenFactor = 10.0;

/// When light is seen of the electrons that excite it.
enum class EmissionLag {
  lifetime,  ///< after the atoms' effective lifetimes
  none       ///< at once
};

struct Emission {
  std::vector<double> lines = {630.0, 557.7, 427.8};  ///< wavelengths in nm
  std::string tables = kDefaultEmissionTables;        ///< that come with the program, or a folder
  /// The text of that folder, read with the scene (sim/scene/table/emission_folder.h); null for the
  /// program's.
  std::shared_ptr<const TableFolder> folder;
  double oxygen_factor = 1.0;  ///< of the atomic oxygen that the tables are made for
  FluxLaw flux_law = FluxLaw::column;
  EmissionLag lag = EmissionLag::lifetime;
  /// What counts of each line, by altitude as in a HeightProfile; empty: all of it. No key of a scene file:
  /// of a scene that is a part of another (sim/render/slab_exposer.h).
  std::vector<std::shared_ptr<const std::vector<float>>> altitude_share;
};

enum class BlurKernelKind {
  full,  ///< untruncated
  paper  ///< truncated as in the paper
};

enum class BlurModel {
  angle,    ///< by a width per line
  physical  ///< the way of the excited atoms
};

enum class BlurOrder {
  lines,  ///< each line by itself, before colour
  rgb     ///< red, green and blue, as in the paper
};

/// Where the widths of the model "angle" come from.
enum class BlurWidths {
  given,  ///< width_deg
  paper   ///< 4.75 and 2.0 pixels of a picture of 383 rows over 35 degrees
};

struct Blur {
  std::vector<double> width_deg = {0.43, 0.18,
                                   0.0};  ///< standard deviation per line, in the order of Emission::lines
  BlurKernelKind kernel = BlurKernelKind::full;
  BlurModel model = BlurModel::angle;
  BlurOrder order = BlurOrder::lines;
  BlurWidths widths = BlurWidths::given;
  EastNorth wind_m_s{0.0, 0.0};  ///< of the air, that carries them
};

enum class SplatRule {
  bilinear,
  nearest  ///< the paper's
};

enum class PointWeight {
  rayleigh,
  unit  ///< every point counts alike, the paper's forward map
};

struct Film {
  SplatRule splat = SplatRule::bilinear;
  PointWeight weight = PointWeight::rayleigh;
};

enum class Primaries { srgb, smpte_c, rec2020, acescg };

/// What the numbers of a response's table are relative to.
enum class ResponsePer { energy, photon };

enum class WhiteBalanceRule {
  given,
  daylight  ///< D65 becomes neutral
};

/// From a camera's channels to the primaries.
enum class MatrixRule {
  none,          ///< they stay as they are
  colorimetric,  ///< least squares
  given
};

/// Where the gain comes from.
enum class ExposureRule {
  gain,   ///< it is given
  camera  ///< it follows from lens, pixel, time and ISO
};

/// Filters of the upper left two by two pixels, row by row.
enum class MosaicPattern { rggb, bggr, grbg, gbrg, none };

enum class ToneKind { srgb, linear, gamma, file };

/// From light to the numbers of a file (sim/view/sensor/sensor.h). Renders without noise know the primaries,
/// the exposure, the vignetting and the tone curve only.
struct Sensor {
  Primaries primaries = Primaries::srgb;
  std::string response = "cie";  ///< the CIE 1931 observer, a built-in camera, or a table "FILE.csv"
  ResponsePer response_per = ResponsePer::energy;
  std::array<double, 3> white_balance{1.0, 1.0, 1.0};  ///< gains of a camera's raw channels
  WhiteBalanceRule white_balance_rule = WhiteBalanceRule::given;
  MatrixRule matrix_rule = MatrixRule::none;
  std::array<double, 9> matrix{1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};  ///< the given one, by rows
  double gain_per_kilorayleigh =
      0.05;  ///< linear sensor value (white = 1) of the luminance of 1 kR of 557.7 nm
  ExposureRule exposure = ExposureRule::gain;
  double f_number = 2.0;
  double lens_transmission = 0.85;
  double pixel_um = 6.0;             ///< edge of a square pixel
  double quantum_efficiency = 0.45;  ///< electrons per photon of 557.7 nm that reaches a green pixel
  double full_well_e = 50000.0;      ///< what a pixel holds, and white at base_iso
  double iso = 1600.0;               ///< white is full_well_e base_iso / iso electrons
  double base_iso = 100.0;
  double read_noise_e = 3.0;  ///< standard deviation
  double dark_e_s = 0.1;      ///< dark current of a pixel
  double black_level = 0.03;  ///< fraction of the largest digital number
  int bits = 14;              ///< of the analogue-digital converter
  MosaicPattern mosaic = MosaicPattern::rggb;
  double vignetting_cos_power = 0.0;                ///< of the angle off the axis; 4: a simple lens
  std::array<double, 3> vignetting{0.0, 0.0, 0.0};  ///< of r^2, r^4, r^6, r = 1 in the corners
  ToneKind tone = ToneKind::srgb;
  double gamma = 2.2;
  std::string tone_file;              ///< CSV of linear and encoded values, beside the scene's file
  std::string colour_table = "none";  ///< of display files: a false colour for grey, by name or file
  double calibration_error = 0.0;     ///< relative, of the absolute scale; 0: not calibrated
};

/// Light behind the aurora, in linear sensor values per channel: level + gradient p + curvature (p^2 - 1/12),
/// where p runs from -1/2 at the top of the picture to 1/2 at its bottom.
struct Sky {
  std::array<double, 3> level{0.0, 0.0, 0.0};
  std::array<double, 3> gradient{0.0, 0.0, 0.0};
  std::array<double, 3> curvature{0.0, 0.0, 0.0};
  double lights_gain = 1.0;  ///< times airglow, twilight and light pollution
};

enum class AirModel { none, standard };

/// What light loses on its way through the lower atmosphere.
struct LowerAir {
  AirModel model = AirModel::none;
  double aerosol_optical_depth = 0.1;  ///< of the whole vertical column from sea level, at 550 nm
  double angstrom_exponent = 1.3;      ///< of the aerosol's optical depth against wavelength
  double aerosol_height_km = 2.0;      ///< scale height
  double ozone_dobson = 300.0;
};

/// The night sky's own light at the zenith, above the air, in rayleighs; 0: none.
struct Airglow {
  double green_rayleigh = 0.0;   ///< 557.7 nm, at 97 km
  double red_rayleigh = 0.0;     ///< 630.0 nm, at 250 km
  double sodium_rayleigh = 0.0;  ///< 589.3 nm, at 92 km
};

/// Where the sun of the twilight stands.
enum class TwilightSun {
  given,
  of_time  ///< as at the site and its time
};

/// The scattered light of a sun below the horizon.
struct Twilight {
  bool shown = false;
  TwilightSun sun = TwilightSun::given;
  double sun_elevation_deg = -12.0;
  double sun_azimuth_deg = 0.0;
  double contrast = 10.0;  ///< of the horizon under the sun to the zenith
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
  random,    ///< as many of each magnitude as the sky has
  catalogue  ///< those of the site and its time
};

/// Stars behind the aurora, and what else of the sky is fixed among them or wanders.
struct Stars {
  bool shown = false;
  StarSource source = StarSource::random;
  bool planets = false;    ///< those that the eye sees, at the site and its time
  bool milky_way = false;  ///< likewise
  double faintest_magnitude = 6.5;
  double width_deg = 0.02;  ///< standard deviation of a star's image
  double gain = 1.0;        ///< times its photometric brightness
};

/// The Moon at the site and its time.
struct Moon {
  bool shown = false;     ///< its disc
  bool skylight = false;  ///< what of its light the air scatters
};

/// The ground below the horizon, in the light of all that the scene has above it.
struct Ground {
  bool shown = false;
  double albedo = 0.85;  ///< 0.8 to 0.9 is fresh snow's
};

/// Pictures behind and before the aurora, by file, beside the scene's.
struct Composite {
  std::string background;        ///< empty: none
  double background_gain = 1.0;  ///< in linear light
  std::string foreground;        ///< empty: none
  double foreground_gain = 1.0;
  std::string mask;  ///< white where the foreground hides the sky; empty: the foreground's alpha
};

/// How a number is distributed, as far as it is known beforehand.
enum class PriorLaw {
  normal,      ///< of the value
  log_normal,  ///< of ln(value), about ln(mean), sigma a fraction
  uniform      ///< anywhere between the limits, which must be given
};

/// What is known of a number beforehand.
struct Prior {
  double mean = 0.0;
  double sigma = 0.0;
  PriorLaw law = PriorLaw::normal;
};

/// On which scale a fit moves a number.
enum class FreeScale {
  of_table,  ///< the parameter's own
  linear,
  logarithmic
};

/// One entry of fit.free as the user wrote it. A path to a vector stands for all its components.
struct FreeParameter {
  std::string path;
  std::optional<double> start, min, max;
  std::optional<Prior> prior;
  int line = 0;  ///< in the scene file, for messages
  /// By which expressions of fit.tied call it; entries of one name are one number. Empty: by its path only.
  std::string name;
  FreeScale scale = FreeScale::of_table;
  std::string photo;  ///< the photograph that it belongs to alone, one of fit.photos; empty: shared by all
};

/// A number that follows from free ones: "sheet.b.energy_kev" = "0.8 * sheet.a.energy_kev".
struct TiedParameter {
  std::string path;
  std::string equals;  ///< an expression of paths and names of fit.free
  std::string photo;   ///< as in FreeParameter
  int line = 0;
};

/// One of several photographs that are fitted together.
struct PhotoEntry {
  std::string name;  ///< by which fit.free calls it; the file's name without its ending if not given
  std::string file, mask;
  std::string decoding;                                  ///< in place of fit.decoding; empty: that
  std::vector<std::pair<std::string, std::string>> set;  ///< path and TOML text of what it alone has
  int line = 0;
};

enum class FitModel {
  expected,  ///< the mean over all draws of beams
  draws      ///< one draw
};

enum class ProfileAlong {
  columns,
  elevation,
  field,
  loop,  ///< across a loop
  limb   ///< away from the Sun's
};

enum class PhotoNoise {
  estimated,
  sensor  ///< what [sensor] says
};

/// Of single residuals.
enum class ResidualLoss { none, huber, cauchy };

struct Fit {
  std::array<int, 4> roi_px{0, 0, 0, 0};  ///< x, y, width, height; all zero: the whole image
  int bands = 24;
  int average_rows = 480;  ///< photographs are averaged to at least so many in the region; 0: never
  std::vector<FreeParameter> free;
  std::vector<TiedParameter> tied;
  std::vector<PhotoEntry> photos;
  bool band_brightness = true;      ///< a brightness per band (rays are uneven), else one
  bool white_balance_known = true;  ///< else a gain per channel, and colour says nothing about E0
  int sky_terms = 3;                ///< solved per channel: 1 level, 2 and gradient, 3 and curvature
  bool band_sky = false;            ///< of every band by itself, along its profile
  std::string decoding = "auto";    ///< "auto", "srgb", "linear" or "sensor"
  double model_error = 0.02;        ///< unmodelled structure, as a fraction of the local brightness
  double profile_smoothness =
      0.0;                     ///< of free-form profiles (fit/parameters/spline_prior.h); 0: the data decide
  double ratio_spread = 0.0;   ///< how far lambda / (2 w) may leave the paper's range, in ln; 0: at will
  int scan_points = 24;        ///< wavelengths tried before the descent; 0: no search, only a descent
  int scan_descents = 6;       ///< of which this many are followed downhill
  int overall_trials = 48;     ///< of distance, energy and bearing before that
  int polish_descents = 2;     ///< ends of descents that are polished with the full model
  double search_beams = 0.25;  ///< share of the beams in the search
  double search_smoothing = 0.025;  ///< of profiles in the search, as a fraction of the region's height

  // What is compared: weights of the statistics in chi2, 0: not at all (fit/compare/statistic.h).
  double profile_weight = 1.0;      ///< intensity along columns, elevation or the field line
  double colour_weight = 0.0;       ///< log ratios of the channels along the same
  double horizontal_weight = 0.0;   ///< intensity across the picture in a few strips
  double border_weight = 0.0;       ///< the lower border's course from band to band
  double image_weight = 0.0;        ///< a low-resolution image
  double texture_weight = 0.0;      ///< autocovariance along the arc: ray spacing and contrast
  double granulation_weight = 0.0;  ///< angular power spectrum of the light on a disc
  FitModel model = FitModel::expected;
  ProfileAlong profile_along = ProfileAlong::columns;
  std::vector<double> guide_x_px, guide_y_px;     ///< of profiles across a loop: points drawn along it
  double guide_half_width_px = 20.0;              ///< how far such a profile reaches to either side
  double guide_cell_px = 1.0;                     ///< from position to position across
  double limb_lowest = 1.02, limb_highest = 2.0;  ///< of profiles above the Sun's limb, in its radii
  double limb_step = 0.02;
  int horizontal_strips = 4;
  int image_cell_px = 16;

  PhotoNoise photo_noise = PhotoNoise::estimated;
  ResidualLoss loss = ResidualLoss::none;
  double loss_sigma = 3.0;  ///< from where on a residual counts less
};

struct Scene {
  // In scene.cpp, as they would be made here: every file that has a scene would compile them again.
  Scene();
  Scene(const Scene& other);
  Scene(Scene&& other) noexcept;
  Scene& operator=(const Scene& other);
  Scene& operator=(Scene&& other) noexcept;
  ~Scene();

  std::uint64_t seed = 1;
  Body body;
  Site site;
  Field field;
  Camera camera;
  std::vector<Sheet> sheets;
  std::vector<Footprint> footprints;
  std::vector<Nebula> nebulae;
  std::vector<Node> nodes;
  std::vector<Volume> volumes;
  Sun sun;
  std::vector<Chromosphere> chromospheres;
  std::vector<Loop> loops;
  std::vector<Corona> coronae;
  std::vector<Bundle> bundles;
  std::vector<Ejection> ejections;
  March march;
  std::vector<OwnLine> own_lines;
  Emission emission;
  Blur blur;
  Film film;
  Sensor sensor;
  Sky sky;
  LowerAir air;
  Airglow airglow;
  Twilight twilight;
  LightPollution light_pollution;
  Stars stars;
  Moon moon;
  Ground ground;
  Composite composite;
  Time time;
  Substorm substorm;
  Fit fit;
  /// Elements of kinds of emitters that a program has added to those here (sim/scene/emitters/
  /// emitter_kinds.h): a std::vector of the kind's struct, by its table.
  std::map<std::string, std::any> added;
  // Neither of these two is written to an output, nor does a result depend on it.
  std::string file;                  ///< where it was read from
  std::map<std::string, int> lines;  ///< of the keys in that file, by path (sim/scene/structs/line_of.h)
  /// The text of the tables that the scene names as files, by the key's path (sim/scene/table/table_files.h).
  std::map<std::string, std::string> tables;
};

}  // namespace vegard::sim
