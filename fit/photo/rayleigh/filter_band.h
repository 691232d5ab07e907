// The transmission of a filter for stars, compared with that for its emission line.
#pragma once

#include <optional>
#include <vector>

namespace vegard::fit {

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

/// Photons cm^-2 s^-1 of a star above the air (sim/view/sky/star_photometry.h) as if they were all of the
/// line's wavelength: the integral of its spectrum times the transmission, over the transmission at the line.
double star_photons_in_band(const FilterBand& band, double magnitude, double colour_index);

/// The mean wavelength of the band, where a star's error and the air's extinction are taken.
double middle_of_band_nm(const FilterBand& band);

}  // namespace vegard::fit
