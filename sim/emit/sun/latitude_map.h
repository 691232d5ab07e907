// A picture by heliographic latitude and longitude.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sim/base/image.h"
#include "sim/base/number/dual.h"

namespace vegard::sim {

/// Equirectangular: rows from the north pole down to the south pole, columns from longitude -180° to 180°;
/// pixels are areas, their values stand in their middles. Linear in between, round the Sun and up to the
/// first and last row's middles, beyond which, at the poles, those rows' values stand.
class LatitudeMap {
 public:
  /// Of one channel. `picture` must outlive it.
  explicit LatitudeMap(const Image& picture) : picture_(picture) {}

  /// At a place in the Sun's frame (sim/emit/sun/sun_frame.h), at any height but 0.
  template <class T>
  T at(const T place[3]) const {
    constexpr double kTurn = 6.28318530717958647693;
    const T level = place[0] * place[0] + place[1] * place[1];
    if (!(value_of(level) > 0.0)) return T(pixel(0, value_of(place[2]) > 0.0 ? 0 : picture_.height - 1));
    const T latitude = arctangent(place[2], square_root(level)), longitude = arctangent(place[1], place[0]);
    const T column = (longitude * (1.0 / kTurn) + 0.5) * static_cast<double>(picture_.width) - 0.5;
    T row = (T(0.25) - latitude * (1.0 / kTurn)) * (2.0 * picture_.height) - 0.5;
    const double last = picture_.height - 1.0;
    if (value_of(row) < 0.0 || value_of(row) > last) row = T(value_of(row) < 0.0 ? 0.0 : last);
    const double left = std::floor(value_of(column)), above = std::floor(value_of(row));
    const T across = column - left, down = row - above;
    const int x = static_cast<int>(left), y = static_cast<int>(above);
    const T upper = mixed(pixel(x, y), pixel(x + 1, y), across),
            lower = mixed(pixel(x, y + 1), pixel(x + 1, y + 1), across);
    return upper + (lower - upper) * down;
  }

 private:
  template <class T>
  static T mixed(double a, double b, const T& share) {
    return share * (b - a) + a;
  }
  double pixel(int x, int y) const {
    const int column = (x % picture_.width + picture_.width) % picture_.width;
    return static_cast<double>(picture_.at(column, std::min(y, picture_.height - 1), 0));
  }

  const Image& picture_;
};

}  // namespace vegard::sim
