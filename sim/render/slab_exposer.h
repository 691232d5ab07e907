// Exposing a film under blur.model = "physical": like Exposer, but what comes out is spread already as far as
// the excited atoms come, before any air or sensor.
//
// Each slow line is exposed in slabs of altitude (sim/render/beams/altitude_slabs.h), up to eight at a time,
// each on a film that reaches as far beyond the wanted one as its light is spread; what falls there, with its
// derivatives, is spread cell by cell (sim/render/slab_spread.h), which is linear in the light. Slabs and
// ladders are those of the scene that this is made with, so that the picture is smooth in every number. What
// is not light of the air's excited atoms (nebulae, grids, the Sun, footprints in two colours) stays as it
// is.
//
// For sim/render/film.cpp only: everybody else has it by Exposer.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "sim/render/exposure.h"
#include "sim/render/slab_spread.h"

namespace vegard::sim {

/// What is exposed together, and on which films.
struct SlabPlan {
  struct Item {
    int line = 0;
    int slab = -1;  ///< of slabs[line]; -1: all of a prompt line
    int cells = 1;  ///< of the wanted film, that one of its own may be wide
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
  double widest_px = 0.0;  ///< that light is spread
};
SlabPlan slab_plan(const Scene& scene, const FilmGeometry& film, int threads);

/// Bytes at the worst moment of an exposure by this plan, with derivatives by so many free numbers, beside
/// what it gives.
double slab_bytes(const SlabPlan& plan, int free, int threads);

class SlabExposer {
 public:
  SlabExposer(const Scene& scene, const FilmGeometry& film, int threads, const MakePartExposer& make);

  // As Exposer has them.
  void expose(const Scene& scene, Exposure& out, const std::function<void(double)>& progress,
              const std::atomic<bool>* stop, int only_sheet);
  void expose_with_derivatives(const Scene& scene, const std::vector<ParameterId>& free, Exposure& out);
  void expose_profiles(const Scene& scene, int sheet, const std::vector<std::vector<float>>& rates, int line,
                       Exposure& out);
  std::vector<float> split_by_age(int sheet, double wavelength_nm, const std::vector<float>& rates) const;

 private:
  using Pass = SlabPlan::Pass;
  using Item = SlabPlan::Item;
  /// Sheets whose light has been carried by the wind beam by beam, since it has ages, and all else.
  struct Group {
    bool is_calm = false;
    std::vector<bool> sheets;
    bool has_footprints = false;
  };
  /// Where the light of a pass's items goes.
  struct PassPlaces {
    std::vector<SlabPlaces> of_item;  ///< empty of what is not spread at all
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
  std::vector<std::unique_ptr<PartExposer>> exposers_;  ///< of the plan's films
  std::vector<Group> groups_;
  std::unique_ptr<const SlabSpread> spread_;
  std::unique_ptr<const Volumes> rest_;  ///< of what stays as it is; null: nothing does
  bool has_footprints_ = false;
};

}  // namespace vegard::sim
