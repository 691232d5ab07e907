// The calibration of a counting camera: its dark level, flat field and filters, and for each filter the
// rayleighs per count and second. docs/rayleighs.md describes its file.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace vegard::fit {

/// The transmission of a filter for stars, compared with that for its emission line.
struct FilterBand {
  double line_nm = 0.0;  ///< whose rayleighs are meant
  /// A rectangle as high as the filter is at the line: its integral over that transmission is its width.
  double centre_nm = 0.0, width_nm = 0.0;
  /// Relative standard uncertainty of that width.
  double width_error = 0.0;
  /// In its place a measured curve, on any scale, at least two rows with increasing wavelengths; straight
  /// between them and 0 beyond.
  std::vector<double> table_nm, transmission;
};

/// Of a measured curve; 1 or 0 of a rectangle.
double transmission_at(const FilterBand& band, double wavelength_nm);

/// Photons cm^-2 s^-1 of a star above the air (sim/view/sky/star_flux.h) as if they were all of the line's
/// wavelength: the integral of its spectrum times the transmission, over the transmission at the line.
double star_photons_in_band(const FilterBand& band, double magnitude, double colour_index);

/// The mean wavelength of the band, where a star's error and the air's extinction are taken.
double middle_of_band_nm(const FilterBand& band);

/// Rayleighs of the filter's line for one count per second above the dark level, where the flat field is 1,
/// below the air: what the camera gets, extinction not undone.
struct RayleighFactor {
  double value = 0.0;
  double error = 0.0;  ///< its standard uncertainty; 0: unknown
};

struct RayleighFilter {
  std::string name;
  int line = 0;  ///< of its table in the file
  FilterBand band;
  std::string dark_file;  ///< a picture of as long an exposure; empty: dark_counts everywhere
  double dark_counts = 0.0, dark_error_counts = 0.0;
  std::string flat_file;    ///< empty: 1 everywhere
  double flat_error = 0.0;  ///< relative, of a pixel against the middle
  std::optional<double> gain_e_per_count;
  double read_noise_counts = 0.0;
  std::optional<double> exposure_s;  ///< where neither the picture nor the command line gives it
  std::string channel;               ///< of a picture of colours: "red", "green", "blue"
  std::optional<RayleighFactor> factor;
};

struct RayleighCamera {
  std::string file, name;
  std::vector<RayleighFilter> filters;  ///< at least one, each with a name of its own
};

/// Files that it names stand beside it. Throws sim::Error(unreadable_input) if there is no such file, and
/// (scene) with file, line and key for what is no such camera.
RayleighCamera read_rayleigh_camera(const std::string& file);

/// All of such a file. Throws sim::Error(unreadable_input).
std::string rayleigh_camera_text(const std::string& file);

/// The same of a text; `file` is for messages and for the folder of what it names.
RayleighCamera parse_rayleigh_camera(const std::string& text, const std::string& file);

/// By its name; of one filter alone, with an empty name too. Throws sim::Error(usage) for another.
const RayleighFilter& filter_called(const RayleighCamera& camera, const std::string& name);

/// The same text with that filter's factor and its error in it, comments and all else as they were. Throws
/// sim::Error(scene) where the filter's table cannot be written in: one that is written in a single line.
std::string with_factor(const std::string& text, const std::string& file, const std::string& filter,
                        const RayleighFactor& factor);

}  // namespace vegard::fit
