#include "fit/compare/granulation_statistic.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fit/measure/noise_model.h"
#include "fit/measure/profile.h"
#include "fit/measure/profile_bins.h"
#include "sim/base/error.h"
#include "sim/base/number/random.h"
#include "sim/emit/sun/sun_frame.h"
#include "sim/scene/table/parameter_id.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit {
namespace {

constexpr int kMaxCells = 128, kFewestCells = 16;
constexpr double kFullToRadii = 0.8, kNothingFromRadii = 0.95;
constexpr std::size_t kRealisations = 8, kForScatter = 16;
constexpr double kMaxNoise = 0.5;    ///< of a band's power
constexpr double kFarShift = 100.0;  ///< lengths of the largest waves that draws lie within
constexpr double kHalfPi = 1.5707963267948966;

sim::Error no_granulation(const sim::Scene& scene, const std::string& problem) {
  return sim::Error(sim::ErrorKind::scene, problem)
      .file(scene.file)
      .key("fit.granulation_weight")
      .hint("or fit.granulation_weight = 0");
}

/// The ray through a place of the picture, in the Sun's frame; false if it does not go its way.
bool ray_of(const sim::Scene& scene, double x_px, double y_px, sim::SkyRay<double>& ray) {
  const sim::CameraView<double> view = sim::camera_view(scene.camera);
  double enu[3];
  if (!sim::enu_of_pixel(view, x_px, y_px, enu)) return false;
  ray = sim::SunFrame<double>(scene.sun, [](const double& number) { return number; }).ray(enu);
  return ray.observer < 0.0;
}

double hann(int i, int n) { return std::pow(std::sin(2.0 * kHalfPi * (i + 0.5) / n), 2); }

double limb_window(double radii) {
  const double t =
      std::clamp((radii - kFullToRadii) / (kNothingFromRadii - kFullToRadii), 0.0, 1.0) * kHalfPi;
  return std::pow(std::cos(t), 2);
}

std::vector<double> window_of(const sim::Scene& scene, const BinGrid& grid, int cell) {
  std::vector<double> window;
  for (int r = 0; r < grid.groups; ++r)
    for (int c = 0; c < grid.positions; ++c) {
      sim::SkyRay<double> ray;
      const bool sees =
          ray_of(scene, grid.region.x + (c + 0.5) * cell, grid.region.y + (r + 0.5) * cell, ray);
      const double radii = sees ? std::sqrt(ray.aside) / scene.sun.radius : 1.0;
      window.push_back(hann(r, grid.groups) * hann(c, grid.positions) * limb_window(radii));
    }
  return window;
}

/// Where the ray through the region's middle meets the middle of each chromosphere.
std::vector<std::array<double, 3>> places_of_middle(const sim::Scene& scene, const Region& region) {
  std::vector<std::array<double, 3>> places;
  sim::SkyRay<double> ray;
  const bool sees = ray_of(scene, region.x + 0.5 * region.width, region.y + 0.5 * region.height, ray);
  for (const sim::Chromosphere& c : scene.chromospheres) {
    double half = 0.0;
    places.push_back({0.0, 0.0, 0.0});
    if (!sees || !sim::meets_sphere(ray, 0.5 * (c.innerradius + c.outerradius), half)) continue;
    for (int i = 0; i < 3; ++i) places.back()[i] = ray.nearest[i] - half * ray.direction[i];
  }
  return places;
}

/// The brightest of the region: a line may shine in one channel alone.
int brightest_channel(const Profile& cells) {
  double light[3] = {0.0, 0.0, 0.0};
  for (std::size_t i = 0; i < cells.mean.size(); ++i)
    if (cells.count[i] > 0) light[i % 3] += cells.mean[i];
  int best = 1;
  for (const int c : {0, 2})
    if (light[c] > light[best]) best = c;
  return best;
}

/// Returns how far each chromosphere is shifted in one realisation.
std::vector<std::array<double, 3>> drawn_shifts(const sim::Scene& scene, std::uint32_t realisation) {
  std::vector<std::array<double, 3>> shifts;
  for (std::size_t c = 0; c < scene.chromospheres.size(); ++c) {
    const sim::Words words =
        sim::random_words(scene.seed, sim::Stream::search, realisation, static_cast<std::uint32_t>(c));
    shifts.push_back({});
    for (int i = 0; i < 3; ++i)
      shifts.back()[i] = kFarShift * (words[static_cast<std::size_t>(i)] / 4294967296.0);
  }
  return shifts;
}

/// The variance of ln(power) over realisations, of which each band has kForScatter, in that of Gaussian
/// light.
double scatter_ratio(const std::vector<std::vector<double>>& ln_power, const PowerSpectrum& spectrum) {
  double ratio = 0.0;
  for (std::size_t b = 0; b < ln_power.size(); ++b) {
    double sum = 0.0, square = 0.0;
    for (const double x : ln_power[b]) sum += x;
    for (const double x : ln_power[b]) square += std::pow(x - sum / kForScatter, 2);
    ratio += square / (kForScatter - 1) / spectrum.relative_variance(b);
  }
  return ratio / static_cast<double>(ln_power.size());
}

}  // namespace

GranulationStatistic::GranulationStatistic(const sim::Scene& scene, const Photo& photo, const Region& region,
                                           double weight, double model_error, int threads)
    : weight_(weight), middle_(places_of_middle(scene, region)) {
  if (!scene.sun.shown || scene.chromospheres.empty())
    throw no_granulation(scene, "there is no chromosphere whose granules could be compared")
        .expected("sun.shown = true and a [[chromosphere]]");
  const int cell = (std::max(region.width, region.height) + kMaxCells - 1) / kMaxCells;
  const auto grid = std::make_shared<const BinGrid>(image_bins(column_bins(region, 1), cell));
  if (std::min(grid->groups, grid->positions) < kFewestCells)
    throw no_granulation(scene, "the region is too small for a spectrum")
        .expected("at least " + std::to_string(kFewestCells * cell) + " pixels each way");
  std::vector<double> window = window_of(scene, *grid, cell);
  const Profile cells = measured_profile(scene, photo, grid);
  channel_ = brightest_channel(cells);
  std::vector<double> light(grid->bins());
  double mean = 0.0, weights = 0.0;
  for (std::size_t b = 0; b < grid->bins(); ++b) {
    const std::size_t i = b * 3 + channel_;
    if (cells.count[i] == 0) window[b] = 0.0;
    if (!(window[b] > 0.0)) continue;
    light[b] = cells.mean[i];
    mean += window[b] * light[b];
    weights += window[b];
  }
  // A sixteenth of what a Hann window alone would leave.
  if (!(weights > grid->bins() / 64.0) || !(mean > 0.0))
    throw no_granulation(scene, "the region shows too little of the Sun's disc")
        .expected("a region (fit.roi_px) on the disc");
  spectrum_ = std::make_unique<PowerSpectrum>(grid->positions, grid->groups, std::move(window));

  for (const sim::Chromosphere& c : scene.chromospheres) start_scale_.push_back(c.scale);
  for (std::size_t k = 0; k < kForScatter; ++k)
    drawn_.push_back(drawn_shifts(scene, static_cast<std::uint32_t>(k)));
  model_ = std::make_unique<ProfileModel>(scene, photo, std::vector<std::shared_ptr<const BinGrid>>{grid},
                                          1.0, 0.0, threads);

  // By how much more than Gaussian light the start's own chromospheres scatter.
  const PowerSpectrum::Light seen = spectrum_->of(light);
  const double noise = spectrum_->noise_power(seen, cell_variances(scene, photo, cells, channel_));
  std::vector<std::vector<double>> ln_power(spectrum_->bands());
  for (std::size_t k = 0; k < kForScatter; ++k) {
    ModelProfile model;
    model_->evaluate(realisation(scene, k), model);
    const std::vector<double> model_cells = cells_of(model);
    if (!std::any_of(model_cells.begin(), model_cells.end(), [](double x) { return x > 0.0; }))
      throw no_granulation(scene, "no light of the scene falls into the region")
          .expected("the Sun's disc in the region (fit.roi_px)");
    const std::vector<double> power = spectrum_->of(model_cells).power;
    for (std::size_t b = 0; b < power.size(); ++b) ln_power[b].push_back(std::log(power[b] + noise));
  }
  const double scatter = std::max(1.0, scatter_ratio(ln_power, *spectrum_));
  for (std::size_t b = 0; b < spectrum_->bands(); ++b) {
    if (!(noise < kMaxNoise * seen.power[b])) continue;
    const double relative = scatter * spectrum_->relative_variance(b);
    // ln of a mean of few is low by half of its variance; the model's mean is of eight times as many.
    const double low = 0.5 * relative * (1.0 - 1.0 / kRealisations);
    bands_.push_back({b, std::log(seen.power[b]) + low, noise,
                      std::sqrt(relative * (1.0 + 1.0 / kRealisations) + 4.0 * model_error * model_error)});
  }
  if (bands_.empty())
    throw sim::unreadable(
        photo.file_name, "noise makes up more than half of the power of the light in all rings of wavenumber")
        .key("fit.granulation_weight")
        .expected("granules that stand out of the noise")
        .hint("a region (fit.roi_px) where they do, or fit.granulation_weight = 0");
}

sim::Scene GranulationStatistic::realisation(const sim::Scene& scene, std::size_t which) const {
  sim::Scene drawn = scene;
  for (std::size_t c = 0; c < drawn.chromospheres.size(); ++c) {
    sim::Chromosphere& chromosphere = drawn.chromospheres[c];
    const double growth = 1.0 / start_scale_[c] - 1.0 / chromosphere.scale;
    for (int i = 0; i < 3; ++i) chromosphere.shift[i] += drawn_[which][c][i] + middle_[c][i] * growth;
  }
  return drawn;
}

std::vector<double> GranulationStatistic::cells_of(const ModelProfile& light) const {
  std::vector<double> cells(light.value.size() / 3);
  for (std::size_t b = 0; b < cells.size(); ++b) cells[b] = light.value[b * 3 + channel_];
  return cells;
}

void GranulationStatistic::evaluate(const StatisticInput& input, double* residual, double* jacobian) const {
  const std::lock_guard<std::mutex> lock(model_in_use_);
  const sim::Scene& scene = input.scene;
  const std::size_t numbers = jacobian != nullptr ? input.numbers.size() : 0;
  std::vector<double> power(spectrum_->bands(), 0.0);
  std::vector<std::vector<double>> slope(numbers, std::vector<double>(spectrum_->bands(), 0.0));
  for (std::size_t k = 0; k < kRealisations; ++k) {
    const sim::Scene drawn = realisation(scene, k);
    ModelProfile model;
    // The shifts follow a scale that moves: three derivatives more for each chromosphere.
    std::vector<sim::ParameterId> free = input.numbers;
    if (numbers > 0) {
      for (std::size_t c = 0; c < drawn.chromospheres.size(); ++c)
        for (int i = 0; i < 3; ++i)
          free.push_back(sim::parameter_with(sim::ParameterRole::granule_shift, static_cast<int>(c), i));
      model_->evaluate_with_derivatives(drawn, free, model);
    } else {
      model_->evaluate(drawn, model);
    }
    const std::vector<double> cells = cells_of(model);
    const PowerSpectrum::Light light = spectrum_->of(cells);
    for (std::size_t b = 0; b < power.size(); ++b) power[b] += light.power[b] / kRealisations;
    for (std::size_t n = 0; n < numbers; ++n) {
      std::vector<double> grow(cells.size());
      const auto add = [&](std::size_t which, double times) {
        for (std::size_t i = 0; i < grow.size(); ++i)
          grow[i] += times * model.derivative[(i * 3 + channel_) * free.size() + which];
      };
      add(n, 1.0);
      for (std::size_t c = 0; c < drawn.chromospheres.size(); ++c)
        if (const double scale = drawn.chromospheres[c].scale;
            free[n] == sim::parameter_with(sim::ParameterRole::granule_size, static_cast<int>(c)))
          for (int i = 0; i < 3; ++i) add(numbers + 3 * c + i, middle_[c][i] / (scale * scale));
      const std::vector<double> by_number = spectrum_->slope(light, grow);
      for (std::size_t b = 0; b < power.size(); ++b) slope[n][b] += by_number[b] / kRealisations;
    }
  }
  const std::size_t p = input.light.free;
  if (jacobian != nullptr) std::fill_n(jacobian, bands_.size() * p, 0.0);
  for (std::size_t r = 0; r < bands_.size(); ++r) {
    const Band& band = bands_[r];
    const double per_sigma = std::sqrt(weight_) / band.sigma, all = power[band.band] + band.noise_power;
    residual[r] = per_sigma * (band.ln_power - std::log(all));
    for (std::size_t n = 0; n < numbers; ++n)
      for (std::size_t j = 0; j < p; ++j)
        jacobian[r * p + j] -= per_sigma * slope[n][band.band] / all *
                               (input.slopes.empty() ? (n == j ? 1.0 : 0.0) : input.slopes[n * p + j]);
  }
}

}  // namespace vegard::fit
