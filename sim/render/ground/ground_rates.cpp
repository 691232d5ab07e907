#include "sim/render/ground/ground_rates.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>

#include "sim/light/own_light.h"
#include "sim/light/tables/emission_tables.h"
#include "sim/render/ground/sight_lines.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {
namespace {

constexpr double kRayleighsPerKm = 0.1;  // of a rate in photons cm^-3 s^-1

}  // namespace

std::vector<float> ground_rates(const Scene& scene, const std::vector<double>& energies_kev, double flux,
                                double altitude_scale, const ElectronSpectrum& spectrum) {
  const AltitudeBins bins;
  const auto lines = static_cast<int>(scene.emission.lines.size());
  std::vector<float> rates(static_cast<std::size_t>(bins.bins()) * lines * kGroundEnergies, 0.0f);
  const double at_flux = scene.emission.flux_law == FluxLaw::linear ? 1.0 : flux;
  const OwnLight own(scene.emission.lines, scene, Sheet());
  for (std::size_t e = 0; e < energies_kev.size(); ++e) {
    HeightProfile profile =
        electron_profile(emission_source(scene), own.asked_nm(), spectrum, energies_kev[e], at_flux);
    own.add_to(profile);
    const auto rate = [&](int line, double altitude_km) {
      const double row = (altitude_km / altitude_scale - HeightProfile::kBottomKm) / HeightProfile::kStepKm;
      if (row < 0.0 || row > HeightProfile::kAltitudes - 1) return 0.0;
      const int i = std::clamp(static_cast<int>(row), 0, HeightProfile::kAltitudes - 2);
      const double t = row - i;
      const auto at = [&](int r) {
        return static_cast<double>(profile.rate[static_cast<std::size_t>(r) * profile.stride + line]);
      };
      return ((1.0 - t) * at(i) + t * at(i + 1)) / altitude_scale;
    };
    for (int bin = 0; bin < bins.bins(); ++bin) {
      const double low = bins.edge_km(bin), high = bins.edge_km(bin + 1);
      const int steps = std::max(1, static_cast<int>((high - low) / HeightProfile::kStepKm + 0.5));
      for (int line = 0; line < lines; ++line) {
        double sum = 0.0;
        for (int i = 0; i < steps; ++i) sum += rate(line, low + (high - low) * (i + 0.5) / steps);
        rates[(static_cast<std::size_t>(bin) * lines + line) * kGroundEnergies + e] =
            static_cast<float>(kRayleighsPerKm * sum / steps);
      }
    }
  }
  return rates;
}

ModeRates::ModeRates(const Scene& scene, const std::vector<double>& energies_kev, double flux_mw_m2,
                     double altitude_scale, const ElectronSpectrum& spectrum) {
  const int count =
      scene.emission.uncertainty == TablesUncertainty::none ? 0 : emission_tables(scene).modes().count();
  Scene with = scene;
  if (count > 0) with.emission.modes.clear();
  rates_ = ground_rates(with, energies_kev, flux_mw_m2, altitude_scale, spectrum);
  for (int mode = 0; mode < count; ++mode) {
    with.emission.modes.assign(static_cast<std::size_t>(count), 0.0);
    with.emission.modes[static_cast<std::size_t>(mode)] = 1.0;
    std::vector<float> moved = ground_rates(with, energies_kev, flux_mw_m2, altitude_scale, spectrum);
    for (std::size_t i = 0; i < moved.size(); ++i)
      moved[i] = rates_[i] > 0.0f && moved[i] > 0.0f ? std::log(moved[i] / rates_[i]) : 0.0f;
    log_by_mode_.push_back(std::move(moved));
  }
}

ModeRates ModeRates::of_other(std::vector<float> rates) const {
  assert(rates.size() == rates_.size());
  ModeRates other;
  other.rates_ = std::move(rates);
  other.log_by_mode_ = log_by_mode_;
  return other;
}

std::vector<float> ModeRates::at(const std::vector<double>& coefficients) const {
  assert(coefficients.size() == log_by_mode_.size());
  std::vector<float> rates = rates_;
  for (std::size_t i = 0; i < rates.size(); ++i) {
    double change = 0.0;
    for (std::size_t mode = 0; mode < log_by_mode_.size(); ++mode)
      change += coefficients[mode] * log_by_mode_[mode][i];
    rates[i] *= static_cast<float>(std::exp(change));
  }
  return rates;
}

std::vector<float> ModeRates::by_mode(int mode, const std::vector<float>& rates) const {
  const std::vector<float>& by = log_by_mode_[static_cast<std::size_t>(mode)];
  assert(rates.size() == by.size());
  std::vector<float> derivative(rates.size());
  for (std::size_t i = 0; i < rates.size(); ++i) derivative[i] = by[i] * rates[i];
  return derivative;
}

}  // namespace vegard::sim
