#include "fit/compare/statistics.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>

#include "fit/compare/border_statistic.h"
#include "fit/compare/colour_statistic.h"
#include "fit/compare/granulation_statistic.h"
#include "fit/compare/texture_statistic.h"
#include "fit/measure/noise_model.h"
#include "fit/measure/profile.h"
#include "fit/measure/profile_bins.h"
#include "sim/base/error.h"
#include "sim/scene/structs/sensor.h"

namespace vegard::fit {
namespace {

/// A weight multiplies chi2. Where it is 1, not a bit of sigma changes.
std::vector<double> weighted(std::vector<double> sigma, double weight) {
  for (double& s : sigma) s = weight > 0.0 ? s / std::sqrt(weight) : 0.0;
  return sigma;
}

using sim::StatisticKind;

/// Statistics that are mean light in bins of their own, beside the profile.
constexpr struct {
  StatisticKind kind;
  BinGrid (*bins)(const BinGrid& profile, const sim::Fit& fit);
} kBinned[] = {
    {StatisticKind::horizontal,
     [](const BinGrid& profile, const sim::Fit& fit) {
       return horizontal_bins(profile, fit.horizontal_strips);
     }},
    {StatisticKind::image,
     [](const BinGrid& profile, const sim::Fit& fit) { return image_bins(profile, fit.image_cell_px); }},
};

/// Of what the others are computed.
struct StatisticSource {
  const sim::Scene& scene;
  const Photo& photo;
  const Profile& profile;
  const std::vector<double>& sigma;
  double weight = 1.0;
  double model_error = 0.0;
  int threads = 0;
};

template <class Made, class... Arguments>
std::unique_ptr<const Statistic> made(const Arguments&... arguments) {
  return std::make_unique<const Made>(arguments...);
}

constexpr struct {
  StatisticKind kind;
  std::unique_ptr<const Statistic> (*make)(const StatisticSource& s);
} kOthers[] = {
    {StatisticKind::colour,
     [](const StatisticSource& s) { return made<ColourStatistic>(s.profile, s.sigma, s.weight); }},
    {StatisticKind::border,
     [](const StatisticSource& s) { return made<BorderStatistic>(s.profile, s.sigma, s.weight); }},
    {StatisticKind::texture,
     [](const StatisticSource& s) {
       return made<TextureStatistic>(s.scene, s.photo, s.profile.region, s.weight);
     }},
    {StatisticKind::granulation,
     [](const StatisticSource& s) {
       return made<GranulationStatistic>(s.scene, s.photo, s.profile.region, s.weight, s.model_error,
                                         s.threads);
     }},
};
static_assert(1 + std::size(kBinned) + std::size(kOthers) == sim::kStatistics.size(),
              "every statistic but the profile has bins or a class");

bool has_binned(const sim::Fit& fit) {
  return std::any_of(std::begin(kBinned), std::end(kBinned),
                     [&](const auto& one) { return fit.weight[one.kind] > 0.0; });
}

/// What does not run along the bands has no place in their skies.
void check_band_sky(const sim::Scene& scene) {
  if (!scene.fit.band_sky || !has_binned(scene.fit)) return;
  throw sim::Error(sim::ErrorKind::scene,
                   "bands have skies along their own profiles, which strips and cells do not run along")
      .file(scene.file)
      .key("fit.band_sky")
      .expected("false, or profiles alone")
      .hint("set fit.horizontal_weight = 0 and fit.image_weight = 0");
}

/// What goes by the picture's columns means nothing where profiles run across a loop or away from the limb,
/// and a grey sensor has no colour.
void check_what_goes_together(const sim::Scene& scene) {
  const sim::Fit& fit = scene.fit;
  const auto meaningless = [&](const std::string& key, const std::string& problem, const std::string& other) {
    return sim::Error(sim::ErrorKind::scene, problem)
        .file(scene.file)
        .key(key)
        .expected("0")
        .hint("set " + key + " = 0, or " + other);
  };
  if (fit.weight[StatisticKind::colour] > 0.0 &&
      sim::response_kind(scene.sensor.response) == sim::ResponseKind::grey)
    throw meaningless(weight_key(StatisticKind::colour), "a grey sensor has no colours to compare",
                      "choose another sensor.response");
  if (fit.profile_along != sim::ProfileAlong::loop && fit.profile_along != sim::ProfileAlong::limb) return;
  const std::string beside = fit.profile_along == sim::ProfileAlong::loop
                                 ? " beside profiles across a loop"
                                 : " beside profiles away from the limb";
  for (const sim::StatisticFacts& facts : sim::kStatistics)
    if (facts.nonsense != nullptr && fit.weight[facts.kind] > 0.0)
      throw meaningless(weight_key(facts.kind), facts.nonsense + beside, "choose another fit.profile_along");
}

}  // namespace

GainLayout gain_layout(const sim::Scene& scene) {
  return {scene.fit.bands, scene.fit.band_brightness, !scene.fit.white_balance_known};
}

Statistics::Statistics(const sim::Scene& scene, const Photo& photo, Profile data, std::vector<double> sigma,
                       double smooth_px, const ModelError& model_error, int threads)
    : profile_(std::move(data)), sigma_(std::move(sigma)) {
  const sim::Fit& fit = scene.fit;
  check_what_goes_together(scene);
  check_band_sky(scene);
  if (profile_.grid == nullptr)
    profile_.grid = std::make_shared<const BinGrid>(column_bins(profile_.region, profile_.bands));
  const double profile_weight = fit.weight[StatisticKind::profile];
  profile_counts_ = profile_weight > 0.0;
  linear_counts_ = profile_counts_ || has_binned(fit);

  const int height = photo.linear.height;
  LinearBins bins;
  const std::vector<double> in_profile = weighted(sigma_, linear_counts_ ? profile_weight : 1.0);
  if (fit.band_sky)
    bins.append_with_skies(profile_, in_profile);
  else
    bins.append(profile_, in_profile, height);
  grids_.push_back(profile_.grid);
  if (profile_counts_) linear_ones_.push_back({StatisticKind::profile, profile_weight, 0, bins.mean.size()});
  for (const auto& [kind, bins_of] : kBinned) {
    const double weight = fit.weight[kind];
    if (weight <= 0.0) continue;
    grids_.push_back(std::make_shared<const BinGrid>(bins_of(*profile_.grid, fit)));
    const Profile in_bins = smoothed_by_px(measured_profile(scene, photo, grids_.back()), smooth_px);
    const std::size_t first = bins.mean.size();
    bins.append(in_bins,
                weighted(fit::profile_sigma(in_bins, model_error.share, model_error.peak_share), weight),
                height);
    linear_ones_.push_back({kind, weight, first, bins.mean.size() - first});
  }
  linear_ = std::make_unique<const LinearPart>(std::move(bins), gain_layout(scene), fit.sky_terms);
  if (linear_counts_) residuals_ = linear_->residuals();

  for (const auto& [kind, make] : kOthers) {
    const double weight = fit.weight[kind];
    if (weight <= 0.0) continue;
    others_.push_back(
        {kind, weight, make({scene, photo, profile_, sigma_, weight, model_error.share, threads})});
    residuals_ += static_cast<int>(others_.back().statistic->residuals());
  }
}

bool Statistics::looks_at_the_profile() const {
  return linear_counts_ || std::any_of(others_.begin(), others_.end(), [](const Other& other) {
           return other.statistic->is_of_the_profile();
         });
}

}  // namespace vegard::fit
