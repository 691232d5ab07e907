// The light of a map of precipitation on a film, and the adjoint of this linear map.
//
// The map x has an energy flux in mW m^-2 for every cell of the ground and each of a few energies E0 of
// electrons of one spectrum (sim/light/spectrum_profile.h). Its light in rayleighs of a line towards a ray is
// linear in it:
//
//     rayleighs = T sum over stretches  km_per_km  sum over energies  (below(to, energy) - below(from,
//     energy)) x(cell, energy)
//
// with the light below an altitude, in rayleighs of a vertical column of 1 mW m^-2 (of the emission tables'
// rates; means over the bins of altitude), and T the transmission of the air. Neither the map A nor its
// adjoint A' is stored as a matrix. <Ax, y> = <x, A'y> to rounding.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "sim/light/spectrum_profile.h"
#include "sim/render/ground/ground_rates.h"
#include "sim/render/ground/sight_lines.h"

namespace vegard::sim {

struct Scene;

/// A number for each energy, side by side: of a cell, or of the light of a line below an altitude.
struct alignas(64) GroundNumbers {
  float of_energy[kGroundEnergies];
};

/// The light of `lines` lines below each level: [level * lines + line].
struct LightBelow {
  int lines = 0;
  const GroundNumbers* below = nullptr;
};

/// light[ray * lines + line] of rays first to last: the sum over stretches and energies of
/// km_per_km x (below(to) - below(from)) x flux[cell].
void sum_light(const SightLines& lines, const LightBelow& light_below, const GroundNumbers* flux,
               std::size_t first, std::size_t last, float* light);

/// The adjoint: adds km_per_km x (below(to) - below(from)) x light to flux[cell].
void spread_light(const SightLines& lines, const LightBelow& light_below, const float* light,
                  std::size_t first, std::size_t last, GroundNumbers* flux);

class GroundLight {
 public:
  /// Energies E0 in keV, at most kGroundEnergies; of Maxwellian electrons, inside the emission tables.
  /// `rates_at_flux_mw_m2`: the energy flux at which the rates per mW m^-2 are taken
  /// (sim/light/tables/flux_law.h); it has no effect under the law "linear", and for other electrons.
  /// `altitude_scale`: the altitudes of the tables are multiplied by it; the column brightness is kept,
  /// except for light that would be below 80 km. Once `stop` is true, what is left of the rays has no light.
  GroundLight(const Scene& scene, const Site& home, const GroundGrid& grid, const FilmGeometry& film,
              const std::vector<std::uint8_t>& wanted, const std::vector<double>& energies_kev,
              double rates_at_flux_mw_m2, int threads, double altitude_scale = 1.0,
              const ElectronSpectrum& spectrum = {}, const std::atomic<bool>* stop = nullptr);

  /// Takes other rates (sim/render/ground/ground_rates.h), of the same lines; the rays stay as they are. Two
  /// threads must not call it, or anything else, at once.
  void set_rates(std::vector<float> rates);

  /// Leaves out the stretches over cells that are not `kept` (one entry per cell, 0: not) from now on until
  /// keep_all(): forward() takes their flux as 0, and add_adjoint() adds nothing to them. What was left out
  /// before stays out. Two threads must not call these, or anything else, at once.
  void keep(const std::vector<std::uint8_t>& kept);
  void keep_all();

  /// The same light for one thread, on the same lines of sight: copies can be used side by side.
  GroundLight on_one_thread() const;
  /// Only these cells are left in the grid (GroundGrid::keep()): what it has over others is forgotten. No
  /// cell may be left out by keep().
  void keep_in_grid(const std::vector<bool>& kept);

  int lines() const { return lines_of_light_; }
  std::size_t rays() const { return sight_->rays(); }
  std::size_t numbers() const { return numbers_; }     ///< size of a map: cells x kGroundEnergies
  const SightLines& sight() const { return *sight_; }  ///< of all cells
  const std::vector<float>& rate() const { return rate_; }
  LightBelow light_below() const { return {lines_of_light_, below_.data()}; }

  /// Computes rayleighs[ray * lines + line] from a map [cell * kGroundEnergies + energy]. Two threads must
  /// not call it at once.
  void forward(const std::vector<float>& map, std::vector<float>& rayleighs) const;
  /// The same with other rates.
  void forward(const std::vector<float>& map, const std::vector<float>& rate,
               std::vector<float>& rayleighs) const;

  /// Adds A' y to `map`; the order of summation does not depend on the number of threads. Two threads must
  /// not call it at once.
  void add_adjoint(const std::vector<float>& rayleighs, std::vector<float>& map) const;

 private:
  const SightLines& in_use() const { return all_ ? *sight_ : kept_; }
  void share_work();
  std::vector<GroundNumbers> below_of(const std::vector<float>& rate) const;
  void forward(const std::vector<float>& map, const LightBelow& light_below,
               std::vector<float>& rayleighs) const;

  std::shared_ptr<const SightLines> sight_;  ///< copies have it together
  SightLines kept_;
  bool all_ = true;
  int lines_of_light_ = 0, threads_ = 0;
  std::size_t numbers_ = 0;
  std::vector<float> rate_;
  std::vector<GroundNumbers> below_;  ///< of rate_
  std::vector<float> transmission_;   ///< [ray * lines + line]
  std::vector<std::size_t>
      first_of_share_;  ///< first ray of each share of the work; shares have similar numbers of stretches
  // Memory of forward() and add_adjoint(), kept from call to call.
  mutable std::vector<GroundNumbers> flux_;
  mutable std::vector<float> weighted_;
  mutable std::vector<std::vector<GroundNumbers>> sums_;
};

}  // namespace vegard::sim
