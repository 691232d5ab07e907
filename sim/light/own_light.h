// The light of a scene's own lines in the height profile of a sheet.
//
// A line that follows another one has `ratio` times its light. One with a layer has, per mW m^-2, the volume
// emission rate of a Chapman layer (Chapman 1931, Proc. Phys. Soc. 43, 26),
//
//     rate(h) = rate_0 exp(1 - x - exp(-x)),    x = (h - peak) / H,
//
// which is what radiation that air of the scale height H absorbs leaves behind, and stands here for what
// electrons do in an air that the emission tables are not of. Its column, over all altitudes, is 0.1 e H
// rate_0 rayleighs. Without a scale height of its own a layer has that of the body's air at its peak. In a
// profile that has an own line itself, as a column of a file or as coefficients of a free form, it is
// neither.
#pragma once

#include <vector>

#include "sim/light/height_profile.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// What of the wavelengths asked for is light of own lines.
class OwnLight {
 public:
  OwnLight(const std::vector<double>& wavelengths_nm, const Scene& scene, const Sheet& sheet);

  /// What the sheet's model is to be asked for in their place: the line that one follows; 0, which no model
  /// has, for one that has no light of the model's.
  const std::vector<double>& asked_nm() const { return asked_nm_; }

  /// Of rates that were asked for, or their derivatives, [altitude][stride]: takes those of the lines that
  /// follow times their ratio.
  void scale(int stride, std::vector<float>& rates) const;

  /// The same of a profile and its slope, and adds the layers.
  void add_to(HeightProfile& profile) const;

 private:
  struct Layer {
    double rayleigh = 0.0, peak_km = 0.0, scale_height_km = 1.0;
  };

  std::vector<double> asked_nm_;
  std::vector<double> ratio_;  ///< by wavelength; of one that follows no other 1
  std::vector<Layer> layers_;  ///< without light of one that has none
};

}  // namespace vegard::sim
