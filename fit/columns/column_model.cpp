#include "fit/columns/column_model.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "sim/base/parallel.h"
#include "sim/light/height_profile.h"
#include "sim/light/spectrum_profile.h"
#include "sim/scene/lines/emission_lines.h"

namespace vegard::fit {
namespace {

constexpr double kEnergyStep = 0.05;  // of ln(E0): the tables' own energies are 0.12 apart
constexpr double kOxygenStep = 0.35;  // of ln(factor): the tables' own factors are farther apart
constexpr double kFluxStep = 0.2;     // of ln(Q): the flux law is a cubic between factors of ten
constexpr double kSameColumn = 1e-4;  // of ln(ratio); what two columns of the tables differ by is above 0.1

std::vector<double> even_nodes(double least, double most, double widest_step) {
  const int steps = std::max(3, static_cast<int>(std::ceil((most - least) / widest_step)));
  std::vector<double> nodes;
  for (int i = 0; i <= steps; ++i) nodes.push_back(least + (most - least) * i / steps);
  nodes.back() = most;
  return nodes;
}

/// Weights of the nodes from `first` on in an interpolated value, and in its slope.
struct CubicWeights {
  std::size_t first = 0;
  int count = 4;
  std::array<double, 4> value{1.0, 0.0, 0.0, 0.0}, slope{};
};

/// Returns the weights of the cubic between two nodes whose slopes at both are those of the parabolas through
/// their neighbours (Catmull and Rom 1974); at the ends the parabola goes on.
CubicWeights cubic_weights(const std::vector<double>& nodes, double at) {
  CubicWeights w;
  if (nodes.size() == 1) {
    w.count = 1;
    return w;
  }
  const auto last = static_cast<int>(nodes.size()) - 1;
  const double step = (nodes.back() - nodes.front()) / last;
  const double place = std::clamp((at - nodes.front()) / step, 0.0, static_cast<double>(last));
  const int piece = std::min(static_cast<int>(place), last - 1);
  const double t = place - piece;
  // Of the nodes piece-1 ... piece+2.
  std::array<double, 4> v = {0.5 * t * (-1.0 + t * (2.0 - t)), 1.0 + t * t * (-2.5 + 1.5 * t),
                             0.5 * t * (1.0 + t * (4.0 - 3.0 * t)), 0.5 * t * t * (t - 1.0)};
  std::array<double, 4> s = {0.5 * (-1.0 + t * (4.0 - 3.0 * t)), t * (-5.0 + 4.5 * t),
                             0.5 * (1.0 + t * (8.0 - 9.0 * t)), 0.5 * t * (3.0 * t - 2.0)};
  const auto fold_first = [](std::array<double, 4>& a) {
    a = {a[1] + 3.0 * a[0], a[2] - 3.0 * a[0], a[3] + a[0], 0.0};
  };
  const auto fold_last = [](std::array<double, 4>& a) {
    a = {0.0, a[0] + a[3], a[1] - 3.0 * a[3], a[2] + 3.0 * a[3]};
  };
  int first = piece - 1;
  if (piece == 0) {
    fold_first(v);
    fold_first(s);
    first = 0;
  } else if (piece == last - 1) {
    fold_last(v);
    fold_last(s);
    first = piece - 2;
  }
  w.first = static_cast<std::size_t>(first);
  w.value = v;
  for (int i = 0; i < 4; ++i) w.slope[i] = s[i] / step;
  return w;
}

sim::HeightProfile profile_of(const sim::EmissionSource& source, const std::vector<double>& lines_nm,
                              const ColumnModelOptions& options, double energy_kev) {
  switch (options.spectrum) {
    case ColumnSpectrum::gaussian:
      return sim::gaussian_profile(source, lines_nm, energy_kev, options.spread);
    case ColumnSpectrum::mono:
      return sim::mono_profile(source, lines_nm, energy_kev);
    case ColumnSpectrum::maxwellian:
      break;
  }
  return sim::maxwellian_profile(source, lines_nm, energy_kev);
}

}  // namespace

ColumnModel::ColumnModel(const sim::EmissionTables& tables, const std::vector<double>& lines_nm,
                         const ColumnModelOptions& options, int threads)
    : lines_nm_(lines_nm) {
  const std::vector<double>& energies_kev = tables.energies_kev();
  const std::vector<double>& factors = tables.maxwellian().oxygen_factors();
  least_ = {std::log(energies_kev.front()), std::log(kMinFlux), std::log(factors.front())};
  most_ = {std::log(energies_kev.back()), std::log(kMaxFlux), std::log(factors.back())};
  energy_nodes_ = even_nodes(least_[kLnEnergy], most_[kLnEnergy], kEnergyStep);
  oxygen_nodes_ = factors.size() > 1 ? even_nodes(least_[kLnOxygen], most_[kLnOxygen], kOxygenStep)
                                     : std::vector<double>{least_[kLnOxygen]};
  tabulate_columns(tables, options, threads);
  if (options.has_modes) tabulate_modes(tables, options, threads);
  if (options.spectrum == ColumnSpectrum::maxwellian) tabulate_flux_law(tables);
}

void ColumnModel::tabulate_columns(const sim::EmissionTables& tables, const ColumnModelOptions& options,
                                   int threads) {
  const std::size_t energies = energy_nodes_.size(), oxygens = oxygen_nodes_.size();
  // The last digit of exp(log(x)) may lie outside of the tables.
  const std::vector<double>&known_kev = tables.energies_kev(),
        &factors = tables.maxwellian().oxygen_factors();
  ln_column_.resize(lines() * oxygens * energies);
  sim::parallel_for(energies * oxygens, threads, [&](std::size_t i, int) {
    const std::size_t e = i % energies, o = i / energies;
    const double energy_kev = std::clamp(std::exp(energy_nodes_[e]), known_kev.front(), known_kev.back());
    const sim::EmissionSource source = {
        tables, std::clamp(std::exp(oxygen_nodes_[o]), factors.front(), factors.back())};
    const sim::HeightProfile profile = profile_of(source, lines_nm_, options, energy_kev);
    for (std::size_t l = 0; l < lines(); ++l) {
      const sim::Column column = sim::column_below(profile, static_cast<int>(l), sim::HeightProfile::kTopKm);
      assert(column.rayleigh > 0.0);
      ln_column_[(l * oxygens + o) * energies + e] = std::log(column.rayleigh);
    }
  });
}

void ColumnModel::tabulate_modes(const sim::EmissionTables& tables, const ColumnModelOptions& options,
                                 int threads) {
  const sim::LightModes& modes = tables.modes();
  modes_ = modes.count();
  if (modes_ == 0) return;
  // Of the electrons of a single energy the modes are those of the Maxwellian with the same mean energy.
  const double maxwellian_kev = options.spectrum == ColumnSpectrum::maxwellian ? 1.0 : 0.5;
  const std::vector<double>& known_kev = tables.energies_kev();
  std::vector<double> altitudes_km;
  constexpr int kRows = 4;  // of the profile, from one altitude to the next: 1 km
  for (int a = 0; a < sim::HeightProfile::kAltitudes; a += kRows)
    altitudes_km.push_back(sim::HeightProfile::altitude_km(a));
  const std::size_t energies = energy_nodes_.size(), count = static_cast<std::size_t>(modes_);
  mode_.assign(lines() * energies * count, 0.0);
  sim::parallel_for(energies, threads, [&](std::size_t e, int) {
    const double energy_kev = std::clamp(std::exp(energy_nodes_[e]), known_kev.front(), known_kev.back());
    const sim::HeightProfile profile = profile_of({tables}, lines_nm_, options, energy_kev);
    for (std::size_t l = 0; l < lines(); ++l) {
      const std::string column =
          sim::column_of(*sim::find_emission_line(lines_nm_[l]), tables.maxwellian()).name;
      for (std::size_t k = 0; k < count; ++k) {
        const std::vector<sim::ModeValue> mode =
            modes.at(static_cast<int>(k), column, maxwellian_kev * energy_kev, altitudes_km);
        double light = 0.0, changed = 0.0;
        for (std::size_t a = 0; a < mode.size(); ++a) {
          const double rate = profile.rate[a * kRows * static_cast<std::size_t>(profile.stride) + l];
          light += rate;
          changed += rate * mode[a].value;
        }
        mode_[(l * energies + e) * count + k] = changed / light;
      }
    }
  });
}

ColumnModes ColumnModel::modes_at(std::size_t line, const ColumnPoint& point) const {
  const CubicWeights energy = cubic_weights(energy_nodes_, point[kLnEnergy]);
  ColumnModes result;
  for (int e = 0; e < energy.count; ++e) {
    const double* row =
        mode_.data() + (line * energy_nodes_.size() + energy.first + static_cast<std::size_t>(e)) *
                           static_cast<std::size_t>(modes_);
    for (std::size_t k = 0; k < static_cast<std::size_t>(modes_); ++k) {
      result.value[k] += energy.value[e] * row[k];
      result.slope[k] += energy.slope[e] * row[k];
    }
  }
  return result;
}

void ColumnModel::tabulate_flux_law(const sim::EmissionTables& tables) {
  flux_nodes_ = even_nodes(least_[kLnFlux], most_[kLnFlux], kFluxStep);
  const std::vector<double>& known_kev = tables.energies_kev();
  for (const double line_nm : lines_nm_) {
    const sim::EmissionLine* line = sim::find_emission_line(line_nm);
    assert(line != nullptr && sim::is_auroral(*line));
    const std::string column = sim::column_of(*line, tables.maxwellian()).name;
    for (const double ln_energy : energy_nodes_) {
      const double energy_kev = std::clamp(std::exp(ln_energy), known_kev.front(), known_kev.back());
      for (const double ln_flux : flux_nodes_)
        ln_factor_.push_back(tables.flux_factors().at(column, energy_kev, std::exp(ln_flux)).log_factor);
    }
  }
}

ColumnLight ColumnModel::at(std::size_t line, const ColumnPoint& point) const {
  const CubicWeights energy = cubic_weights(energy_nodes_, point[kLnEnergy]);
  const CubicWeights oxygen = cubic_weights(oxygen_nodes_, point[kLnOxygen]);
  ColumnLight light{point[kLnFlux], {0.0, 1.0, 0.0}};
  for (int o = 0; o < oxygen.count; ++o) {
    double value = 0.0, slope = 0.0;
    for (int e = 0; e < energy.count; ++e) {
      const double here = node(line, energy.first + e, oxygen.first + o);
      value += energy.value[e] * here;
      slope += energy.slope[e] * here;
    }
    light.ln_rayleigh += oxygen.value[o] * value;
    light.slope[kLnEnergy] += oxygen.value[o] * slope;
    light.slope[kLnOxygen] += oxygen.slope[o] * value;
  }
  if (ln_factor_.empty()) return light;
  const CubicWeights flux = cubic_weights(flux_nodes_, point[kLnFlux]);
  for (int e = 0; e < energy.count; ++e) {
    const double* row = ln_factor_.data() +
                        (line * energy_nodes_.size() + energy.first + e) * flux_nodes_.size() + flux.first;
    double value = 0.0, slope = 0.0;
    for (int q = 0; q < flux.count; ++q) {
      value += flux.value[q] * row[q];
      slope += flux.slope[q] * row[q];
    }
    light.ln_rayleigh += energy.value[e] * value;
    light.slope[kLnEnergy] += energy.slope[e] * value;
    light.slope[kLnFlux] += energy.value[e] * slope;
  }
  return light;
}

bool ColumnModel::is_multiple(std::size_t line, std::size_t other) const {
  double least = 0.0, most = 0.0;
  const auto compare = [&](const ColumnPoint& point) {
    const double ratio = at(line, point).ln_rayleigh - at(other, point).ln_rayleigh;
    if (least == 0.0 && most == 0.0) least = most = ratio;
    least = std::min(least, ratio);
    most = std::max(most, ratio);
  };
  for (const double ln_energy : energy_nodes_)
    for (const double ln_oxygen : oxygen_nodes_)
      for (const double ln_flux : {std::log(0.1), std::log(10.0)}) compare({ln_energy, ln_flux, ln_oxygen});
  return most - least < kSameColumn;
}

}  // namespace vegard::fit
