#include "fit/radar/radar_density.h"

#include <algorithm>
#include <cmath>

#include "sim/base/error.h"
#include "sim/base/number/dense_solvers.h"
#include "sim/light/chemistry/ion_balance.h"
#include "sim/light/ionosphere/ionosphere_model.h"
#include "sim/scene/table/emission_folder.h"

namespace vegard::fit {
namespace radar_density {

constexpr double kLnFirst = -7.0, kLnStep = 0.25;  // of pairs
constexpr std::size_t kNodes = 101;
constexpr double kNoDensity = 1e-30;  // for logarithms

/// The ends of the energies of a spectrum's tables.
struct EnergyEnds {
  double least_kev = 0.0, most_kev = 0.0;
};
EnergyEnds energy_ends(const sim::EmissionTables& tables, const sim::ElectronSpectrum& spectrum) {
  if (spectrum.kind == sim::ElectronSpectrum::Kind::maxwellian)
    return {tables.energies_kev().front(), tables.energies_kev().back()};
  return {tables.mono().min_energy_kev(), tables.mono().max_energy_kev()};
}

}  // namespace radar_density

RadarDensity::RadarDensity(const sim::EmissionTables& tables, const std::vector<double>& altitudes_km,
                           const RadarDensityOptions& options)
    : tables_(tables), options_(options), altitudes_km_(altitudes_km) {
  using namespace radar_density;
  if (!tables.maxwellian().has("ionisation_electron"))
    throw sim::unreadable(tables.folder().place + "/" + sim::kMaxwellianFile, "the tables have no ion pairs")
        .key("emission.tables")
        .expected("a column ionisation_electron, as vegard tables writes it");
  const sim::FieldPlace place;  // ions do not depend on the field
  const sim::AirTable air = sim::with_oxygen_factor(sim::air_of_tables(tables), options.oxygen_factor);
  of_tables_ = sim::ionosphere_air(air, tables.maxwellian().altitudes_km(), place);
  air_ = sim::ionosphere_air(air, altitudes_km_, place);
  for (const sim::ReactingAir& here : air_.places) {
    ln_.emplace_back();
    for (std::size_t node = 0; node < kNodes; ++node) {
      const double pairs = std::exp(kLnFirst + kLnStep * static_cast<double>(node));
      const sim::IonDensities ions = sim::ion_balance(here, sim::ion_production(pairs, here, physics()),
                                                      physics().reactions, options_.seconds, physics().night);
      ln_.back().push_back(std::log(std::max(kNoDensity, ions.electrons)));
    }
  }
}

sim::IonospherePhysics RadarDensity::physics() const {
  sim::IonospherePhysics physics;
  physics.seconds = options_.seconds;
  return physics;
}

std::vector<double> RadarDensity::pairs_at(const sim::ElectronSpectrum& spectrum, double energy_kev) const {
  return sim::moved_ion_pairs(sim::ion_pairs(tables_, spectrum, energy_kev, 1.0, options_.oxygen_factor),
                              of_tables_, air_);
}

RadarDensity::Pairs RadarDensity::pairs(const sim::ElectronSpectrum& spectrum, double energy_kev) const {
  constexpr double kStep = 1e-4;
  const radar_density::EnergyEnds ends = radar_density::energy_ends(tables_, spectrum);
  const double inside_kev = std::clamp(energy_kev, ends.least_kev, ends.most_kev);
  const std::vector<double> zeros(altitudes(), 0.0);
  Pairs pairs{pairs_at(spectrum, inside_kev), zeros, zeros};
  if (spectrum.kind == sim::ElectronSpectrum::Kind::gaussian) {
    sim::ElectronSpectrum narrow = spectrum, wide = spectrum;
    narrow.spread *= 1.0 - kStep;
    wide.spread *= 1.0 + kStep;
    const std::vector<double> low = pairs_at(narrow, inside_kev), high = pairs_at(wide, inside_kev);
    for (std::size_t i = 0; i < altitudes(); ++i)
      pairs.by_spread[i] = (high[i] - low[i]) / (wide.spread - narrow.spread);
  }
  if (inside_kev != energy_kev) return pairs;
  const double low_kev = std::max(ends.least_kev, energy_kev * (1.0 - kStep)),
               high_kev = std::min(ends.most_kev, energy_kev * (1.0 + kStep));
  const std::vector<double> low = pairs_at(spectrum, low_kev), high = pairs_at(spectrum, high_kev);
  for (std::size_t i = 0; i < altitudes(); ++i)
    pairs.by_ln_energy[i] = (high[i] - low[i]) / std::log(high_kev / low_kev);
  return pairs;
}

RadarDensity::Density RadarDensity::density(std::size_t place, double pairs_cm3_s) const {
  using namespace radar_density;
  const std::vector<double>& ln = ln_[place];
  const bool is_steady = std::isinf(options_.seconds);
  const double first_pairs = std::exp(kLnFirst);
  if (!(pairs_cm3_s > first_pairs)) {
    // The rest of the table has no say: what is there is the night's, or next to nothing.
    const double first = std::exp(ln.front());
    if (!is_steady) return {first, 0.0};
    const double root = std::sqrt(std::max(0.0, pairs_cm3_s) / first_pairs);
    return {first * root, root > 0.0 ? 0.5 * first / (root * first_pairs) : 0.0};
  }
  const double at = (std::log(pairs_cm3_s) - kLnFirst) / kLnStep;
  const auto node = std::min(static_cast<std::size_t>(at), kNodes - 2);
  const double u = at - static_cast<double>(node);
  const auto slope = [&](std::size_t n) {
    const std::size_t low = n == 0 ? 0 : n - 1, high = std::min(n + 1, kNodes - 1);
    return (ln[high] - ln[low]) / static_cast<double>(high - low);
  };
  const double from = ln[node], to = ln[node + 1], leaving = slope(node), arriving = slope(node + 1);
  const double v = 1.0 - u;
  const double value = from * v * v * (1.0 + 2.0 * u) + to * u * u * (3.0 - 2.0 * u) + leaving * u * v * v -
                       arriving * u * u * v;
  const double by_node =
      6.0 * u * v * (to - from) + leaving * v * (v - 2.0 * u) - arriving * u * (2.0 * v - u);
  const double density = std::exp(value);
  return {density, density * by_node / (kLnStep * pairs_cm3_s)};
}

Eigen::MatrixXd RadarDensity::physics_modes(const sim::ElectronSpectrum& spectrum, double energy_kev,
                                            double energy_flux_mw_m2, std::uint64_t seed) const {
  constexpr int kDraws = 64;
  constexpr double kKept = 0.98, kMost = 3.0;  // of the variance; of a change of ln(density)
  const radar_density::EnergyEnds ends = radar_density::energy_ends(tables_, spectrum);
  sim::IonosphereRequest request;
  request.spectrum = spectrum;
  request.oxygen_factor = options_.oxygen_factor;
  request.seconds = options_.seconds;
  const sim::IonosphereModel model(tables_, request);
  const double inside_kev = std::clamp(energy_kev, ends.least_kev, ends.most_kev);
  const std::vector<double>& made_km = model.altitudes_km();
  const auto ln_densities = [&](const sim::Ionosphere& of) {
    std::vector<double> ln;
    for (const sim::IonDensities& ions : of.ions)
      ln.push_back(std::log(std::max(radar_density::kNoDensity, ions.electrons)));
    return ln;
  };
  const std::vector<double> usual = ln_densities(model.at(inside_kev, energy_flux_mw_m2));
  const auto places = static_cast<Eigen::Index>(altitudes());
  Eigen::MatrixXd change(places, kDraws);
  for (int draw = 0; draw < kDraws; ++draw) {
    const std::vector<double> drawn =
        ln_densities(model.drawn(inside_kev, energy_flux_mw_m2, seed, static_cast<std::uint32_t>(draw), 1));
    for (Eigen::Index i = 0; i < places; ++i) {
      const double at = altitudes_km_[static_cast<std::size_t>(i)];
      const auto after = std::upper_bound(made_km.begin() + 1, made_km.end() - 1, at);
      const auto upper = static_cast<std::size_t>(after - made_km.begin());
      const double share =
          std::clamp((at - made_km[upper - 1]) / (made_km[upper] - made_km[upper - 1]), 0.0, 1.0);
      const double low = drawn[upper - 1] - usual[upper - 1], high = drawn[upper] - usual[upper];
      change(i, draw) = std::clamp(low + share * (high - low), -kMost, kMost);
    }
  }
  const Eigen::MatrixXd covariance = change * change.transpose() / kDraws;
  const sim::SymmetricEigen eigen = sim::symmetric_eigen(covariance);
  Eigen::Index modes = 0;
  double left = eigen.values.sum();
  const double all = left;
  while (modes < places && left > (1.0 - kKept) * all) left -= eigen.values(places - 1 - modes++);
  Eigen::MatrixXd kept(places, modes);
  for (Eigen::Index m = 0; m < modes; ++m)
    kept.col(m) = std::sqrt(std::max(0.0, eigen.values(places - 1 - m))) * eigen.vectors.col(places - 1 - m);
  return kept;
}

}  // namespace vegard::fit
