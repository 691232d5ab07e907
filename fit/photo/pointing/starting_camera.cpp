#include "fit/photo/pointing/lens_choice.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "sim/base/number/quantile.h"

// Finds a camera to start from if nothing but the stars is known.
//
// A lens with a scale and a centre turns the pixels of two stars into two directions in the camera, and one
// rotation takes these to the stars' directions in the sky. All pairs of well separated stars, scales around
// the pair's own ratio of pixels to angle, and centres around the frame's middle are tried in a fixed order;
// the cameras that map the most stars to their places are refined with a robust loss.

namespace vegard::fit {
namespace {

constexpr double kTruncation = 0.05, kStartCoarse = 0.02;  // of the stars' extent
constexpr int kMaxPairs = 24, kMaxScored = 30, kRefined = 4;
constexpr int kPairsOfOneStar = 5;

Eigen::Vector3d enu_of(const StarSighting& star) { return {star.enu[0], star.enu[1], star.enu[2]}; }

double extent_px(const std::vector<StarSighting>& stars) {
  double left = stars[0].x_px, right = left, top = stars[0].y_px, bottom = top;
  for (const StarSighting& star : stars) {
    left = std::min(left, star.x_px);
    right = std::max(right, star.x_px);
    top = std::min(top, star.y_px);
    bottom = std::max(bottom, star.y_px);
  }
  return std::hypot(right - left, bottom - top);
}

struct Pair {
  std::size_t a, b;
  double angle, distance_px;
};

/// The widest pairs, no star in more than a few of them: one star that is mistaken must not spoil them all.
std::vector<Pair> wide_pairs(const std::vector<StarSighting>& stars, std::vector<double>& px_per_radian) {
  std::vector<Pair> all;
  for (std::size_t a = 0; a < stars.size(); ++a)
    for (std::size_t b = a + 1; b < stars.size(); ++b) {
      const Eigen::Vector3d u = enu_of(stars[a]), v = enu_of(stars[b]);
      const double angle = std::atan2(u.cross(v).norm(), u.dot(v));
      const double distance = std::hypot(stars[a].x_px - stars[b].x_px, stars[a].y_px - stars[b].y_px);
      if (angle < 1e-6 || distance < 1e-3) continue;
      all.push_back({a, b, angle, distance});
      px_per_radian.push_back(distance / angle);
    }
  // Opposite stars fix no rotation: what counts is the sine.
  std::stable_sort(all.begin(), all.end(), [](const Pair& p, const Pair& q) {
    return std::sin(std::min(p.angle, 1.5707)) * p.distance_px >
           std::sin(std::min(q.angle, 1.5707)) * q.distance_px;
  });
  std::vector<int> taken(stars.size(), 0);
  std::vector<Pair> pairs;
  for (const Pair& pair : all) {
    if (static_cast<int>(pairs.size()) == kMaxPairs) break;
    if (taken[pair.a] >= kPairsOfOneStar || taken[pair.b] >= kPairsOfOneStar) continue;
    ++taken[pair.a];
    ++taken[pair.b];
    pairs.push_back(pair);
  }
  return pairs;
}

Eigen::Matrix3d triad(const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
  Eigen::Matrix3d axes;
  axes.col(0) = (u + v).normalized();
  axes.col(2) = u.cross(v).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

/// Turns the camera so that it sees the pair where it was seen, as well as a rotation can.
bool turn_to(SkyCamera& camera, const sim::Lens<double>& lens, const StarSighting& a, const StarSighting& b) {
  double u[3], v[3];
  if (!sim::unproject(lens, a.x_px, a.y_px, u) || !sim::unproject(lens, b.x_px, b.y_px, v)) return false;
  const Eigen::Vector3d in_camera_a(u[0], u[1], u[2]), in_camera_b(v[0], v[1], v[2]);
  if (in_camera_a.cross(in_camera_b).norm() < 1e-9) return false;
  camera.camera_from_enu = triad(in_camera_a, in_camera_b) * triad(enu_of(a), enu_of(b)).transpose();
  return true;
}

double truncated_sum(const SkyCamera& camera, const std::vector<StarSighting>& stars, double cut_px,
                     double enough) {
  double sum = 0.0;
  for (const StarSighting& star : stars) {
    double x = 0.0, y = 0.0, square = cut_px * cut_px;
    if (place_of_star(camera, star.enu, x, y))
      square = std::min(square, (x - star.x_px) * (x - star.x_px) + (y - star.y_px) * (y - star.y_px));
    sum += square;
    if (sum >= enough) break;
  }
  return sum;
}

struct Start {
  SkyCamera camera;
  double sum;
};

/// Keeps the few best, in order.
void offer(std::vector<Start>& best, const SkyCamera& camera, double sum) {
  const auto place = std::upper_bound(best.begin(), best.end(), sum,
                                      [](double value, const Start& start) { return value < start.sum; });
  best.insert(place, {camera, sum});
  if (best.size() > kRefined) best.pop_back();
}

}  // namespace

double truncated_sum(const SkyCamera& camera, const std::vector<StarSighting>& stars) {
  return truncated_sum(camera, stars, kTruncation * extent_px(stars), 1e300);
}

double lost_sum(const std::vector<StarSighting>& stars) {
  const double cut_px = kTruncation * extent_px(stars);
  return static_cast<double>(stars.size()) * cut_px * cut_px;
}

CameraFit refined_start(const SkyCamera& start, const std::vector<StarSighting>& stars) {
  const std::vector<LensNumber> free = {turn_about_right, turn_about_down, turn_about_forward,
                                        focal_px_number,  centre_x_number, centre_y_number};
  const double extent = extent_px(stars);
  const CameraFit coarse = fit_camera(start, free, stars, {}, kStartCoarse * extent);
  return fit_camera(coarse.camera, free, stars, {}, 0.25 * kStartCoarse * extent);
}

CameraFit starting_camera(sim::LensModel model, bool mirrored, const std::vector<StarSighting>& stars,
                          const Frame& frame) {
  CameraFit best;
  std::vector<double> ratios;
  const std::vector<Pair> pairs = wide_pairs(stars, ratios);
  if (pairs.empty()) return best;
  const double ratio = sim::median(ratios);
  std::vector<StarSighting> scored;
  const std::size_t stride = (stars.size() + kMaxScored - 1) / kMaxScored;
  for (std::size_t i = 0; i < stars.size(); i += stride) scored.push_back(stars[i]);
  const double extent = extent_px(stars), cut_px = kTruncation * extent;

  SkyCamera camera;
  camera.model = model;
  camera.mirrored = mirrored;
  std::vector<Start> starts;
  const double reach = std::max(frame.width_px, frame.height_px);
  for (int step = -4; step <= 3; ++step) {
    camera.numbers[focal_px_number] = ratio * std::exp2(step / 4.0);
    for (int row = -2; row <= 2; ++row)
      for (int column = -2; column <= 2; ++column) {
        camera.numbers[centre_x_number] = 0.5 * frame.width_px + column * 0.12 * reach;
        camera.numbers[centre_y_number] = 0.5 * frame.height_px + row * 0.12 * reach;
        const sim::Lens<double> lens = lens_of(camera, camera.numbers.data());
        for (const Pair& pair : pairs) {
          if (!turn_to(camera, lens, stars[pair.a], stars[pair.b])) continue;
          const double enough = starts.size() < kRefined ? 1e300 : starts.back().sum;
          const double sum = truncated_sum(camera, scored, cut_px, enough);
          if (sum < enough) offer(starts, camera, sum);
        }
      }
  }
  double least = 1e300;
  for (const Start& start : starts) {
    const CameraFit fit = refined_start(start.camera, stars);
    const double sum = truncated_sum(fit.camera, stars, cut_px, 1e300);
    if (fit.good && sum < least) {
      least = sum;
      best = fit;
    }
  }
  return best;
}

}  // namespace vegard::fit
