// [fit]: how the scene is fitted to photographs.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/scene/structs/statistic_kinds.h"

namespace vegard::sim {

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

/// A radar's profile of electron density that is fitted beside the photographs. What is not set is left to
/// the file, or to the default that the key's row names (sim/scene/table/free_entry_keys.cpp).
struct RadarEntry {
  std::string name;  ///< name in results; default: the file's name without its extension
  std::string file;
  std::optional<double> beam, time_s;                 ///< which of the file's profiles
  std::optional<double> lowest_km, highest_km;        ///< altitudes that are compared
  std::optional<double> latitude_deg, longitude_deg;  ///< foot of the field line at 110 km
  std::optional<double> azimuth_deg, elevation_deg;   ///< or the beam, from its site
  std::optional<double> site_latitude_deg, site_longitude_deg, site_altitude_m;
  std::optional<double> scale_sigma;  ///< prior of the scale, whose mean is 1; none: it is 1
  std::optional<double> seconds;      ///< since the electrons have begun to fall; none: a steady state
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
  std::vector<RadarEntry> radars;
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

}  // namespace vegard::sim
