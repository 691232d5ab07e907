// One photograph beside a model of it: the statistics of both, at one resolution, and what is left between
// them.
#pragma once

#include <memory>
#include <vector>

#include "fit/linear_part.h"
#include "fit/parameter_map.h"
#include "fit/photo.h"
#include "fit/profile.h"
#include "fit/profile_model.h"

namespace vegard::fit {

/// Profile, noise and model of a photograph, as a search or a polish looks at them.
class Comparison {
 public:
  /// How much of the work is done.
  struct Resolution {
    double beams_share = 1.0;  ///< of the scene's beams
    double smooth_rows = 0.0;  ///< standard deviation by which profiles are smoothed; 0: not at all
    int threads = 0;
  };

  /// `data` and `sigma` are the photograph's profile as this resolution sees it, and its noise. The
  /// photograph is not kept.
  Comparison(const sim::Scene& scene, const Photo& photo, Profile data, std::vector<double> sigma,
             const Resolution& resolution);

  Comparison(const Comparison&) = delete;
  Comparison& operator=(const Comparison&) = delete;

  int residuals() const { return linear_.residuals(); }
  int coefficients() const { return linear_.coefficients(); }

  struct Point {
    ModelProfile aurora;  ///< derivatives, if any, by the free numbers that move
    LinearSolution solution;
    double chi2 = 0.0;
    const std::vector<double>& residual() const { return solution.residual; }
  };
  Point at(const sim::Scene& scene);
  /// With derivatives by what `motion` says.
  Point at(const sim::Scene& scene, const ParameterMap::Motion& motion);

  /// d residual / d free, row-major [residual][moved].
  void jacobian(const Point& point, std::vector<double>& out) const;

  const Profile& data() const { return data_; }
  const std::vector<double>& sigma() const { return sigma_; }
  const GainLayout& gains() const { return gains_; }
  const LinearPart& linear() const { return linear_; }

 private:
  const Profile data_;
  const std::vector<double> sigma_;
  const GainLayout gains_;
  const LinearPart linear_;
  ProfileModel model_;
};

/// The gains that a scene's [fit] asks for.
GainLayout gain_layout(const sim::Scene& scene);

}  // namespace vegard::fit
