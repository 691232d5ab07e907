// One photograph beside a model of it: the statistics of both, at one resolution, and what is left between
// them.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fit/compare/inflation.h"
#include "fit/compare/linear_part.h"
#include "fit/compare/statistics.h"
#include "fit/measure/profile.h"
#include "fit/model/profile_model.h"
#include "fit/parameters/parameter_map.h"
#include "fit/photo/photo.h"

namespace vegard::fit {

/// Statistics, noise and model of a photograph, as a search or a polish looks at them.
class Comparison {
 public:
  /// How much of the work is done.
  struct Resolution {
    double beams_share = 1.0;  ///< of the scene's beams
    double smooth_rows = 0.0;  ///< standard deviation by which profiles are smoothed; 0: not at all
    int threads = 0;
    /// Of statistics other than the profile, whose sigma is given; none: the scene's.
    std::optional<Statistics::ModelError> model_error = {};
    std::uint64_t sampling = 0;  ///< another draw of the beams (sim::BeamSampling)
    double fineness = 1.0;       ///< of the mean over all draws, likewise
  };

  /// `data` and `sigma` are the photograph's profile as this resolution sees it, and its noise; it has the
  /// bins of profile_bins(), or its `grid` says which. Other statistics, if switched on, are taken from the
  /// photograph, which is not kept.
  Comparison(const sim::Scene& scene, const Photo& photo, Profile data, std::vector<double> sigma,
             const Resolution& resolution);
  /// With what another compares, and a model laid out for `scene`.
  Comparison(const sim::Scene& scene, const Photo& photo, const Comparison& like,
             const Resolution& resolution);

  Comparison(const Comparison&) = delete;
  Comparison& operator=(const Comparison&) = delete;

  int residuals() const { return statistics_->residuals(); }
  /// Gains and sky terms that the residuals were made small with: none, if no linear statistic is compared.
  int coefficients() const { return statistics_->linear_counts() ? linear().coefficients_in_use() : 0; }

  struct Point {
    ModelProfile aurora;  ///< in the bins of all grids; derivatives, if any, by the free numbers that move
    LinearSolution solution;
    double chi2 = 0.0;
    /// Of all that is compared: linear statistics in the order of their bins, then the others.
    const std::vector<double>& residual() const { return whitened; }

    std::vector<double> whitened;
    std::vector<double> jacobian_of_others;  ///< row-major [residual][moved]
  };
  Point at(const sim::Scene& scene);
  /// With derivatives by what `motion` says.
  Point at(const sim::Scene& scene, const ParameterMap::Motion& motion);

  /// d residual / d free, row-major [residual][moved].
  void jacobian(const Point& point, std::vector<double>& out) const;

  const Profile& data() const { return statistics_->profile(); }
  const std::vector<double>& sigma() const { return statistics_->profile_sigma(); }
  const GainLayout& gains() const { return gains_; }
  /// Over the bins of all grids, of which the profile's are the first.
  const LinearPart& linear() const { return statistics_->linear(); }

  /// The profile's share of a point: residuals and the values that they are of. Both are empty if the profile
  /// is not compared.
  struct ProfilePart {
    std::vector<std::size_t> used;  ///< indices into the profile
    std::vector<double> residual;
  };
  ProfilePart profile_part(const Point& point) const;
  /// fit::error_inflation() of a point: the correlation of residuals is the profile's to say, compared or
  /// not, unless nothing has to do with its bins; how large they are, all statistics'.
  Inflation error_inflation(const Point& point, int dof) const;
  /// Model of the profile in the data's units, at all values.
  std::vector<double> profile_model(const Point& point) const;
  /// Held gains among the coefficients().
  int held_gains(const Point& point) const;
  /// chi2 if there were no aurora and the sky were solved for again. Statistics that have no value without an
  /// aurora stay as they are; infinity if nothing else is compared.
  double chi2_without_aurora(const Point& point) const;

  /// What statistics have solved for beside the coefficients.
  std::vector<Statistic::Solved> solved_by_statistics(const sim::Scene& scene) const;

  /// What each statistic has to do with a point's chi2, weight included.
  struct Share {
    std::string name;
    double weight = 1.0;
    int residuals = 0;
    double chi2 = 0.0;
  };
  std::vector<Share> shares(const Point& point) const;

 private:
  void evaluate_others(const sim::Scene& scene, const ParameterMap::Motion& motion, Point& point) const;

  std::shared_ptr<const Statistics> statistics_;
  const GainLayout gains_;
  ProfileModel model_;
};

}  // namespace vegard::fit
