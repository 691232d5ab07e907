// The absolute scale: the expected counts of a camera per kilorayleigh, and their uncertainty.
//
// The electrons of a pixel are rayleighs times pixel_photons_s_per_rayleigh() (sim/view/colour/radiometry.h)
// times exposure time and quantum efficiency. Digital numbers follow from the electrons at white, full_well_e
// base_iso / iso. Standard uncertainties are added in quadrature (JCGM 100:2008, "GUM", 5.1.2, for a product
// of independent factors; that of a range without a preferred value is half its width / sqrt(3), 4.3.7).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/view/colour/colour.h"

namespace vegard::sim {

struct Scene;

/// One contribution to the relative uncertainty of counts.
struct UncertaintyPart {
  std::string name;       ///< "lens transmission"
  double relative = 0.0;  ///< standard uncertainty
  std::string source;     ///< reference for the uncertainty, or that it is an estimate
};

/// The counts of a pixel on the axis that is filled by light of one line. Counts of a raw channel are 0 where
/// the scene's response is negative, as for display primaries (sim/view/colour/line_colours.h).
struct LineCounts {
  double wavelength_nm = 0.0;
  Vector3 electrons_per_kilorayleigh{};  ///< raw red, green, blue
  Vector3 dn_per_kilorayleigh{};         ///< digital numbers above black
  double saturation_kilorayleigh =
      0.0;  ///< brightness at which the first channel saturates; infinite without light
};

struct ExpectedCounts {
  std::vector<LineCounts> lines;  ///< in the order of emission.lines
  double white_e = 0.0;           ///< electrons of linear raw value 1
  double saturation_e = 0.0;      ///< electrons beyond which a pixel is saturated
  double dn_per_electron = 0.0;
  double black_dn = 0.0;
  double dark_e = 0.0;  ///< mean dark electrons of the exposure
  double read_noise_e = 0.0;
  double quantisation_e = 0.0;  ///< standard deviation of the converter's rounding

  /// Of the scale from rayleighs to counts: the root of the sum of the squares of `parts`. Empty if unknown,
  /// for a given gain without a calibration_error.
  std::optional<double> relative_uncertainty;
  std::vector<UncertaintyPart> parts;  ///< the known contributions, even if the total is unknown
};

/// Returns the expected counts of a valid scene.
ExpectedCounts expected_counts(const Scene& scene);

/// Returns the electrons of light over their noise: of photons, dark current, reading and rounding.
double signal_to_noise(const ExpectedCounts& counts, double electrons);

}  // namespace vegard::sim
