// The comparison of one photograph with a model of it: the statistics of both at one resolution, and their
// residuals.
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

/// Statistics, noise and model of a photograph at one resolution, for a search or for the final descent.
class Comparison {
 public:
  /// The resolution, which decides how long an evaluation takes.
  struct Resolution {
    double beams_share = 1.0;  ///< fraction of the scene's beams that is used
    double smooth_rows = 0.0;  ///< standard deviation by which profiles are smoothed; 0: not at all
    int threads = 0;
    /// Model error of statistics other than the profile (the profile's sigma is given); none: the scene's.
    std::optional<Statistics::ModelError> model_error = {};
    std::uint64_t sampling = 0;  ///< number of the random draw of beams (sim::BeamSampling)
    double fineness = 1.0;       ///< fineness of the mean over all draws (sim::BeamSampling)
  };

  /// `data` and `sigma` are the photograph's profile at this resolution and its noise; its bins are those of
  /// profile_bins(), or those of its `grid`. Other statistics that are switched on are computed from the
  /// photograph, which is not kept.
  Comparison(const sim::Scene& scene, const Photo& photo, Profile data, std::vector<double> sigma,
             const Resolution& resolution);
  /// Compares the same statistics as `like`, with a model laid out for `scene`.
  Comparison(const sim::Scene& scene, const Photo& photo, const Comparison& like,
             const Resolution& resolution);

  Comparison(const Comparison&) = delete;
  Comparison& operator=(const Comparison&) = delete;

  int residuals() const { return statistics_->residuals(); }
  /// Number of gains and sky terms that were solved to minimise the residuals: 0 if no linear statistic is
  /// compared.
  int coefficients() const { return statistics_->linear_counts() ? linear().coefficients_in_use() : 0; }

  struct Point {
    ModelProfile aurora;  ///< in the bins of all grids; derivatives, if any, by the free numbers that vary
    LinearSolution solution;
    double chi2 = 0.0;
    /// Residuals of all that is compared: linear statistics in the order of their bins, then the others.
    const std::vector<double>& residual() const { return whitened; }

    std::vector<double> whitened;
    std::vector<double> jacobian_of_others;  ///< row-major [residual][moved]
  };
  Point at(const sim::Scene& scene);
  /// As above, with derivatives by the numbers in `motion`.
  Point at(const sim::Scene& scene, const ParameterMap::Motion& motion);

  /// d residual / d free, row-major [residual][moved].
  void jacobian(const Point& point, std::vector<double>& out) const;

  const Profile& data() const { return statistics_->profile(); }
  const std::vector<double>& sigma() const { return statistics_->profile_sigma(); }
  const GainLayout& gains() const { return gains_; }
  /// The linear part, over the bins of all grids; those of the profile come first.
  const LinearPart& linear() const { return statistics_->linear(); }

  /// The part of a point that belongs to the profile. Both lists are empty if the profile is not compared.
  struct ProfilePart {
    std::vector<std::size_t> used;  ///< indices into the profile
    std::vector<double> residual;
  };
  ProfilePart profile_part(const Point& point) const;
  /// fit::error_inflation() at a point. The correlation of residuals is estimated from the profile, compared
  /// or not (unless no statistic uses its bins); their size is estimated from all statistics.
  Inflation error_inflation(const Point& point, int dof) const;
  /// The model of the profile in the data's units, for all values.
  std::vector<double> profile_model(const Point& point) const;
  /// Number of held gains among the coefficients().
  int held_gains(const Point& point) const;
  /// chi2 without aurora, with the sky solved again. Statistics that are not defined without an aurora keep
  /// their residuals; infinity if no other statistic is compared.
  double chi2_without_aurora(const Point& point) const;

  /// Numbers that statistics have solved by themselves, other than the coefficients.
  std::vector<Statistic::Solved> solved_by_statistics(const sim::Scene& scene) const;

  /// The contribution of each statistic to a point's chi2, weight included.
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
