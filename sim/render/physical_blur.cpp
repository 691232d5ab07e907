#include "sim/render/physical_blur.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "sim/base/parallel.h"
#include "sim/render/beam_exposer.h"
#include "sim/render/beams/beams.h"
#include "sim/render/beams/kernel.h"
#include "sim/render/beams/kernel_scene.h"
#include "sim/render/film.h"
#include "sim/scene/emitters/emitter_kinds.h"
#include "sim/scene/lines/scene_lines.h"
#include "sim/view/film/level_ladder.h"

namespace vegard::sim {
namespace {

double wind_km_s(const Scene& scene) {
  return 1e-3 * std::hypot(scene.blur.wind_m_s.east, scene.blur.wind_m_s.north);
}

double diagonal_px(const Scene& scene) { return std::hypot(scene.camera.width, scene.camera.height); }

/// Returns the same scene with some of its lines only, no other blur, and no volumes, which come from
/// elsewhere.
Scene with_lines(const Scene& scene, const std::vector<double>& lines_nm) {
  Scene part = scene;
  part.emission.lines = lines_nm;
  part.blur.width_deg.assign(lines_nm.size(), 0.0);
  remove_emitters(part);
  return part;
}

double highest_km(const Scene& scene) {
  double top_km = HeightProfile::kBottomKm;
  for (const Sheet& sheet : scene.sheets) top_km = std::max(top_km, sheet.top_km);
  return top_km;
}

/// The most pixels that a kilometre at an altitude takes in the picture.
class NearestScale {
 public:
  explicit NearestScale(const Scene& scene)
      : sphere_km_(scene.body.radius_km), observer_km_(scene.site.altitude_m * 1e-3) {
    const CameraView<double> view = camera_view(scene.camera);
    const double across = 0.5 * scene.camera.width / view.lens.focal_px;
    const double down = 0.5 * scene.camera.height / view.lens.focal_px;
    slant_ = std::sqrt(1.0 + across * across + down * down);
    per_km_at_1_km_ = view.lens.focal_px * slant_ * std::sqrt(0.5 * (1.0 + slant_ * slant_));
    // The highest point of the picture is the zenith, if it shows, or lies on its border.
    const double* up[3] = {&view.camera_from_enu[0][2], &view.camera_from_enu[1][2],
                           &view.camera_from_enu[2][2]};
    const bool zenith_shows =
        *up[2] > 0.0 && std::abs(*up[0]) <= across * *up[2] && std::abs(*up[1]) <= down * *up[2];
    const auto look = [&](double x, double y) {
      highest_sine_ =
          std::max(highest_sine_, (x * *up[0] + y * *up[1] + *up[2]) / std::sqrt(1.0 + x * x + y * y));
    };
    constexpr int kPointsOnAnEdge = 64;
    for (int i = 0; i <= kPointsOnAnEdge; ++i) {
      const double share = 2.0 * i / kPointsOnAnEdge - 1.0;
      for (const double side : {-1.0, 1.0}) {
        look(share * across, side * down);
        look(side * across, share * down);
      }
    }
    if (zenith_shows) highest_sine_ = 1.0;
  }

  double px_per_km(double altitude_km) const {
    const double above = altitude_km - observer_km_, from_centre = sphere_km_ + observer_km_;
    const double b = from_centre * highest_sine_, c = above * (2.0 * from_centre + above);
    return per_km_at_1_km_ / (c / (b + std::sqrt(b * b + c)));
  }

 private:
  double sphere_km_ = kEarthRadiusKm, observer_km_ = 0.0, highest_sine_ = -1.0, slant_ = 1.0,
         per_km_at_1_km_ = 0.0;
};

/// Returns the largest of `km(a)` in pixels, over the altitudes up to top_km.
template <class Kilometres>
double largest_px(const Scene& scene, double top_km, const Kilometres& km) {
  const NearestScale scale(scene);
  double largest = 0.0;
  for (int a = 0; a < HeightProfile::kAltitudes; ++a) {
    const double altitude_km = HeightProfile::kBottomKm + a * HeightProfile::kStepKm;
    if (altitude_km > top_km) break;
    largest = std::max(largest, km(a) * scale.px_per_km(altitude_km));
  }
  return largest;
}

/// Returns the film that holds those of all levels and what the wind carries there.
FilmGeometry film_of_all(const std::vector<BlurLevel>& levels, double carried_px) {
  FilmGeometry all;
  double right = 0.0, bottom = 0.0;
  for (const BlurLevel& level : levels) {
    const FilmGeometry& film = level.film;
    all.x0_px = std::min(all.x0_px, film.x0_px);
    all.y0_px = std::min(all.y0_px, film.y0_px);
    right = std::max(right, film.x0_px + film.columns * film.cell_width_px);
    bottom = std::max(bottom, film.y0_px + film.rows * film.cell_height_px);
  }
  const double beyond = std::ceil(carried_px);
  all.x0_px -= beyond;
  all.y0_px -= beyond;
  all.columns = static_cast<int>(std::ceil(right + beyond - all.x0_px));
  all.rows = static_cast<int>(std::ceil(bottom + beyond - all.y0_px));
  return all;
}

/// One metastable line, whose atoms move before they emit: the films of all levels of blur that its light
/// falls on.
class SlowLine {
 public:
  SlowLine(const Scene& scene, const EmissionLine& line, const BeamLayout& layout, int threads)
      : line_scene_(with_lines(scene, {line.wavelength_nm})),
        layout_(layout),
        threads_(threads),
        spread_(spread_profile(line, 1e3 * wind_km_s(scene))),
        calm_(spread_profile(line, 0.0)),
        levels_(level_ladder(scene.camera.width, scene.camera.height,
                             widest_spread_px(scene, spread_, highest_km(scene)))),
        slots_(threads) {
    for (const BlurLevel& level : levels_) {
      films_.push_back(level.film);
      variances_px2_.push_back(static_cast<float>(level.variance_px2));
      first_cell_.push_back(first_cell_.back() + level.cells());
    }
    moved_.lifetime_s = spread_.lifetime_s.data();
    moved_.variance_km2 = spread_.variance_km2.data();
    moved_.wind_enu_km_s[0] = 1e-3 * scene.blur.wind_m_s.east;
    moved_.wind_enu_km_s[1] = 1e-3 * scene.blur.wind_m_s.north;
    moved_.count = static_cast<int>(levels_.size());
    moved_.films = films_.data();
    moved_.variance_px2 = variances_px2_.data();
    aged_ = moved_;
    aged_.variance_km2 = calm_.variance_km2.data();
    std::fill(aged_.wind_enu_km_s, aged_.wind_enu_km_s + 3, 0.0);
    make_kernels(scene);
  }
  SlowLine(const SlowLine&) = delete;
  SlowLine& operator=(const SlowLine&) = delete;

  /// Lets the beams of one sheet, or of all (-1), fall on the levels. Returns the deflection points.
  std::uint64_t fall(const std::function<void(double)>& progress, const std::atomic<bool>* stop,
                     int only_sheet) {
    std::atomic<std::uint64_t> points{0};
    std::atomic<std::size_t> done{0};
    parallel_for(layout_.chunks().size(), threads_, [&](std::size_t c, int s) {
      if (stop != nullptr && stop->load(std::memory_order_relaxed)) return;
      Slot& slot = slots_[s];
      if (slot.cells.empty()) {
        slot.cells.assign(first_cell_.back(), 0);
        for (std::size_t l = 0; l < levels_.size(); ++l)
          slot.films.push_back(slot.cells.data() + first_cell_[l]);
      }
      const Chunk& chunk = layout_.chunks()[c];
      if (only_sheet >= 0 && chunk.sheet != only_sheet) return;
      layout_.pack(line_scene_, chunk, kernels_[chunk.sheet], slot.packed);
      points += fall_on_levels(kernels_[chunk.sheet], layout_.ages().lags(chunk.sheet) ? aged_ : moved_,
                               slot.packed.groups.data(), slot.packed.groups.size(), slot.films.data());
      const std::size_t finished = ++done;
      if (progress) progress(static_cast<double>(finished) / static_cast<double>(layout_.chunks().size()));
    });
    return points;
  }

  /// Blurs the levels and adds them to a channel.
  void add_to(Image& rayleigh, int channel) const {
    const double rayleighs_per_unit = 1.0 / (kFilmUnitsPerRayleigh * layout_.instants());
    for (std::size_t l = 0; l < levels_.size(); ++l) {
      std::vector<float> cells(levels_[l].cells());
      std::atomic<bool> lit{false};
      parallel_for(static_cast<std::size_t>(levels_[l].film.rows), threads_, [&](std::size_t row, int) {
        const std::size_t first = row * levels_[l].film.columns;
        std::int64_t any = 0;
        for (std::size_t i = first; i < first + levels_[l].film.columns; ++i) {
          std::int64_t sum = 0;
          for (const Slot& slot : slots_)
            if (!slot.cells.empty()) sum += slot.films[l][i];
          any |= sum;
          cells[i] = static_cast<float>(static_cast<double>(sum) * rayleighs_per_unit);
        }
        if (any != 0) lit = true;
      });
      if (lit) add_level(levels_[l], cells, rayleigh, channel, threads_);
    }
  }

 private:
  /// What one thread adds up.
  struct Slot {
    std::vector<std::int64_t> cells;  ///< of all levels
    std::vector<std::int64_t*> films;
    PackedChunk packed;
  };

  void make_kernels(const Scene& scene) {
    const double carried_px = std::min(diagonal_px(scene), largest_px(scene, highest_km(scene), [&](int a) {
                                         return wind_km_s(scene) * spread_.lifetime_s[a];
                                       }));
    profiles_ = layout_.profiles(line_scene_);
    const FilmGeometry seen = film_of_all(levels_, carried_px);
    for (std::size_t s = 0; s < line_scene_.sheets.size(); ++s)
      kernels_.push_back(kernel_scene(line_scene_, line_scene_.sheets[s],
                                      layout_.path_step(static_cast<int>(s)), seen, profiles_));
  }

  Scene line_scene_;
  const BeamLayout& layout_;
  int threads_;
  SpreadProfile spread_, calm_;  ///< with the wind, and without
  std::vector<BlurLevel> levels_;
  std::vector<FilmGeometry> films_;
  std::vector<float> variances_px2_;
  std::vector<std::size_t> first_cell_ = {0};  ///< of each level, in Slot::cells
  KernelLevels moved_;
  KernelLevels aged_;  ///< of light that has ages: the wind has carried it for as long, beam by beam
  std::vector<HeightProfile> profiles_;
  std::vector<KernelScene> kernels_;  ///< which point to the profiles
  std::vector<Slot> slots_;
};

/// Adds one metastable line to one channel.
std::uint64_t add_slow_line(const Scene& scene, const EmissionLine& line, const BeamLayout& layout,
                            int threads, const std::function<void(double)>& progress,
                            const std::atomic<bool>* stop, Image& rayleigh, int channel, int only_sheet) {
  SlowLine slow(scene, line, layout, threads);
  const std::uint64_t points = slow.fall(progress, stop, only_sheet);
  if (stop == nullptr || !stop->load()) slow.add_to(rayleigh, channel);
  return points;
}

/// Adds the prompt lines at once, without any blur.
std::uint64_t add_prompt_lines(const Scene& scene, const std::vector<int>& channels, int threads,
                               const std::function<void(double)>& progress, const std::atomic<bool>* stop,
                               Image& rayleigh, int only_sheet) {
  std::vector<double> lines_nm;
  for (const int channel : channels) lines_nm.push_back(scene.emission.lines[channel]);
  const Scene prompt = with_lines(scene, lines_nm);
  const FilmGeometry film = film_for(prompt, 0, 0, rayleigh.width, rayleigh.height, 1.0, 1.0);
  Exposure exposure;
  BeamExposer(prompt, film, threads).expose(prompt, exposure, progress, stop, only_sheet);
  const int left = static_cast<int>(-film.x0_px), top = static_cast<int>(-film.y0_px);
  for (std::size_t l = 0; l < channels.size(); ++l) {
    const float* plane = exposure.rayleigh.data() + l * exposure.cells();
    for (int y = 0; y < rayleigh.height; ++y)
      for (int x = 0; x < rayleigh.width; ++x)
        rayleigh.at(x, y, channels[l]) += plane[static_cast<std::size_t>(y + top) * film.columns + x + left];
  }
  return exposure.deflection_points;
}

}  // namespace

bool is_spread_by_beams(const Scene& scene) {
  const Camera& c = scene.camera;
  return c.model == LensModel::pinhole && c.k1 == 0.0 && c.k2 == 0.0 && c.k3 == 0.0 && c.p1 == 0.0 &&
         c.p2 == 0.0 && c.aspect == 1.0 && !c.mirrored && c.principal_x_px == 0.0 &&
         c.principal_y_px == 0.0 && scene.footprints.empty();
}

double widest_spread_px(const Scene& scene, const SpreadProfile& spread, double top_km) {
  const double widest = largest_px(
      scene, top_km, [&](int a) { return std::sqrt(static_cast<double>(spread.variance_km2[a])); });
  return std::min(0.5 * diagonal_px(scene), widest);
}

std::uint64_t add_lines_physically(const Scene& scene, int threads,
                                   const std::function<void(double)>& progress, const std::atomic<bool>* stop,
                                   Image& rayleigh, int only_sheet) {
  const int used_threads = thread_count(threads);
  std::vector<int> slow, prompt;
  for (int l = 0; l < rayleigh.channels(); ++l)
    (is_prompt(find_line(scene, scene.emission.lines[l]).value()) ? prompt : slow).push_back(l);
  const std::size_t passes = slow.size() + (prompt.empty() ? 0 : 1);
  std::size_t pass = 0;
  std::function<void(double)> share;
  if (progress)
    share = [&](double pass_share) {
      progress((static_cast<double>(pass) + pass_share) / static_cast<double>(passes));
    };
  std::uint64_t points = 0;
  const BeamLayout layout(scene, 0.0);
  for (const int l : slow) {
    const EmissionLine line = find_line(scene, scene.emission.lines[l]).value();
    points = std::max(points,
                      add_slow_line(scene, line, layout, used_threads, share, stop, rayleigh, l, only_sheet));
    ++pass;
  }
  if (!prompt.empty())
    points = std::max(points, add_prompt_lines(scene, prompt, threads, share, stop, rayleigh, only_sheet));
  return points;
}

}  // namespace vegard::sim
