#include "fit/search/lateral_offsets.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/base/number/dense_solvers.h"
#include "sim/scene/table/parameter_id.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit {
namespace {

constexpr double kRowsTogether =
    30.0;                              // neighbouring rows of a profile whose residuals go up and down as one
constexpr double kBelieved_km = 12.0;  // how far a stretch may be from where the model has it
constexpr double kOffset_km = 20.0, kSlope = 0.3;
constexpr double kCourseSteps = 8.0;  // of the wave number, to one more wave in view

struct Line {
  std::array<double, 2> start, along, aside;
  double length_km;
};

Line line_of(const sim::Scene& scene, const sim::Sheet& sheet) {
  const double bearing = sheet.bearing_deg * sim::kRadiansPerDegree;
  const double side = scene.field.inclination_deg < 0.0 ? -1.0 : 1.0;  // sim/emit/aurora/sheet.h
  Line line;
  line.along = {std::sin(bearing), std::cos(bearing)};
  line.aside = {-side * line.along[1], side * line.along[0]};
  line.length_km = sheet.length_km;
  line.start = {sheet.center_km.east - 0.5 * sheet.length_km * line.along[0],
                sheet.center_km.north - 0.5 * sheet.length_km * line.along[1]};
  return line;
}

/// Distance along a line at which an azimuth meets it; negative if it does not within its ends.
double meets_at_km(const Line& line, double azimuth_deg) {
  const double azimuth = azimuth_deg * sim::kRadiansPerDegree;
  const std::array<double, 2> look = {std::sin(azimuth), std::cos(azimuth)};
  const double cross = line.along[0] * look[1] - line.along[1] * look[0];
  if (std::abs(cross) < 0.05) return -1.0;
  const double t = -(line.start[0] * look[1] - line.start[1] * look[0]) / cross;
  const double ahead =
      (line.start[0] + t * line.along[0]) * look[0] + (line.start[1] + t * line.along[1]) * look[1];
  return ahead > 0.0 && t < line.length_km ? t : -1.0;
}

/// How far to the side the model has its own layers, in the mean.
double own_aside_km(const sim::Sheet& sheet, double along_km) {
  double sum = 0.0;
  for (int layer = 0; layer < sheet.layers; ++layer) {
    const double share = sheet.layers > 1 ? static_cast<double>(layer) / (sheet.layers - 1) : 0.0;
    sum += std::sin(sim::kTwoPi * along_km / sheet.wavelength_km + sheet.phase_rad +
                    share * sheet.phase_shift_rad);
  }
  return sheet.thickness_km * sum / sheet.layers;
}

}  // namespace

std::vector<std::vector<LateralOffset>> lateral_offsets(Comparison& comparison, const sim::Scene& scene) {
  const std::size_t sheets = scene.sheets.size();
  ParameterMap::Motion motion;
  std::vector<Line> lines;
  for (std::size_t s = 0; s < sheets; ++s) {
    for (int c = 0; c < 2; ++c)
      motion.numbers.push_back(sim::parameter_with(sim::ParameterRole::centre, static_cast<int>(s), c));
    lines.push_back(line_of(scene, scene.sheets[s]));
  }
  const Comparison::Point point = comparison.at(scene, motion);
  std::vector<double> jacobian;
  comparison.jacobian(point, jacobian);

  const Profile& data = comparison.data();
  // The profile's rows come first; where it is not compared, there are no offsets.
  const auto [used, residuals] = comparison.profile_part(point);
  const auto n = static_cast<Eigen::Index>(sheets);
  std::vector<Eigen::MatrixXd> normal(data.bands, Eigen::MatrixXd::Zero(n, n));
  std::vector<Eigen::VectorXd> right(data.bands, Eigen::VectorXd::Zero(n));
  std::vector<double> chi2(data.bands, 0.0);
  std::vector<int> rows(data.bands, 0);
  // A bin of several rows has the weight of all of them (fit/compare/observation.cpp).
  const int rows_of_bin = data.grid != nullptr ? std::max(1, static_cast<int>(data.grid->position_px)) : 1;
  Eigen::VectorXd slope(n);
  for (std::size_t k = 0; k < used.size(); ++k) {
    const std::size_t band = used[k] / (3 * static_cast<std::size_t>(data.rows));
    for (std::size_t s = 0; s < sheets; ++s)
      slope(static_cast<Eigen::Index>(s)) = lines[s].aside[0] * jacobian[(k * sheets + s) * 2] +
                                            lines[s].aside[1] * jacobian[(k * sheets + s) * 2 + 1];
    const double residual = residuals[k];
    normal[band].noalias() += slope * slope.transpose();
    right[band] -= slope * residual;
    chi2[band] += residual * residual;
    rows[band] += rows_of_bin;
  }

  std::vector<std::vector<LateralOffset>> result(sheets);
  for (int b = 0; b < data.bands; ++b) {
    if (rows[b] == 0) continue;
    const double variance = kRowsTogether * std::max(1.0, chi2[b] / rows[b]);
    const Eigen::MatrixXd covariance =
        sim::inverse_of(normal[b] / variance + Eigen::MatrixXd::Identity(n, n) / (kBelieved_km * kBelieved_km));
    const Eigen::VectorXd moved = covariance * right[b] / variance;
    const double x =
        0.5 * (band_begin(data.region, data.bands, b) + band_begin(data.region, data.bands, b + 1));
    const double azimuth =
        sim::direction_of_pixel(scene.camera, x, data.region.y + 0.7 * data.region.height).azimuth_deg;
    for (std::size_t s = 0; s < sheets; ++s) {
      const auto i = static_cast<Eigen::Index>(s);
      const double along = meets_at_km(lines[s], azimuth);
      if (along < 0.0 || covariance(i, i) > 0.5 * kBelieved_km * kBelieved_km) continue;
      // The belief takes a share of the step, and is no part of the data.
      const double data_variance = 1.0 / (1.0 / covariance(i, i) - 1.0 / (kBelieved_km * kBelieved_km));
      result[s].push_back({along,
                           own_aside_km(scene.sheets[s], along) + moved(i) * data_variance / covariance(i, i),
                           std::sqrt(data_variance)});
    }
  }
  return result;
}

std::vector<SineThroughOffsets> sines_through(const std::vector<LateralOffset>& offsets, double middle_km,
                                              double min_wavelength_km, double max_wavelength_km,
                                              double amplitude_km, int most) {
  if (offsets.size() < 5) return {};
  const auto by_place = [](const LateralOffset& a, const LateralOffset& b) {
    return a.along_km < b.along_km;
  };
  const auto [first, last] = std::minmax_element(offsets.begin(), offsets.end(), by_place);
  const double in_view = std::max(1.0, last->along_km - first->along_km);
  const double lowest = 1.0 / max_wavelength_km, highest = 1.0 / min_wavelength_km;
  const int steps = 1 + static_cast<int>(std::ceil(kCourseSteps * in_view * (highest - lowest)));
  std::vector<SineThroughOffsets> all;
  for (int step = 0; step <= steps; ++step) {
    const double wave_number = lowest + (highest - lowest) * step / steps;
    Eigen::Matrix4d normal =
        Eigen::Vector4d(1.0 / (kOffset_km * kOffset_km), 1.0 / (kSlope * kSlope),
                        1.0 / (amplitude_km * amplitude_km), 1.0 / (amplitude_km * amplitude_km))
            .asDiagonal();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    const auto basis = [&](double along) {
      const double angle = sim::kTwoPi * along * wave_number;
      return Eigen::Vector4d(1.0, along - middle_km, std::sin(angle), std::cos(angle));
    };
    double chi2 = 0.0;
    for (const LateralOffset& p : offsets) {
      const double weight = 1.0 / (p.sigma_km * p.sigma_km);
      const Eigen::Vector4d row = basis(p.along_km);
      normal += weight * row * row.transpose();
      right += weight * p.lateral_km * row;
      chi2 += weight * p.lateral_km * p.lateral_km;
    }
    const Eigen::Vector4d c = normal.ldlt().solve(right);
    all.push_back(
        {1.0 / wave_number, std::hypot(c(2), c(3)), std::atan2(c(3), c(2)), c(0), c(1), chi2 - right.dot(c)});
  }
  std::vector<SineThroughOffsets> best;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool below_left = i == 0 || all[i].chi2 <= all[i - 1].chi2;
    const bool below_right = i + 1 == all.size() || all[i].chi2 < all[i + 1].chi2;
    if (below_left && below_right) best.push_back(all[i]);
  }
  std::stable_sort(best.begin(), best.end(),
                   [](const SineThroughOffsets& a, const SineThroughOffsets& b) { return a.chi2 < b.chi2; });
  if (static_cast<int>(best.size()) > most) best.resize(most);
  return best;
}

}  // namespace vegard::fit
