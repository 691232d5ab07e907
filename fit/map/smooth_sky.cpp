#include "fit/map/smooth_sky.h"

#include <cmath>

#include <Eigen/Dense>

#include "sim/base/number/constants.h"
#include "sim/base/number/dense_solvers.h"
#include "sim/base/number/quantile.h"
#include "sim/view/sky/night_sky.h"

namespace vegard::fit {
namespace {

constexpr double kTownHeight_deg = 8.0;

}  // namespace

SmoothSky::SmoothSky(const sim::Scene& scene, const sim::FilmGeometry& film)
    : cells_(static_cast<std::size_t>(film.rows) * film.columns), block_((cells_ + kLanes - 1) / kLanes) {
  // Level; airglow by airmass, and what its layer and the air make of that; a town's or the twilight's glow
  // by its height, and round the horizon as a mean and two waves; both ways along the horizon.
  const sim::CameraView<double> view = sim::camera_view(scene.camera);
  const double observer = scene.site.altitude_m * 1e-3;
  for (int row = 0; row < film.rows; ++row)
    for (int column = 0; column < film.columns; ++column) {
      double enu[3];
      if (!sim::enu_of_cell(view, film, row, column, enu)) continue;
      const std::size_t cell = static_cast<std::size_t>(row) * film.columns + column;
      const double elevation = std::asin(std::clamp(enu[2], -1.0, 1.0)) / sim::kRadiansPerDegree;
      const double airglow = sim::van_rhijn(std::max(0.0, enu[2]), 97.0, observer) - 1.0;
      const double town = std::exp(-std::max(0.0, elevation) / kTownHeight_deg);
      const std::array<double, kTerms> terms = {1.0,
                                                airglow,
                                                town,
                                                enu[0],
                                                enu[1],
                                                town * enu[0],
                                                town * enu[1],
                                                town * (enu[0] * enu[0] - enu[1] * enu[1]),
                                                town * enu[0] * enu[1],
                                                airglow * airglow};
      for (std::size_t j = 0; j < kTerms; ++j)
        block_[cell / kLanes].term[j][cell % kLanes] = static_cast<float>(terms[j]);
    }
}

void SmoothSky::weigh(const std::vector<float>& weight, const std::vector<float>& data) {
  weighted_.clear();
  for (std::size_t block = 0; block < block_.size(); ++block)
    for (std::size_t i = block * kLanes * 3; i < std::min(weight.size(), (block + 1) * kLanes * 3); ++i)
      if (weight[i] > 0.0f) {
        weighted_.push_back(static_cast<std::uint32_t>(block));
        break;
      }
  // A sky that is as bright as the picture's darkest part, give or take all of it: a prior of next to no
  // weight that keeps terms which the region cannot tell apart from growing against each other.
  for (std::size_t c = 0; c < 3; ++c) {
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(kTerms, kTerms);
    std::vector<double> light;
    for (std::size_t cell = 0; cell < cells_; ++cell) {
      const double w = weight[cell * 3 + c];
      if (w == 0.0) continue;
      light.push_back(data[cell * 3 + c]);
      const Block& block = block_[cell / kLanes];
      std::array<double, kTerms> f{};
      for (std::size_t j = 0; j < kTerms; ++j) f[j] = block.term[j][cell % kLanes];
      for (std::size_t i = 0; i < kTerms; ++i)
        for (std::size_t j = 0; j <= i; ++j) normal(i, j) += w * f[i] * f[j];
    }
    if (light.empty()) {
      inverse_[c].assign(kTerms * kTerms, 0.0);
      continue;
    }
    const double dark = std::max(sim::quantile(light, 0.1), 1e-9);
    for (std::size_t i = 0; i < kTerms; ++i) normal(i, i) += i == 0 ? 0.0 : 1.0 / (dark * dark);
    const Eigen::MatrixXd full = normal.selfadjointView<Eigen::Lower>();
    const Eigen::MatrixXd inverse = sim::inverse_of(full);
    inverse_[c].assign(inverse.data(), inverse.data() + inverse.size());
  }
}

std::vector<float> SmoothSky::light(const Coefficients& sky) const {
  std::vector<float> light(cells_ * 3);
  for (std::size_t block = 0; block < block_.size(); ++block)
    each_of(block, sky, [&](std::size_t i, float of_cell) { light[i] = of_cell; });
  return light;
}

}  // namespace vegard::fit
