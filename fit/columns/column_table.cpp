#include "fit/columns/column_table.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>
#include <utility>

#include "sim/base/parallel.h"
#include "sim/light/height_profile.h"
#include "sim/scene/lines/emission_lines.h"

namespace vegard::fit {
namespace {

/// An energy in keV, inside the tables: the last digit of exp(log(x)) may lie outside.
double known_energy(const sim::EmissionTables& tables, double ln_energy) {
  return std::clamp(std::exp(ln_energy), tables.energies_kev().front(), tables.energies_kev().back());
}

}  // namespace

EvenNodes::EvenNodes(double least, double most, double widest_step) {
  const int steps = std::max(3, static_cast<int>(std::ceil((most - least) / widest_step)));
  for (int i = 0; i <= steps; ++i) at_.push_back(least + (most - least) * i / steps);
  at_.back() = most;
  step_ = (most - least) / steps;
}

EvenNodes::Weights EvenNodes::cubic(double at) const {
  Weights w;
  if (size() == 1) {
    w.count = 1;
    return w;
  }
  const auto last = static_cast<int>(size()) - 1;
  const double place = std::clamp((at - at_.front()) / step_, 0.0, static_cast<double>(last));
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
  for (std::size_t i = 0; i < 4; ++i) w.slope[i] = s[i] / step_;
  return w;
}

EvenNodes::Weights EvenNodes::spline(double at) const {
  Weights w;
  if (size() == 1) {
    w.count = 1;
    return w;
  }
  w.count = 3;
  const auto last = static_cast<int>(size()) - 1;
  const double place = std::clamp((at - at_.front()) / step_, 0.0, static_cast<double>(last));
  const int middle = std::min(static_cast<int>(place + 0.5), last);
  const double t = place - middle;
  std::array<double, 3> v = {0.5 * (0.5 - t) * (0.5 - t), 0.75 - t * t, 0.5 * (0.5 + t) * (0.5 + t)};
  std::array<double, 3> s = {t - 0.5, -2.0 * t, t + 0.5};
  int first = middle - 1;
  for (std::array<double, 3>* a : {&v, &s}) {
    if (middle == 0) *a = {(*a)[0] + (*a)[1], (*a)[2], 0.0};
    if (middle == last) *a = {0.0, (*a)[0], (*a)[1] + (*a)[2]};
  }
  if (middle == 0) first = 0;
  if (middle == last) first = last - 2;
  w.first = static_cast<std::size_t>(first);
  for (std::size_t i = 0; i < 3; ++i) {
    w.value[i] = v[i];
    w.slope[i] = s[i] / step_;
  }
  return w;
}

ColumnTable::ColumnTable(const sim::EmissionTables& tables, const std::vector<double>& lines_nm,
                         const sim::ElectronSpectrum& spectrum, EvenNodes energies, EvenNodes fluxes,
                         EvenNodes oxygens, bool has_modes, int threads)
    : lines_(lines_nm.size()),
      energies_(std::move(energies)),
      fluxes_(std::move(fluxes)),
      oxygens_(std::move(oxygens)) {
  tabulate_columns(tables, lines_nm, spectrum, threads);
  if (has_modes) tabulate_modes(tables, lines_nm, spectrum, threads);
  if (spectrum.kind == sim::ElectronSpectrum::Kind::maxwellian) tabulate_flux_law(tables, lines_nm);
}

void ColumnTable::tabulate_columns(const sim::EmissionTables& tables, const std::vector<double>& lines_nm,
                                   const sim::ElectronSpectrum& spectrum, int threads) {
  const std::size_t energies = energies_.size(), oxygens = oxygens_.size();
  const std::vector<double>& factors = tables.maxwellian().oxygen_factors();
  ln_column_.resize(oxygens * energies * lines_);
  sim::parallel_for(energies * oxygens, threads, [&](std::size_t i, int) {
    const std::size_t e = i % energies, o = i / energies;
    const sim::EmissionSource source = {
        tables, std::clamp(std::exp(oxygens_.at()[o]), factors.front(), factors.back())};
    const sim::HeightProfile profile =
        sim::electron_profile(source, lines_nm, spectrum, known_energy(tables, energies_.at()[e]));
    for (std::size_t l = 0; l < lines_; ++l) {
      const sim::Column column = sim::column_below(profile, static_cast<int>(l), sim::HeightProfile::kTopKm);
      assert(column.rayleigh > 0.0);
      ln_column_[i * lines_ + l] = std::log(column.rayleigh);
    }
  });
}

void ColumnTable::tabulate_modes(const sim::EmissionTables& tables, const std::vector<double>& lines_nm,
                                 const sim::ElectronSpectrum& spectrum, int threads) {
  const sim::LightModes& modes = tables.modes();
  modes_ = modes.count();
  if (modes_ == 0) return;
  // The modes are those of the Maxwellian with the same mean energy.
  const double maxwellian_kev = 0.5 * sim::mean_energy_over_e0(spectrum);
  std::vector<double> altitudes_km;
  constexpr int kRows = 4;  // of the profile, from one altitude to the next: 1 km
  for (int a = 0; a < sim::HeightProfile::kAltitudes; a += kRows)
    altitudes_km.push_back(sim::HeightProfile::altitude_km(a));
  const std::size_t count = static_cast<std::size_t>(modes_);
  mode_.assign(energies_.size() * lines_ * count, 0.0);
  sim::parallel_for(energies_.size(), threads, [&](std::size_t e, int) {
    const double energy_kev = known_energy(tables, energies_.at()[e]);
    const sim::HeightProfile profile = sim::electron_profile({tables}, lines_nm, spectrum, energy_kev);
    for (std::size_t l = 0; l < lines_; ++l) {
      const std::string column =
          sim::column_of(*sim::find_emission_line(lines_nm[l]), tables.maxwellian()).name;
      for (std::size_t k = 0; k < count; ++k) {
        const std::vector<sim::ModeValue> mode =
            modes.at(static_cast<int>(k), column, maxwellian_kev * energy_kev, altitudes_km);
        double light = 0.0, changed = 0.0;
        for (std::size_t a = 0; a < mode.size(); ++a) {
          const double rate = profile.rate[a * kRows * static_cast<std::size_t>(profile.stride) + l];
          light += rate;
          changed += rate * mode[a].value;
        }
        mode_[(e * lines_ + l) * count + k] = changed / light;
      }
    }
  });
}

void ColumnTable::tabulate_flux_law(const sim::EmissionTables& tables, const std::vector<double>& lines_nm) {
  std::vector<std::string> columns;
  for (const double line_nm : lines_nm) {
    const sim::EmissionLine* line = sim::find_emission_line(line_nm);
    assert(line != nullptr && sim::is_auroral(*line));
    columns.push_back(sim::column_of(*line, tables.maxwellian()).name);
  }
  for (const double ln_energy : energies_.at())
    for (const double ln_flux : fluxes_.at())
      for (const std::string& column : columns)
        ln_factor_.push_back(
            tables.flux_factors().at(column, known_energy(tables, ln_energy), std::exp(ln_flux)).log_factor);
}

Eigen::MatrixXd ColumnTable::modes_at_node(std::size_t energy) const {
  Eigen::MatrixXd changes(static_cast<Eigen::Index>(lines_), modes_);
  const double* value = mode_.data() + energy * lines_ * static_cast<std::size_t>(modes_);
  for (Eigen::Index l = 0; l < changes.rows(); ++l)
    for (Eigen::Index k = 0; k < changes.cols(); ++k) changes(l, k) = *value++;
  return changes;
}

void ColumnTable::multiply(const Eigen::VectorXd& modes, const Eigen::VectorXd& ln_factors) {
  for (std::size_t e = 0; e < energies_.size(); ++e) {
    const Eigen::VectorXd change = modes_at_node(e) * modes + ln_factors;
    for (std::size_t o = 0; o < oxygens_.size(); ++o)
      for (std::size_t l = 0; l < lines_; ++l)
        ln_column_[(o * energies_.size() + e) * lines_ + l] += change(static_cast<Eigen::Index>(l));
  }
}

void ColumnTable::at(double ln_energy, double ln_flux, double ln_oxygen, ComponentLight* light) const {
  const EvenNodes::Weights energy = energies_.cubic(ln_energy), oxygen = oxygens_.cubic(ln_oxygen);
  std::fill(light, light + lines_, ComponentLight{});
  for (std::size_t o = 0; o < oxygen.count; ++o)
    for (std::size_t e = 0; e < energy.count; ++e) {
      const double value = energy.value[e] * oxygen.value[o], by_energy = energy.slope[e] * oxygen.value[o],
                   by_oxygen = energy.value[e] * oxygen.slope[o];
      const double* row =
          ln_column_.data() + ((oxygen.first + o) * energies_.size() + energy.first + e) * lines_;
      for (std::size_t l = 0; l < lines_; ++l) {
        light[l].ln_rayleigh += value * row[l];
        light[l].by_energy += by_energy * row[l];
        light[l].by_oxygen += by_oxygen * row[l];
      }
    }
  if (ln_factor_.empty()) return;
  const EvenNodes::Weights flux = fluxes_.cubic(ln_flux);
  for (std::size_t e = 0; e < energy.count; ++e)
    for (std::size_t q = 0; q < flux.count; ++q) {
      const double value = energy.value[e] * flux.value[q], by_energy = energy.slope[e] * flux.value[q],
                   by_flux = energy.value[e] * flux.slope[q];
      const double* row = ln_factor_.data() + ((energy.first + e) * fluxes_.size() + flux.first + q) * lines_;
      for (std::size_t l = 0; l < lines_; ++l) {
        light[l].ln_rayleigh += value * row[l];
        light[l].by_energy += by_energy * row[l];
        light[l].by_flux += by_flux * row[l];
      }
    }
}

}  // namespace vegard::fit
