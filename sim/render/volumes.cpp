#include "sim/render/volumes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "sim/base/parallel.h"
#include "sim/emit/sun/sun_frame.h"
#include "sim/render/depth_file.h"
#include "sim/render/emitters.h"
#include "sim/render/kernel_scene.h"
#include "sim/render/volume_files.h"
#include "sim/view/rays.h"

namespace vegard::sim {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double plain(const double& number) { return number; }

/// Where rays are stopped by the photosphere.
class SunBall {
 public:
  explicit SunBall(const Scene& scene)
      : shown_(scene.sun.shown), radius_(scene.sun.radius), frame_(scene.sun, plain) {}

  double end_km(const double enu[3]) const {
    if (!shown_) return kInfinity;
    const SkyRay<double> ray = frame_.sky().ray(enu);
    double half;
    if (!meets_sphere(ray, radius_, half) || ray.observer >= -half) return kInfinity;
    return (-half - ray.observer) * frame_.unit_km();
  }

 private:
  bool shown_;
  double radius_;
  SunFrame<double> frame_;
};

/// Angle between the rays of neighbouring pixels of a row, in the middle of the picture.
double radians_per_px(const CameraView<double>& view, const Camera& camera) {
  double a[3], b[3];
  const double x = 0.5 * camera.width, y = 0.5 * camera.height;
  if (!enu_of_pixel(view, x - 0.5, y, a) || !enu_of_pixel(view, x + 0.5, y, b)) return 0.0;
  return std::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                   (a[2] - b[2]) * (a[2] - b[2]));
}

/// The rays of one row of a film, of those cells that are wanted and see anything, and what comes out of
/// them.
template <class T>
struct RowOfRays {
  std::vector<int> column;
  std::vector<T> direction[3];
  std::vector<double> end_km;

  void aim(const CameraView<T>& view, const CameraView<double>& plain_view, const FilmGeometry& film, int row,
           double observer_altitude_km, const DepthImage& depth, const SunBall& sun,
           const std::vector<std::uint8_t>& wanted) {
    const double y_px = film.y0_px + (row + 0.5) * film.cell_height_px;
    column.clear();
    end_km.clear();
    for (auto& axis : direction) axis.clear();
    for (int c = 0; c < film.columns; ++c) {
      if (!wanted.empty() && wanted[static_cast<std::size_t>(row) * film.columns + c] == 0) continue;
      T enu[3];
      if (!enu_of_cell(view, film, row, c, enu)) continue;
      column.push_back(c);
      for (int axis = 0; axis < 3; ++axis) direction[axis].push_back(enu[axis]);
      const double towards[3] = {value_of(enu[0]), value_of(enu[1]), value_of(enu[2])};
      end_km.push_back(std::min(ray_end_km(plain_view, observer_altitude_km, depth,
                                           film.x0_px + (c + 0.5) * film.cell_width_px, y_px, towards),
                                sun.end_km(towards)));
    }
  }

  RayBundle<T> bundle(double cell_rad) const {
    return {column.size(),
            {direction[0].data(), direction[1].data(), direction[2].data()},
            end_km.data(),
            cell_rad};
  }
};

/// What one emitter makes of a row.
template <class T>
struct RowLight {
  std::vector<T> rayleigh, kept;
  std::vector<double> entry_km, depth_km;

  BundleLight<T> clear(std::size_t rays, int lines) {
    rayleigh.assign(rays * lines, T(0.0));
    kept.assign(rays * lines, T(1.0));
    entry_km.assign(rays, kInfinity);
    depth_km.assign(rays, kInfinity);
    return {lines, rayleigh.data(), kept.data(), entry_km.data(), depth_km.data()};
  }
};

/// Rows of rays through all emitters: calls use(row, rays, combined light) for every row of the film.
template <class T>
class RowMarch {
 public:
  using Emitters = std::vector<std::unique_ptr<Emitter<T>>>;

  /// Of the emitters `made` beforehand, or if there are none of those that the scene makes now.
  RowMarch(const Scene& scene, const VolumeFiles& files, const NumberAs<T>& number, int threads,
           const Emitters* made = nullptr)
      : lines_(static_cast<int>(scene.emission.lines.size())),
        observer_km_(scene.site.altitude_m * 1e-3),
        depth_(files.depth),
        sun_(scene),
        plain_view_(camera_view(scene.camera)),
        rad_per_px_(radians_per_px(plain_view_, scene.camera)),
        view_(camera_view<T>(
            scene.camera,
            [&](CameraNumber which) { return number(*camera_number_address(scene.camera, which)); })),
        made_here_(made != nullptr ? Emitters() : make_emitters<T>(scene, files, number, threads)),
        emitters_(made != nullptr ? *made : made_here_),
        slots_(thread_count(threads)) {}

  bool absorbs() const {
    return std::any_of(emitters_.begin(), emitters_.end(), [](const auto& e) { return e->absorbs(); });
  }

  template <class Use>
  void run(int row, int slot, const FilmGeometry& film, const std::vector<std::uint8_t>& wanted,
           const Use& use) {
    Slot& s = slots_[slot];
    s.rays.aim(view_, plain_view_, film, row, observer_km_, depth_, sun_, wanted);
    const RayBundle<T> bundle = s.rays.bundle(rad_per_px_ * film.cell_width_px);
    if (bundle.count == 0) return;
    s.of_emitter.resize(emitters_.size());
    for (std::size_t e = 0; e < emitters_.size(); ++e)
      emitters_[e]->march(bundle, s.of_emitter[e].clear(bundle.count, lines_));
    if (emitters_.size() == 1) return use(s.rays, s.of_emitter.front());  // in front of nothing
    combine(s, bundle.count);
    use(s.rays, s.sum);
  }

 private:
  struct Slot {
    RowOfRays<T> rays;
    std::vector<RowLight<T>> of_emitter;
    RowLight<T> sum;
    std::vector<std::size_t> order;
  };

  /// From the nearest to the farthest.
  void combine(Slot& s, std::size_t rays) const {
    s.sum.clear(rays, lines_);
    s.order.resize(emitters_.size());
    for (std::size_t i = 0; i < rays; ++i) {
      std::iota(s.order.begin(), s.order.end(), std::size_t{0});
      std::stable_sort(s.order.begin(), s.order.end(), [&](std::size_t a, std::size_t b) {
        return s.of_emitter[a].entry_km[i] < s.of_emitter[b].entry_km[i];
      });
      double weight = 0.0, weighted = 0.0;
      for (const std::size_t e : s.order) {
        const RowLight<T>& one = s.of_emitter[e];
        double bright = 0.0;
        for (int l = 0; l < lines_; ++l) {
          const std::size_t at = l * rays + i;
          const T seen = s.sum.kept[at] * one.rayleigh[at];
          bright += value_of(seen);
          s.sum.rayleigh[at] = s.sum.rayleigh[at] + seen;
          s.sum.kept[at] = s.sum.kept[at] * one.kept[at];
        }
        if (bright > 0.0 && one.depth_km[i] < kInfinity) {
          weight += bright;
          weighted += bright * one.depth_km[i];
        }
      }
      if (weight > 0.0) s.sum.depth_km[i] = weighted / weight;
    }
  }

  int lines_;
  double observer_km_;
  const DepthImage& depth_;
  SunBall sun_;
  CameraView<double> plain_view_;
  double rad_per_px_;
  CameraView<T> view_;
  const Emitters made_here_;
  const Emitters& emitters_;
  std::vector<Slot> slots_;
};

}  // namespace

bool has_volumes(const Scene& scene) {
  return !scene.footprints.empty() || !scene.volumes.empty() || scene.sun.shown ||
         std::any_of(scene.nebulae.begin(), scene.nebulae.end(),
                     [](const Nebula& nebula) { return nebula.method != "literal"; });
}

/// Emitters look into the scene that they are made of.
struct Volumes::Made {
  Scene scene;
  std::vector<std::unique_ptr<Emitter<double>>> emitters;
};

Volumes::Volumes(const Scene& scene, int threads, bool of_one_scene)
    : threads_(thread_count(threads)), files_(std::make_unique<VolumeFiles>(read_volume_files(scene))) {
  if (!of_one_scene) return;
  auto made = std::make_unique<Made>(Made{scene, {}});
  made->emitters = make_emitters<double>(
      made->scene, *files_, [](const double& number) { return number; }, threads_);
  made_ = std::move(made);
}

Volumes::~Volumes() = default;

MarchCells Volumes::marcher(const Scene& scene, const std::function<void(double)>& progress,
                            const std::atomic<bool>* stop) const {
  const auto rows = std::make_shared<RowMarch<double>>(
      scene, *files_, [](const double& number) { return number; }, threads_,
      made_ ? &made_->emitters : nullptr);
  const int lines = static_cast<int>(scene.emission.lines.size());
  return [rows, lines, progress, stop, threads = threads_](const FilmGeometry& film,
                                                           const std::vector<std::uint8_t>& wanted) {
    VolumeLight light;
    light.lines = lines;
    const std::size_t cells = static_cast<std::size_t>(film.rows) * film.columns;
    light.rayleigh.assign(cells * lines, 0.0f);
    light.depth_km.assign(cells, std::numeric_limits<float>::infinity());
    if (rows->absorbs()) light.kept.assign(cells * lines, 1.0f);
    std::atomic<int> done{0};
    parallel_for(static_cast<std::size_t>(film.rows), threads, [&](std::size_t row, int slot) {
      if (stop != nullptr && stop->load(std::memory_order_relaxed)) return;
      rows->run(static_cast<int>(row), slot, film, wanted,
                [&](const RowOfRays<double>& rays, const RowLight<double>& sum) {
                  const std::size_t count = rays.column.size();
                  for (std::size_t i = 0; i < count; ++i) {
                    const std::size_t cell = row * film.columns + rays.column[i];
                    light.depth_km[cell] = static_cast<float>(sum.depth_km[i]);
                    for (int l = 0; l < lines; ++l) {
                      light.rayleigh[l * cells + cell] = static_cast<float>(sum.rayleigh[l * count + i]);
                      if (!light.kept.empty())
                        light.kept[l * cells + cell] = static_cast<float>(sum.kept[l * count + i]);
                    }
                  }
                });
      const int finished = ++done;
      if (progress && wanted.empty()) progress(static_cast<double>(finished) / film.rows);
    });
    return light;
  };
}

void Volumes::add_derivatives(const Scene& scene, const FilmGeometry& film,
                              const std::vector<const double*>& free, std::size_t stride,
                              float* derivative) const {
  const std::size_t cells = static_cast<std::size_t>(film.rows) * film.columns;
  const int lines = static_cast<int>(scene.emission.lines.size());
  for (std::size_t first = 0; first < free.size(); first += kTangentWidth) {
    const std::size_t count = std::min<std::size_t>(kTangentWidth, free.size() - first);
    const Seeds seeds(free, first, count);
    RowMarch<FreeDual> rows(
        scene, *files_, [&](const double& number) { return seeds(number); }, threads_);
    parallel_for(static_cast<std::size_t>(film.rows), threads_, [&](std::size_t row, int slot) {
      rows.run(static_cast<int>(row), slot, film, {},
               [&](const RowOfRays<FreeDual>& rays, const RowLight<FreeDual>& sum) {
                 for (std::size_t i = 0; i < rays.column.size(); ++i)
                   for (int l = 0; l < lines; ++l) {
                     const FreeDual& light = sum.rayleigh[l * rays.column.size() + i];
                     float* to =
                         derivative + (l * cells + row * film.columns + rays.column[i]) * stride + first;
                     for (std::size_t j = 0; j < count; ++j) to[j] += static_cast<float>(light.d.t[j]);
                   }
               });
    });
  }
}

}  // namespace vegard::sim
