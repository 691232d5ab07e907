// The scene: all settings of what is simulated, how it is seen and how it is fitted. Data only, no behaviour.
//
// Each number that a user can set also has one row in sim/scene/rows or sim/scene/emitters, which declares
// its unit, limits and meaning. A member's unit is at the end of its name.
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
#include "sim/scene/structs/statistic_kinds.h"
#include "sim/scene/structs/sun_of_scene.h"
#include "sim/scene/structs/table_folder.h"
#include "sim/scene/structs/volumes_of_scene.h"

namespace vegard::sim {

enum class FieldModel {
  uniform,  ///< the same everywhere
  dipole,   ///< the direction of a tilted dipole's field at each foot
  igrf      ///< the direction of the IGRF at each foot, at the site's time
};

/// The geomagnetic field. Every beam has a straight field line with the field's direction at its foot.
struct Field {
  FieldModel model = FieldModel::uniform;
  double inclination_deg = 78.0;       ///< of the uniform field, below the horizon in the north
  double declination_deg = 0.0;        ///< of the uniform field, from north to the east
  double pole_latitude_deg = 80.65;    ///< of the dipole's pole in the north
  double pole_longitude_deg = -72.68;  ///< of the dipole's pole in the north, east positive
};

/// The times of pictures and animations on the scene's clock. A picture is the mean of its instants
/// start_s + k exposure_s / instants, k = 0 ... instants - 1.
struct Time {
  double start_s = 0.0;
  double exposure_s = 0.0;
  int instants = 1;
  double frames_per_second = 60.0;  ///< of an animation: frame n is at start_s + n lapse / frames_per_second
  int frames = 60;
  double lapse = 1.0;  ///< of an animation: seconds of the scene's clock per second of the animation
};

/// The brightness of all aurora during a substorm, as a factor on the brightness of the emitters.
struct Substorm {
  double quiet = 1.0;  ///< before the growth phase and after the recovery; 1: no substorm
  double grown = 0.3;  ///< at the end of the growth phase, when the expansion sets in
  double onset_s = 3600.0;
  double growth_s = 3600.0;
  double expansion_s = 1200.0;
  double recovery_s = 3600.0;
};

/// The projection of a lens (sim/view/camera/lens.h). The pinhole has Brown's distortion; the polynomial is
/// one in the angle off the axis. The last two are panoramas of all directions: a map by longitude and
/// latitude, and the six faces of a cube.
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

/// How a picture arranges the six faces of a cube (sim/view/camera/cube_map.h).
enum class CubeLayout {
  cross,  ///< four by three
  strip,  ///< six by one
  grid    ///< three by two
};

/// The geometry of a camera: its lens (sim/view/camera/lens.h), direction and picture size. The scale follows
/// from hfov_deg for a pinhole, from the picture's size for panoramas, and from focal_px for all others.
struct Camera {
  LensModel model = LensModel::pinhole;
  int width = 720;
  int height = 480;
  double hfov_deg = 60.0;    ///< of a pinhole without distortion, across the picture's width
  double focal_px = 300.0;   ///< of the other lenses: pixels per radian at the axis, horizontally
  double azimuth_deg = 0.0;  ///< of the lens's axis, the direction of the principal point
  double elevation_deg = 30.0;
  double roll_deg = 0.0;
  double principal_x_px = 0.0;  ///< of the principal point, to the right of the picture's middle
  double principal_y_px = 0.0;  ///< of the principal point, below the picture's middle
  double aspect = 1.0;          ///< vertical over horizontal scale
  bool mirrored = false;        ///< left and right are exchanged
  /// Radial terms. Pinhole: of r^2, r^4, r^6 (Brown, as in OpenCV); polynomial: of theta^2, theta^4, theta^6
  /// relative to the equidistant lens.
  double k1 = 0.0, k2 = 0.0, k3 = 0.0;
  double p1 = 0.0, p2 = 0.0;  ///< decentring terms, as in OpenCV
  /// Width and height of a pixel of the picture (width x height), in the pixels that focal_px and the
  /// principal point are given in. No key of a scene file; sim/view/camera/camera.h sets them.
  double pixel_width_px = 1.0, pixel_height_px = 1.0;
  CubeLayout cube_layout = CubeLayout::cross;  ///< of the model "cube"
};

/// One sheet of precipitating electrons, or several equal ones side by side (rows B1-B17, B28-B29 of
/// docs/physics.md).
struct Sheet {
  std::string name = "main";
  std::string form = "custom";      ///< the preset that its defaults come from
  EastNorth center_km{0.0, 200.0};  ///< middle of the line from start to end, at 110 km altitude
  double bearing_deg = 90.0;        ///< from start to end, clockwise from north
  double length_km = 400.0;         ///< from start to end (D)
  double thickness_km = 3.0;        ///< the amplitude w of the sine, as in the paper
  double wavelength_km = 60.0;      ///< of the sine
  double phase_rad = 0.0;           ///< of the first layer's sine at the start
  double phase_shift_rad = 0.5;     ///< between the first and the last layer
  SheetCourse course = SheetCourse::sine;
  std::vector<double> east_km, north_km;  ///< points of a curve in order, feet at 110 km
  std::vector<double> point_brightness;   ///< at the points, times energy_flux_mw_m2; empty: 1
  std::vector<double> point_energy_kev;   ///< at the points, in place of energy_kev; empty: energy_kev
  std::vector<double> point_width_km;     ///< at the points, in place of width_km; empty: width_km
  int layers = 3;
  double width_km = 1.5;                   ///< standard deviation of a layer's Gaussian cross-section
  int beams = 2000;                        ///< per layer
  double energy_kev = 3.0;                 ///< E0 of a Maxwellian, else the central energy
  double energy_flux_mw_m2 = 5.0;          ///< Q, maximum of a layer's cross-section
  double path_spread = 0.0;                ///< random variation of the depth, fraction of the path (ΔL)
  double loss_cone_deg = 2.5;              ///< pitch angle at the lower end of the path (α_D)
  double pitch_step_rad = 0.015;           ///< reduction of the pitch angle along the path (Δα)
  PitchLaw pitch_law = PitchLaw::reduced;  ///< interpretation of the paper's equation (4)
  double path_step = 1.0 / 300.0;          ///< largest step between deflections, fraction of the path (d_t)
  double top_km = 500.0;                   ///< altitude at which a beam starts
  double spacing_jitter = 0.5;             ///< of the beams along the arc, fraction of their spacing (j)
  SpacingRule spacing_rule = SpacingRule::stratified;
  double beams_per_km = 0.0;  ///< if not 0, the number of beams follows from the length, not from `beams`
  PathStepRule step_rule = PathStepRule::given;
  PathRule path_rule = PathRule::even;
  double points_per_px =
      0.0;  ///< render() adds beams where a layer has fewer deflection points per pixel; 0: never

  int arcs = 1;                  ///< number of equal sheets side by side
  double arc_spacing_km = 30.0;  ///< between them

  double brightness_kilorayleigh = 0.0;  ///< if not 0: of 557.7 nm along the field, replaces Q
  ProfileKind profile = ProfileKind::maxwellian;
  double energy_spread = 0.2;      ///< of a Gaussian spectrum: standard deviation over energy_kev
  std::string profile_file;        ///< CSV of a height profile, relative to the scene's file
  double peak_km = 110.0;          ///< altitude of the maximum of a form's light
  double lower_km = 4.0;           ///< distance below the peak at which a form's light has fallen to a tenth
  double upper_km = 20.0;          ///< distance above the peak at which a form's light has fallen to a tenth
  double spline_bottom_km = 80.0;  ///< lower end of a free-form profile, where it is 0
  double spline_top_km = 500.0;    ///< upper end of a free-form profile, where it is 0
  int spline_knots = 36;           ///< coefficients of a free-form profile per line
  /// Coefficients of a free-form profile, photons cm^-3 s^-1 per mW m^-2, [line][knot]
  /// (sim/scene/rows/spline_rates.h); empty for other profiles.
  std::vector<double> spline_rate;

  double fold_spacing_km = 0.0;      ///< mean distance of folds; 0: none
  double fold_spacing_jitter = 0.5;  ///< random shift of the folds, fraction of the spacing
  double fold_length_km = 8.0;       ///< length of the part of the sine that a fold replaces
  double fold_stage = 0.5;           ///< 0: ripple; 0.5: overhang; 1: horseshoe bend
  double fold_stage_spread = 0.5;    ///< largest random reduction of the stage, fraction of it
  double fold_speed_km_s = 0.0;
  double fold_lifetime_s = 0.0;  ///< 0: they last

  double curl_spacing_km = 0.0;  ///< mean distance of curls; 0: none
  double curl_radius_km = 1.0;
  double curl_turn_rad = 3.0;  ///< angle by which a curl has turned its centre
  double curl_gather = 0.5;    ///< relative spacing of the beams at the centre is 1 - curl_gather
  double curl_speed_km_s = 0.0;
  double curl_lifetime_s = 0.0;  ///< 0: they last

  double spiral_spacing_km = 0.0;  ///< mean distance of spirals; 0: none
  double spiral_radius_km = 25.0;
  double spiral_turn_rad = 6.0;  ///< angle by which a spiral has turned its centre
  double spiral_speed_km_s = 0.0;
  double spiral_lifetime_s = 0.0;  ///< 0: they last

  double ray_contrast = 0.0;         ///< standard deviation of ln(light) along the sheet
  double ray_width_km = 0.5;         ///< full width at half maximum of a ray
  double ray_length_contrast = 0.0;  ///< standard deviation of ln(height above the peak) of rays
  double ray_speed_km_s = 0.0;
  double ray_lifetime_s = 0.0;  ///< 0: they last

  double patch_size_km = 0.0;     ///< 0: no patches
  double patch_contrast = 1.0;    ///< standard deviation of ln(light)
  double patch_lifetime_s = 0.0;  ///< 0: they last

  double border_amplitude_km = 0.0;  ///< of the undulation of the lower border
  double border_scale_km = 20.0;     ///< length of the undulation's largest waves
  int border_octaves = 3;
  double border_lifetime_s = 0.0;  ///< 0: it lasts
  BorderRule border_rule = BorderRule::light;

  EastNorth drift_km_s{0.0, 0.0};  ///< of the whole sheet
  double sine_speed_km_s = 0.0;    ///< of the sine, from start to end
};

/// How the light depends on the energy flux.
enum class FluxLaw {
  column,  ///< by the column brightnesses of the emission tables
  linear   ///< proportional
};

/// The emission tables of a scene that names none.
inline const char* const kDefaultEmissionTables = "vegard";

/// Limits of Emission::oxygen_factor, and of the factors that emission tables cover.
inline constexpr double kMinOxygenFactor = 0.1, kMaxOxygenFactor = 10.0;

/// The delay between the electrons and the light that they excite.
enum class EmissionLag {
  lifetime,  ///< effective lifetimes of the excited atoms
  none       ///< no delay
};

struct Emission {
  std::vector<double> lines = {630.0, 557.7, 427.8};  ///< wavelengths in nm
  std::string tables = kDefaultEmissionTables;        ///< name of built-in tables, or a folder
  /// The text of that folder, read with the scene (sim/scene/table/emission_folder.h); null for built-in
  /// tables.
  std::shared_ptr<const TableFolder> folder;
  double oxygen_factor = 1.0;  ///< factor on the atomic oxygen of the tables' atmosphere
  FluxLaw flux_law = FluxLaw::column;
  EmissionLag lag = EmissionLag::lifetime;
  /// Factors on the light, [line][altitude] with the altitudes of a HeightProfile; empty: all 1. No key of a
  /// scene file: sim/render/slab_exposer.h sets them to render a part of a scene.
  std::vector<std::shared_ptr<const std::vector<float>>> altitude_share;
};

enum class BlurKernelKind {
  full,  ///< untruncated
  paper  ///< truncated as in the paper
};

enum class BlurModel {
  angle,    ///< Gaussian with a width per line
  physical  ///< diffusion and drift of the excited atoms before they shine
};

enum class BlurOrder {
  lines,  ///< blurs each line separately, before the colours
  rgb     ///< blurs red, green and blue, as in the paper
};

/// The origin of the widths of BlurModel::angle.
enum class BlurWidths {
  given,  ///< Blur::width_deg
  paper   ///< 4.75 and 2.0 pixels of a picture of 383 rows over 35 degrees
};

struct Blur {
  std::vector<double> width_deg = {0.43, 0.18,
                                   0.0};  ///< standard deviation per line, in the order of Emission::lines
  BlurKernelKind kernel = BlurKernelKind::full;
  BlurModel model = BlurModel::angle;
  BlurOrder order = BlurOrder::lines;
  BlurWidths widths = BlurWidths::given;
  EastNorth wind_m_s{0.0, 0.0};  ///< of the air, which carries the excited atoms
};

enum class SplatRule {
  bilinear,
  nearest  ///< as in the paper
};

enum class PointWeight {
  rayleigh,
  unit  ///< every point has weight 1, as in the paper's forward mapping
};

struct Film {
  SplatRule splat = SplatRule::bilinear;
  PointWeight weight = PointWeight::rayleigh;
};

enum class Primaries { srgb, smpte_c, rec2020, acescg };

/// Whether a table of a colour response is per energy or per photon.
enum class ResponsePer { energy, photon };

enum class WhiteBalanceRule {
  given,
  daylight  ///< D65 becomes neutral
};

/// The matrix from a camera's channels to the primaries.
enum class MatrixRule {
  none,          ///< identity
  colorimetric,  ///< least squares
  given
};

/// The origin of the gain from light to numbers.
enum class ExposureRule {
  gain,   ///< Sensor::gain_per_kilorayleigh
  camera  ///< from lens, pixel, exposure time and ISO
};

/// Colour filters of the upper left two by two pixels, row by row; none: all colours in every pixel.
enum class MosaicPattern { rggb, bggr, grbg, gbrg, none };

enum class ToneKind { srgb, linear, gamma, file };

/// How light becomes the numbers of a file (sim/view/sensor/sensor.h). The mosaic, bits, black_level, read
/// noise and dark current only affect renders with noise.
struct Sensor {
  Primaries primaries = Primaries::srgb;
  std::string response = "cie";  ///< the CIE 1931 observer, a built-in camera, or a table "FILE.csv"
  ResponsePer response_per = ResponsePer::energy;
  std::array<double, 3> white_balance{1.0, 1.0, 1.0};  ///< gains of a camera's raw channels
  WhiteBalanceRule white_balance_rule = WhiteBalanceRule::given;
  MatrixRule matrix_rule = MatrixRule::none;
  std::array<double, 9> matrix{1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};  ///< if given, row-major
  double gain_per_kilorayleigh =
      0.05;  ///< linear sensor value (white = 1) of the luminance of 1 kR of 557.7 nm
  ExposureRule exposure = ExposureRule::gain;
  // From here to the bits: ESTIMATED, a full-frame camera of about 2015 to a factor of two; data sheets by
  // EMVA 1288 give a camera's own.
  double f_number = 2.0;
  double lens_transmission = 0.85;
  double pixel_um = 6.0;             ///< edge of a square pixel
  double quantum_efficiency = 0.45;  ///< electrons per photon of 557.7 nm that reaches a green pixel
  double full_well_e = 50000.0;      ///< full well of a pixel; equals white at base_iso
  double iso = 1600.0;               ///< white is full_well_e base_iso / iso electrons
  double base_iso = 100.0;
  double read_noise_e = 3.0;  ///< standard deviation
  double dark_e_s = 0.1;      ///< dark current of a pixel
  double black_level = 0.03;  ///< number without light, fraction of the largest digital number
  int bits = 14;              ///< of the analogue-digital converter
  MosaicPattern mosaic = MosaicPattern::rggb;
  double vignetting_cos_power = 0.0;                ///< power of cos(angle off the axis); 4: simple lens
  std::array<double, 3> vignetting{0.0, 0.0, 0.0};  ///< terms of r^2, r^4, r^6, r = 1 in the corners
  ToneKind tone = ToneKind::srgb;
  double gamma = 2.2;
  std::string tone_file;              ///< CSV of linear and encoded values, relative to the scene's file
  std::string colour_table = "none";  ///< false colours of display files, by name or file
  double calibration_error = 0.0;     ///< relative error of the absolute scale; 0: not calibrated
};

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

/// The distribution of a prior.
enum class PriorLaw {
  normal,      ///< of the value
  log_normal,  ///< of ln(value), with mean ln(mean) and standard deviation sigma
  uniform      ///< between min and max, which must be given
};

/// What is known of a parameter before the fit.
struct Prior {
  double mean = 0.0;
  double sigma = 0.0;
  PriorLaw law = PriorLaw::normal;
};

/// The scale on which a fit varies a parameter.
enum class FreeScale {
  of_table,  ///< as declared in the parameter table
  linear,
  logarithmic
};

/// One entry of fit.free, as in the scene file. A path to a vector stands for all its components.
struct FreeParameter {
  std::string path;
  std::optional<double> start, min, max;
  std::optional<Prior> prior;
  int line = 0;  ///< in the scene file, for messages
  /// Name for the expressions of fit.tied; entries with the same name are one number. Empty: only the path.
  std::string name;
  FreeScale scale = FreeScale::of_table;
  std::string photo;  ///< name of the only photograph (of fit.photos) that has it; empty: all share it
};

/// A number that is computed from others: "sheet.b.energy_kev" = "0.8 * sheet.a.energy_kev".
struct TiedParameter {
  std::string path;
  std::string equals;  ///< an expression of paths and names of fit.free
  std::string photo;   ///< as in FreeParameter
  int line = 0;
};

/// One of several photographs that are fitted together.
struct PhotoEntry {
  std::string name;  ///< name for fit.free; default: the file's name without its extension
  std::string file, mask;
  std::string decoding;                                  ///< in place of fit.decoding; empty: fit.decoding
  std::vector<std::pair<std::string, std::string>> set;  ///< settings of this photograph: path and TOML text
  int line = 0;
};

enum class FitModel {
  expected,  ///< the mean over all draws of beams
  draws      ///< one draw
};

/// The direction of the intensity profiles that a fit compares.
enum class ProfileAlong {
  columns,
  elevation,
  field,
  loop,  ///< across a coronal loop
  limb   ///< away from the Sun's limb
};

enum class PhotoNoise {
  estimated,
  sensor  ///< from the settings in [sensor]
};

/// The robust loss function of single residuals.
enum class ResidualLoss { none, huber, cauchy };

struct Fit {
  std::array<int, 4> roi_px{0, 0, 0, 0};  ///< x, y, width, height; all zero: the whole image
  int bands = 24;
  int average_rows = 480;  ///< photographs are averaged, to no fewer rows in the region; 0: never
  std::vector<FreeParameter> free;
  std::vector<TiedParameter> tied;
  std::vector<PhotoEntry> photos;
  bool band_brightness = true;      ///< true: a gain per band, since rays are uneven; false: one gain
  bool white_balance_known = true;  ///< false: a gain per channel, so that colour does not constrain E0
  int sky_terms = 3;                ///< solved per channel: 1: level; 2: also gradient; 3: also curvature
  bool band_sky = false;            ///< true: a sky for each band, along its profile
  std::string decoding = "auto";    ///< a word of sim/scene/rows/decoding_word.h
  double model_error = 0.02;        ///< unmodelled structure, fraction of the local brightness
  double profile_smoothness =
      0.0;                     ///< of free-form profiles (fit/parameters/spline_prior.h); 0: from the data
  double ratio_spread = 0.0;   ///< prior: sigma of ln(lambda / (2 w)) outside the paper's range; 0: none
  int scan_points = 24;        ///< wavelengths tried before the descents; 0: one descent from the start
  int scan_descents = 6;       ///< number of the best trials from which a descent starts
  int overall_trials = 48;     ///< trials of distance, energy and bearing before the wavelengths
  int polish_descents = 2;     ///< best ends of descents that are refined with all beams
  double search_beams = 0.25;  ///< share of the beams in the search
  double search_smoothing = 0.025;  ///< of profiles in the search, fraction of the region's height

  StatisticWeights weight;
  FitModel model = FitModel::expected;
  ProfileAlong profile_along = ProfileAlong::columns;
  std::vector<double> guide_x_px, guide_y_px;     ///< for profiles across a loop: points along the loop
  double guide_half_width_px = 20.0;              ///< length of such a profile on either side
  double guide_cell_px = 1.0;                     ///< step of such a profile
  double limb_lowest = 1.02, limb_highest = 2.0;  ///< range of profiles above the Sun's limb, in solar radii
  double limb_step = 0.02;
  int horizontal_strips = 4;
  int image_cell_px = 16;

  PhotoNoise photo_noise = PhotoNoise::estimated;
  ResidualLoss loss = ResidualLoss::none;
  double loss_sigma = 3.0;  ///< residuals beyond this many standard deviations have less weight
};

struct Scene {
  // Defaulted in scene.cpp: here, every file that uses a scene would compile them again.
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
  /// Elements of the kinds of emitters that a program adds (sim/scene/emitters/emitter_kinds.h), by the name
  /// of their table: each a std::vector of the kind's struct.
  std::map<std::string, std::any> added;
  // No output contains the next two, and no result depends on them.
  std::string file;                  ///< the file that the scene was read from
  std::map<std::string, int> lines;  ///< line of each key in that file, by path (sim/scene/structs/line_of.h)
  /// Texts of the tables that the scene names as files, by the path of the key
  /// (sim/scene/table/table_files.h).
  std::map<std::string, std::string> tables;
};

}  // namespace vegard::sim
