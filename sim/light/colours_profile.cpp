#include "sim/light/colours_profile.h"

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <cstddef>

namespace vegard::sim {
namespace {

using Colour = std::array<double, 3>;

/// The best set of lines found so far.
struct Best {
  double residual = 0.0;  ///< its square
  double light = 0.0;
  std::vector<double> amounts;
};

/// Tries the lines of `chosen` alone.
void consider(const std::vector<Colour>& of_line, const Colour& colour, const std::vector<int>& chosen,
              double same, Best& best) {
  const int n = static_cast<int>(chosen.size());
  Eigen::MatrixXd matrix(3, n);
  for (int k = 0; k < n; ++k)
    for (int c = 0; c < 3; ++c) matrix(c, k) = of_line[chosen[k]][c];
  const Eigen::Vector3d wanted(colour[0], colour[1], colour[2]);
  const auto solver = matrix.colPivHouseholderQr();
  if (solver.rank() < n) return;
  const Eigen::VectorXd amounts = solver.solve(wanted);
  // A colour on the edge of the cone may miss it by rounding.
  const double rounding = 1e-12 * amounts.cwiseAbs().maxCoeff();
  if (amounts.minCoeff() < -rounding) return;
  const Eigen::VectorXd light = amounts.cwiseMax(0.0);
  const double residual = (matrix * light - wanted).squaredNorm();
  if (residual > best.residual + same) return;
  if (residual > best.residual - same && light.sum() >= best.light) return;
  best.residual = residual;
  best.light = light.sum();
  best.amounts.assign(of_line.size(), 0.0);
  for (int k = 0; k < n; ++k) best.amounts[chosen[k]] = light[k];
}

}  // namespace

std::vector<double> line_amounts(const std::vector<Colour>& of_line, const Colour& colour) {
  const int lines = static_cast<int>(of_line.size());
  const double size = colour[0] * colour[0] + colour[1] * colour[1] + colour[2] * colour[2];
  Best best{size, 0.0, std::vector<double>(of_line.size(), 0.0)};
  // The best choice is the best of some three lines or fewer, by their normal equations: all are tried.
  const double same = 1e-18 * size;
  for (int i = 0; i < lines; ++i) {
    consider(of_line, colour, {i}, same, best);
    for (int j = i + 1; j < lines; ++j) {
      consider(of_line, colour, {i, j}, same, best);
      for (int k = j + 1; k < lines; ++k) consider(of_line, colour, {i, j, k}, same, best);
    }
  }
  return best.amounts;
}

HeightProfile colours_profile(const HeightProfile& usual, const ColourLadder& ladder) {
  HeightProfile profile = dark_profile(usual.lines);
  for (int a = 0; a < HeightProfile::kAltitudes; ++a) {
    const std::size_t row = static_cast<std::size_t>(a) * usual.stride;
    double rate = 0.0, slope = 0.0, amounts = 0.0;
    const double high = std::clamp(
        (HeightProfile::altitude_km(a) - ladder.low_km) / (ladder.high_km - ladder.low_km), 0.0, 1.0);
    for (int l = 0; l < usual.lines; ++l) {
      rate += usual.rate[row + l];
      slope += usual.d_rate_d_ln_energy[row + l];
      amounts += (1.0 - high) * ladder.low[l] + high * ladder.high[l];
    }
    if (!(amounts > 0.0)) continue;
    for (int l = 0; l < usual.lines; ++l) {
      const double share = ((1.0 - high) * ladder.low[l] + high * ladder.high[l]) / amounts;
      profile.rate[row + l] = static_cast<float>(rate * share);
      profile.d_rate_d_ln_energy[row + l] = static_cast<float>(slope * share);
    }
  }
  return profile;
}

ProfileTable colours_table(const ProfileTable& usual, const ColourLadder& ladder) {
  ProfileTable table = usual;
  for (HeightProfile& profile : table.of_energy) profile = colours_profile(profile, ladder);
  return table;
}

}  // namespace vegard::sim
