// One photograph that a map of precipitation must explain: its light in the cells of a film, the errors, and
// the light that a map and a sky would give there.
//
// The model of channel c in a cell is
//
//     gain_c  sum over lines  colour[c][line]  blur(rayleighs of the line)
//             +  sum over j  sky_j f_j(direction),
//
// linear in the map and in the sky. The sky (fit/map/smooth_sky.h) is solved for any given map, so that no
// derivative by it is needed (variable projection, Golub and Pereyra 1973, doi:10.1137/0710036). Where a
// channel was clipped at no light, the data only require that the model is not above it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "fit/map/smooth_sky.h"
#include "fit/photo/photo.h"
#include "sim/base/number/constants.h"
#include "sim/render/ground/ground_grid.h"
#include "sim/render/ground/ground_light.h"
#include "sim/render/ground/ground_rates.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/camera/camera.h"
#include "sim/view/film/blur.h"

namespace vegard::fit {

/// Standard deviation, in cells of the film, of the smooth errors that a model of the light has.
inline constexpr double kModelErrorReach_cells = 4.0;
/// Cells that share a smooth error: of the model, and of the map itself, which is sparse and has cells. What
/// changes the light as a whole is told by so many fewer values than there are.
inline constexpr double kMapSharedBy = 4.0 * sim::kPi * kModelErrorReach_cells * kModelErrorReach_cells;

/// Sums over a film's cells and channels: [cell * 3 + channel].
using MapLight = std::vector<float>;

/// The sum of products, in double precision.
double dot(const std::vector<float>& a, const std::vector<float>& b);

struct MapObservationOptions {
  int pixels_per_cell = 1;    ///< along each side of a film's cell
  double model_error = 0.02;  ///< as a fraction of the light above the sky
  double lowest_elevation_deg = 3.0;
  int margin_cells = 0;  ///< margin of the film around the picture; 0: as far as the blur reaches
  int threads = 0;
  const std::atomic<bool>* stop = nullptr;  ///< as GroundLight's
};

/// The data: a film with its cells' mean light.
class MapObservation {
 public:
  MapObservation(const sim::Scene& scene, const Photo& photo, const MapObservationOptions& options);

  const sim::Scene& scene() const { return scene_; }
  const sim::FilmGeometry& film() const { return film_; }
  std::size_t cells() const { return static_cast<std::size_t>(film_.rows) * film_.columns; }
  /// Cells whose light must be computed: those that are used, and those around them as far as the blur
  /// reaches.
  const std::vector<std::uint8_t>& wanted() const { return wanted_; }
  std::size_t values() const { return values_; }  ///< number of values in the data

  const MapLight& data() const { return data_; }
  const MapLight& sigma() const { return sigma_; }  ///< 0: not used
  const MapLight& noise() const { return noise_; }  ///< the part of sigma that does not depend on the model
  void set_data(MapLight data) { data_ = std::move(data); }
  /// 1 / sigma², or 0 where a value is not used or left out.
  const MapLight& weight() const { return weight_; }
  /// Sets weights of the given cells to 0: one entry per cell, 1: left out. Empty: none is left out.
  void leave_out(const std::vector<std::uint8_t>& cells);

  /// Light will be computed in all cells, so that the operator serves other pictures of the same camera.
  void want_all() { wanted_.assign(cells(), 1); }
  /// Makes the forward operator for a grid.
  void look_at(const sim::Site& home, const sim::GroundGrid& grid, const std::vector<double>& energies_kev,
               double rates_at_flux_mw_m2, double altitude_scale = 1.0,
               const sim::ElectronSpectrum& spectrum = {});
  /// Takes the forward operator and the light of another picture of the same camera. They are one from then
  /// on: what changes the one's light changes the other's.
  void share_light_of(const MapObservation& other) {
    light_ = other.light_;
    rates_ = other.rates_;
  }
  /// Takes a forward operator of its own, on the same lines of sight, and works on one thread from then on:
  /// copies of a picture can be worked on side by side.
  void work_alone() {
    threads_ = 1;
    light_ = std::make_shared<sim::GroundLight>(light_->on_one_thread());
  }
  /// Only these cells are left in the grid of its light (GroundGrid::keep()).
  void keep_in_grid(const std::vector<bool>& kept) { light_->keep_in_grid(kept); }
  /// Takes other rates for the forward operator (sim/render/ground/ground_rates.h).
  void set_rates(std::vector<float> rates) { light_->set_rates(std::move(rates)); }
  /// Takes the light of other electrons, or of other emission tables, for the forward operator that
  /// look_at() has made: `scene` differs from the picture's own in its emission alone.
  void look_by_light_of(const sim::Scene& scene, const std::vector<double>& energies_kev,
                        double rates_at_flux_mw_m2, double altitude_scale,
                        const sim::ElectronSpectrum& spectrum) {
    light_->set_rates(sim::ground_rates(scene, energies_kev, rates_at_flux_mw_m2, altitude_scale, spectrum));
  }
  /// Gives it light for any coefficients of the modes of the tables' uncertainty.
  void set_light(std::shared_ptr<const sim::ModeRates> rates, const std::vector<double>& modes);
  void set_modes(const std::vector<double>& modes) { light_->set_rates(rates_->at(modes)); }
  const sim::GroundLight& light() const { return *light_; }
  /// As GroundLight's.
  void keep(const std::vector<std::uint8_t>& cells) { light_->keep(cells); }
  void keep_all() { light_->keep_all(); }

  /// The light of a map, without the sky. Two threads must not call it or add_adjoint() at once.
  void forward(const std::vector<float>& map, MapLight& out) const { forward(map, light_->rate(), out); }
  /// Its derivative by the coefficient of a mode.
  void forward_by_mode(int mode, const std::vector<float>& map, MapLight& out) const {
    forward(map, rates_->by_mode(mode, light_->rate()), out);
  }
  void add_adjoint(const MapLight& light, std::vector<float>& map) const;

  /// Solves for the sky of a model's light and returns chi2; `residual` becomes (light + sky - data) /
  /// sigma², whose adjoint is the gradient of chi2 / 2.
  double residual(const MapLight& light, MapLight& residual);
  /// Subtracts from the weighted product W (light) what the sky can explain of it: for curvatures.
  void take_sky_away(const MapLight& light, MapLight& weighted) const;
  /// The sky that the last residual() found.
  MapLight sky() const { return smooth_.light(sky_); }

  /// The channel whose gain is that of the scene where the white balance is unknown: the first of G, R, B
  /// with data.
  int reference_channel() const { return reference_; }

  /// Gain of each channel; that of the first photograph's reference channel stays 1.
  std::array<double, 3> gain{1.0, 1.0, 1.0};

 private:
  void forward(const std::vector<float>& map, const std::vector<float>& rate, MapLight& out) const;
  void bin(const Photo& photo, const MapObservationOptions& options);
  void want_light_around();
  void leave_out_beside(const std::vector<std::uint8_t>& clipped, std::vector<std::uint8_t>& used);
  /// Fills the standard deviations of the cells' means.
  void estimate_noise(const Photo& photo, const MapObservationOptions& options,
                      const std::vector<std::uint8_t>& used);

  sim::Scene scene_;
  sim::FilmGeometry film_;
  int threads_, reference_ = 1;
  const std::atomic<bool>* stop_ = nullptr;
  bool clips_ = false;  ///< whether negative light was stored as 0
  std::size_t values_ = 0;
  MapLight data_, sigma_, noise_, weight_;
  SmoothSky smooth_;
  SmoothSky::Coefficients sky_{};  ///< that residual() has found
  std::vector<std::uint8_t> wanted_;
  std::vector<std::array<double, 3>> colour_;  ///< per rayleigh of each line
  std::vector<sim::PlaneBlur> blur_;
  std::shared_ptr<sim::GroundLight> light_;
  std::shared_ptr<const sim::ModeRates> rates_;
  // Memory of forward() and add_adjoint(), kept from call to call.
  mutable std::vector<float> rayleighs_, planes_, blurred_;
};

}  // namespace vegard::fit
