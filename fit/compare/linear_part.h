// The linear part of a photograph's mean light (exposure gains and sky), which is solved exactly at every
// evaluation.
//
// Variable projection with the full derivative (Golub and Pereyra 1973, doi:10.1137/0710036; Kaufman's
// shortcut drops a term and fails the difference test): data = night sky + sum of gains * aurora + sky level
// + sky gradient * place, where no gain multiplies the night sky's known lights (ModelProfile::offset).
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "fit/compare/statistic.h"
#include "fit/measure/profile.h"
#include "fit/model/profile_model.h"

namespace vegard::fit {

// Mean light in bins, of all statistics that are linear in the gains and the sky.

struct LinearBins {
  std::vector<double> mean, sigma;  ///< [bin][channel]; a sigma of 0: not used
  std::vector<int> band;            ///< [bin]: the band whose gain applies
  std::vector<double> place;  ///< [bin]: coordinate of the sky terms: 0 top to 1 bottom of the picture; if
                              ///< each band has its own sky, 0 first to 1 last position
  int skies = 1;              ///< number of skies: one, or one per band, with the index `band`

  /// Appends the bins of a profile.
  void append(const Profile& data, const std::vector<double>& sigma_of_data, int picture_height);
  /// Appends the bins of a profile of which each band has its own sky. There must be no other bins.
  void append_with_skies(const Profile& data, const std::vector<double>& sigma_of_data);
};

/// The number of gains: one; one per band (rays are uneven); one per channel, or per band and channel, where
/// the white balance is unknown.
struct GainLayout {
  int bands = 1;
  bool per_band = false;
  bool per_channel = false;
  int count() const { return (per_band ? bands : 1) * (per_channel ? 3 : 1); }
  int column(int band, int channel) const {
    return (per_band ? band : 0) * (per_channel ? 3 : 1) + (per_channel ? channel : 0);
  }
};

/// The solution for one model of the aurora, with its residuals in units of sigma.
struct LinearSolution {
  /// Gains, then per sky term (level, gradient, curvature) 3 channels, sky after sky.
  std::vector<double> coefficients;
  std::vector<bool> held;        ///< a gain that would be negative, or has no light to scale, is held at 0
  std::vector<double> residual;  ///< (data - model) / sigma, one per used value
  double chi2 = 0.0;
};

class LinearPart {
 public:
  /// `sky_terms`: 1 level, 2 and gradient, 3 and curvature. Values whose sigma is 0 are left out.
  LinearPart(LinearBins bins, const GainLayout& gains, int sky_terms);
  /// For one profile alone.
  LinearPart(const Profile& data, const std::vector<double>& sigma, const GainLayout& gains, int sky_terms,
             int picture_height);

  int residuals() const { return static_cast<int>(used_.size()); }
  int coefficients() const { return sky(0, 0, skies()); }
  /// Number of coefficients on which any value depends: a channel that is not used has no sky.
  int coefficients_in_use() const;
  /// Index of a sky term of a channel among the coefficients.
  int sky(int term, int channel, int which = 0) const {
    return gains_.count() + 3 * (sky_terms_ * which + term) + channel;
  }
  int sky_terms() const { return sky_terms_; }
  int skies() const { return bins_.skies; }                       ///< one, or one per band
  const std::vector<std::size_t>& used() const { return used_; }  ///< indices into the bins' values

  /// Solves the weighted least squares problem for this aurora.
  LinearSolution solve(const ModelProfile& aurora) const;

  /// d residual / d parameter of solve(aurora), row-major [residual][parameter], the change of the
  /// coefficients included. `aurora` must have derivatives.
  void jacobian(const ModelProfile& aurora, const LinearSolution& solution, std::vector<double>& out) const;

  /// Returns the first `values` values of the aurora's light and of the light behind it, with slopes if
  /// `aurora` has derivatives.
  SolvedLight light(const ModelProfile& aurora, const LinearSolution& solution, std::size_t values) const;

  /// The model in the data's units, for all values (also unused ones).
  std::vector<double> model(const ModelProfile& aurora, const LinearSolution& solution) const;

  /// Variances of the coefficients: those at fixed aurora, times inflation squared, plus those from the free
  /// parameters' covariance [parameter][parameter]. 0 for a held gain and for a sky without data. `aurora`
  /// must have derivatives.
  std::vector<double> coefficient_variance(const ModelProfile& aurora, const LinearSolution& solution,
                                           double inflation,
                                           const std::vector<std::vector<double>>& covariance) const;

  /// Returns what shifts of the free parameters, [shift][parameter], do to the coefficients, to first order:
  /// [shift][coefficient]. `aurora` must have derivatives.
  std::vector<std::vector<double>> coefficient_shifts(const ModelProfile& aurora,
                                                      const LinearSolution& solution,
                                                      const std::vector<std::vector<double>>& shifts) const;

 private:
  struct Normal;
  Eigen::MatrixXd coefficient_slopes(const ModelProfile& aurora, const LinearSolution& solution,
                                     const Normal& normal) const;
  Normal normal_matrix(const ModelProfile& aurora, const std::vector<bool>& held) const;
  std::array<double, 3> sky_basis(std::size_t bin) const;
  int sky_of(std::size_t bin) const { return bins_.skies > 1 ? bins_.band[bin] : 0; }
  std::vector<bool> seen() const;

  LinearBins bins_;
  GainLayout gains_;
  int sky_terms_;
  std::vector<std::size_t> used_;
  struct Where {
    int gain, level;            // indices of coefficients; the further sky terms follow at distances of 3
    std::array<double, 3> sky;  // the basis at this row
  };
  std::vector<Where> where_;  // of every used value
};

}  // namespace vegard::fit
