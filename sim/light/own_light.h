// The light of the scene's own lines (lines that the user defines) in the height profile of a sheet.
//
// An own line is of one of two kinds. A line that follows another one has `ratio` times its light. A line
// with a layer has, per mW m^-2, the volume emission rate of a Chapman layer (Chapman 1931, Proc. Phys. Soc.
// 43, 26),
//
//     rate(h) = rate_0 exp(1 - x - exp(-x)),    x = (h - peak) / H,
//
// the absorption of radiation in an air of scale height H. Here it approximates the excitation by electrons
// in an air that the emission tables do not describe. Its column over all altitudes is 0.1 e H rate_0
// rayleighs. A layer without a scale height of its own has that of the body's air at its peak. Neither rule
// applies if the sheet's profile itself contains the line, as a column of a file or as coefficients of a free
// form.
#pragma once

#include <vector>

#include "sim/light/height_profile.h"

namespace vegard::sim {

struct Scene;
struct Sheet;

/// Replaces own lines by lines that the emission model has, and computes the own lines from its result.
class OwnLight {
 public:
  OwnLight(const std::vector<double>& wavelengths_nm, const Scene& scene, const Sheet& sheet);

  /// Wavelengths to ask the sheet's model for, one per element of `wavelengths_nm`: for an own line the line
  /// that it follows, or 0, which is dark in every model, if it has a layer.
  const std::vector<double>& asked_nm() const { return asked_nm_; }

  /// Multiplies the rates of lines that follow another one, or derivatives of rates, by their ratio. `rates`:
  /// the model's result for asked_nm(), [altitude][stride].
  void scale(int stride, std::vector<float>& rates) const;

  /// Scales the rates of a profile and their derivatives, and adds the layers.
  void add_to(HeightProfile& profile) const;

 private:
  struct Layer {
    double rayleigh = 0.0, peak_km = 0.0, scale_height_km = 1.0;
  };

  std::vector<double> asked_nm_;
  std::vector<double> ratio_;  ///< [wavelength]; 1 for a line that follows no other
  std::vector<Layer> layers_;  ///< [wavelength]; 0 rayleigh for a line without a layer
};

}  // namespace vegard::sim
