// The random numbers that a scene of the scorecard is drawn with.
#pragma once

#include <cmath>
#include <cstdint>

#include "sim/base/number/distributions.h"
#include "sim/base/number/random.h"

namespace vegard::scorecard {

/// What a number decides. Each has a place of its own, so that one more changes none of the others. Numbers
/// of the second sheet stand kSecondSheet further on.
enum class Draw : std::uint32_t {
  hfov,
  border_row,
  roll,
  inclination,
  declination,
  two_sheets,
  rays,
  folds,
  exposure,
  sky_red,
  sky_green,
  sky_blue,
  scene_seed,
  distance,
  bearing,
  phase_shift,
  width,
  thickness,
  wavelength,
  phase,
  energy,
  energy_flux,
  ray_contrast,
  ray_width,
  fold_spacing,
  fold_length,
  fold_stage,
};
inline constexpr std::uint32_t kSecondSheet = 1000, kFirstMode = 900;

/// The numbers of scene `scene` of the set `set`: pure functions of both.
class Draws {
 public:
  Draws(std::uint64_t set, std::uint32_t scene, std::uint32_t sheet = 0)
      : set_(set), scene_(scene), first_(sheet * kSecondSheet) {}

  std::uint32_t word(Draw what) const { return words(what)[0]; }
  double uniform(Draw what) const { return sim::uniform(words(what)[0]); }
  /// A normal number: the coefficient of a mode of the emission tables' uncertainty.
  double mode(std::uint32_t number) const {
    return sim::normal_quantile(sim::uniform(words(static_cast<Draw>(kFirstMode + number))[0]));
  }
  double between(Draw what, double low, double high) const { return low + (high - low) * uniform(what); }
  double log_between(Draw what, double low, double high) const {
    return low * std::pow(high / low, uniform(what));
  }

 private:
  // No stream of the simulator's (sim::Stream), so that no drawn number is one that it uses.
  static constexpr std::uint32_t kTag = 0x5c0feca4u;

  sim::Words words(Draw what) const {
    return sim::philox4x32({scene_, first_ + static_cast<std::uint32_t>(what), 0, kTag},
                           sim::random_key(set_));
  }

  std::uint64_t set_;
  std::uint32_t scene_, first_;
};

}  // namespace vegard::scorecard
