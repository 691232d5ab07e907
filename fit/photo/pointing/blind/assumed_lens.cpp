#include "fit/photo/pointing/blind/assumed_lens.h"

#include <algorithm>
#include <cmath>

#include "sim/base/number/constants.h"

namespace vegard::fit {
namespace {

/// The distance from the centre, in units of the focal length.
double radius_of(sim::LensModel model, double angle) {
  switch (model) {
    case sim::LensModel::pinhole:
      return std::tan(angle);
    case sim::LensModel::stereographic:
      return 2.0 * std::tan(0.5 * angle);
    case sim::LensModel::equisolid:
      return 2.0 * std::sin(0.5 * angle);
    default:
      return angle;
  }
}

double share_seen(bool is_bright) { return is_bright ? 0.6 : 0.3; }

}  // namespace

void CameraHit::count_missing(bool is_bright) { score += std::log(1.0 - share_seen(is_bright)); }

void CameraHit::count_seen(bool is_bright, double density, double tolerance_px) {
  const double by_chance = std::min(0.9, 1.0 - std::exp(-density * M_PI * tolerance_px * tolerance_px));
  const double expected = share_seen(is_bright);
  score += std::log(std::max(0.3, (1.0 - expected) + expected / by_chance));
}

const std::vector<AssumedLens>& assumed_lenses() {
  using sim::LensModel;
  static const std::vector<AssumedLens> lenses = [] {
    std::vector<AssumedLens> all;
    for (const double a : {10.0, 14.0, 19.0, 25.0, 32.0, 38.0, 44.0, 50.0, 56.0, 62.0})
      all.push_back({LensModel::pinhole, a});
    for (const double a : {25.0, 36.0, 48.0, 60.0, 73.0, 86.0, 100.0, 115.0})
      all.push_back({LensModel::stereographic, a});
    for (const double a : {36.0, 48.0, 60.0, 73.0, 86.0, 100.0, 115.0}) {
      all.push_back({LensModel::equidistant, a});
      all.push_back({LensModel::equisolid, a});
    }
    return all;
  }();
  return lenses;
}

SkyCamera assumed_camera(const AssumedLens& lens, bool mirrored, const Frame& frame, double centre_x_px,
                         double centre_y_px) {
  SkyCamera camera;
  camera.model = lens.model;
  camera.mirrored = mirrored;
  camera.numbers[centre_x_number] = centre_x_px;
  camera.numbers[centre_y_number] = centre_y_px;
  camera.numbers[focal_px_number] = 0.5 * std::max(frame.width_px, frame.height_px) /
                                    radius_of(lens.model, lens.half_width_deg * sim::kRadiansPerDegree);
  return camera;
}

}  // namespace vegard::fit
