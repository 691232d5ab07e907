// The local median and scatter of a picture's values.
#pragma once

#include <functional>
#include <vector>

#include "fit/photo/mask/plane.h"

namespace vegard::fit {

/// Medians and robust standard deviations of the tiles of a plane, interpolated between the tiles' centres.
/// σ = 1.4826 × the median of |value − median|, which is the standard deviation of a normal law and does not
/// see what less than half of a tile holds (Hampel 1974, J. Am. Stat. Assoc. 69, 383); or, where that is
/// more, what 84 % are below, less the median: noise that the file has cut off at black has an upper side
/// only.
class LocalNoise {
 public:
  static constexpr int kTile_px = 48;

  /// floor: the least σ, one per value of the plane `level` at the tile's median of it (the step of a file's
  /// code, by which a smooth picture seems to have no noise).
  LocalNoise(const Plane& values, const Plane& level, const std::function<double(double)>& floor);

  /// At the centre of a pixel.
  struct Usual {
    float median, sigma;
  };
  Usual at(int x, int y) const;

 private:
  int columns_ = 0, rows_ = 0;
  std::vector<float> median_, sigma_;
};

}  // namespace vegard::fit
