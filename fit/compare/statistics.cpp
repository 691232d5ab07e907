#include "fit/compare/statistics.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "fit/compare/border_statistic.h"
#include "fit/compare/colour_statistic.h"
#include "fit/compare/granulation_statistic.h"
#include "fit/compare/texture_statistic.h"
#include "fit/measure/measured_profile.h"
#include "fit/measure/noise_model.h"
#include "fit/measure/profile_bins.h"
#include "fit/measure/smoothing.h"
#include "sim/base/error.h"

namespace vegard::fit {
namespace {

/// A weight multiplies chi2. Where it is 1, not a bit of sigma changes.
std::vector<double> weighted(std::vector<double> sigma, double weight) {
  for (double& s : sigma) s = weight > 0.0 ? s / std::sqrt(weight) : 0.0;
  return sigma;
}

/// What does not run along the bands has no place in their skies.
void check_band_sky(const sim::Scene& scene) {
  const sim::Fit& fit = scene.fit;
  if (!fit.band_sky || (fit.horizontal_weight == 0.0 && fit.image_weight == 0.0)) return;
  throw sim::Error(
      sim::ErrorKind::scene,
      {"bands have skies along their own profiles, which strips and cells do not run along", scene.file, 0,
       "fit.band_sky", "false, or profiles alone", "set fit.horizontal_weight = 0 and fit.image_weight = 0"});
}

/// What goes by the picture's columns means nothing where profiles run across a loop or away from the limb,
/// and a grey sensor has no colour.
void check_what_goes_together(const sim::Scene& scene) {
  const sim::Fit& fit = scene.fit;
  const auto refuse = [&](const std::string& key, const std::string& problem, const std::string& other) {
    throw sim::Error(sim::ErrorKind::scene,
                     {problem, scene.file, 0, key, "0", "set " + key + " = 0, or " + other});
  };
  if (fit.colour_weight > 0.0 && scene.sensor.response == "grey")
    refuse("fit.colour_weight", "a grey sensor has no colours to compare", "choose another sensor.response");
  if (fit.profile_along != "loop" && fit.profile_along != "limb") return;
  const std::string beside =
      fit.profile_along == "loop" ? "beside profiles across a loop" : "beside profiles away from the limb";
  const struct {
    const char* key;
    double weight;
    const char* problem;
  } others[] = {
      {"fit.colour_weight", fit.colour_weight, "colours of an aurora's heights mean nothing "},
      {"fit.horizontal_weight", fit.horizontal_weight, "strips along the picture's rows mean nothing "},
      {"fit.border_weight", fit.border_weight, "lower borders, sought down the columns, mean nothing "},
      {"fit.image_weight", fit.image_weight, "cells with gains of the picture's columns mean nothing "},
      {"fit.texture_weight", fit.texture_weight, "texture along the picture's rows means nothing "}};
  for (const auto& other : others)
    if (other.weight > 0.0) refuse(other.key, other.problem + beside, "choose another fit.profile_along");
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
  profile_counts_ = fit.profile_weight > 0.0;
  linear_counts_ = profile_counts_ || fit.horizontal_weight > 0.0 || fit.image_weight > 0.0;

  const int height = photo.linear.height;
  LinearBins bins;
  const std::vector<double> in_profile = weighted(sigma_, linear_counts_ ? fit.profile_weight : 1.0);
  if (fit.band_sky)
    bins.append_with_skies(profile_, in_profile);
  else
    bins.append(profile_, in_profile, height);
  grids_.push_back(profile_.grid);
  if (profile_counts_) linear_ones_.push_back({"profile", fit.profile_weight, 0, bins.mean.size()});
  const auto add = [&](const char* name, double weight, BinGrid grid) {
    grids_.push_back(std::make_shared<const BinGrid>(std::move(grid)));
    const Profile in_bins = smoothed_by_px(measured_profile(scene, photo, grids_.back()), smooth_px);
    const std::size_t first = bins.mean.size();
    bins.append(in_bins,
                weighted(fit::profile_sigma(in_bins, model_error.share, model_error.peak_share), weight),
                height);
    linear_ones_.push_back({name, weight, first, bins.mean.size() - first});
  };
  if (fit.horizontal_weight > 0.0)
    add("horizontal", fit.horizontal_weight, horizontal_bins(*profile_.grid, fit.horizontal_strips));
  if (fit.image_weight > 0.0) add("image", fit.image_weight, image_bins(*profile_.grid, fit.image_cell_px));
  linear_ = std::make_unique<const LinearPart>(std::move(bins), gain_layout(scene), fit.sky_terms);
  if (linear_counts_) residuals_ = linear_->residuals();

  if (fit.colour_weight > 0.0)
    others_.push_back(
        {fit.colour_weight, std::make_unique<const ColourStatistic>(profile_, sigma_, fit.colour_weight)});
  if (fit.border_weight > 0.0)
    others_.push_back(
        {fit.border_weight, std::make_unique<const BorderStatistic>(profile_, sigma_, fit.border_weight)});
  if (fit.texture_weight > 0.0)
    others_.push_back({fit.texture_weight, std::make_unique<const TextureStatistic>(
                                               scene, photo, profile_.region, fit.texture_weight)});
  if (fit.granulation_weight > 0.0)
    others_.push_back({fit.granulation_weight, std::make_unique<const GranulationStatistic>(
                                                   scene, photo, profile_.region, fit.granulation_weight,
                                                   model_error.share, threads)});
  for (const Other& other : others_) residuals_ += static_cast<int>(other.statistic->residuals());
}

bool Statistics::looks_at_the_profile() const {
  return linear_counts_ || std::any_of(others_.begin(), others_.end(), [](const Other& other) {
           return other.statistic->is_of_the_profile();
         });
}

}  // namespace vegard::fit
