#include "sim/render/ground/ground_light.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

#include "sim/base/parallel.h"
#include "sim/light/spectrum_profile.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/camera/camera.h"
#include "sim/view/sky/air.h"

namespace vegard::sim {
namespace {

// To wake threads takes longer than what there is to do for fewer, thousands of times in the fit of a map.
constexpr std::size_t kFewRays = 4096, kFewCells = 4096;
constexpr int kShares = 4;  // of the rays in an adjoint, each with sums of its own

std::vector<float> transmissions(const Scene& scene, const FilmGeometry& film) {
  const std::size_t lines = scene.emission.lines.size();
  std::vector<float> through(static_cast<std::size_t>(film.rows) * film.columns * lines, 1.0f);
  const AirAbove air(scene);
  if (air.none()) return through;
  const CameraView<double> view = camera_view(scene.camera);
  std::vector<LineDepths<double>> depths;
  for (const double wavelength : scene.emission.lines)
    depths.emplace_back(wavelength, scene.air.aerosol_optical_depth, scene.air.angstrom_exponent,
                        scene.air.ozone_dobson);
  for (int row = 0; row < film.rows; ++row)
    for (int column = 0; column < film.columns; ++column) {
      double enu[3];
      if (!enu_of_cell(view, film, row, column, enu)) continue;
      const Airmasses<double> masses = air.towards(enu[2]);
      const std::size_t ray = static_cast<std::size_t>(row) * film.columns + column;
      for (std::size_t line = 0; line < lines; ++line)
        through[ray * lines + line] = static_cast<float>(depths[line].transmission(masses));
    }
  return through;
}

}  // namespace

GroundLight::GroundLight(const Scene& scene, const Site& home, const GroundGrid& grid,
                         const FilmGeometry& film, const std::vector<std::uint8_t>& wanted,
                         const std::vector<double>& energies_kev, double rates_at_flux_mw_m2, int threads,
                         double altitude_scale, const ElectronSpectrum& spectrum,
                         const std::atomic<bool>* stop)
    : sight_(std::make_shared<const SightLines>(sight_lines(scene, home, grid, film, wanted, threads, stop))),
      lines_of_light_(static_cast<int>(scene.emission.lines.size())),
      threads_(threads),
      numbers_(static_cast<std::size_t>(grid.cells()) * kGroundEnergies),
      rate_(ground_rates(scene, energies_kev, rates_at_flux_mw_m2, altitude_scale, spectrum)),
      transmission_(transmissions(scene, film)) {
  assert(energies_kev.size() <= kGroundEnergies);
  below_ = below_of(rate_);
  share_work();
}

void GroundLight::share_work() {
  const SightLines& lines = in_use();
  const std::size_t all = lines.stretch.size();
  first_of_share_.clear();
  for (int share = 0; share < kShares; ++share)
    first_of_share_.push_back(static_cast<std::size_t>(
        std::lower_bound(lines.first.begin(), lines.first.end() - 1, all * share / kShares) -
        lines.first.begin()));
  first_of_share_.push_back(lines.rays());
}

void GroundLight::keep(const std::vector<std::uint8_t>& kept) {
  assert(kept.size() * kGroundEnergies == numbers_);
  if (!all_) {  // in place, as the lists are large
    std::size_t to = 0, from = 0;
    for (std::size_t ray = 0; ray < kept_.rays(); ++ray) {
      for (; from < kept_.first[ray + 1]; ++from)
        if (kept[kept_.stretch[from].cell] != 0) kept_.stretch[to++] = kept_.stretch[from];
      kept_.first[ray + 1] = to;
    }
    kept_.stretch.resize(to);
    share_work();
    return;
  }
  const SightLines& from = *sight_;
  SightLines left;
  left.first.reserve(from.first.size());
  left.first.push_back(0);
  left.stretch.reserve(static_cast<std::size_t>(
      std::count_if(from.stretch.begin(), from.stretch.end(),
                    [&](const SightStretch& stretch) { return kept[stretch.cell] != 0; })));
  for (std::size_t ray = 0; ray < from.rays(); ++ray) {
    for (std::size_t i = from.first[ray]; i < from.first[ray + 1]; ++i)
      if (kept[from.stretch[i].cell] != 0) left.stretch.push_back(from.stretch[i]);
    left.first.push_back(left.stretch.size());
  }
  kept_ = std::move(left);
  all_ = false;
  share_work();
}

void GroundLight::keep_all() {
  kept_ = {};
  all_ = true;
  share_work();
}

GroundLight GroundLight::on_one_thread() const {
  GroundLight other = *this;
  other.threads_ = 1;
  return other;
}

void GroundLight::keep_in_grid(const std::vector<bool>& kept) {
  assert(all_ && kept.size() * kGroundEnergies == numbers_);
  std::vector<std::uint32_t> number(kept.size());
  std::uint32_t count = 0;
  for (std::size_t cell = 0; cell < kept.size(); ++cell) {
    number[cell] = count;
    count += kept[cell] ? 1 : 0;
  }
  SightLines left;
  left.first = {0};
  for (std::size_t ray = 0; ray < rays(); ++ray) {
    for (std::size_t i = sight_->first[ray]; i < sight_->first[ray + 1]; ++i) {
      SightStretch stretch = sight_->stretch[i];
      if (!kept[stretch.cell]) continue;
      stretch.cell = number[stretch.cell];
      left.stretch.push_back(stretch);
    }
    left.first.push_back(left.stretch.size());
  }
  sight_ = std::make_shared<const SightLines>(std::move(left));
  numbers_ = std::size_t{count} * kGroundEnergies;
  share_work();
}

void GroundLight::set_rates(std::vector<float> rates) {
  assert(rates.size() == rate_.size());
  rate_ = std::move(rates);
  below_ = below_of(rate_);
}

std::vector<GroundNumbers> GroundLight::below_of(const std::vector<float>& rate) const {
  const AltitudeBins bins;
  const auto lines = static_cast<std::size_t>(lines_of_light_);
  std::vector<GroundNumbers> below(static_cast<std::size_t>(bins.levels()) * lines, GroundNumbers{});
  for (std::size_t line = 0; line < lines; ++line)
    for (int energy = 0; energy < kGroundEnergies; ++energy) {
      double sum = 0.0;
      for (int bin = 0; bin < bins.bins(); ++bin) {
        const double all =
            bins.height_km(bin) * rate[(static_cast<std::size_t>(bin) * lines + line) * kGroundEnergies +
                                       static_cast<std::size_t>(energy)];
        for (int part = 1; part <= AltitudeBins::kLevelsInBin; ++part)
          below[(static_cast<std::size_t>(bin) * AltitudeBins::kLevelsInBin + part) * lines + line]
              .of_energy[energy] = static_cast<float>(sum + all * part / AltitudeBins::kLevelsInBin);
        sum += all;
      }
    }
  return below;
}

void GroundLight::forward(const std::vector<float>& map, std::vector<float>& rayleighs) const {
  forward(map, light_below(), rayleighs);
}

void GroundLight::forward(const std::vector<float>& map, const std::vector<float>& rate,
                          std::vector<float>& rayleighs) const {
  assert(rate.size() == rate_.size());
  const std::vector<GroundNumbers> below = below_of(rate);
  forward(map, {lines_of_light_, below.data()}, rayleighs);
}

void GroundLight::forward(const std::vector<float>& map, const LightBelow& light_below,
                          std::vector<float>& rayleighs) const {
  assert(map.size() == numbers_);
  rayleighs.resize(rays() * lines_of_light_);
  flux_.resize(numbers_ / kGroundEnergies);
  std::memcpy(flux_.data(), map.data(), numbers_ * sizeof(float));
  constexpr std::size_t kRun = 512;
  parallel_for((rays() + kRun - 1) / kRun, rays() < kFewRays ? 1 : threads_, [&](std::size_t run, int) {
    const std::size_t first = run * kRun, last = std::min(first + kRun, rays());
    sum_light(in_use(), light_below, flux_.data(), first, last, rayleighs.data());
    for (std::size_t i = first * lines_of_light_; i < last * lines_of_light_; ++i)
      rayleighs[i] *= transmission_[i];
  });
}

void GroundLight::add_adjoint(const std::vector<float>& rayleighs, std::vector<float>& map) const {
  assert(map.size() == numbers_);
  weighted_.resize(rayleighs.size());
  for (std::size_t i = 0; i < weighted_.size(); ++i) weighted_[i] = rayleighs[i] * transmission_[i];
  sums_.resize(kShares);
  parallel_for(kShares, rays() < kFewRays ? 1 : threads_, [&](std::size_t share, int) {
    sums_[share].assign(numbers_ / kGroundEnergies, GroundNumbers{});
    spread_light(in_use(), light_below(), weighted_.data(), first_of_share_[share],
                 first_of_share_[share + 1], sums_[share].data());
  });
  const std::size_t cells = numbers_ / kGroundEnergies;
  constexpr std::size_t kRun = 256;
  parallel_for((cells + kRun - 1) / kRun, cells < kFewCells ? 1 : threads_, [&](std::size_t run, int) {
    for (std::size_t cell = run * kRun; cell < std::min((run + 1) * kRun, cells); ++cell)
      for (int energy = 0; energy < kGroundEnergies; ++energy) {
        float sum = 0.0f;
        for (const std::vector<GroundNumbers>& part : sums_) sum += part[cell].of_energy[energy];
        map[cell * kGroundEnergies + static_cast<std::size_t>(energy)] += sum;
      }
  });
}

}  // namespace vegard::sim
