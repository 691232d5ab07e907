#include "sim/view/camera/lens.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "sim/base/number/constants.h"

namespace vegard::sim {
namespace {

constexpr double kFarthestOff = 170.0 * kRadiansPerDegree;
constexpr int kMaxSteps = 60;

/// Returns d/dr of r (1 + k1 r^2 + k2 r^4 + k3 r^6).
double growth(double k1, double k2, double k3, double r) {
  const double r2 = r * r;
  return 1.0 + r2 * (3.0 * k1 + r2 * (5.0 * k2 + r2 * 7.0 * k3));
}

constexpr int kFoldPieces = 4096;

/// Returns the first r below `end`, up to rounding, at which growth() becomes negative; `end` if there is
/// none. growth() is a cubic in r^2, so it is monotonic between the zeros of its derivative.
double first_zero_of_growth(double k1, double k2, double k3, double end) {
  std::array<double, 4> bounds = {0.0, end, end, end};
  int count = 1;
  // 3 k1 + 2 * 5 k2 u + 3 * 7 k3 u^2 = 0, by the form that does not cancel.
  const double a = 21.0 * k3, b = 10.0 * k2, c = 3.0 * k1, root = b * b - 4.0 * a * c;
  if (root >= 0.0) {
    const double q = -0.5 * (b + std::copysign(std::sqrt(root), b));
    for (const double u : {a != 0.0 ? q / a : -1.0, q != 0.0 ? c / q : -1.0})
      if (u > 0.0 && u < end * end) bounds[count++] = std::sqrt(u);
  }
  if (bounds[1] > bounds[2]) std::swap(bounds[1], bounds[2]);
  for (int i = 1; i <= count; ++i) {
    double good = bounds[i - 1], bad = bounds[i];
    if (growth(k1, k2, k3, bad) > 0.0) continue;
    for (int step = 0; step < kMaxSteps; ++step) {
      const double middle = 0.5 * (good + bad);
      (growth(k1, k2, k3, middle) > 0.0 ? good : bad) = middle;
    }
    return bad;
  }
  return end;
}

/// Returns the first r at which the radial terms fold the picture back, at most `end`.
double first_fold(double k1, double k2, double k3, double end) {
  const double zero = first_zero_of_growth(k1, k2, k3, end);
  const int before = std::clamp(static_cast<int>(zero / end * kFoldPieces) - 1, 0, kFoldPieces);
  // What lies before needs no search; a fold narrower than a piece counts for none.
  for (int i = before + 1; i <= kFoldPieces; ++i) {
    double good = end * (i - 1) / kFoldPieces, bad = end * i / kFoldPieces;
    if (growth(k1, k2, k3, bad) > 0.0) continue;
    for (int step = 0; step < kMaxSteps; ++step) {
      const double middle = 0.5 * (good + bad);
      (growth(k1, k2, k3, middle) > 0.0 ? good : bad) = middle;
    }
    return good;
  }
  return end;
}

/// Returns the r below the fold with r (1 + k1 r^2 + ...) = radius, by Newton's steps held inside a bracket;
/// negative if there is none.
double undo_radial(const Lens<double>& lens, double radius, double fold) {
  const auto at = [&](double r) {
    const double r2 = r * r;
    return r * (1.0 + r2 * (lens.k1 + r2 * (lens.k2 + r2 * lens.k3)));
  };
  if (radius > at(fold)) return -1.0;
  double low = 0.0, high = fold, r = std::min(radius, 0.5 * fold);
  for (int step = 0; step < kMaxSteps; ++step) {
    const double miss = at(r) - radius;
    (miss > 0.0 ? high : low) = r;
    double next = r - miss / growth(lens.k1, lens.k2, lens.k3, r);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - r) <= 1e-15 * (1.0 + r)) return next;
    r = next;
  }
  return r;
}

/// Returns the angle of a radius in units of focal_px; negative if the lens draws nothing there.
double angle_of_radius(const Lens<double>& lens, double radius) {
  const double end = std::acos(lens.min_cosine);
  double theta = radius;
  switch (lens.model) {
    case LensModel::pinhole:
      theta = std::atan(undo_radial(lens, radius, std::tan(std::min(end, 1.57))));
      break;
    case LensModel::equidistant:
      break;
    case LensModel::equisolid:
      theta = radius < 2.0 ? 2.0 * std::asin(0.5 * radius) : -1.0;
      break;
    case LensModel::stereographic:
      theta = 2.0 * std::atan(0.5 * radius);
      break;
    case LensModel::orthographic:
      theta = radius < 1.0 ? std::asin(radius) : -1.0;
      break;
    case LensModel::polynomial:
      theta = undo_radial(lens, radius, end);
      break;
    case LensModel::equirectangular:
    case LensModel::cube:
      return -1.0;  // no radius tells where these look
  }
  return theta < end ? theta : -1.0;
}

bool unproject_panorama(const Lens<double>& lens, double x_px, double y_px, double in_camera[3]) {
  if (lens.model == LensModel::equirectangular) {
    // Beyond a pole the cosine of the latitude is negative, and the direction is that on the other side.
    const double longitude = (x_px - lens.principal_x_px) / (lens.focal_px * lens.side);
    const double below = (y_px - lens.principal_y_px) / (lens.focal_px * lens.aspect);
    in_camera[0] = std::cos(below) * std::sin(longitude);
    in_camera[1] = std::sin(below);
    in_camera[2] = std::cos(below) * std::cos(longitude);
    return true;
  }
  const double edge = 2.0 * lens.focal_px, column = std::floor(x_px / edge), row = std::floor(y_px / edge);
  for (const CubeFace& face : cube_faces(lens.cube_layout)) {
    if (face.column != column || face.row != row) continue;
    const double right = x_px / lens.focal_px - (2.0 * column + 1.0),
                 down = y_px / lens.focal_px - (2.0 * row + 1.0);
    const double scale = 1.0 / std::sqrt(1.0 + right * right + down * down);
    for (int i = 0; i < 3; ++i)
      in_camera[i] = scale * (face.right[i] * right + face.down[i] * down + face.forward[i]);
    return true;
  }
  return false;
}

}  // namespace

double min_cosine(LensModel model, double k1, double k2, double k3) {
  switch (model) {
    case LensModel::pinhole: {
      constexpr double kWidest = 60.0;  // 89 degrees
      const double fold = k1 == 0.0 && k2 == 0.0 && k3 == 0.0 ? kWidest : first_fold(k1, k2, k3, kWidest);
      return fold < kWidest ? 1.0 / std::sqrt(1.0 + fold * fold) : 0.0;
    }
    case LensModel::orthographic:
      return 0.0;
    case LensModel::polynomial:
      return std::cos(first_fold(k1, k2, k3, kFarthestOff));
    case LensModel::equirectangular:
    case LensModel::cube:
      return -1.0;
    default:
      return std::cos(kFarthestOff);
  }
}

bool unproject(const Lens<double>& lens, double x_px, double y_px, double in_camera[3]) {
  if (is_panorama(lens.model)) return unproject_panorama(lens, x_px, y_px, in_camera);
  const double x_seen = (x_px - lens.principal_x_px) / (lens.focal_px * lens.side);
  const double y_seen = (y_px - lens.principal_y_px) / (lens.focal_px * lens.aspect);
  if (is_plain_pinhole(lens)) {
    const double scale = 1.0 / std::sqrt(1.0 + x_seen * x_seen + y_seen * y_seen);
    in_camera[0] = x_seen * scale;
    in_camera[1] = y_seen * scale;
    in_camera[2] = scale;
    return true;
  }
  const auto from_radius = [&](double x, double y) {
    const double radius = std::hypot(x, y);
    const double theta = angle_of_radius(lens, radius);
    if (!(theta >= 0.0)) return false;
    const double across = radius > 0.0 ? std::sin(theta) / radius : 0.0;
    in_camera[0] = x * across;
    in_camera[1] = y * across;
    in_camera[2] = std::cos(theta);
    return true;
  };
  if (lens.p1 == 0.0 && lens.p2 == 0.0) return from_radius(x_seen, y_seen);
  // With decentring there is no closed form: Newton's method on the direction itself, from where it would be
  // without, or from nearer to the axis if that is outside of the lens's picture. A step out of the picture
  // is halved.
  Lens<double> centred = lens;
  centred.p1 = centred.p2 = 0.0;
  const auto start_at = [&](double share) {
    return unproject(centred, lens.principal_x_px + share * (x_px - lens.principal_x_px),
                     lens.principal_y_px + share * (y_px - lens.principal_y_px), in_camera);
  };
  double share = 1.0;
  while (!start_at(share)) {
    share *= 0.98;
    if (share < 0.8) return false;
  }
  double x = 0.0, y = 0.0;
  if (!project(lens, in_camera, x, y)) return false;
  for (int step = 0; step < kMaxSteps; ++step) {
    const PlaceSlopes slopes = place_slopes(lens, in_camera);
    const double determinant = slopes.determinant();
    if (!(std::abs(determinant) > 0.0)) return false;
    const double off_x = x_px - x, off_y = y_px - y;
    double a = (off_x * slopes.slope[1][1] - off_y * slopes.slope[0][1]) / determinant;
    double b = (off_y * slopes.slope[0][0] - off_x * slopes.slope[1][0]) / determinant;
    double next[3];
    for (int halving = 0;; ++halving) {
      double length = 0.0;
      for (int i = 0; i < 3; ++i) {
        next[i] = in_camera[i] + a * slopes.across[0][i] + b * slopes.across[1][i];
        length += next[i] * next[i];
      }
      length = std::sqrt(length);
      for (double& number : next) number /= length;
      if (project(lens, next, x, y)) break;
      if (halving == kMaxSteps) return false;
      a *= 0.5;
      b *= 0.5;
    }
    std::copy(next, next + 3, in_camera);
    if (std::abs(a) + std::abs(b) < 1e-14) break;
  }
  // What lies outside of the picture is approached and never met.
  return std::abs(x - x_px) + std::abs(y - y_px) < 1e-6;
}

PlaceSlopes place_slopes(const Lens<double>& lens, const double direction[3]) {
  using Two = Dual<double, Tangents<double, 2>>;
  PlaceSlopes slopes;
  // Any direction that is not along this one will do to start from.
  const int least = std::abs(direction[0]) < std::abs(direction[1]) ? 0 : 1;
  double first[3] = {least == 0 ? 1.0 : 0.0, least == 1 ? 1.0 : 0.0, 0.0}, length = 0.0;
  const double along = direction[least];
  for (int i = 0; i < 3; ++i) {
    first[i] -= along * direction[i];
    length += first[i] * first[i];
  }
  length = std::sqrt(length);
  for (int i = 0; i < 3; ++i) slopes.across[0][i] = first[i] / length;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    slopes.across[1][i] = direction[j] * slopes.across[0][k] - direction[k] * slopes.across[0][j];
  }
  const Lens<Two> dual = converted<Two>(lens, [](double number) { return Two(number); });
  Two there[3], x(0.0), y(0.0);
  for (int i = 0; i < 3; ++i) {
    there[i] = direction[i];
    for (int k = 0; k < 2; ++k) there[i].d.t[k] = slopes.across[k][i];
  }
  project(dual, there, x, y);
  for (int k = 0; k < 2; ++k) {
    slopes.slope[0][k] = x.d.t[k];
    slopes.slope[1][k] = y.d.t[k];
  }
  return slopes;
}

double pixel_steradians(const Lens<double>& lens, double x_px, double y_px) {
  double direction[3];
  if (!unproject(lens, x_px, y_px, direction)) return 0.0;
  return 1.0 / std::abs(place_slopes(lens, direction).determinant());
}

}  // namespace vegard::sim
