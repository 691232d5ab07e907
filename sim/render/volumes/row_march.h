// Marches rows of rays through all emitters of a scene, in order of distance.
//
// Along every ray the emitters are sorted by the distance at which each begins. Mixed emitters
// (Emitter::is_mixed()) are marched once more up to the beginning of each absorbing emitter: this part of
// their light is in front of the absorber, and the rest, including light from within it, is attenuated by it.
//
// For the files of this folder only.
#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <numeric>
#include <vector>

#include "sim/base/parallel.h"
#include "sim/render/emitters/emitter_makers.h"
#include "sim/render/emitters/volume_files.h"
#include "sim/render/volumes/row_of_rays.h"
#include "sim/view/camera/camera.h"

namespace vegard::sim {

/// Marches rows of rays through all emitters and calls use(row, rays, combined light) for every row of the
/// film.
template <class T>
class RowMarch {
 public:
  /// Uses the emitters `made` beforehand; if it is null, makes those of the scene.
  RowMarch(const Scene& scene, const VolumeFiles& files, const NumberAs<T>& number, int threads,
           const Emitters<T>* made = nullptr)
      : lines_(static_cast<int>(scene.emission.lines.size())),
        scene_(scene),
        depth_(files.depth),
        sun_(scene),
        plain_view_(camera_view(scene.camera)),
        rad_per_px_(radians_per_px(plain_view_, scene.camera)),
        view_(camera_view<T>(scene.camera,
                             [&](CameraNumber which) { return number(camera_number(scene.camera, which)); })),
        made_here_(made != nullptr ? Emitters<T>() : make_emitters<T>(scene, files, number, threads)),
        emitters_(made != nullptr ? *made : made_here_),
        slots_(thread_count(threads)) {
    for (std::size_t e = 0; e < emitters_.size(); ++e) {
      if (emitters_[e]->absorbs()) absorbers_.push_back(e);
      if (emitters_[e]->is_mixed()) mixed_.push_back(e);
    }
  }

  bool absorbs() const { return !absorbers_.empty(); }

  template <class Use>
  void run(int row, int slot, const FilmGeometry& film, const std::vector<std::uint8_t>& wanted,
           const Use& use) {
    Slot& s = slots_[slot];
    s.rays.aim(view_, plain_view_, film, row, scene_, depth_, sun_, wanted);
    const RayBundle<T> bundle = s.rays.bundle(rad_per_px_ * film.cell_width_px);
    if (bundle.count == 0) return;
    s.of_emitter.resize(emitters_.size());
    for (std::size_t e = 0; e < emitters_.size(); ++e)
      emitters_[e]->march(bundle, s.of_emitter[e].clear(bundle.count, lines_));
    if (emitters_.size() == 1) return use(s.rays, s.of_emitter.front());  // in front of nothing
    march_up_to_absorbers(s, bundle);
    combine(s, bundle.count);
    use(s.rays, s.sum);
  }

 private:
  struct Slot {
    RowOfRays<T> rays;
    std::vector<RowLight<T>> of_emitter;
    RowLight<T> sum;
    std::vector<std::size_t> order;
    // For the n-th absorber along each ray: where it begins, [n * rays + ray], infinity if the ray ends
    // before; and all mixed light in front of it, [(n * lines + line) * rays + ray].
    std::vector<double> cut_km;
    std::vector<T> cut, before;  // `cut` as cut_km, with its derivatives
    RowOfRays<T> some;
    std::vector<T> some_cut;
    std::vector<std::size_t> some_at;
    RowLight<T> some_light;
    std::vector<std::size_t> entries;
  };

  void march_up_to_absorbers(Slot& s, const RayBundle<T>& rays) const {
    const std::size_t cuts = mixed_.empty() ? 0 : absorbers_.size();
    s.cut_km.assign(cuts * rays.count, std::numeric_limits<double>::infinity());
    s.cut.assign(cuts * rays.count, T(0.0));
    s.before.assign(cuts * rays.count * lines_, T(0.0));
    if (cuts == 0) return;
    for (std::size_t i = 0; i < rays.count; ++i) {
      s.entries = absorbers_;
      std::stable_sort(s.entries.begin(), s.entries.end(), [&](std::size_t a, std::size_t b) {
        return s.of_emitter[a].entry_km[i] < s.of_emitter[b].entry_km[i];
      });
      for (std::size_t n = 0; n < cuts; ++n) {
        const RowLight<T>& absorber = s.of_emitter[s.entries[n]];
        if (!(absorber.entry_km[i] <= rays.end_km[i])) continue;
        s.cut_km[n * rays.count + i] = absorber.entry_km[i];
        const T& moving = absorber.entry_moving[i];
        s.cut[n * rays.count + i] =
            value_of(moving) < std::numeric_limits<double>::infinity() ? moving : T(absorber.entry_km[i]);
      }
    }
    for (std::size_t n = 0; n < cuts; ++n) march_some(s, rays, n);
  }

  void march_some(Slot& s, const RayBundle<T>& rays, std::size_t n) const {
    s.some_at.clear();
    s.some.end_km.clear();
    s.some_cut.clear();
    for (auto& axis : s.some.direction) axis.clear();
    for (std::size_t i = 0; i < rays.count; ++i) {
      const double cut_km = s.cut_km[n * rays.count + i];
      if (!(cut_km < std::numeric_limits<double>::infinity())) continue;
      if (cut_km == rays.end_km[i]) {  // what absorbs is what the ray ends at: all is before it
        for (int l = 0; l < lines_; ++l)
          s.before[(n * lines_ + l) * rays.count + i] = mixed_light(s, l * rays.count + i);
        continue;
      }
      s.some_at.push_back(i);
      s.some.end_km.push_back(cut_km);
      s.some_cut.push_back(s.cut[n * rays.count + i]);
      for (int axis = 0; axis < 3; ++axis) s.some.direction[axis].push_back(rays.direction[axis][i]);
    }
    const std::size_t count = s.some_at.size();
    if (count == 0) return;
    s.some.column.resize(count);
    RayBundle<T> some = s.some.bundle(rays.cell_rad);
    some.end_moving = s.some_cut.data();
    for (const std::size_t e : mixed_) {
      emitters_[e]->march(some, s.some_light.clear(count, lines_));
      for (int l = 0; l < lines_; ++l)
        for (std::size_t i = 0; i < count; ++i) {
          T& sum = s.before[(n * lines_ + l) * rays.count + s.some_at[i]];
          sum = sum + s.some_light.rayleigh[l * count + i];
        }
    }
  }

  /// Adds up the light of the emitters from the nearest to the farthest.
  void combine(Slot& s, std::size_t rays) const {
    s.sum.clear(rays, lines_);
    s.order.resize(emitters_.size());
    for (std::size_t i = 0; i < rays; ++i) {
      std::iota(s.order.begin(), s.order.end(), std::size_t{0});
      std::stable_sort(s.order.begin(), s.order.end(), [&](std::size_t a, std::size_t b) {
        return s.of_emitter[a].entry_km[i] < s.of_emitter[b].entry_km[i];
      });
      const bool is_cut = !s.cut_km.empty() && s.cut_km[i] < std::numeric_limits<double>::infinity();
      std::size_t passed = 0;
      double weight = 0.0, weighted = 0.0;
      for (const std::size_t e : s.order) {
        const RowLight<T>& one = s.of_emitter[e];
        const bool in_pieces = is_cut && emitters_[e]->is_mixed();
        if (is_cut && emitters_[e]->absorbs() && passed < absorbers_.size() &&
            s.cut_km[passed * rays + i] < std::numeric_limits<double>::infinity())
          add_mixed(s, rays, i, passed++);
        double bright = 0.0;
        for (int l = 0; l < lines_; ++l) {
          const std::size_t at = l * rays + i;
          const T seen = s.sum.kept[at] * one.rayleigh[at];
          bright += value_of(seen);
          if (in_pieces) continue;
          s.sum.rayleigh[at] = s.sum.rayleigh[at] + seen;
          s.sum.kept[at] = s.sum.kept[at] * one.kept[at];
        }
        if (bright > 0.0 && one.depth_km[i] < std::numeric_limits<double>::infinity()) {
          weight += bright;
          weighted += bright * one.depth_km[i];
        }
      }
      if (is_cut) add_mixed_rest(s, rays, i, passed);
      if (weight > 0.0) s.sum.depth_km[i] = weighted / weight;
    }
  }

  /// Returns all mixed light up to the ray's end.
  T mixed_light(const Slot& s, std::size_t at) const {
    T light(0.0);
    for (const std::size_t e : mixed_) light = light + s.of_emitter[e].rayleigh[at];
    return light;
  }

  /// Adds the mixed light between the previous absorber, or the camera, and the n-th absorber.
  void add_mixed(Slot& s, std::size_t rays, std::size_t i, std::size_t n) const {
    for (int l = 0; l < lines_; ++l) {
      const std::size_t at = l * rays + i;
      T light = s.before[(n * lines_ + l) * rays + i];
      if (n > 0) light = light - s.before[((n - 1) * lines_ + l) * rays + i];
      s.sum.rayleigh[at] = s.sum.rayleigh[at] + s.sum.kept[at] * light;
    }
  }

  /// Adds the mixed light behind all n absorbers that the ray has passed.
  void add_mixed_rest(Slot& s, std::size_t rays, std::size_t i, std::size_t n) const {
    for (int l = 0; l < lines_; ++l) {
      const std::size_t at = l * rays + i;
      T light = mixed_light(s, at);
      if (n > 0) light = light - s.before[((n - 1) * lines_ + l) * rays + i];
      s.sum.rayleigh[at] = s.sum.rayleigh[at] + s.sum.kept[at] * light;
    }
  }

  int lines_;
  const Scene& scene_;
  const DepthImage& depth_;
  SunBall sun_;
  CameraView<double> plain_view_;
  double rad_per_px_;
  CameraView<T> view_;
  const Emitters<T> made_here_;
  const Emitters<T>& emitters_;
  std::vector<std::size_t> absorbers_, mixed_;
  std::vector<Slot> slots_;
};

}  // namespace vegard::sim
