// The calibration of a counting camera: its dark level, flat field and filters, and for each filter the
// rayleighs per count and second. docs/rayleighs.md describes its file.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace vegard::fit {

/// The transmission of a filter for stars, compared with that for its emission line.
struct FilterBand {
  double line_nm = 0.0;  ///< the emission line whose rayleighs are meant
  /// A rectangular band, as high as the transmission at the line: its equivalent width.
  double centre_nm = 0.0, width_nm = 0.0;
  /// Relative standard uncertainty of the width.
  double width_error = 0.0;
  /// A measured curve instead of the rectangle, on any scale: at least two points with increasing
  /// wavelengths, linear between them and 0 beyond.
  std::vector<double> table_nm, transmission;
};

/// Returns the transmission of the measured curve; 1 or 0 for a rectangle.
double transmission_at(const FilterBand& band, double wavelength_nm);

/// Returns the photons cm^-2 s^-1 of a star above the air (sim/view/sky/star_flux.h) that would give as many
/// counts at the line's wavelength: the integral of its spectrum times the transmission, divided by the
/// transmission at the line.
double star_photons_in_band(const FilterBand& band, double magnitude, double colour_index);

/// Returns the mean wavelength of the band, at which a star's error and the air's extinction are evaluated.
double middle_of_band_nm(const FilterBand& band);

/// The rayleighs of the filter's line per count s^-1 above the dark level where the flat field is 1. They are
/// those below the air, without a correction for extinction.
struct RayleighFactor {
  double value = 0.0;
  double error = 0.0;  ///< standard uncertainty; 0: unknown
};

struct RayleighFilter {
  std::string name;
  int line = 0;  ///< line of its table in the file
  FilterBand band;
  std::string dark_file;  ///< a picture of as long an exposure; empty: dark_counts everywhere
  double dark_counts = 0.0, dark_error_counts = 0.0;
  std::string flat_file;    ///< empty: 1 everywhere
  double flat_error = 0.0;  ///< relative error of a pixel against the middle
  std::optional<double> gain_e_per_count;
  double read_noise_counts = 0.0;
  std::optional<double> exposure_s;  ///< used if neither the picture nor the command line gives it
  std::string channel;               ///< channel of a colour picture: "red", "green", "blue"
  std::optional<RayleighFactor> factor;
};

struct RayleighCamera {
  std::string file, name;
  std::vector<RayleighFilter> filters;  ///< at least one, each with a name of its own
};

/// Reads a camera's file; the files that it names lie beside it. Throws sim::Error(unreadable_input) if there
/// is no such file, and (scene) with file, line and key if it is invalid.
RayleighCamera read_rayleigh_camera(const std::string& file);

/// Returns the text of such a file. Throws sim::Error(unreadable_input).
std::string rayleigh_camera_text(const std::string& file);

/// Parses the text of a camera's file; `file` is for messages and gives the folder of the files that it
/// names.
RayleighCamera parse_rayleigh_camera(const std::string& text, const std::string& file);

/// Returns the filter with this name; a single filter also for an empty name. Throws sim::Error(usage) for an
/// unknown name.
const RayleighFilter& filter_called(const RayleighCamera& camera, const std::string& name);

/// Returns the text with the filter's factor and its error set, everything else unchanged. Throws
/// sim::Error(scene) if the filter's table is written in a single line, which cannot be changed.
std::string with_factor(const std::string& text, const std::string& file, const std::string& filter,
                        const RayleighFactor& factor);

}  // namespace vegard::fit
