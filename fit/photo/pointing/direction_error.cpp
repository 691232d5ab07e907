#include "fit/photo/pointing/direction_error.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "sim/base/file/number_text.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/quantile.h"

namespace vegard::fit {
namespace {

constexpr double kSecondOpinion = 1.2;  ///< of the chosen lens's leave-one-out residuals
constexpr int kErrorPlaces = 24;        ///< along each side of the picture

std::vector<const SkyCamera*> second_opinions(const Calibration& calibration) {
  std::vector<const SkyCamera*> cameras;
  const LensCandidate& chosen = calibration.candidates[calibration.chosen];
  for (const LensCandidate& one : calibration.candidates)
    if (&one != &chosen && one.fit.good && one.is_held && one.rms_px > 0.0 &&
        one.without_rms_px <= kSecondOpinion * chosen.without_rms_px)
      cameras.push_back(&one.fit.camera);
  return cameras;
}

/// The direction of a pixel in the observer's sky.
std::optional<Eigen::Vector3d> enu_of_place(const SkyCamera& camera, const sim::Lens<double>& lens,
                                            double x_px, double y_px) {
  double seen[3];
  if (!sim::unproject(lens, x_px, y_px, seen)) return std::nullopt;
  return (camera.camera_from_enu.transpose() * Eigen::Vector3d(seen[0], seen[1], seen[2])).eval();
}

class ErrorOfDirections {
 public:
  explicit ErrorOfDirections(const Calibration& calibration)
      : calibration_(calibration), lens_(true_lens(calibration.camera)) {
    for (const SkyCamera* camera : second_opinions(calibration))
      others_.emplace_back(camera, true_lens(*camera));
    for (int i = 0; i < lens_numbers; ++i) all_.push_back(static_cast<LensNumber>(i));
  }

  int opinions() const { return static_cast<int>(others_.size()); }
  std::optional<Eigen::Vector3d> enu_at(double x_px, double y_px) const {
    return enu_of_place(calibration_.camera, lens_, x_px, y_px);
  }

  std::optional<DirectionError> at(double x_px, double y_px) const {
    const std::optional<Eigen::Vector3d> enu = enu_at(x_px, y_px);
    if (!enu) return std::nullopt;
    DirectionError error;
    const Eigen::Vector3d in_camera = calibration_.camera.camera_from_enu * *enu;
    const sim::PlaceSlopes slopes = sim::place_slopes(lens_, in_camera.data());
    if (!(std::abs(slopes.determinant()) > 0.0)) return std::nullopt;
    StarSighting place;
    place.enu = {(*enu)[0], (*enu)[1], (*enu)[2]};
    place.x_px = x_px;
    place.y_px = y_px;
    Eigen::Matrix2d pixels_per_radian;
    pixels_per_radian << slopes.slope[0][0], slopes.slope[0][1], slopes.slope[1][0], slopes.slope[1][1];
    const Eigen::MatrixXd moved =
        place_jacobian(calibration_.camera, all_, {place}) * calibration_.number_roots;
    const Eigen::MatrixXd turned = pixels_per_radian.inverse() * moved;
    const Eigen::Matrix2d covariance = turned * turned.transpose();
    const double half_sum = 0.5 * covariance.trace();
    const double half_difference = std::hypot(0.5 * (covariance(0, 0) - covariance(1, 1)), covariance(0, 1));
    error.by_stars_deg = std::sqrt(half_sum + half_difference) / sim::kRadiansPerDegree;
    double squares = 0.0;
    int seen = 0;
    for (const auto& [camera, lens] : others_) {
      const std::optional<Eigen::Vector3d> other = enu_of_place(*camera, lens, x_px, y_px);
      if (!other) continue;
      const double off = std::atan2(enu->cross(*other).norm(), enu->dot(*other)) / sim::kRadiansPerDegree;
      squares += off * off;
      ++seen;
    }
    if (seen > 0) error.by_lens_deg = std::sqrt(squares / seen);
    return error;
  }

 private:
  const Calibration& calibration_;
  sim::Lens<double> lens_;
  std::vector<std::pair<const SkyCamera*, sim::Lens<double>>> others_;
  std::vector<LensNumber> all_;
};

}  // namespace

double DirectionError::total_deg() const { return std::hypot(by_stars_deg, by_lens_deg); }

std::optional<DirectionError> direction_error(const Calibration& calibration, double x_px, double y_px) {
  return ErrorOfDirections(calibration).at(x_px, y_px);
}

std::optional<DirectionError> direction_error(const Calibration& calibration,
                                              const std::array<double, 3>& enu) {
  double x_px = 0.0, y_px = 0.0;
  if (!place_of_star(calibration.camera, enu, x_px, y_px)) return std::nullopt;
  return ErrorOfDirections(calibration).at(x_px, y_px);
}

DirectionErrors direction_errors(const Calibration& calibration) {
  const ErrorOfDirections errors(calibration);
  DirectionErrors found;
  found.opinions = errors.opinions();
  std::vector<double> all;
  const double lowest_up = std::sin(calibration.horizon_elevation_deg * sim::kRadiansPerDegree);
  for (int row = 0; row <= kErrorPlaces; ++row)
    for (int column = 0; column <= kErrorPlaces; ++column) {
      const double x_px = static_cast<double>(calibration.frame.width_px) * column / kErrorPlaces;
      const double y_px = static_cast<double>(calibration.frame.height_px) * row / kErrorPlaces;
      const std::optional<Eigen::Vector3d> enu = errors.enu_at(x_px, y_px);
      if (!enu || (*enu)[2] < lowest_up) continue;
      const std::optional<DirectionError> error = errors.at(x_px, y_px);
      if (!error || !std::isfinite(error->total_deg())) continue;
      all.push_back(error->total_deg());
      if (all.back() < found.worst_deg) continue;
      found.worst_deg = all.back();
      found.worst_x_px = x_px;
      found.worst_y_px = y_px;
    }
  if (!all.empty()) found.typical_deg = sim::median(all);
  return found;
}

std::string words_of(const DirectionErrors& errors) {
  return kDirectionsKnown + sim::short_number(errors.typical_deg, 2) + " deg typically, to " +
         sim::short_number(errors.worst_deg, 2) + " deg at (" + sim::short_number(errors.worst_x_px, 4) +
         ", " + sim::short_number(errors.worst_y_px, 4) + ") px, where it is worst" +
         (errors.opinions > 0 ? "; other lenses that fit as well: " + std::to_string(errors.opinions)
                              : "; no other lens fits as well");
}

}  // namespace vegard::fit
