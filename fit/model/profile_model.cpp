#include "fit/model/profile_model.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "fit/measure/profile_bins.h"
#include "fit/measure/smoothing.h"
#include "fit/model/bin_weights.h"
#include "fit/model/spread_runs.h"
#include "sim/base/large_vector.h"
#include "sim/base/parallel.h"
#include "sim/emit/aurora/sheet.h"
#include "sim/light/sheet_profile.h"
#include "sim/render/air_on_film.h"
#include "sim/render/film.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/table/counterpart.h"
#include "sim/view/colour/line_colours.h"
#include "sim/view/film/blur.h"
#include "sim/view/sky/night_sky.h"

namespace vegard::fit {
namespace {

constexpr int kWidestCell = 4;
constexpr int kCellsPerBand = 12;
constexpr int kCellsPerNarrowBin = 4;
constexpr std::size_t kBinsPerTask = 64, kRowsPerTask = 16;
constexpr double kBeyond = 0.5;  // sheet lengths by which a fit may move an end

/// The first grid's bins are wide, as those of bands are; others may be narrow.
int cell_width(const std::vector<std::shared_ptr<const BinGrid>>& grids) {
  const BinGrid& first = *grids.front();
  int cell = std::clamp(first.narrowest_px / kCellsPerBand, 1, kWidestCell);
  for (std::size_t g = 1; g < grids.size(); ++g)
    cell = std::min(cell, std::max(1, grids[g]->narrowest_px / kCellsPerNarrowBin));
  return cell;
}

double value_of(double number) { return number; }
double value_of(const sim::SkyDual& number) { return number.v; }

/// The light of a line grows with a parameter as that of a height profile, a row of SheetShapers::rates.
struct Shaper {
  int parameter = 0, line = 0;
  std::size_t rate = 0;
};
struct SheetShapers {
  std::vector<std::vector<float>> rates;  // each once: lines share their splines' basis
  std::vector<Shaper> shapers;
};
struct ProfileShapers {
  std::vector<SheetShapers> of_sheet;
  std::vector<bool> alone;  // by parameter: it does nothing but shape a profile
};

/// What the free numbers do to the height profiles. The energy flux scales the light too, which the kernel
/// has.
ProfileShapers profile_shapers(const sim::Scene& scene, const std::vector<const double*>& free) {
  ProfileShapers result;
  result.of_sheet.resize(scene.sheets.size());
  result.alone.assign(free.size(), false);
  for (std::size_t s = 0; s < scene.sheets.size(); ++s) {
    SheetShapers& of_sheet = result.of_sheet[s];
    for (std::size_t j = 0; j < free.size(); ++j) {
      const std::vector<float> slope =
          sim::profile_slope(scene.emission.lines, scene, static_cast<int>(s), free[j]);
      if (slope.empty()) continue;
      result.alone[j] = free[j] != &scene.sheets[s].energy_flux_mw_m2;
      const std::size_t stride = slope.size() / sim::HeightProfile::kAltitudes;
      for (std::size_t l = 0; l < scene.emission.lines.size(); ++l) {
        std::vector<float> rate(sim::HeightProfile::kAltitudes);
        for (std::size_t a = 0; a < rate.size(); ++a) rate[a] = slope[a * stride + l];
        if (std::all_of(rate.begin(), rate.end(), [](float x) { return x == 0.0f; })) continue;
        const auto found = std::find(of_sheet.rates.begin(), of_sheet.rates.end(), rate);
        of_sheet.shapers.push_back({static_cast<int>(j), static_cast<int>(l),
                                    static_cast<std::size_t>(found - of_sheet.rates.begin())});
        if (found == of_sheet.rates.end()) of_sheet.rates.push_back(std::move(rate));
      }
    }
  }
  return result;
}

}  // namespace

struct ProfileModel::Workspace {
  std::vector<std::shared_ptr<const BinGrid>> grids;
  int threads = 1;
  bool clips = true;  // the photograph has no negative light
  double smooth_rows = 0.0;
  sim::FilmGeometry film;
  BinWeights weights;
  std::vector<std::vector<std::size_t>> runs_of_row;  // of the weights, by film row
  std::vector<int> full_beams, used_beams;
  std::unique_ptr<sim::Exposer> exposer;
  sim::Exposure exposure;
  std::vector<float> down, blurred, lines;  // planes
  std::vector<std::uint8_t> lit;            // [row][column][channel]: not clipped
  std::vector<float> rgb;                   // likewise: light at unit gain, clipped
  // As weights.pixels, 0 where the light is clipped, [cell of a run] within [channel] within the run: what
  // the derivatives of the cells count for.
  std::vector<float> shown;
  std::vector<double> slopes;        // [run][channel][stride]
  std::vector<sim::Vector3> colour;  // RGB per rayleigh at unit gain, of the last evaluation
  sim::Scene scene;                  // with this model's number of beams

  // Blurred light of the profiles' slopes, by sheet: [line][rate][row][column]. Coefficients of splines do
  // not change it, so it stays as long as nothing else in the scene changes.
  std::vector<sim::LargeVector<float>> shaped;
  std::vector<SheetShapers> shaped_by;
  std::string shaped_in;
  // The coefficients that the model was made with. The scale on which the slopes' light is rounded goes by
  // these, not by those at which it happens to be asked for first: it is to be the same after a resumption.
  std::vector<std::vector<double>> first_rates;

  void shape(const ProfileShapers& shapers) {
    sim::Scene rest = scene;
    for (std::size_t s = 0; s < rest.sheets.size(); ++s) rest.sheets[s].spline_rate = first_rates[s];
    std::string words = sim::write_scene(rest);
    const auto same = [](const SheetShapers& a, const SheetShapers& b) { return a.rates == b.rates; };
    if (words == shaped_in && std::equal(shaped_by.begin(), shaped_by.end(), shapers.of_sheet.begin(),
                                         shapers.of_sheet.end(), same))
      return;
    shaped_in = std::move(words);
    shaped_by = shapers.of_sheet;
    shaped.resize(scene.sheets.size());
    const std::vector<float> kept = sim::transmission_on_film(scene, film, threads);
    sim::Exposure light;
    std::vector<float> dimmed;
    for (std::size_t s = 0; s < shaped.size(); ++s) {
      const auto& rates = shapers.of_sheet[s].rates;
      if (rates.empty()) continue;
      exposer->expose_profiles(rest, static_cast<int>(s), rates, light);
      const std::size_t cells = light.cells(), lines_count = scene.emission.lines.size();
      shaped[s].resize(cells * lines_count * rates.size());
      down.resize(cells);
      for (std::size_t l = 0; l < lines_count; ++l) {
        const sim::BlurKernel by_rows = kernel(static_cast<int>(l), film.cell_height_px);
        const sim::BlurKernel by_columns = kernel(static_cast<int>(l), film.cell_width_px);
        for (std::size_t i = 0; i < rates.size(); ++i) {
          const float* plane = light.rayleigh.data() + i * cells;
          if (!kept.empty()) {
            dimmed.assign(plane, plane + cells);
            for (std::size_t cell = 0; cell < cells; ++cell) dimmed[cell] *= kept[l * cells + cell];
            plane = dimmed.data();
          }
          sim::blur_down(plane, down.data(), film.rows, film.columns, 1, by_rows, threads);
          sim::blur_across(down.data(), shaped[s].data() + (l * rates.size() + i) * cells, film.rows,
                           film.columns, 1, by_columns, threads);
        }
      }
    }
  }

  /// Calls body(bin) for every bin, on all threads.
  template <class Body>
  void for_every_bin(const Body& body) const {
    sim::parallel_for(
        (weights.bins() + kBinsPerTask - 1) / kBinsPerTask, threads, [&](std::size_t task, int) {
          const std::size_t first = task * kBinsPerTask;
          for (std::size_t bin = first; bin < std::min(weights.bins(), first + kBinsPerTask); ++bin)
            body(bin);
        });
  }

  /// Calls body(run, index) for every run of a bin; index: of the run's first cell on the film.
  template <class Body>
  void for_every_run(std::size_t bin, const Body& body) const {
    for (std::size_t r = weights.first_run[bin]; r < weights.first_run[bin + 1]; ++r) {
      const BinWeights::Run& run = weights.runs[r];
      body(run, static_cast<std::size_t>(run.row) * film.columns + run.first_column);
    }
  }

  /// Copies the numbers of `from`; the addresses in `free` follow to the copy.
  std::vector<const double*> adopt(const sim::Scene& from, const std::vector<const double*>& free) {
    for (std::size_t s = 0; s < from.sheets.size(); ++s) used_beams[s] = scene.sheets[s].beams;
    scene = from;
    scene.march.shrink = 1;  // light and derivatives are to be of one march
    for (std::size_t s = 0; s < from.sheets.size(); ++s) {
      scene.sheets[s].beams = used_beams[s];
      scene.sheets[s].beams_per_km = 0.0;
    }
    return sim::counterparts(from, free, scene);
  }

  /// The kernel of a line, or its derivative, in cells of so many pixels.
  sim::BlurKernel kernel(int line, double cell_px, bool derivative = false) const {
    const int radius_px = sim::blur_radius_px(scene, line);
    const int radius = radius_px < 0 ? -1 : static_cast<int>(std::lround(radius_px / cell_px));
    const double sigma = sim::blur_sigma_px(scene, line) / cell_px;
    return derivative ? sim::gaussian_kernel_derivative(sigma, radius) : sim::gaussian_kernel(sigma, radius);
  }

  /// Blurs and colours the exposure; fills `lines`, `lit` and the values.
  void finish_values(ModelProfile& out) {
    const std::size_t cells = exposure.cells();
    const int count = exposure.lines;
    lines.resize(cells * count);
    down.resize(cells);
    for (int l = 0; l < count; ++l) {
      sim::blur_down(exposure.rayleigh.data() + l * cells, down.data(), film.rows, film.columns, 1,
                     kernel(l, film.cell_height_px), threads);
      sim::blur_across(down.data(), lines.data() + l * cells, film.rows, film.columns, 1,
                       kernel(l, film.cell_width_px), threads);
    }
    colour = colours();
    lit.resize(cells * 3);
    rgb.resize(cells * 3);
    sim::parallel_for(static_cast<std::size_t>(film.rows), threads, [&](std::size_t row, int) {
      for (std::size_t cell = row * film.columns; cell < (row + 1) * film.columns; ++cell) {
        for (int c = 0; c < 3; ++c) {
          double light = 0.0;
          for (int l = 0; l < count; ++l) light += colour[l][c] * lines[l * cells + cell];
          const bool shows = !clips || light > 0.0;
          lit[cell * 3 + c] = shows;
          rgb[cell * 3 + c] = shows ? static_cast<float>(light) : 0.0f;
        }
      }
    });
    out.value.resize(weights.bins() * 3);
    for_every_bin([&](std::size_t bin) {
      double sum[3] = {0.0, 0.0, 0.0};
      for_every_run(bin, [&](const BinWeights::Run& run, std::size_t first) {
        const float *pixels = &weights.pixels[run.first_pixels], *light = &rgb[first * 3];
        for (int i = 0; i < run.columns; ++i)
          for (int c = 0; c < 3; ++c) sum[c] += static_cast<double>(pixels[i * 3 + c]) * light[i * 3 + c];
      });
      for (int c = 0; c < 3; ++c) out.value[bin * 3 + c] = sum[c] * weights.inverse[bin * 3 + c];
    });
  }

  /// After finish_values().
  void find_shown() {
    shown.resize(weights.pixels.size());
    for_every_bin([&](std::size_t bin) {
      for_every_run(bin, [&](const BinWeights::Run& run, std::size_t first) {
        const float* pixels = &weights.pixels[run.first_pixels];
        for (int c = 0; c < 3; ++c)
          for (int i = 0; i < run.columns; ++i)
            shown[run.first_pixels + static_cast<std::size_t>(c) * run.columns + i] =
                lit[(first + i) * 3 + c] ? pixels[i * 3 + c] : 0.0f;
      });
    });
  }

  /// Calls body(value index, mean) with the bins' means of the night sky. T is double or SkyDual.
  template <class T, class Body>
  void night_sky(const Body& body) const {
    const sim::SkyView<T> view(scene);
    const sim::NightSky<T> sky(scene);
    for_every_bin([&](std::size_t bin) {
      std::array<T, 3> sum = {T(0.0), T(0.0), T(0.0)};
      for_every_run(bin, [&](const BinWeights::Run& run, std::size_t) {
        const double y = film.y0_px + (run.row + 0.5) * film.cell_height_px;
        for (int i = 0; i < run.columns; ++i) {
          const float* pixels = &weights.pixels[run.first_pixels + static_cast<std::size_t>(i) * 3];
          if (pixels[0] + pixels[1] + pixels[2] == 0.0f) continue;
          const double x = film.x0_px + (run.first_column + i + 0.5) * film.cell_width_px;
          if (!view.sees(x, y)) continue;
          const std::array<T, 3> light = sky.light(view.at(x, y));
          for (int c = 0; c < 3; ++c)
            if (!clips || value_of(light[c]) > 0.0)  // as the aurora
              sum[c] = sum[c] + light[c] * static_cast<double>(pixels[c]);
        }
      });
      for (int c = 0; c < 3; ++c)
        body(bin * 3 + c, sum[c] * static_cast<double>(weights.inverse[bin * 3 + c]));
    });
  }

  /// The night sky's lights alone.
  void add_offset(ModelProfile& out) const {
    out.offset.clear();
    out.offset_derivative.clear();
    if (!sim::has_night_sky(scene)) return;
    out.offset.resize(out.value.size());
    night_sky<double>([&](std::size_t i, double mean) { out.offset[i] = mean; });
  }

  /// The same with their derivatives by `free`. A free brightness counts even where it is 0.
  void add_offset(const std::vector<const double*>& free, ModelProfile& out) const {
    const std::vector<int> which = sim::sky_numbers_of(scene, free);
    out.offset.clear();
    out.offset_derivative.clear();
    const bool any_free = std::any_of(which.begin(), which.end(),
                                      [](int k) { return k >= sim::sky_green && k < sim::first_sky_camera; });
    if (!sim::has_night_sky(scene) && !any_free) return;
    out.offset.resize(out.value.size());
    out.offset_derivative.assign(out.value.size() * free.size(), 0.0);
    night_sky<sim::SkyDual>([&](std::size_t i, const sim::SkyDual& mean) {
      out.offset[i] = mean.v;
      for (std::size_t j = 0; j < which.size(); ++j)
        if (which[j] >= 0) out.offset_derivative[i * free.size() + j] = mean.d.t[which[j]];
    });
  }

  /// RGB per rayleigh at unit gain.
  std::vector<sim::Vector3> colours() const {
    std::vector<sim::Vector3> weights_per_kilorayleigh = sim::line_colours_at_unit_gain(scene);
    for (sim::Vector3& of_line : weights_per_kilorayleigh)
      for (double& channel : of_line) channel *= 1e-3;
    return weights_per_kilorayleigh;
  }

  /// Adds the profile of a plane of derivatives that is blurred already, [row][column], of line `l`, to that
  /// of a parameter.
  void add_plane(const float* plane, int parameter, int l, ModelProfile& out) const {
    for_every_bin([&](std::size_t bin) {
      float sum[3] = {};
      for_every_run(bin, [&](const BinWeights::Run& run, std::size_t first) {
        for (int c = 0; c < 3; ++c) {
          const float* weight = &shown[run.first_pixels + static_cast<std::size_t>(c) * run.columns];
          for (int i = 0; i < run.columns; ++i) sum[c] += weight[i] * plane[first + i];
        }
      });
      for (int c = 0; c < 3; ++c)
        out.derivative[(bin * 3 + c) * out.free + parameter] +=
            colour[l][c] * weights.inverse[bin * 3 + c] * sum[c];
    });
  }

  /// Blurs the exposure's derivatives and adds their profiles to those of `parameters`. The blur along a row
  /// and the sum over a run's cells are one sum with other weights, and there are fewer runs than cells.
  void add_exposed(const std::vector<int>& parameters, ModelProfile& out) {
    const std::size_t cells = exposure.cells(), stride = static_cast<std::size_t>(exposure.free_stride);
    std::vector<sim::BlurKernel> by_rows, by_columns;
    for (int l = 0; l < exposure.lines; ++l) {
      by_rows.push_back(kernel(l, film.cell_height_px));
      by_columns.push_back(kernel(l, film.cell_width_px));
    }
    slopes.assign(weights.runs.size() * 3 * stride, 0.0);
    const std::size_t tasks = (static_cast<std::size_t>(film.rows) + kRowsPerTask - 1) / kRowsPerTask;
    sim::parallel_for(tasks, threads, [&](std::size_t task, int) {
      std::vector<float> wide(film.columns * stride);
      for (int l = 0; l < exposure.lines; ++l) {
        SpreadRuns spread(by_columns[l], film.columns);
        for (std::size_t row = task * kRowsPerTask;
             row < std::min<std::size_t>(film.rows, (task + 1) * kRowsPerTask); ++row) {
          if (runs_of_row[row].empty()) continue;
          sim::blur_down_row(exposure.derivative.data() + l * cells * stride, wide.data(), film.rows,
                             film.columns, static_cast<int>(stride), by_rows[l], static_cast<int>(row));
          for (std::size_t i = 0; i < runs_of_row[row].size(); ++i) {
            const std::size_t index = runs_of_row[row][i];
            const BinWeights::Run& run = weights.runs[index];
            const float* of_run = &shown[run.first_pixels];
            const float *before = nullptr, *sum = nullptr;
            for (int c = 0; c < 3; ++c, of_run += run.columns) {
              // Two channels often show the same cells.
              if (before == nullptr || !std::equal(of_run, of_run + run.columns, before))
                sum = spread.sum(i * 3 + c, run, of_run, wide.data(), stride);
              before = of_run;
              if (sum == nullptr) continue;
              double* to = slopes.data() + (index * 3 + c) * stride;
              for (std::size_t j = 0; j < stride; ++j) to[j] += colour[l][c] * sum[j];
            }
          }
        }
      }
    });
    for_every_bin([&](std::size_t bin) {
      for (std::size_t r = weights.first_run[bin]; r < weights.first_run[bin + 1]; ++r) {
        for (int c = 0; c < 3; ++c) {
          const double* from = slopes.data() + (r * 3 + c) * stride;
          double* to = out.derivative.data() + (bin * 3 + c) * out.free;
          for (std::size_t j = 0; j < parameters.size(); ++j)
            to[parameters[j]] += weights.inverse[bin * 3 + c] * from[j];
        }
      }
    });
  }
};

ProfileModel::ProfileModel(const sim::Scene& scene, const Photo& photo, const Region& region, int bands,
                           double beams_share, double smooth_rows, int threads, std::uint64_t sampling)
    : ProfileModel(scene, photo, {std::make_shared<const BinGrid>(column_bins(region, bands))}, beams_share,
                   smooth_rows, threads, sampling) {}

ProfileModel::ProfileModel(const sim::Scene& scene, const Photo& photo,
                           const std::vector<std::shared_ptr<const BinGrid>>& grids, double beams_share,
                           double smooth_rows, int threads, std::uint64_t sampling)
    : work_(std::make_unique<Workspace>()) {
  Workspace& w = *work_;
  w.grids = grids;
  w.clips = !keeps_negative_light(photo);
  w.smooth_rows = smooth_rows;
  w.threads = sim::thread_count(threads);
  w.scene = scene;
  w.scene.march.shrink = 1;
  w.used_beams.resize(scene.sheets.size());
  for (sim::Sheet& sheet : w.scene.sheets) {
    sheet.beams = std::max(1, static_cast<int>(std::lround(sim::beams_per_layer(sheet) * beams_share)));
    sheet.beams_per_km = 0.0;
    sheet.spacing_jitter = 0.0;  // the expectation is wanted, not one realisation
    w.first_rates.push_back(sheet.spline_rate);
  }
  const int cell = cell_width(grids);
  const Region& region = grids.front()->region;
  w.film = sim::film_for(scene, region.x, region.y, region.width, region.height, cell, 1.0);
  w.exposer = std::make_unique<sim::Exposer>(w.scene, w.film, threads, kBeyond, sampling);
  w.weights = bin_weights(photo, grids, w.film);
  w.runs_of_row.resize(w.film.rows);
  for (std::size_t r = 0; r < w.weights.runs.size(); ++r) w.runs_of_row[w.weights.runs[r].row].push_back(r);
}

ProfileModel::~ProfileModel() = default;

std::uint64_t ProfileModel::deflection_points() const { return work_->exposure.deflection_points; }

void ProfileModel::evaluate(const sim::Scene& scene, ModelProfile& out) {
  Workspace& w = *work_;
  w.adopt(scene, {});
  w.exposer->expose(w.scene, w.exposure);
  sim::dim_by_air(w.scene, w.exposure, w.threads);
  out.free = 0;
  out.derivative.clear();
  w.finish_values(out);
  w.add_offset(out);
  if (w.smooth_rows > 0.0) smooth(out, w.grids, w.smooth_rows);
}

void ProfileModel::evaluate_with_derivatives(const sim::Scene& scene, const std::vector<const double*>& free,
                                             ModelProfile& out) {
  Workspace& w = *work_;
  const std::vector<const double*> moved = w.adopt(scene, free);
  const ProfileShapers shapers = profile_shapers(w.scene, moved);
  std::vector<const double*> of_kernel;
  std::vector<int> kernel_parameters;
  for (std::size_t j = 0; j < moved.size(); ++j)
    if (!shapers.alone[j]) {
      of_kernel.push_back(moved[j]);
      kernel_parameters.push_back(static_cast<int>(j));
    }
  if (of_kernel.empty()) {
    w.exposer->expose(w.scene, w.exposure);
    sim::dim_by_air(w.scene, w.exposure, w.threads);
  } else {
    w.exposer->expose_with_derivatives(w.scene, of_kernel, w.exposure);
    sim::dim_by_air(w.scene, of_kernel, w.exposure, w.threads);
  }
  w.finish_values(out);
  w.find_shown();
  out.free = static_cast<int>(free.size());
  out.derivative.assign(out.value.size() * free.size(), 0.0);
  w.add_offset(moved, out);

  const std::size_t cells = w.exposure.cells();
  if (!of_kernel.empty()) w.add_exposed(kernel_parameters, out);
  w.down.resize(cells);
  w.blurred.resize(cells);
  for (int l = 0; l < w.exposure.lines; ++l) {
    const double sigma = sim::blur_sigma_px(w.scene, l);
    const sim::BlurKernel down = w.kernel(l, w.film.cell_height_px);
    const sim::BlurKernel across = w.kernel(l, w.film.cell_width_px);
    // The blur's own width, free or following the field of view: sigma = width * pixels / hfov.
    for (std::size_t j = 0; j < moved.size(); ++j) {
      double growth = 0.0;
      if (moved[j] == &w.scene.blur.width_deg[l]) growth = sim::pixels_per_degree(w.scene.camera);
      if (moved[j] == sim::camera_number_address(w.scene.camera, sim::scale_number))
        growth = sigma * sim::pixels_per_degree_growth(w.scene.camera);
      if (growth == 0.0 || sigma <= 0.0) continue;
      const float* plane = w.exposure.rayleigh.data() + l * cells;
      const auto add = [&](const sim::BlurKernel& first, const sim::BlurKernel& second, double per_cell) {
        sim::blur_down(plane, w.down.data(), w.film.rows, w.film.columns, 1, first, w.threads);
        sim::blur_across(w.down.data(), w.blurred.data(), w.film.rows, w.film.columns, 1, second, w.threads);
        for (float& x : w.blurred) x *= static_cast<float>(growth * per_cell);
        w.add_plane(w.blurred.data(), static_cast<int>(j), l, out);
      };
      add(w.kernel(l, w.film.cell_height_px, true), across, 1.0 / w.film.cell_height_px);
      add(down, w.kernel(l, w.film.cell_width_px, true), 1.0 / w.film.cell_width_px);
    }
  }
  w.shape(shapers);
  for (std::size_t s = 0; s < shapers.of_sheet.size(); ++s)
    for (const Shaper& shaper : shapers.of_sheet[s].shapers)
      w.add_plane(w.shaped[s].data() + (shaper.line * shapers.of_sheet[s].rates.size() + shaper.rate) * cells,
                  shaper.parameter, shaper.line, out);
  if (w.smooth_rows > 0.0) smooth(out, w.grids, w.smooth_rows);
}

}  // namespace vegard::fit
