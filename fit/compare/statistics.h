// The statistics of one photograph that a scene's [fit] switches on, computed from the photograph alone.
// Nothing here depends on the model.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "fit/compare/linear_part.h"
#include "fit/compare/statistic.h"
#include "fit/measure/profile.h"
#include "fit/photo/photo.h"

namespace vegard::fit {

class Statistics {
 public:
  /// Errors of the model as a fraction of its light, as in profile_sigma() (fit/measure/noise_model.h).
  struct ModelError {
    double share = 0.0, peak_share = 0.1;
  };

  /// `data` and `sigma` are the profile, already smoothed; other statistics are computed here from the
  /// photograph, smoothed likewise by `smooth_px`. The photograph is not kept. `threads` is for statistics
  /// that render.
  Statistics(const sim::Scene& scene, const Photo& photo, Profile data, std::vector<double> sigma,
             double smooth_px, const ModelError& model_error, int threads = 0);

  const Profile& profile() const { return profile_; }
  const std::vector<double>& profile_sigma() const { return sigma_; }
  bool profile_counts() const { return profile_counts_; }

  /// The grids of the model's bins; the profile's is the first.
  const std::vector<std::shared_ptr<const BinGrid>>& grids() const { return grids_; }
  const LinearPart& linear() const { return *linear_; }
  /// Whether the linear residuals are compared. If no linear statistic is switched on, they are the
  /// profile's, and serve only to solve the gains and the sky.
  bool linear_counts() const { return linear_counts_; }

  /// Whether any compared statistic uses the profile's bins.
  bool looks_at_the_profile() const;

  /// A statistic that consists of mean light in bins: `values` values of the bins, from `first` on.
  struct Linear {
    sim::StatisticKind kind;
    double weight = 1.0;
    std::size_t first = 0, values = 0;
  };
  const std::vector<Linear>& linear_ones() const { return linear_ones_; }

  struct Other {
    sim::StatisticKind kind;
    double weight = 1.0;
    std::unique_ptr<const Statistic> statistic;
  };
  const std::vector<Other>& others() const { return others_; }

  /// Number of all residuals that are compared.
  int residuals() const { return residuals_; }

 private:
  Profile profile_;
  std::vector<double> sigma_;
  bool profile_counts_ = true, linear_counts_ = true;
  std::vector<std::shared_ptr<const BinGrid>> grids_;
  std::vector<Linear> linear_ones_;
  std::unique_ptr<const LinearPart> linear_;
  std::vector<Other> others_;
  int residuals_ = 0;
};

/// The gains that a scene's [fit] asks for.
GainLayout gain_layout(const sim::Scene& scene);

}  // namespace vegard::fit
