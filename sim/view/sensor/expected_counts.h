// The absolute scale: what a camera records of a kilorayleigh, and how sure one can be of it.
//
// Electrons of a pixel: rayleighs times pixel_photons_s_per_rayleigh() (sim/view/colour/radiometry.h) times
// the exposure time and the quantum efficiency; digital numbers by the electrons at white, full_well_e
// base_iso / iso. Uncertainties are standard ones, in quadrature (JCGM 100:2008, "GUM", 5.1.2, for a product
// of independent factors; a range without a preferred value counts as half its width / sqrt(3), 4.3.7).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/scene/structs/scene.h"
#include "sim/view/colour/colour.h"

namespace vegard::sim {

/// One reason why a count may be off by a factor.
struct UncertaintyPart {
  std::string name;       ///< "lens transmission"
  double relative = 0.0;  ///< standard uncertainty
  std::string source;     ///< where the figure comes from, or that it is an estimate
};

/// What a pixel on the axis records of a line that fills it. Counts of a raw channel are 0 where the scene's
/// response is negative: the display primaries are no filters (sim/view/colour/line_colours.h).
struct LineCounts {
  double wavelength_nm = 0.0;
  Vector3 electrons_per_kilorayleigh{};  ///< raw red, green, blue
  Vector3 dn_per_kilorayleigh{};         ///< digital numbers above black
  double saturation_kilorayleigh = 0.0;  ///< at which the first channel is full; infinite without light
};

struct ExpectedCounts {
  std::vector<LineCounts> lines;  ///< in the scene's order
  double white_e = 0.0;           ///< electrons of linear raw value 1
  double saturation_e = 0.0;      ///< electrons beyond which a pixel is saturated
  double dn_per_electron = 0.0;
  double black_dn = 0.0;
  double dark_e = 0.0;  ///< mean dark electrons of the exposure
  double read_noise_e = 0.0;
  double quantisation_e = 0.0;  ///< standard deviation of the converter's rounding

  /// Of the scale from rayleighs to counts: the root of the sum of the parts' squares. Empty where it is not
  /// known: a gain that was simply given, without a calibration_error.
  std::optional<double> relative_uncertainty;
  std::vector<UncertaintyPart> parts;  ///< what is known, even where the whole is not
};

/// Of a valid scene.
ExpectedCounts expected_counts(const Scene& scene);

/// Electrons of light over their noise: photons', dark current's, reading and rounding.
double signal_to_noise(const ExpectedCounts& counts, double electrons);

}  // namespace vegard::sim
