#include "fit/photo/pointing/held_out.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "fit/photo/pointing/chance_agreement.h"
#include "fit/photo/pointing/star_check.h"

namespace vegard::fit {
namespace {

constexpr double kUnknown_px = std::numeric_limits<double>::quiet_NaN();

double rms_of(double squares, int count) { return count > 0 ? std::sqrt(squares / count) : kUnknown_px; }

}  // namespace

std::vector<RegionHeldOut> regions_held_out(const Calibration& calibration) {
  std::array<RegionHeldOut, kPictureNinths> all;
  std::array<double, kPictureNinths> each{}, region{};
  for (std::size_t i = 0; i < calibration.stars.size(); ++i) {
    const StarResidual& one = calibration.residuals[i];
    if (!one.used) continue;
    const StarSighting& star = calibration.stars[i];
    const auto ninth = static_cast<std::size_t>(ninth_of(calibration.frame, star.x_px, star.y_px));
    all[ninth].name = region_name(calibration.frame, star.x_px, star.y_px);
    ++all[ninth].stars;
    each[ninth] += one.without_dx_px * one.without_dx_px + one.without_dy_px * one.without_dy_px;
    region[ninth] += one.without_region_dx_px * one.without_region_dx_px +
                     one.without_region_dy_px * one.without_region_dy_px;
  }
  std::vector<RegionHeldOut> regions;
  for (std::size_t ninth = 0; ninth < all.size(); ++ninth) {
    if (all[ninth].stars == 0) continue;
    all[ninth].without_rms_px = rms_of(each[ninth], all[ninth].stars);
    all[ninth].without_region_rms_px = rms_of(region[ninth], all[ninth].stars);
    regions.push_back(all[ninth]);
  }
  return regions;
}

ExplainedPoints explained_points(const Calibration& calibration, const std::vector<FoundStar>& points,
                                 const std::vector<StarSighting>& sky) {
  ExplainedPoints explained;
  explained.points = static_cast<int>(points.size());
  if (sky.empty() || points.empty()) return explained;
  explained.faintest = sky.back().magnitude;
  const double size = std::max(calibration.frame.width_px, calibration.frame.height_px);
  const double radius = std::max(2.5 * std::max(1.0, size / 1500.0), 3.0 * calibration.rms_px);
  const std::vector<ExpectedStar> expected = expected_stars(calibration.camera, calibration.frame, sky);
  const PointCells cells(points, calibration.frame, points.size());
  const auto tolerance = [&](const ExpectedStar&) { return radius; };
  explained.stars = static_cast<int>(each_others_nearest(expected, points, cells, tolerance).size());
  const double area = static_cast<double>(calibration.frame.width_px) * calibration.frame.height_px;
  const double share = static_cast<double>(expected.size()) / area * M_PI * radius * radius;
  // Of the points that are no stars so many are as near to one.
  explained.by_chance = (explained.points - explained.stars) * (1.0 - std::exp(-share));
  return explained;
}

std::string held_out_line(const Calibration& calibration) {
  std::string words =
      fmt::format("stars held out: each by a fit without it {:.2f} px", calibration.without_rms_px);
  double squares = 0.0;
  int stars = 0;
  const std::vector<RegionHeldOut> regions = regions_held_out(calibration);
  const RegionHeldOut* worst = nullptr;
  for (const RegionHeldOut& one : regions) {
    if (!std::isfinite(one.without_region_rms_px)) continue;
    squares += one.stars * one.without_region_rms_px * one.without_region_rms_px;
    stars += one.stars;
    if (worst == nullptr || one.without_region_rms_px > worst->without_region_rms_px) worst = &one;
  }
  if (worst == nullptr) return words;
  return words +
         fmt::format(
             ", each ninth of the picture by a fit without its stars {:.2f} px, the worst ({}, {} {}) "
             "{:.2f} px",
             rms_of(squares, stars), worst->name, worst->stars, worst->stars == 1 ? "star" : "stars",
             worst->without_region_rms_px);
}

std::string explained_line(const Calibration& calibration) {
  if (!calibration.explained || calibration.explained->points == 0) return {};
  const ExplainedPoints& one = *calibration.explained;
  return fmt::format(
      "{} of {} points of light ({:.0f} %) are stars to magnitude {:.1f}, {:.1f} of them by chance",
      one.stars, one.points, 100.0 * one.stars / one.points, one.faintest, one.by_chance);
}

}  // namespace vegard::fit
