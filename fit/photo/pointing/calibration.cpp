#include "fit/photo/pointing/calibration.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "fit/photo/pointing/star_check.h"
#include "sim/base/error.h"
#include "sim/base/file/number_text.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/dense_solvers.h"
#include "sim/base/parallel.h"
#include "sim/scene/table/parameter_id.h"

namespace vegard::fit {
namespace {

constexpr double kCorrelationStrong = 0.95;  // of a correlation that is reported
constexpr double kDegrees = 1.0 / sim::kRadiansPerDegree;

/// A scene's number as a function of a calibration's.
struct SceneNumber {
  sim::ParameterRole role;
  double value;
  Eigen::RowVectorXd by_number;  ///< [LensNumber]
};

std::vector<SceneNumber> scene_numbers(const SkyCamera& camera, const Frame& frame,
                                       const Pointing& pointing) {
  std::vector<SceneNumber> all;
  using sim::ParameterRole;
  const auto add = [&](ParameterRole role, double value, LensNumber number, double slope) {
    all.push_back({role, value, Eigen::RowVectorXd::Zero(lens_numbers)});
    all.back().by_number[number] = slope;
  };
  const double angles[3] = {pointing.azimuth_deg, pointing.elevation_deg, pointing.roll_deg};
  constexpr ParameterRole kAngles[3] = {ParameterRole::camera_azimuth, ParameterRole::camera_elevation,
                                        ParameterRole::camera_roll};
  for (int i = 0; i < 3; ++i) {
    all.push_back({kAngles[i], angles[i], Eigen::RowVectorXd::Zero(lens_numbers)});
    all.back().by_number.head<3>() = pointing.by_turns.row(i);
  }
  const auto& n = camera.numbers;
  const double half = 0.5 * frame.width_px, focal = n[focal_px_number];
  if (camera.model == sim::LensModel::pinhole)
    add(ParameterRole::field_of_view, 2.0 * std::atan(half / focal) * kDegrees, focal_px_number,
        -2.0 * half / (focal * focal + half * half) * kDegrees);
  else
    add(ParameterRole::focal_length, focal, focal_px_number, 1.0);
  add(ParameterRole::principal_x, n[centre_x_number] - half, centre_x_number, 1.0);
  add(ParameterRole::principal_y, n[centre_y_number] - 0.5 * frame.height_px, centre_y_number, 1.0);
  add(ParameterRole::lens_aspect, n[aspect_ratio_number], aspect_ratio_number, 1.0);
  add(ParameterRole::lens_k1, n[radial_1_number], radial_1_number, 1.0);
  add(ParameterRole::lens_k2, n[radial_2_number], radial_2_number, 1.0);
  add(ParameterRole::lens_k3, n[radial_3_number], radial_3_number, 1.0);
  add(ParameterRole::lens_p1, n[decentring_1_number], decentring_1_number, 1.0);
  add(ParameterRole::lens_p2, n[decentring_2_number], decentring_2_number, 1.0);
  return all;
}

/// Sets all standard errors and correlations by the roots of the covariance. A number is free if it depends
/// on one that was fitted.
void take_roots(const Eigen::MatrixXd& roots, Calibration& calibration) {
  calibration.number_roots = roots;
  calibration.estimates.clear();
  std::vector<Eigen::RowVectorXd> free_rows;
  for (const SceneNumber& number :
       scene_numbers(calibration.camera, calibration.frame, calibration.pointing)) {
    CameraEstimate estimate{sim::parameter_with(number.role), number.value, 0.0, false};
    for (int one = 0; one < lens_numbers; ++one)
      estimate.free = estimate.free || (number.by_number[one] != 0.0 && calibration.is_free[one]);
    if (estimate.free) {
      free_rows.push_back(number.by_number * roots);
      estimate.sigma = free_rows.back().norm();
    }
    calibration.estimates.push_back(estimate);
  }
  const int m = static_cast<int>(free_rows.size());
  calibration.correlation = Eigen::MatrixXd::Identity(m, m);
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m; ++j) {
      const double lengths_product = free_rows[i].norm() * free_rows[j].norm();
      if (i != j && lengths_product > 0.0)
        calibration.correlation(i, j) = free_rows[i].dot(free_rows[j]) / lengths_product;
    }
  calibration.line_of_sight_sigma_deg = std::max(roots.row(0).norm(), roots.row(1).norm()) * kDegrees;
  calibration.twist_sigma_deg = roots.row(2).norm() * kDegrees;
}

std::string number_text(const char* format, double a, double b = 0.0) {
  char text[320];
  std::snprintf(text, sizeof text, format, a, b);
  return text;
}

/// The errors by the Jacobian of the stars in use.
void tell_errors(Calibration& calibration, const std::vector<LensNumber>& free) {
  const int k = static_cast<int>(free.size()), n = 2 * calibration.used();
  StarSet used;
  double sum = 0.0;
  for (const StarResidual& one : calibration.residuals) {
    used.push_back(one.used);
    if (one.used) sum += one.dx_px * one.dx_px + one.dy_px * one.dy_px;
  }
  calibration.sigma_px = n > k ? std::sqrt(sum / (n - k)) : 0.0;
  const Eigen::MatrixXd root =
      root_of_inverse(place_jacobian(calibration.camera, free, calibration.stars, used));
  // The rows are all of the calibration's numbers; those of numbers held fixed are 0.
  Eigen::MatrixXd roots = Eigen::MatrixXd::Zero(lens_numbers, k);
  for (int j = 0; j < k; ++j) roots.row(free[j]) = root.row(j);
  set_errors(calibration, roots, free);
}

/// Computes the residual of each star in a fit without it. Each fit is its own, so that threads share them.
/// One of many stars changes the fit so little that the linear formula gives the same.
void leave_out(Calibration& calibration, const std::vector<LensNumber>& free) {
  constexpr int kLinearFrom = 100;
  StarSet used;
  for (const StarResidual& one : calibration.residuals) used.push_back(one.used);
  std::vector<Eigen::Vector2d> linear;
  if (calibration.used() >= kLinearFrom)
    linear = left_one_out(calibration.camera, free, calibration.stars, used);
  std::size_t next = 0;
  for (StarResidual& one : calibration.residuals) {
    if (linear.empty() || !one.used) continue;
    one.without_dx_px = linear[next][0];
    one.without_dy_px = linear[next++][1];
  }
  if (linear.empty())
    sim::parallel_for(used.size(), 0, [&](std::size_t i, int) {
      StarResidual& one = calibration.residuals[i];
      if (!one.used) return;
      StarSet others = used;
      others[i] = 0;
      const CameraFit fit = fit_camera(calibration.camera, free, calibration.stars, others);
      const Eigen::Vector2d left = residuals(fit.camera, {calibration.stars[i]})[0];
      one.without_dx_px = left[0];
      one.without_dy_px = left[1];
    });
  double sum = 0.0;
  for (const StarResidual& one : calibration.residuals)
    if (one.used) sum += one.without_dx_px * one.without_dx_px + one.without_dy_px * one.without_dy_px;
  calibration.without_rms_px = std::sqrt(sum / calibration.used());
}

/// Computes the residual of each star in a fit without its ninth of the picture.
void leave_regions_out(Calibration& calibration, const std::vector<LensNumber>& free) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  std::array<StarSet, kPictureNinths> others;
  for (StarSet& set : others)
    for (const StarResidual& one : calibration.residuals) set.push_back(one.used);
  std::vector<int> ninths;
  for (std::size_t i = 0; i < calibration.stars.size(); ++i) {
    ninths.push_back(ninth_of(calibration.frame, calibration.stars[i].x_px, calibration.stars[i].y_px));
    others[static_cast<std::size_t>(ninths.back())][i] = 0;
  }
  const int k = static_cast<int>(free.size());
  sim::parallel_for(kPictureNinths, 0, [&](std::size_t ninth, int) {
    const bool enough = 2 * count(others[ninth]) >= k + 4;
    CameraFit fit;
    if (enough) fit = fit_camera(calibration.camera, free, calibration.stars, others[ninth]);
    for (std::size_t i = 0; i < calibration.stars.size(); ++i) {
      StarResidual& one = calibration.residuals[i];
      if (ninths[i] != static_cast<int>(ninth)) continue;
      one.without_region_dx_px = one.without_region_dy_px = kUnknown;
      if (!enough || !fit.good || !one.used) continue;
      const Eigen::Vector2d left = residuals(fit.camera, {calibration.stars[i]})[0];
      if (!left.allFinite()) continue;
      one.without_region_dx_px = left[0];
      one.without_region_dy_px = left[1];
    }
  });
}

/// Throws if lenses fit the stars, but each only because of single stars.
void refuse_unheld(const LensChoice& choice, const std::string& name) {
  const LensCandidate* best = nullptr;
  for (const LensCandidate& one : choice.candidates)
    if (!one.is_held && (best == nullptr || one.without_rms_px < best->without_rms_px)) best = &one;
  if (best == nullptr) return;
  throw sim::unreadable(
      name, number_text("the stars do not hold the lens: they are %.2f px off, but each by a fit without it "
                        "%.2f px",
                        best->rms_px, best->without_rms_px))
      .expected("more stars, or a lens of fewer numbers")
      .hint("some may have wrong names; --camera with --free rotation fits a known lens to few stars");
}

}  // namespace

const char* words_of(CalibrationEvidence evidence) {
  return evidence == CalibrationEvidence::stars ? "stars" : "points of the maps";
}

std::string words_of(const MapAgreement& agreement) {
  std::string words = "all " + std::to_string(agreement.pixels) + " pixels: rms " +
                      sim::short_number(agreement.rms_px, 3) + " px, the largest " +
                      sim::short_number(agreement.largest_px, 3) + " px at (" +
                      std::to_string(agreement.largest_x) + ", " + std::to_string(agreement.largest_y) + ")";
  if (agreement.without_image > 0)
    words += "; of " + std::to_string(agreement.without_image) + " more the lens has no image";
  return words;
}

int Calibration::used() const {
  return static_cast<int>(
      std::count_if(residuals.begin(), residuals.end(), [](const StarResidual& one) { return one.used; }));
}

void set_residuals(Calibration& calibration, const StarSet& used) {
  calibration.pointing = pointing_of(calibration.camera);
  calibration.residuals.clear();
  const std::vector<Eigen::Vector2d> left = residuals(calibration.camera, calibration.stars);
  double sum = 0.0;
  for (std::size_t i = 0; i < calibration.stars.size(); ++i) {
    const StarSighting& star = calibration.stars[i];
    StarResidual one;
    one.dx_px = one.without_dx_px = one.without_region_dx_px = left[i][0];
    one.dy_px = one.without_dy_px = one.without_region_dy_px = left[i][1];
    one.used = used[i] != 0;
    if (one.used) sum += left[i].squaredNorm();
    const double along = calibration.camera.camera_from_enu.row(2).dot(
        Eigen::RowVector3d(star.enu[0], star.enu[1], star.enu[2]));
    one.off_axis_deg = std::acos(std::clamp(along, -1.0, 1.0)) * kDegrees;
    one.from_centre_px = std::hypot(star.x_px - calibration.camera.numbers[centre_x_number],
                                    star.y_px - calibration.camera.numbers[centre_y_number]);
    calibration.residuals.push_back(one);
  }
  calibration.rms_px = calibration.without_rms_px = std::sqrt(sum / std::max(1, calibration.used()));
}

Eigen::MatrixXd root_of_inverse(const Eigen::MatrixXd& jacobian) {
  // The triangle of a QR decomposition, of columns of length 1, is used because J'J would lose half of the
  // digits.
  const Eigen::RowVectorXd lengths = jacobian.colwise().norm();
  const Eigen::MatrixXd scaled = jacobian * lengths.cwiseInverse().asDiagonal();
  const Eigen::MatrixXd triangle = sim::upper_triangle(scaled);
  const Eigen::MatrixXd inverse = triangle.triangularView<Eigen::Upper>().solve(
      Eigen::MatrixXd::Identity(jacobian.cols(), jacobian.cols()));
  return lengths.cwiseInverse().asDiagonal() * inverse;
}

void set_errors(Calibration& calibration, const Eigen::MatrixXd& unit_roots,
                const std::vector<LensNumber>& free) {
  for (const LensNumber one : free) calibration.is_free[one] = true;
  take_roots(calibration.sigma_px * unit_roots, calibration);
}

void set_warnings(Calibration& calibration) {
  std::vector<const CameraEstimate*> free;
  for (const CameraEstimate& estimate : calibration.estimates)
    if (estimate.free) free.push_back(&estimate);
  for (std::size_t i = 0; i < free.size(); ++i)
    for (std::size_t j = i + 1; j < free.size(); ++j) {
      const double r = calibration.correlation(static_cast<int>(i), static_cast<int>(j));
      if (std::abs(r) < kCorrelationStrong) continue;
      std::string words = free[i]->key() + " and " + free[j]->key() +
                          " are strongly correlated (correlation " + number_text("%.3f)", r);
      if (free[i]->id.role() == sim::ParameterRole::camera_azimuth &&
          free[j]->id.role() == sim::ParameterRole::camera_roll)
        words +=
            number_text(": the camera looks %.1f° from the zenith; about its axis it is known to %.3f°",
                        90.0 - std::abs(calibration.pointing.elevation_deg), calibration.twist_sigma_deg);
      calibration.warnings.push_back(words);
    }
  constexpr double kHeldByEach = 2.0;
  if (calibration.evidence == CalibrationEvidence::stars &&
      calibration.without_rms_px > kHeldByEach * calibration.rms_px && calibration.without_rms_px > 0.1)
    calibration.warnings.push_back(number_text(
        "the stars hardly hold this lens: they are %.2f px off, but each by a fit without it %.2f px; "
        "add stars, or take a lens of fewer numbers (--lens, --terms, --hold-centre)",
        calibration.rms_px, calibration.without_rms_px));
  const int left_out = static_cast<int>(calibration.stars.size()) - calibration.used();
  if (3 * left_out > static_cast<int>(calibration.stars.size()))
    calibration.warnings.push_back(
        calibration.evidence == CalibrationEvidence::stars
            ? "more than a third of the stars were left out: are they the stars they are called?"
            : "more than a third of the points were left out: no lens that is known here made these maps");
}

Calibration calibrate(const LensSettings& settings, const std::vector<StarSighting>& stars,
                      const Frame& frame, const std::string& name, CalibrationEvidence evidence) {
  std::size_t fewest = settings.only.size();
  if (fewest == 0) {
    fewest = lens_numbers;
    for (const LensForm& form : lens_forms()) {
      if (settings.model && form.model != *settings.model) continue;
      if (settings.form && words_of(form) != words_of(*settings.form)) continue;
      const auto n = static_cast<int>(stars.size());
      const bool may_hold = n >= kFewestStars && n <= kVeryFewStars && form.radial == 0;
      fewest = std::min(fewest, free_numbers(form, settings.centre_free && !may_hold).size());
    }
  }
  check_stars(stars, static_cast<int>(fewest), name, words_of(evidence));
  const LensChoice choice = choose_lens(settings, stars, frame);
  if (choice.chosen < 0) {
    refuse_unheld(choice, name);
    throw sim::unreadable(
        name, std::string("no lens brings the ") + words_of(evidence) + " to where they were seen")
        .hint(evidence == CalibrationEvidence::stars
                  ? "are they the stars they are called? Check the time, the site, and the columns' meaning"
                  : "do both maps belong to one camera, and say degrees from north to the east and above the "
                    "horizon?");
  }
  Calibration calibration;
  calibration.evidence = evidence;
  calibration.candidates = choice.candidates;
  calibration.chosen = choice.chosen;
  const LensCandidate& chosen = calibration.candidates[choice.chosen];
  calibration.camera = chosen.fit.camera;
  calibration.form = chosen.form;
  calibration.frame = frame;
  calibration.stars = stars;
  set_residuals(calibration, choice.used);
  tell_errors(calibration, chosen.free);
  if (evidence == CalibrationEvidence::stars) {
    leave_out(calibration, chosen.free);
    leave_regions_out(calibration, chosen.free);
  }
  set_warnings(calibration);
  return calibration;
}

void add_time_error(Calibration& calibration, double latitude_deg, double turn_deg) {
  const bool is_turning = calibration.is_free[turn_about_right] && calibration.is_free[turn_about_down] &&
                          calibration.is_free[turn_about_forward];
  if (!is_turning || !(turn_deg > 0.0)) return;
  const double latitude = latitude_deg * sim::kRadiansPerDegree;
  const Eigen::Vector3d pole(0.0, std::cos(latitude), std::sin(latitude));
  Eigen::MatrixXd roots = calibration.number_roots;
  roots.conservativeResize(Eigen::NoChange, roots.cols() + 1);
  roots.col(roots.cols() - 1).setZero();
  roots.col(roots.cols() - 1).head<3>() =
      calibration.camera.camera_from_enu * pole * (turn_deg * sim::kRadiansPerDegree);
  take_roots(roots, calibration);
}

}  // namespace vegard::fit
