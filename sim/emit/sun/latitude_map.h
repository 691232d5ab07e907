// A picture as a function of heliographic latitude and longitude.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sim/base/image.h"
#include "sim/base/number/dual.h"

namespace vegard::sim {

/// An equirectangular picture: rows from the north pole to the south pole, columns from longitude -180° to
/// 180°; pixels are areas whose values apply at their middles. The interpolation is linear, and periodic in
/// longitude; between the middles of the first and last rows and the poles these rows' values are used.
class LatitudeMap {
 public:
  /// `picture` has one channel and must outlive this object.
  explicit LatitudeMap(const Image& picture) : picture_(picture) {}

  /// Returns the value at a place in the Sun's frame (sim/emit/sun/sun_frame.h), at any distance but 0 from
  /// the middle.
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
