// The granulation statistic: the sizes of the bright and dark structures on the Sun's disc, wherever each
// granule is.
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "fit/compare/statistic.h"
#include "fit/measure/power_spectrum.h"
#include "fit/model/profile_model.h"
#include "fit/photo/photo.h"
#include "fit/photo/region.h"

namespace vegard::fit {

/// Compares the angular power spectrum (fit/measure/power_spectrum.h) of the light in square cells of the
/// region (at most 128 each way), under a window that falls to zero at the region's edges and towards the
/// limb (cos² from 0.8 to 0.95 radii of the photosphere). Residuals are ln P of the photograph less ln P of
/// the model, for each band of wavenumber.
///
/// The model's P is the mean over eight chromospheres that differ only by their shift, drawn from the scene's
/// seed: the places of single granules are not compared. A change of `chromosphere.scale` magnifies each
/// about the place in the region's middle. If it were magnified about the Sun's middle, where the lattice of
/// the noise has its origin, a change by a few per cent would give an unrelated chromosphere. Gain and sky
/// cancel, except for what the sky adds to the light: all light is taken as solar.
///
/// Noise: sigma² = s (1 + 1/8) V + (2 model_error)², where V is the relative variance for Gaussian light
/// under the window, and s is the factor (at least 1) by which the variance of ln P among sixteen
/// chromospheres of the start exceeds it: granules with edges are not Gaussian. The photograph's own noise
/// (fit/measure/noise_model.h) is added to the model's power; bands in which it is more than half of the
/// power are left out. Bands are taken as independent, but granules with edges correlate them: error bars
/// come out too small by about 1.4 (docs/corona/fits.md).
class GranulationStatistic : public Statistic {
 public:
  /// `weight` multiplies chi2. Throws sim::Error(scene) with key "fit.granulation_weight" if the scene has no
  /// Sun or no chromosphere, or the region shows too little of the disc; sim::Error(unreadable_input) with
  /// the same key if noise makes up more than half of all bands.
  GranulationStatistic(const sim::Scene& scene, const Photo& photo, const Region& region, double weight,
                       double model_error, int threads);

  std::size_t residuals() const override { return bands_.size(); }
  bool is_of_the_profile() const override { return false; }
  void evaluate(const StatisticInput& input, double* residual, double* jacobian) const override;

  /// The data of each residual, for tests and reports.
  struct Band {
    std::size_t band = 0;  ///< index in the spectrum
    double ln_power = 0.0, noise_power = 0.0, sigma = 0.0;
  };
  const std::vector<Band>& bands() const { return bands_; }
  const PowerSpectrum& spectrum() const { return *spectrum_; }

 private:
  using Shifts = std::vector<std::array<double, 3>>;  // of each chromosphere
  sim::Scene realisation(const sim::Scene& scene, std::size_t which) const;
  std::vector<double> cells_of(const ModelProfile& light) const;

  double weight_;
  int channel_ = 1;
  std::vector<double> start_scale_;
  Shifts middle_;              ///< place in the region's middle, by chromosphere
  std::vector<Shifts> drawn_;  ///< [realisation]
  std::unique_ptr<PowerSpectrum> spectrum_;
  std::vector<Band> bands_;
  std::unique_ptr<ProfileModel> model_;
  mutable std::mutex model_in_use_;
};

}  // namespace vegard::fit
