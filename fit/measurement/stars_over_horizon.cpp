#include "fit/measurement/stars_over_horizon.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Dense>

#include "fit/photo/pointing/catalogue_sky.h"
#include "sim/base/number/constants.h"
#include "sim/view/camera/camera.h"
#include "sim/view/sky/star_place.h"

namespace vegard::fit {
namespace stars_over_horizon_parts {
namespace {

constexpr std::size_t kLeastStars = 3;
constexpr double kWorst_deg = 2.0;             // rms: a lens by its nominal focal length is not better
constexpr double kHighestLatitude_deg = 87.0;  // nearer to a pole the horizon's error turns north anywhere

double above_zero(double degrees) { return std::fmod(std::fmod(degrees, 360.0) + 360.0, 360.0); }

/// The turn from the observer's axes (east, north, up) of the camera's file to equatorial ones that explains
/// the stars best (Kabsch 1976, Acta Crystallographica A32, 922).
std::optional<Eigen::Matrix3d> equatorial_from_enu(const std::vector<StarSighting>& stars,
                                                   const sim::Camera& camera) {
  const sim::CameraView<double> view = sim::camera_view(camera);
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> pairs;
  for (const StarSighting& star : stars) {
    double enu[3];
    if (!sim::enu_of_pixel(view, star.x_px, star.y_px, enu)) continue;
    pairs.emplace_back(Eigen::Vector3d(enu[0], enu[1], enu[2]),
                       Eigen::Vector3d(star.enu[0], star.enu[1], star.enu[2]));
    products += pairs.back().second * pairs.back().first.transpose();
  }
  if (pairs.size() < kLeastStars) return std::nullopt;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(products, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d turn = svd.matrixU() * svd.matrixV().transpose();
  if (turn.determinant() < 0.0)
    turn = svd.matrixU() * Eigen::Vector3d(1.0, 1.0, -1.0).asDiagonal() * svd.matrixV().transpose();
  double sum = 0.0;
  for (const auto& [here, there] : pairs) sum += (turn * here - there).squaredNorm();
  if (!(std::sqrt(sum / static_cast<double>(pairs.size())) < kWorst_deg * sim::kRadiansPerDegree))
    return std::nullopt;
  return turn;
}

/// The same without errors.
std::optional<StarsOverHorizon> found_with(const std::vector<StarSighting>& stars,
                                           const sim::Camera& camera) {
  const std::optional<Eigen::Matrix3d> turn = equatorial_from_enu(stars, camera);
  if (!turn) return std::nullopt;
  const Eigen::Vector3d zenith = turn->col(2), pole = turn->row(2).transpose();
  StarsOverHorizon out;
  const sim::Equatorial place = equatorial_place(zenith);
  out.latitude_deg = place.declination_deg;
  out.sidereal_time_deg = place.right_ascension_deg;
  // Where north was taken to be, the celestial north pole is not.
  const double pole_deg = std::atan2(pole.x(), pole.y()) / sim::kRadiansPerDegree;
  out.azimuth_deg = above_zero(camera.azimuth_deg - pole_deg);
  return out;
}

}  // namespace
}  // namespace stars_over_horizon_parts

double StarsOverHorizon::longitude_deg(double julian_date) const {
  return std::remainder(sidereal_time_deg - sim::mean_sidereal_time_deg(julian_date), 360.0);
}

std::optional<StarsOverHorizon> stars_over_horizon(const std::vector<StarSighting>& stars,
                                                   const sim::Camera& camera, double elevation_error_deg,
                                                   double roll_error_deg) {
  using namespace stars_over_horizon_parts;
  std::optional<StarsOverHorizon> found = found_with(stars, camera);
  if (!found || std::abs(found->latitude_deg) > kHighestLatitude_deg) return std::nullopt;
  sim::Camera higher = camera, turned = camera;
  higher.elevation_deg += elevation_error_deg;
  turned.roll_deg += roll_error_deg;
  for (const sim::Camera& other : {higher, turned}) {
    const std::optional<StarsOverHorizon> moved = found_with(stars, other);
    if (!moved) return std::nullopt;
    const auto add = [](double& error, double a, double b) {
      error = std::hypot(error, std::remainder(a - b, 360.0));
    };
    add(found->azimuth_error_deg, moved->azimuth_deg, found->azimuth_deg);
    add(found->latitude_error_deg, moved->latitude_deg, found->latitude_deg);
    add(found->sidereal_time_error_deg, moved->sidereal_time_deg, found->sidereal_time_deg);
  }
  return found;
}

std::string words_of(const StarsOverHorizon& found, std::optional<double> julian_date) {
  std::string words =
      fmt::format("the camera looked to azimuth {:.0f} ± {:.0f}°, from a latitude of {:.1f} ± {:.1f}°",
                  found.azimuth_deg, found.azimuth_error_deg, found.latitude_deg, found.latitude_error_deg);
  if (julian_date)
    words += fmt::format(" and a longitude of {:.1f} ± {:.1f}°", found.longitude_deg(*julian_date),
                         found.sidereal_time_error_deg);
  return words;
}

}  // namespace vegard::fit
