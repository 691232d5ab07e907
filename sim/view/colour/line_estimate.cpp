#include "sim/view/colour/line_estimate.h"

#include <Eigen/Dense>
#include <cassert>
#include <utility>

#include "sim/base/error.h"
#include "sim/base/number/dense_solvers.h"

namespace vegard::sim {
namespace {

constexpr double kEstimateMinShare = 1e-3;

Eigen::MatrixXd columns(const std::vector<Vector3>& rgb) {
  Eigen::MatrixXd m(3, rgb.size());
  for (std::size_t l = 0; l < rgb.size(); ++l)
    for (int c = 0; c < 3; ++c) m(c, l) = rgb[l][c];
  return m;
}

}  // namespace

LineEstimator::LineEstimator(std::vector<Vector3> rgb_per_rayleigh) : rgb_(std::move(rgb_per_rayleigh)) {
  if (rgb_.empty() || rgb_.size() > 3)
    throw Error(ErrorKind::scene,
                "three channels cannot give the light of " + std::to_string(rgb_.size()) + " lines")
        .key("emission.lines")
        .expected("one to three lines")
        .hint("name those that make up most of the light");
  const Eigen::MatrixXd scaled = columns(rgb_).colwise().normalized();
  const Eigen::VectorXd singular = singular_values(scaled);
  if (!(singular(singular.size() - 1) > kEstimateMinShare))
    throw Error(ErrorKind::scene, "the sensor cannot tell the colours of the lines apart")
        .key("emission.lines")
        .expected("lines of different colours that it sees")
        .hint("leave one of them out");
}

LineEstimate LineEstimator::estimate(const Vector3& rgb, const Matrix3& covariance) const {
  const Eigen::MatrixXd model = columns(rgb_);
  Eigen::Matrix3d noise;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) noise(r, c) = covariance[r][c];
  const Eigen::LLT<Eigen::Matrix3d> root(noise);
  assert(root.info() == Eigen::Success);
  // Whitened, so that the normal matrix need not be formed.
  const Eigen::MatrixXd white_model = root.matrixL().solve(model);
  const Eigen::Vector3d white_rgb = root.matrixL().solve(Eigen::Vector3d(rgb[0], rgb[1], rgb[2]));
  // Lines differ by orders of magnitude in what a sensor makes of them.
  const Eigen::VectorXd scale = white_model.colwise().norm();
  const Eigen::MatrixXd scaled = white_model * scale.cwiseInverse().asDiagonal();
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(scaled);
  const Eigen::VectorXd solution = scale.cwiseInverse().asDiagonal() * qr.solve(white_rgb);
  const Eigen::MatrixXd spread = scale.cwiseInverse().asDiagonal() * inverse_of(scaled.transpose() * scaled) *
                                 scale.cwiseInverse().asDiagonal();
  LineEstimate result;
  for (int l = 0; l < lines(); ++l) {
    result.rayleigh.push_back(solution(l));
    result.covariance.emplace_back();
    for (int m = 0; m < lines(); ++m) result.covariance[l].push_back(spread(l, m));
  }
  return result;
}

LineEstimate LineEstimator::estimate(const Vector3& rgb, const Vector3& sigma) const {
  return estimate(rgb, diagonal({sigma[0] * sigma[0], sigma[1] * sigma[1], sigma[2] * sigma[2]}));
}

}  // namespace vegard::sim
