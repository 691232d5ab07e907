#include "sim/light/transport/electron_transport.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

#include <Eigen/Dense>

namespace vegard::sim {
namespace {

/// Returns the mean of a function that falls off (or grows) exponentially from a to b; of a straight line
/// where one is not above 0.
double mean_between(double a, double b) {
  if (a <= 0.0 || b <= 0.0) return 0.5 * (a + b);
  const double ratio = a / b;
  if (std::abs(ratio - 1.0) < 1e-4) return 0.5 * (a + b);
  return (a - b) / std::log(ratio);
}

/// The share of the incident flux that a path through an optical depth transmits, and what the sources at its
/// beginning and its end add.
struct Passage {
  double left, from_begin, from_end;
};

Passage passage(double depth) {
  if (depth < 1e-3)
    return {1.0 - depth * (1.0 - 0.5 * depth), depth * (0.5 - depth / 3.0), depth * (0.5 - depth / 6.0)};
  const double left = std::exp(-depth), mean = -std::expm1(-depth) / depth;
  return {left, mean - left, 1.0 - mean};
}

/// Returns how often per path, cm^-1, electrons at an energy of the grid pass on to the next lower one (from
/// the lowest, to the thermal ones), since thermal electrons slow them down.
double slowing_cm(const EnergyGrid& grid, const FieldAir& column, std::size_t energy, std::size_t place) {
  if (column.electrons_cm3.empty()) return 0.0;
  const double here = grid.energy_ev[energy], lower = energy > 0 ? grid.energy_ev[energy - 1] : 0.0;
  return loss_to_electrons_ev_cm(here, column.electrons_cm3[place], column.electron_temperature_k[place]) /
         (here - lower);
}

/// Solves all energies of a column with 2 N streams.
template <int Size>
class Sweep {
 public:
  using Block = Eigen::Matrix<double, Size, Size, Eigen::RowMajor>;
  using Vector = Eigen::Matrix<double, Size, 1>;

  Sweep(const Degradation& degradation, const FieldAir& column, const Streams& directions)
      : degradation_(degradation),
        column_(column),
        directions_(directions),
        places_(column.size()),
        energies_(degradation.grid.size()),
        psi_(energies_, std::vector<double>(places_ * Size, 0.0)),
        flux_(energies_, std::vector<double>(places_, 0.0)),
        source_(places_),
        extinction_(places_),
        onward_(places_),
        answer_(places_) {
    for (std::size_t k = 0; k < Size; ++k) weight_(static_cast<Eigen::Index>(k)) = directions.weight[k];
  }

  void run(const std::vector<double>& incident, const std::vector<double>& angles) {
    for (std::size_t i = energies_; i-- > 0;) {
      const bool lit = add_sources(i) || incident[i] > 0.0;
      if (!lit) continue;
      Vector from_above = Vector::Zero();
      for (std::size_t k = 0; k < Size; ++k)
        from_above(static_cast<Eigen::Index>(k)) = incident[i] * angles[k];
      solve(i, from_above);
    }
  }

  const std::vector<std::vector<double>>& psi() const { return psi_; }
  const std::vector<std::vector<double>>& flux() const { return flux_; }

 private:
  static constexpr std::size_t kHalf = Size / 2;

  double density(std::size_t gas, std::size_t place) const { return column_.density_cm3[gas][place]; }

  /// Adds what higher energies leave at this one. Returns false if that is nothing.
  bool add_sources(std::size_t i) {
    for (Vector& source : source_) source.setZero();
    std::array<std::vector<double>, kGases> anywhere;
    for (auto& gas : anywhere) gas.assign(places_, 0.0);
    bool any = false;
    for (std::size_t j = i + 1; j < energies_; ++j) {
      std::array<double, kGases> straight{};
      bool goes_straight = false;
      for (std::size_t g = 0; g < kGases; ++g) {
        const GasDegradation& gas = degradation_.gases[g];
        straight[g] = gas.straight[i][j - i];
        goes_straight = goes_straight || straight[g] > 0.0;
        const double turned = gas.anywhere[i][j - i];
        if (turned <= 0.0) continue;
        for (std::size_t m = 0; m < places_; ++m) anywhere[g][m] += turned * flux_[j][m];
        any = true;
      }
      if (!goes_straight) continue;
      any = true;
      const double* psi = psi_[j].data();
      for (std::size_t m = 0; m < places_; ++m) {
        double rate = 0.0;
        for (std::size_t g = 0; g < kGases; ++g) rate += density(g, m) * straight[g];
        source_[m] += rate * Eigen::Map<const Vector>(psi + m * Size);
      }
    }
    for (std::size_t m = 0; m < places_; ++m) {
      double turned = 0.0;
      for (std::size_t g = 0; g < kGases; ++g) turned += density(g, m) * anywhere[g][m];
      source_[m].array() += 0.5 * turned;
    }
    if (any && !column_.electrons_cm3.empty())
      for (std::size_t m = 0; m < places_; ++m)
        source_[m] += slowing_cm(degradation_.grid, column_, i + 1, m) *
                      Eigen::Map<const Vector>(psi_[i + 1].data() + m * Size);
    return any;
  }

  /// Returns the scattering into other streams at the same energy: elastic collisions, and losses smaller
  /// than the grid's step.
  Block turns(const Block& elastic, std::size_t i, std::size_t place) const {
    double hits = 0.0, losses = 0.0;
    for (std::size_t g = 0; g < kGases; ++g) {
      hits += density(g, place) * degradation_.gases[g].elastic[i];
      losses += density(g, place) * degradation_.gases[g].anywhere[i][0];
    }
    Block block = hits * elastic;
    block.rowwise() += (0.5 * losses) * weight_.transpose();
    return block / extinction_[place];
  }

  void solve(std::size_t i, const Vector& from_above) {
    constexpr double kNothing = 1e-200;  // cm^-1: no air
    const ElasticTurn turn =
        elastic_turn(directions_, std::min(1.0, degradation_.factor(kElasticTurn) *
                                                    elastic_transfer_ratio(degradation_.grid.energy_ev[i])));
    const Block elastic = Eigen::Map<const Block>(turn.into.data());
    for (std::size_t m = 0; m < places_; ++m) {
      double sum = 0.0;
      for (std::size_t g = 0; g < kGases; ++g) {
        const GasDegradation& gas = degradation_.gases[g];
        sum += density(g, m) * (gas.inelastic[i] - gas.straight[i][0] + gas.elastic[i] * turn.kept);
      }
      extinction_[m] = std::max(sum + slowing_cm(degradation_.grid, column_, i, m), kNothing);
      source_[m] /= extinction_[m];
    }
    // From the bottom up: every place as what it makes of the place above.
    Block here = turns(elastic, i, 0), below = Block::Zero();
    std::array<Passage, Size> lower{}, upper{};
    for (std::size_t m = 0; m < places_; ++m) {
      const bool bottom = m == 0, top = m + 1 == places_;
      Block above = Block::Zero();
      if (!top) {
        above = turns(elastic, i, m + 1);
        const double depth =
            mean_between(extinction_[m], extinction_[m + 1]) * (column_.path_cm[m + 1] - column_.path_cm[m]);
        for (std::size_t k = 0; k < Size; ++k) upper[k] = passage(depth / std::abs(directions_.cosine[k]));
      }
      Block own = Block::Identity(), to_above = Block::Zero(), to_below = Block::Zero();
      Vector right = Vector::Zero();
      for (std::size_t k = 0; k < Size; ++k) {
        const auto r = static_cast<Eigen::Index>(k);
        const bool down = k < kHalf;
        if (down && top) {
          right(r) = from_above(r);
        } else if (down) {
          const Passage& p = upper[k];
          own.row(r) -= p.from_end * here.row(r);
          to_above.row(r) = p.from_begin * above.row(r);
          to_above(r, r) += p.left;
          right(r) = p.from_begin * source_[m + 1](r) + p.from_end * source_[m](r);
        } else if (!bottom) {
          const Passage& p = lower[k];
          own.row(r) -= p.from_end * here.row(r);
          to_below.row(r) = p.from_begin * below.row(r);
          to_below(r, r) += p.left;
          right(r) = p.from_begin * source_[m - 1](r) + p.from_end * source_[m](r);
        }
      }
      if (!bottom) {
        own -= to_below * onward_[m - 1];
        right += to_below * answer_[m - 1];
      }
      const Eigen::PartialPivLU<Block> factors(own);
      if (!top) onward_[m] = factors.solve(to_above);
      answer_[m] = factors.solve(right);
      below = here;
      here = above;
      lower = upper;
    }
    for (std::size_t m = places_; m-- > 0;) {
      if (m + 1 < places_) answer_[m] += onward_[m] * answer_[m + 1];
      Eigen::Map<Vector>(psi_[i].data() + m * Size) = answer_[m];
      flux_[i][m] = weight_.dot(answer_[m]);
    }
  }

  const Degradation& degradation_;
  const FieldAir& column_;
  const Streams& directions_;
  std::size_t places_, energies_;
  std::vector<std::vector<double>> psi_, flux_;  // [energy][place * Size + stream], [energy][place]
  std::vector<Vector> source_;
  std::vector<double> extinction_;
  std::vector<Block> onward_;
  std::vector<Vector> answer_;
  Vector weight_;
};

/// Returns the density times the sum over energies of a cross-section and the flux.
std::vector<double> rate_of(const std::vector<double>& cm2, const std::vector<double>& density,
                            const std::vector<std::vector<double>>& flux) {
  std::vector<double> rate(density.size(), 0.0);
  for (std::size_t j = 0; j < flux.size(); ++j) {
    if (cm2[j] == 0.0) continue;
    for (std::size_t m = 0; m < rate.size(); ++m) rate[m] += cm2[j] * flux[j][m];
  }
  for (std::size_t m = 0; m < rate.size(); ++m) rate[m] *= density[m];
  return rate;
}

void add_rate(std::vector<double>& sum, const std::vector<double>& part, double factor = 1.0) {
  for (std::size_t m = 0; m < sum.size(); ++m) sum[m] += factor * part[m];
}

void add_rates(const Degradation& degradation, const FieldAir& column, ElectronRates& rates) {
  const std::size_t places = column.size();
  ElectronBudget& budget = rates.budget;
  rates.deposited_ev_cm3_s.assign(places, 0.0);
  std::vector<double> ion_pairs(places, 0.0);
  for (std::size_t g = 0; g < kGases; ++g) {
    const GasDegradation& gas = degradation.gases[g];
    const GasCollisions& collisions = degradation.collisions[g];
    const std::vector<double>& density = column.density_cm3[g];
    std::vector<double> excited(places, 0.0);
    for (std::size_t e = 0; e < gas.excitation.size(); ++e) {
      rates.excitation_cm3_s[g].push_back(rate_of(gas.excitation[e], density, rates.flux));
      add_rate(excited, rates.excitation_cm3_s[g].back(), collisions.excitations[e].curve.loss_ev);
    }
    rates.ion_pairs_cm3_s[g].assign(places, 0.0);
    for (std::size_t s = 0; s < gas.shell.size(); ++s) {
      rates.shell_cm3_s[g].push_back(rate_of(gas.shell[s], density, rates.flux));
      add_rate(rates.ion_pairs_cm3_s[g], rates.shell_cm3_s[g].back(), collisions.shells[s].ion_pairs());
    }
    add_rate(ion_pairs, rates.ion_pairs_cm3_s[g]);
    const std::vector<double> bound = rate_of(gas.bound_ev_cm2, density, rates.flux);
    const std::vector<double> thermal = rate_of(gas.thermal_ev_cm2, density, rates.flux);
    add_rate(rates.deposited_ev_cm3_s, bound);
    add_rate(rates.deposited_ev_cm3_s, thermal);
    const double excitation = path_integral(column, excited);
    budget.excitation_ev += excitation;
    budget.ionisation_ev += path_integral(column, bound) - excitation;
    budget.thermal_ev += path_integral(column, thermal);
  }
  if (!column.electrons_cm3.empty()) {
    std::vector<double> heating(places, 0.0);
    for (std::size_t m = 0; m < places; ++m)
      for (std::size_t j = 0; j < rates.flux.size(); ++j)
        heating[m] +=
            rates.flux[j][m] * loss_to_electrons_ev_cm(degradation.grid.energy_ev[j], column.electrons_cm3[m],
                                                       column.electron_temperature_k[m]);
    add_rate(rates.deposited_ev_cm3_s, heating);
    budget.heating_ev = path_integral(column, heating);
  }
  budget.ion_pairs = path_integral(column, ion_pairs);
}

void add_ends(const EnergyGrid& grid, const Streams& directions, ElectronRates& rates) {
  ElectronBudget& budget = rates.budget;
  for (std::size_t j = 0; j < grid.size(); ++j)
    for (std::size_t k = 0; k < directions.size(); ++k) {
      const double through = directions.weight[k] * std::abs(directions.cosine[k]);
      const bool down = k < directions.half();
      const double number = through * (down ? rates.bottom : rates.top)[j][k];
      (down ? budget.through_number : budget.back_number) += number;
      (down ? budget.through_ev : budget.back_ev) += grid.energy_ev[j] * number;
    }
}

template <int Size>
ElectronRates transport_of(const Degradation& degradation, const FieldAir& column,
                           const std::vector<double>& flux, PitchAngles angles, bool keep_streams) {
  const Streams directions = pitch_streams(Size / 2);
  Sweep<Size> sweep(degradation, column, directions);
  sweep.run(flux, incident_angles(directions, angles));
  ElectronRates rates;
  rates.flux = sweep.flux();
  for (std::size_t j = 0; j < flux.size(); ++j) {
    rates.budget.incident_number += flux[j];
    rates.budget.incident_ev += flux[j] * degradation.grid.energy_ev[j];
    const std::vector<double>& psi = sweep.psi()[j];
    rates.bottom.emplace_back(psi.begin(), psi.begin() + Size);
    rates.top.emplace_back(psi.end() - Size, psi.end());
  }
  if (keep_streams) rates.streams = sweep.psi();
  add_ends(degradation.grid, directions, rates);
  add_rates(degradation, column, rates);
  return rates;
}

}  // namespace

double ElectronRates::all_ion_pairs(std::size_t place) const {
  double sum = 0.0;
  for (const std::vector<double>& gas : ion_pairs_cm3_s) sum += gas[place];
  return sum;
}

double loss_to_electrons_ev_cm(double energy_ev, double electrons_cm3, double electron_temperature_k) {
  constexpr double kBoltzmannEv = 8.617333262e-5;
  const double thermal_ev = kBoltzmannEv * electron_temperature_k;
  if (energy_ev <= thermal_ev || electrons_cm3 <= 0.0) return 0.0;
  return 3.37e-12 * std::pow(electrons_cm3, 0.97) * std::pow(energy_ev, -0.94) *
         std::pow((energy_ev - thermal_ev) / (energy_ev - 0.53 * thermal_ev), 2.36);
}

double path_integral(const FieldAir& column, const std::vector<double>& rate) {
  double sum = 0.0;
  for (std::size_t m = 0; m + 1 < column.size(); ++m)
    sum += mean_between(rate[m], rate[m + 1]) * (column.path_cm[m + 1] - column.path_cm[m]);
  return sum;
}

ElectronRates electron_transport(const Degradation& degradation, const FieldAir& column,
                                 const std::vector<double>& flux, PitchAngles angles,
                                 const TransportOptions& options) {
  assert(flux.size() == degradation.grid.size());
  assert(options.half_streams == 4 || options.half_streams == 8);
  if (options.half_streams == 8)
    return transport_of<16>(degradation, column, flux, angles, options.keep_streams);
  return transport_of<8>(degradation, column, flux, angles, options.keep_streams);
}

}  // namespace vegard::sim
