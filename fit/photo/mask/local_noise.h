// The local median and scatter of a picture's values.
#pragma once

#include <functional>
#include <vector>

#include "fit/photo/mask/plane.h"

namespace vegard::fit {

/// Medians and robust standard deviations σ of the tiles of a plane, interpolated between the tiles' centres.
/// σ is the larger of 1.4826 × the median of |value − median|, which is the standard deviation for a normal
/// distribution and is insensitive to outliers in less than half of a tile (Hampel 1974, J. Am. Stat. Assoc.
/// 69, 383), and of the 84 % quantile less the median, because noise that the file clips at black has only an
/// upper side.
class LocalNoise {
 public:
  static constexpr int kTile_px = 48;

  /// `floor` returns the least σ for a value of the plane `level`, of which it is given the tile's median:
  /// the step of a file's codes, without which a smooth picture would seem to have no noise.
  LocalNoise(const Plane& values, const Plane& level, const std::function<double(double)>& floor);

  /// The values at the centre of a pixel.
  struct Usual {
    float median, sigma;
  };
  Usual at(int x, int y) const;

 private:
  int columns_ = 0, rows_ = 0;
  std::vector<float> median_, sigma_;
};

}  // namespace vegard::fit
