// Exposes a film under blur.model = "physical": the resulting light is already spread by the motion of the
// excited atoms, before any effect of air or sensor.
//
// Each slow line is exposed in slabs of altitude (sim/render/beams/altitude_slabs.h), up to eight at a time,
// each on a film that extends beyond the wanted one by the spread of its light. The light on it, with its
// derivatives, is then spread cell by cell (sim/render/slab_spread.h), which is linear in the light. Slabs
// and levels of blur are those of the constructor's scene, so that the picture is smooth in every parameter.
// Light that is not of the air's excited atoms (nebulae, grids, the Sun, footprints in two colours) is not
// spread.
#pragma once

#include <memory>
#include <vector>

#include "sim/render/beam_exposer.h"
#include "sim/render/slab_spread.h"

namespace vegard::sim {

/// Which slabs are exposed together, and on which films.
struct SlabPlan {
  struct Item {
    int line = 0;
    int slab = -1;  ///< of slabs[line]; -1: all of a prompt line
    int cells = 1;  ///< how many cells of the wanted film one cell of its own film may be wide
    double margin_px = 0.0;
  };
  struct Pass {
    std::vector<Item> items;
    std::size_t film = 0;
  };
  struct PassFilm {
    int cells = 1;
    FilmGeometry film;
  };
  std::vector<std::vector<AltitudeSlab>> slabs;  ///< [line]
  std::vector<Pass> passes;
  std::vector<PassFilm> films;
  double widest_px = 0.0;  ///< largest standard deviation of the spread
};
SlabPlan slab_plan(const Scene& scene, const FilmGeometry& film, int threads);

/// Returns the peak number of bytes of an exposure by this plan with derivatives with respect to `free`
/// parameters, without its result.
double slab_bytes(const SlabPlan& plan, int free, int threads);

class SlabExposer final : public Exposer {
 public:
  /// The arguments are those of make_exposer().
  SlabExposer(const Scene& scene, const FilmGeometry& film, int threads, double beyond,
              const BeamSampling& sampling);

  void expose(const Scene& scene, Exposure& out, const std::function<void(double)>& progress,
              const std::atomic<bool>* stop, int only_sheet) override;
  void expose_with_derivatives(const Scene& scene, const std::vector<ParameterId>& free,
                               Exposure& out) override;
  void expose_profiles(const Scene& scene, int sheet, const std::vector<std::vector<float>>& rates,
                       Exposure& out, int line) override;
  std::vector<float> split_by_age(int sheet, double wavelength_nm,
                                  const std::vector<float>& rates) const override;
  bool spreads() const override { return true; }

 private:
  using Pass = SlabPlan::Pass;
  using Item = SlabPlan::Item;
  /// Emitters that are exposed together. `is_calm`: sheets whose light is split by age, so that the wind has
  /// been applied to each beam already.
  struct Group {
    bool is_calm = false;
    std::vector<bool> sheets;
    bool has_footprints = false;
  };
  /// The cells to which the light of a pass's items is spread.
  struct PassPlaces {
    std::vector<SlabPlaces> of_item;  ///< empty for light that is not spread
  };

  Scene part_of(const Scene& scene, const Pass& pass, bool has_footprints) const;
  Scene rest_of(const Scene& scene) const;
  PassPlaces places_of(const Scene& scene, const Pass& pass, bool is_calm) const;
  void add_line(const Pass& pass, const PassPlaces& places, int line, const float* planes, std::size_t stride,
                int width, float* out) const;
  void begin(Exposure& out) const;
  void add_rest(const Scene& scene, Exposure& out, const std::atomic<bool>* stop,
                bool whole_resolution) const;
  std::size_t cells() const { return static_cast<std::size_t>(film_.rows) * film_.columns; }

  FilmGeometry film_;
  int threads_ = 1;
  int lines_ = 0;
  SlabPlan plan_;
  std::vector<std::unique_ptr<BeamExposer>> exposers_;  ///< of the plan's films
  std::vector<Group> groups_;
  std::unique_ptr<const SlabSpread> spread_;
  std::unique_ptr<const Volumes> rest_;  ///< the volumes whose light is not spread; null: none
  bool has_footprints_ = false;
};

}  // namespace vegard::sim
