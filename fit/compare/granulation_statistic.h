// Granulation: of what size the unevenness of the Sun's disc is, wherever each granule stands.
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

/// Of the light in square cells of the region (at most 128 each way) the angular power spectrum
/// (fit/measure/power_spectrum.h) under a window that falls to nothing at the region's edges and towards the
/// limb (cos² from 0.8 to 0.95 radii of the photosphere). Residuals are ln P of the photograph less ln of the
/// model's, band by band of wavenumber.
///
/// The model's is the mean over eight chromospheres that differ by their shift alone, drawn from the scene's
/// seed: where a granule stands is nothing that is compared. A change of `chromosphere.scale` magnifies each
/// about the place in the region's middle: about the Sun's middle, where the noise's lattice has its origin,
/// it would be another chromosphere after a change of a few per cent. Gain and sky drop out, but for what the
/// sky adds to the light: light is taken as solar all of it.
///
/// Noise: sigma² = s (1 + 1/8) V + (2 model_error)², V the relative variance of Gaussian light under the
/// window and s by how much ln P of sixteen of the start's chromospheres scatter more than that (at least 1):
/// granules with edges are not Gaussian. The photograph's own noise (fit/measure/cell_noise.h) is added to
/// the model's power; bands that it makes up more than half of are left out. Bands are taken as independent,
/// which granules with edges are not: error bars come out too small by about 1.4 (docs/corona/fits.md).
class GranulationStatistic : public Statistic {
 public:
  /// `weight` multiplies chi2. Throws sim::Error(scene) with key "fit.granulation_weight" if the scene has no
  /// Sun or no chromosphere, or the region shows too little of the disc; sim::Error(unreadable_input) with
  /// the same key if noise makes up more than half of all bands.
  GranulationStatistic(const sim::Scene& scene, const Photo& photo, const Region& region, double weight,
                       double model_error, int threads);

  std::string name() const override { return "granulation"; }
  std::size_t residuals() const override { return bands_.size(); }
  bool is_of_the_profile() const override { return false; }
  void evaluate(const StatisticInput& input, double* residual, double* jacobian) const override;

  /// For tests and reports: of each residual.
  struct Band {
    std::size_t band = 0;  ///< of the spectrum
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
