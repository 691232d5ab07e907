// The mean of several emitters that are the same object at different instants of an exposure.
//
// Both the emitted light and the transmission are averaged, since a film adds up all light that reaches it.
// For one such emitter in front of objects that stand still this is the mean of the pictures. For two that
// move and hide each other it is an approximation: it does not pair their instants.
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "sim/emit/aurora/motion.h"
#include "sim/light/emitter.h"
#include "sim/render/emitters/emitter_makers.h"

namespace vegard::sim {

template <class T>
class MeanOfInstants : public Emitter<T> {
 public:
  /// `instants`: at least one emitter, all of the same kind.
  explicit MeanOfInstants(Emitters<T> instants) : instants_(std::move(instants)) {}

  bool absorbs() const override { return instants_.front()->absorbs(); }
  bool is_mixed() const override { return instants_.front()->is_mixed(); }

  void march(const RayBundle<T>& rays, const BundleLight<T>& out) const override {
    constexpr double kNowhere = std::numeric_limits<double>::infinity();
    const std::size_t all = rays.count * static_cast<std::size_t>(out.lines);
    const double share = 1.0 / static_cast<double>(instants_.size());
    std::vector<T> rayleigh(all), kept(all), moving(rays.count), sum_kept(all, T(0.0));
    std::vector<double> entry(rays.count), depth(rays.count), weight(rays.count, 0.0), far(rays.count, 0.0);
    for (const auto& one : instants_) {
      std::fill(rayleigh.begin(), rayleigh.end(), T(0.0));
      std::fill(kept.begin(), kept.end(), T(1.0));
      std::fill(moving.begin(), moving.end(), T(kNowhere));
      std::fill(entry.begin(), entry.end(), kNowhere);
      std::fill(depth.begin(), depth.end(), kNowhere);
      one->march(rays, {out.lines, rayleigh.data(), kept.data(), entry.data(), depth.data(), moving.data()});
      for (std::size_t i = 0; i < all; ++i) {
        out.rayleigh[i] = out.rayleigh[i] + rayleigh[i] * share;
        sum_kept[i] = sum_kept[i] + kept[i] * share;
      }
      for (std::size_t i = 0; i < rays.count; ++i) {
        if (entry[i] < out.entry_km[i]) {
          out.entry_km[i] = entry[i];
          if (out.entry_moving != nullptr) out.entry_moving[i] = moving[i];
        }
        if (!(depth[i] < kNowhere)) continue;
        double light = 0.0;
        for (int l = 0; l < out.lines; ++l) light += value_of(rayleigh[l * rays.count + i]);
        weight[i] += light;
        far[i] += light * depth[i];
      }
    }
    if (absorbs()) std::copy(sum_kept.begin(), sum_kept.end(), out.kept);
    for (std::size_t i = 0; i < rays.count; ++i)
      if (weight[i] > 0.0) out.depth_km[i] = far[i] / weight[i];
  }

 private:
  Emitters<T> instants_;
};

/// Returns the instants of the scene's exposure for an object that moves, otherwise only its beginning.
inline std::vector<double> instants_of(const Scene& scene, bool moves) {
  if (!moves || scene.time.exposure_s == 0.0) return {scene.time.start_s};
  return instants_s(scene.time);
}

/// Adds the emitter that `make` makes for a single instant, or the mean of the emitters for several instants.
template <class T>
void add_mean(const std::vector<double>& instants,
              const std::function<std::unique_ptr<Emitter<T>>(double instant_s)>& make, Emitters<T>& all) {
  if (instants.size() == 1) {
    all.push_back(make(instants.front()));
    return;
  }
  Emitters<T> each;
  for (const double instant : instants) each.push_back(make(instant));
  all.push_back(std::make_unique<MeanOfInstants<T>>(std::move(each)));
}

}  // namespace vegard::sim
