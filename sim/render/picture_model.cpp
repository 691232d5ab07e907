#include "sim/render/picture_model.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "sim/base/parallel.h"
#include "sim/render/film.h"
#include "sim/render/picture.h"
#include "sim/render/profile_light.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/view/colour/line_colours.h"
#include "sim/view/film/blur.h"
#include "sim/view/sky/night_sky.h"

namespace vegard::sim {
namespace picture_model {

constexpr std::size_t kMeansPerTask = 64;

/// The means of a film's cells that are wanted.
struct CellMeans {
  int threads = 1;
  FilmGeometry film;
  CellWeights weights;

  /// Calls body(mean) for every mean, on all threads.
  template <class Body>
  void for_every_mean(const Body& body) const {
    parallel_for((weights.means() + kMeansPerTask - 1) / kMeansPerTask, threads, [&](std::size_t task, int) {
      const std::size_t first = task * kMeansPerTask;
      for (std::size_t mean = first; mean < std::min(weights.means(), first + kMeansPerTask); ++mean)
        body(mean);
    });
  }

  /// Calls body(run, index) for every run of a mean; index: of the run's first cell on the film.
  template <class Body>
  void for_every_run(std::size_t mean, const Body& body) const {
    for (std::size_t r = weights.first_run[mean]; r < weights.first_run[mean + 1]; ++r) {
      const CellWeights::Run& run = weights.runs[r];
      body(run, static_cast<std::size_t>(run.row) * film.columns + run.first_column);
    }
  }
};

}  // namespace picture_model

namespace {

using picture_model::CellMeans;

constexpr std::size_t kFilmRowsPerTask = 16;

/// The means of the night sky's lights, which no line makes.
class NightSkyMeans {
 public:
  NightSkyMeans(const CellMeans& means, bool keeps_negative_light)
      : means_(means), keeps_negative_light_(keeps_negative_light) {}

  /// Fills the offsets of the values.
  void put_offset(const Scene& scene, PictureMeans& out) const {
    out.offset.clear();
    out.offset_derivative.clear();
    if (!has_night_sky(scene)) return;
    out.offset.resize(out.value.size());
    for_every_value<double>(scene, [&](std::size_t i, double mean) { out.offset[i] = mean; });
  }

  /// Fills the offsets and their derivatives by `free`. A free brightness counts even where it is 0.
  void put_offset(const Scene& scene, const std::vector<ParameterId>& free, PictureMeans& out) const {
    const std::vector<int> which = sky_numbers_of(scene, free);
    out.offset.clear();
    out.offset_derivative.clear();
    const bool any_free =
        std::any_of(which.begin(), which.end(), [](int k) { return k >= sky_green && k < first_sky_camera; });
    if (!has_night_sky(scene) && !any_free) return;
    out.offset.resize(out.value.size());
    out.offset_derivative.assign(out.value.size() * free.size(), 0.0);
    for_every_value<SkyDual>(scene, [&](std::size_t i, const SkyDual& mean) {
      out.offset[i] = mean.v;
      for (std::size_t j = 0; j < which.size(); ++j)
        if (which[j] >= 0) out.offset_derivative[i * free.size() + j] = mean.d.t[which[j]];
    });
  }

 private:
  /// Calls body(value index, mean) with the night sky of each value. T is double or SkyDual.
  template <class T, class Body>
  void for_every_value(const Scene& scene, const Body& body) const {
    const NightSkyOnFilm<T> sky(scene, means_.film);
    means_.for_every_mean([&](std::size_t mean) {
      std::array<T, 3> sum = {T(0.0), T(0.0), T(0.0)};
      means_.for_every_run(mean, [&](const CellWeights::Run& run, std::size_t) {
        for (int i = 0; i < run.columns; ++i) {
          const float* pixels = &means_.weights.pixels[run.first_pixels + static_cast<std::size_t>(i) * 3];
          if (pixels[0] + pixels[1] + pixels[2] == 0.0f) continue;
          const std::array<T, 3> light = sky.light(run.first_column + i, run.row);
          for (int c = 0; c < 3; ++c)
            if (keeps_negative_light_ || is_shown(value_of(light[c])))
              sum[c] = sum[c] + light[c] * static_cast<double>(pixels[c]);
        }
      });
      for (int c = 0; c < 3; ++c)
        body(mean * 3 + c, sum[c] * static_cast<double>(means_.weights.inverse[mean * 3 + c]));
    });
  }

  const CellMeans& means_;
  bool keeps_negative_light_;
};

/// Returns by how much the width of a line's blur grows with a parameter: its own width, free, or the field
/// of view that it follows, sigma = width * pixels / hfov.
double blur_growth_px(const Scene& scene, const ParameterId& id, int line) {
  double growth = 0.0;
  if (id.role() == ParameterRole::blur_width && index_in(scene, id) == line)
    growth = scene.blur.widths == BlurWidths::given ? pixels_per_degree(scene.camera) : 0.0;
  if (camera_number_of(scene.camera, id) == scale_number) growth = blur_sigma_growth_px(scene, line);
  return growth;
}

}  // namespace

struct PictureModel::Workspace {
  CellMeans means;
  bool keeps_negative_light = false;
  std::vector<std::vector<std::size_t>> runs_of_row;  // of the weights, by film row
  std::unique_ptr<Exposer> exposer;
  Exposure exposure;
  Image rayleigh, rgb;               // of all cells, of the last evaluation
  std::vector<float> down, blurred;  // planes
  std::vector<std::uint8_t> lit;     // [row][column][channel]: not clipped
  // What the derivatives of the cells count for: as weights.pixels, but 0 where the light is clipped, [cell
  // of a run] within [channel] within the run.
  std::vector<float> shown;
  std::vector<double> slopes;   // [run][channel][stride]
  std::vector<Vector3> colour;  // RGB per rayleigh at unit gain, of the last evaluation

  std::unique_ptr<ProfileLight> profile_light;

  /// Colours the lines' light; fills `rgb`, `lit` and the values.
  void finish_values(const Scene& scene, PictureMeans& out) {
    const std::vector<Vector3> per_kilorayleigh = line_colours_at_unit_gain(scene);
    colour = per_kilorayleigh;
    for (Vector3& line : colour)
      for (double& channel : line) channel *= 1e-3;
    lit.resize(exposure.cells() * 3);
    if (rgb.empty()) rgb = Image(means.film.columns, means.film.rows, {"R", "G", "B"});
    const std::size_t columns = static_cast<std::size_t>(means.film.columns);
    parallel_for(static_cast<std::size_t>(means.film.rows), means.threads, [&](std::size_t row, int) {
      float* light = rgb.data.data() + row * columns * 3;
      colour_cells(rayleigh.data.data() + row * columns * exposure.lines, columns, per_kilorayleigh, light);
      for (std::size_t i = 0; i < columns * 3; ++i) {
        const bool shows = keeps_negative_light || is_shown(light[i]);
        lit[row * columns * 3 + i] = shows;
        if (!shows) light[i] = 0.0f;
      }
    });
    out.value.resize(means.weights.means() * 3);
    means.for_every_mean([&](std::size_t mean) {
      double sum[3] = {0.0, 0.0, 0.0};
      means.for_every_run(mean, [&](const CellWeights::Run& run, std::size_t first) {
        const float *pixels = &means.weights.pixels[run.first_pixels], *light = &rgb.data[first * 3];
        for (int i = 0; i < run.columns; ++i)
          for (int c = 0; c < 3; ++c) sum[c] += static_cast<double>(pixels[i * 3 + c]) * light[i * 3 + c];
      });
      for (int c = 0; c < 3; ++c) out.value[mean * 3 + c] = sum[c] * means.weights.inverse[mean * 3 + c];
    });
  }

  /// Fills `shown`, after finish_values().
  void find_shown() {
    shown.resize(means.weights.pixels.size());
    means.for_every_mean([&](std::size_t mean) {
      means.for_every_run(mean, [&](const CellWeights::Run& run, std::size_t first) {
        const float* pixels = &means.weights.pixels[run.first_pixels];
        for (int c = 0; c < 3; ++c)
          for (int i = 0; i < run.columns; ++i)
            shown[run.first_pixels + static_cast<std::size_t>(c) * run.columns + i] =
                lit[(first + i) * 3 + c] ? pixels[i * 3 + c] : 0.0f;
      });
    });
  }

  /// Adds the means of a plane of derivatives that is blurred already, [row][column], of line `l`, to those
  /// of a parameter.
  void add_plane(const float* plane, int parameter, int l, PictureMeans& out) const {
    means.for_every_mean([&](std::size_t mean) {
      float sum[3] = {};
      means.for_every_run(mean, [&](const CellWeights::Run& run, std::size_t first) {
        for (int c = 0; c < 3; ++c) {
          const float* weight = &shown[run.first_pixels + static_cast<std::size_t>(c) * run.columns];
          for (int i = 0; i < run.columns; ++i) sum[c] += weight[i] * plane[first + i];
        }
      });
      for (int c = 0; c < 3; ++c)
        out.derivative[(mean * 3 + c) * out.free + parameter] +=
            colour[l][c] * means.weights.inverse[mean * 3 + c] * sum[c];
    });
  }

  /// Adds the sums over a row's runs of derivatives of line `l` to `slopes`. `wide` is blurred down only:
  /// `spread` blurs across.
  void add_row(std::size_t row, int l, const std::vector<float>& wide, SpreadRuns& spread) {
    const auto stride = static_cast<std::size_t>(exposure.free_stride);
    for (std::size_t i = 0; i < runs_of_row[row].size(); ++i) {
      const std::size_t index = runs_of_row[row][i];
      const CellWeights::Run& run = means.weights.runs[index];
      const float* channel = &shown[run.first_pixels];
      const float *before = nullptr, *sum = nullptr;
      for (int c = 0; c < 3; ++c, channel += run.columns) {
        // Two channels often show the same cells.
        if (before == nullptr || !std::equal(channel, channel + run.columns, before))
          sum = spread.sum(i * 3 + c, run, channel, wide.data(), stride);
        before = channel;
        if (sum == nullptr) continue;
        double* to = slopes.data() + (index * 3 + c) * stride;
        for (std::size_t j = 0; j < stride; ++j) to[j] += colour[l][c] * sum[j];
      }
    }
  }

  /// Blurs the exposure's derivatives and adds their means to those of `parameters`. The blur along a row
  /// and the sum over a run's cells are one sum with other weights, and there are fewer runs than cells.
  void add_exposed(const Scene& scene, const std::vector<int>& parameters, PictureMeans& out) {
    const auto stride = static_cast<std::size_t>(exposure.free_stride);
    std::vector<PlaneBlur> blurs;
    for (int l = 0; l < exposure.lines; ++l) blurs.push_back(line_blur(scene, means.film, l));
    slopes.assign(means.weights.runs.size() * 3 * stride, 0.0);
    const std::size_t tasks =
        (static_cast<std::size_t>(means.film.rows) + kFilmRowsPerTask - 1) / kFilmRowsPerTask;
    parallel_for(tasks, means.threads, [&](std::size_t task, int) {
      std::vector<float> wide(means.film.columns * stride);
      for (int l = 0; l < exposure.lines; ++l) {
        SpreadRuns spread(blurs[l].across, means.film.columns);
        const std::size_t end = std::min<std::size_t>(means.film.rows, (task + 1) * kFilmRowsPerTask);
        for (std::size_t row = task * kFilmRowsPerTask; row < end; ++row) {
          if (runs_of_row[row].empty()) continue;
          blur_down_row(exposure.derivative.data() + l * exposure.cells() * stride, wide.data(),
                        means.film.rows, means.film.columns, static_cast<int>(stride), blurs[l].down,
                        static_cast<int>(row));
          add_row(row, l, wide, spread);
        }
      }
    });
    means.for_every_mean([&](std::size_t mean) {
      for (std::size_t r = means.weights.first_run[mean]; r < means.weights.first_run[mean + 1]; ++r) {
        for (int c = 0; c < 3; ++c) {
          const double* from = slopes.data() + (r * 3 + c) * stride;
          double* to = out.derivative.data() + (mean * 3 + c) * out.free;
          for (std::size_t j = 0; j < parameters.size(); ++j)
            to[parameters[j]] += means.weights.inverse[mean * 3 + c] * from[j];
        }
      }
    });
  }

  /// Adds the derivatives by the blur's own widths.
  void add_blur_widths(const Scene& scene, const std::vector<ParameterId>& free, PictureMeans& out) {
    const std::size_t cells = exposure.cells();
    down.resize(cells);
    blurred.resize(cells);
    for (int l = 0; l < exposure.lines; ++l) {
      const double sigma = blur_sigma_px(scene, l);
      if (sigma <= 0.0) continue;
      const PlaneBlur blur = line_blur(scene, means.film, l), slope = line_blur_slope(scene, means.film, l);
      for (std::size_t j = 0; j < free.size(); ++j) {
        const double growth = blur_growth_px(scene, free[j], l);
        if (growth == 0.0) continue;
        const float* plane = exposure.rayleigh.data() + l * cells;
        const auto add = [&](const BlurKernel& first, const BlurKernel& second, double per_cell) {
          blur_down(plane, down.data(), means.film.rows, means.film.columns, 1, first, means.threads);
          blur_across(down.data(), blurred.data(), means.film.rows, means.film.columns, 1, second,
                      means.threads);
          for (float& x : blurred) x *= static_cast<float>(growth * per_cell);
          add_plane(blurred.data(), static_cast<int>(j), l, out);
        };
        add(slope.down, blur.across, 1.0 / means.film.cell_height_px);
        if (means.film.ramp_px == 0.0) add(blur.down, slope.across, 1.0 / means.film.cell_width_px);
      }
    }
  }
};

PictureModel::PictureModel(const Scene& scene, const FilmGeometry& film, CellWeights weights,
                           const PictureModelOptions& options)
    : work_(std::make_unique<Workspace>()) {
  Workspace& w = *work_;
  w.means.threads = thread_count(options.threads);
  w.exposure.one_ray = true;  // with and without derivatives
  w.keeps_negative_light = options.keeps_negative_light;
  w.means.film = film;
  w.means.weights = std::move(weights);
  w.runs_of_row.resize(film.rows);
  for (std::size_t r = 0; r < w.means.weights.runs.size(); ++r)
    w.runs_of_row[w.means.weights.runs[r].row].push_back(r);
  w.exposer = make_exposer(scene, film, options.threads, options.beyond, options.sampling);
  w.profile_light = std::make_unique<ProfileLight>(scene, film, w.means.threads, *w.exposer);
}

PictureModel::~PictureModel() = default;

const Image& PictureModel::rayleigh() const { return work_->rayleigh; }

const Image& PictureModel::rgb() const { return work_->rgb; }

std::uint64_t PictureModel::deflection_points() const { return work_->exposure.deflection_points; }

void PictureModel::evaluate(const Scene& scene, PictureMeans& out) {
  Workspace& w = *work_;
  w.exposer->expose(scene, w.exposure);
  form_lines(scene, w.exposure, all_of(w.means.film), w.means.threads, w.rayleigh);
  out.free = 0;
  out.derivative.clear();
  w.finish_values(scene, out);
  NightSkyMeans(w.means, w.keeps_negative_light).put_offset(scene, out);
}

void PictureModel::evaluate_with_derivatives(const Scene& scene, const std::vector<ParameterId>& free,
                                             PictureMeans& out) {
  Workspace& w = *work_;
  const ProfileShapers shapers = profile_shapers(scene, free, *w.exposer);
  std::vector<ParameterId> kernel_free;
  std::vector<int> kernel_parameters;
  for (std::size_t j = 0; j < free.size(); ++j)
    if (!shapers.alone[j]) {
      kernel_free.push_back(free[j]);
      kernel_parameters.push_back(static_cast<int>(j));
    }
  if (kernel_free.empty()) {
    w.exposer->expose(scene, w.exposure);
    form_lines(scene, w.exposure, all_of(w.means.film), w.means.threads, w.rayleigh);
  } else {
    w.exposer->expose_with_derivatives(scene, kernel_free, w.exposure);
    form_lines(scene, kernel_free, w.exposure, all_of(w.means.film), w.means.threads, w.rayleigh);
  }
  w.finish_values(scene, out);
  w.find_shown();
  out.free = static_cast<int>(free.size());
  out.derivative.assign(out.value.size() * free.size(), 0.0);
  NightSkyMeans(w.means, w.keeps_negative_light).put_offset(scene, free, out);
  if (!kernel_free.empty()) w.add_exposed(scene, kernel_parameters, out);
  w.add_blur_widths(scene, free, out);
  w.profile_light->expose(scene, shapers);
  for (std::size_t s = 0; s < shapers.sheets.size(); ++s)
    for (const Shaper& shaper : shapers.sheets[s].shapers)
      w.add_plane(w.profile_light->plane(s, shaper), shaper.parameter, shaper.line, out);
}

}  // namespace vegard::sim
