// Ionospheres over energies and energy fluxes, for maps: computed at nodes and interpolated.
//
// Nodes are even in ln(E0) and ln(Q), at most 0.35 and 1.2 apart; between them the logarithm of each number
// is the product of cubic polynomials through four nodes a side. From 85 km up, and from a tenth of the
// largest density on, that is within 1 % of the ionosphere itself. Standard deviations are half of the middle
// 68 % of draws of the numbers of physics at fewer nodes, and linear between them.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "sim/light/ionosphere/ionosphere_model.h"

namespace vegard::sim {

/// The numbers of an ionosphere by altitude, in this order everywhere.
enum class IonosphereNumber { electrons, op, o2p, nop, n2p, pedersen, hall, deposited };
inline constexpr std::size_t kIonosphereNumbers = 8;

/// Returns such a number: cm^-3, S m^-1 or W m^-3.
double ionosphere_number(const Ionosphere& of, IonosphereNumber number, std::size_t place);

/// E0 and Q with their errors; all may be NaN.
struct ElectronEstimate {
  double energy_kev = 0.0, energy_flux_mw_m2 = 0.0;
  double ln_energy_sigma = 0.0, relative_flux_sigma = 0.0, correlation = 0.0;
};

/// A number and its standard deviation by the electrons' errors and by physics.
struct KnownNumber {
  double value = 0.0, sigma = 0.0;
};

struct IonosphereEstimate {
  KnownNumber pedersen_s, hall_s, peak_cm3, peak_km;
  double pedersen_physics_sigma = 0.0, hall_physics_sigma = 0.0;  ///< of the sigmas, what physics leaves
};

class IonosphereTable {
 public:
  struct Range {
    double least_kev = 0.0, most_kev = 0.0, least_mw_m2 = 0.0, most_mw_m2 = 0.0;
  };

  /// Fluxes below are 0 for the table: the ionosphere of a steady state goes on as its last slope does, that
  /// some time after the onset is the night's.
  static constexpr double kLeastFlux = 1e-4;
  static constexpr int kUsualDraws = 64;

  /// `range`: of the electrons that will be asked for, limited to the model's energies. `draws`: 0 takes
  /// physics as exact. The numbers do not depend on `threads`. Throws nothing of its own.
  IonosphereTable(const IonosphereModel& model, const Range& range, int draws, int threads);

  /// Returns the numbers of all altitudes; NaN where the electrons are not known, and for the largest density
  /// where it is less than three times what is assumed of the night before. Without flux, and in a steady
  /// state, they are 0, with unknown errors.
  IonosphereEstimate at(const ElectronEstimate& electrons) const;

  /// Returns a number at each altitude; 0 with an unknown error where there is next to nothing.
  std::vector<KnownNumber> profile(const ElectronEstimate& electrons, IonosphereNumber number) const;

  const std::vector<double>& altitudes_km() const { return altitudes_km_; }

 private:
  struct Axis {
    double first = 0.0, step = 1.0;
    std::size_t count = 1;
    static Axis over(double least, double most, double step, std::size_t nodes);
    double at(std::size_t node) const { return first + step * static_cast<double>(node); }
  };
  /// Weights of nodes and of their derivatives by the axis.
  struct Weights {
    std::size_t lower = 0;
    std::array<double, 4> value{}, slope{};
  };
  struct Place {
    bool is_known = false, is_dark = false;
    Weights energy, flux;
    double beyond = 0.0;  ///< ln of the flux over the least one, below it
    std::size_t coarse_energy = 0, coarse_flux = 0;
    double coarse_energy_share = 0.0, coarse_flux_share = 0.0;
  };
  struct LnNumber {
    double value = 0.0, by_energy = 0.0, by_flux = 0.0;
  };

  static Weights weights_at(const Axis& axis, double at);
  Place place_of(const ElectronEstimate& electrons) const;
  LnNumber ln_number(const Place& place, std::size_t index) const;
  double physics_sigma(const Place& place, std::size_t index) const;
  KnownNumber known(const Place& place, const ElectronEstimate& electrons, std::size_t index) const;
  std::size_t size() const { return kIonosphereNumbers * altitudes_km_.size() + 2; }
  void draw(const IonosphereModel& model, int draws, int threads);

  std::vector<double> altitudes_km_;
  bool is_steady_ = true, has_draws_ = false;
  Axis energy_, flux_, coarse_energy_, coarse_flux_;
  std::vector<double> ln_;     ///< [(energy * fluxes + flux) * size + index]
  std::vector<double> sigma_;  ///< likewise of the coarse nodes, with the peak's altitude in km behind
};

}  // namespace vegard::sim
