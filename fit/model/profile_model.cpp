#include "fit/model/profile_model.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <type_traits>

#include "fit/measure/profile_bins.h"
#include "sim/base/parallel.h"
#include "sim/emit/aurora/sheet.h"
#include "sim/render/beams/sheet_nodes.h"
#include "sim/render/film.h"
#include "sim/view/film/blur.h"

namespace vegard::fit {
namespace {

constexpr int kWidestCell = 4;
constexpr double kWidestMeanCell = 20.0;
constexpr double kNarrowestRamp = 0.25;  // of a wide cell
constexpr int kCellsPerBand = 12;
constexpr int kCellsPerNarrowBin = 4;
constexpr double kBeyond = 0.5;  // sheet lengths by which a fit may move an end

/// The first grid's bins are wide, as those of bands are; others may be narrow.
int cell_width(const std::vector<std::shared_ptr<const BinGrid>>& grids) {
  const BinGrid& first = *grids.front();
  int cell = std::clamp(first.narrowest_px / kCellsPerBand, 1, kWidestCell);
  for (std::size_t g = 1; g < grids.size(); ++g)
    cell = std::min(cell, std::max(1, grids[g]->narrowest_px / kCellsPerNarrowBin));
  return cell;
}

/// The mean over all draws is smooth: a band of columns needs no more than a few wide cells, with ramps
/// between them as wide as the blur across makes them. Other bins ask for narrow cells.
sim::FilmGeometry film_of(const sim::Scene& scene, const std::vector<std::shared_ptr<const BinGrid>>& grids) {
  const BinGrid& first = *grids.front();
  const Region& region = first.region;
  const auto film_with = [&](double cell_width, double cell_height) {
    return sim::film_for(scene, region.x, region.y, region.width, region.height, cell_width, cell_height);
  };
  if (!has_smooth_bands(scene)) return film_with(cell_width(grids), 1.0);
  double blur_px = 0.0;
  for (std::size_t l = 0; l < scene.emission.lines.size(); ++l)
    blur_px +=
        sim::blur_sigma_px(scene, static_cast<int>(l)) / static_cast<double>(scene.emission.lines.size());
  const double band_px = static_cast<double>(region.width) / first.groups;
  const double wide = band_px / std::ceil(band_px / kWidestMeanCell);
  // A parabola over the ramp is as wide as the Gaussian.
  const double ramp_px = std::max(kNarrowestRamp * wide, std::sqrt(20.0) * blur_px);
  if (wide <= kWidestCell || ramp_px > wide) return film_with(cell_width(grids), first.position_px);
  sim::FilmGeometry film = film_with(wide, first.position_px);
  film.ramp_px = ramp_px;
  return film;
}

/// Of `count` numbers in a row, each with as many steps of `stride` before and behind it as the kernel is
/// wide.
void smooth_inside(const sim::BlurKernel& kernel, const double* from, std::size_t count,
                   std::ptrdiff_t stride, double* to) {
  constexpr std::size_t kAtOnce = 8;  // their sums stay in registers
  const auto smooth_some = [&](std::size_t first, auto some) {
    double sum[kAtOnce];
    for (std::size_t i = 0; i < some; ++i) sum[i] = kernel.weights[0] * from[first + i];
    for (int k = 1; k <= kernel.radius(); ++k) {
      const double w = kernel.weights[k];
      const double *before = from + first - k * stride, *behind = from + first + k * stride;
      for (std::size_t i = 0; i < some; ++i) sum[i] += w * (before[i] + behind[i]);
    }
    std::copy_n(sum, static_cast<std::size_t>(some), to + first);
  };
  std::size_t first = 0;
  for (; first + kAtOnce <= count; first += kAtOnce)
    smooth_some(first, std::integral_constant<std::size_t, kAtOnce>());
  if (first < count) smooth_some(first, count - first);
}

/// One grid's values, from the index `first` on.
void smooth_part(ModelProfile& model, std::size_t first, int bands, int rows, double sigma_rows,
                 int threads) {
  const sim::BlurKernel kernel = sim::gaussian_kernel(sigma_rows);
  const int radius = kernel.radius();
  double total_weight = kernel.weights[0];
  for (int k = 1; k <= radius; ++k) total_weight += 2.0 * kernel.weights[k];
  // One band's rows at a time: value and derivatives lie side by side, three channels to a row.
  const auto smooth_rows = [&](std::vector<double>& data, std::size_t per_value) {
    const std::size_t per_row = 3 * per_value;
    sim::parallel_for(static_cast<std::size_t>(bands), threads, [&](std::size_t b, int) {
      thread_local std::vector<double> from;
      from.resize(per_row * rows);
      double* band = data.data() + first * per_value + b * rows * per_row;
      std::copy_n(band, from.size(), from.begin());
      // By the sum of all weights where all rows are there, which rounding keeps from 1, else by that of
      // some.
      if (rows > 2 * radius)
        smooth_inside(kernel, from.data() + radius * per_row, (rows - 2 * radius) * per_row,
                      static_cast<std::ptrdiff_t>(per_row), band + radius * per_row);
      for (int r = 0; r < rows; ++r) {
        double* to = band + r * per_row;
        double weight = total_weight;
        if (r < radius || r >= rows - radius) {
          std::fill_n(to, per_row, 0.0);
          weight = 0.0;
          for (int k = std::max(-radius, -r); k <= std::min(radius, rows - 1 - r); ++k) {
            const double w = kernel.weights[std::abs(k)];
            weight += w;
            const double* row = from.data() + (r + k) * per_row;
            for (std::size_t i = 0; i < per_row; ++i) to[i] += w * row[i];
          }
        }
        for (std::size_t i = 0; i < per_row; ++i) to[i] /= weight;
      }
    });
  };
  smooth_rows(model.value, 1);
  if (model.free > 0) smooth_rows(model.derivative, model.free);
  if (!model.offset.empty()) smooth_rows(model.offset, 1);
  if (!model.offset_derivative.empty()) smooth_rows(model.offset_derivative, model.free);
}

}  // namespace

struct ProfileModel::Workspace {
  std::vector<std::shared_ptr<const BinGrid>> grids;
  double smooth_rows = 0.0;
  int threads = 1;
  sim::Scene scene;  // with this model's number of beams
  std::unique_ptr<sim::PictureModel> picture;

  /// Copies the numbers of `from`.
  void adopt(const sim::Scene& from) {
    std::vector<int> used_beams;
    for (const sim::Sheet& sheet : scene.sheets) used_beams.push_back(sheet.beams);
    scene = from;
    scene.march.shrink = 1;  // light and derivatives are to be of one march
    for (std::size_t s = 0; s < from.sheets.size(); ++s) {
      scene.sheets[s].beams = used_beams[s];
      scene.sheets[s].beams_per_km = 0.0;
    }
  }
};

bool is_drawn(const sim::Scene& scene) {
  return scene.fit.model == sim::FitModel::draws || !sim::has_expected_picture(scene);
}

bool has_smooth_bands(const sim::Scene& scene) {
  const sim::Fit& fit = scene.fit;
  return !is_drawn(scene) && scene.blur.model == sim::BlurModel::angle && !sim::has_volumes(scene) &&
         fit.profile_along == sim::ProfileAlong::columns &&
         !fit.weight.any_beside_profile([](const sim::StatisticFacts&) { return true; });
}

ProfileModel::ProfileModel(const sim::Scene& scene, const Photo& photo, const Region& region, int bands,
                           double beams_share, double smooth_rows, int threads, std::uint64_t sampling,
                           double fineness)
    : ProfileModel(scene, photo, {std::make_shared<const BinGrid>(column_bins(region, bands))}, beams_share,
                   smooth_rows, threads, sampling, fineness) {}

ProfileModel::ProfileModel(const sim::Scene& scene, const Photo& photo,
                           const std::vector<std::shared_ptr<const BinGrid>>& grids, double beams_share,
                           double smooth_rows, int threads, std::uint64_t sampling, double fineness)
    : work_(std::make_unique<Workspace>()) {
  Workspace& w = *work_;
  w.grids = grids;
  w.smooth_rows = smooth_rows;
  w.threads = sim::thread_count(threads);
  w.scene = scene;
  w.scene.march.shrink = 1;
  for (sim::Sheet& sheet : w.scene.sheets) {
    const double share = is_drawn(scene) ? beams_share : 1.0;
    sheet.beams = std::max(1, static_cast<int>(std::lround(sim::beams_per_layer(sheet) * share)));
    sheet.beams_per_km = 0.0;
    sheet.spacing_jitter = 0.0;  // the expectation is wanted, not one realisation
  }
  const sim::FilmGeometry film = film_of(scene, grids);
  sim::PictureModelOptions options;
  options.keeps_negative_light = keeps_negative_light(photo);
  options.beyond = kBeyond;
  options.sampling.draw = sampling;
  options.sampling.mean = !is_drawn(scene);
  options.sampling.smooth_px = smooth_rows;
  options.sampling.fineness = fineness;
  options.threads = threads;
  w.picture = std::make_unique<sim::PictureModel>(w.scene, film, bin_weights(photo, grids, film), options);
}

ProfileModel::~ProfileModel() = default;

std::uint64_t ProfileModel::deflection_points() const { return work_->picture->deflection_points(); }

const sim::PictureModel& ProfileModel::picture() const { return *work_->picture; }

void ProfileModel::evaluate(const sim::Scene& scene, ModelProfile& out) {
  Workspace& w = *work_;
  w.adopt(scene);
  w.picture->evaluate(w.scene, out);
  if (w.smooth_rows > 0.0) smooth(out, w.grids, w.smooth_rows, w.threads);
}

void ProfileModel::evaluate_with_derivatives(const sim::Scene& scene,
                                             const std::vector<sim::ParameterId>& free, ModelProfile& out) {
  Workspace& w = *work_;
  w.adopt(scene);
  w.picture->evaluate_with_derivatives(w.scene, free, out);
  if (w.smooth_rows > 0.0) smooth(out, w.grids, w.smooth_rows, w.threads);
}

void smooth(ModelProfile& model, int bands, int rows, double sigma_rows) {
  smooth_part(model, 0, bands, rows, sigma_rows, 1);
}

void smooth(ModelProfile& model, const std::vector<std::shared_ptr<const BinGrid>>& grids, double sigma_px,
            int threads) {
  std::size_t first = 0;
  for (const std::shared_ptr<const BinGrid>& grid : grids) {
    if (grid->position_px > 0.0)
      smooth_part(model, first, grid->groups, grid->positions, sigma_px / grid->position_px, threads);
    first += grid->bins() * 3;
  }
}

sim::CellWeights bin_weights(const Photo& photo, const std::vector<std::shared_ptr<const BinGrid>>& grids,
                             const sim::FilmGeometry& film) {
  sim::CellWeights weights;
  for (const std::shared_ptr<const BinGrid>& grid : grids) {
    const Region& region = grid->region;
    const auto cell_of = [&](int x) { return static_cast<int>((x + 0.5) / film.cell_width_px); };
    const int top = static_cast<int>(std::lround((region.y - film.y0_px) / film.cell_height_px));
    const auto row_of = [&](int y) { return static_cast<int>((y - region.y + 0.5) / film.cell_height_px); };
    const int left = static_cast<int>(std::lround((region.x - film.x0_px) / film.cell_width_px));
    for (std::size_t bin = 0; bin < grid->bins(); ++bin) {
      weights.first_run.push_back(weights.runs.size());
      int count[3] = {0, 0, 0};
      for (std::size_t r = grid->first_run[bin]; r < grid->first_run[bin + 1]; ++r) {
        const BinGrid::Run& pixel_run = grid->runs[r];
        const int begin = pixel_run.begin - region.x, end = pixel_run.end - region.x;
        sim::CellWeights::Run run;
        run.row = top + row_of(pixel_run.y);
        run.first_column = left + cell_of(begin);
        run.columns = cell_of(end - 1) - cell_of(begin) + 1;
        const bool goes_on = weights.runs.size() > weights.first_run.back() &&
                             weights.runs.back().row == run.row &&
                             weights.runs.back().first_column == run.first_column &&
                             weights.runs.back().columns == run.columns;
        run.first_pixels = goes_on ? weights.runs.back().first_pixels : weights.pixels.size();
        if (!goes_on)
          weights.pixels.resize(run.first_pixels + static_cast<std::size_t>(run.columns) * 3, 0.0f);
        float* pixels = weights.pixels.data() + run.first_pixels;
        for (int c = 0; c < 3; ++c)
          for (int x = begin; x < end; ++x) {
            if (!photo.usable[photo.linear.index(region.x + x, pixel_run.y, c)]) continue;
            pixels[(cell_of(x) - cell_of(begin)) * 3 + c] += 1.0f;
            ++count[c];
          }
        if (!goes_on) weights.runs.push_back(run);
      }
      for (const int pixels : count)
        weights.inverse.push_back(pixels > 0 ? 1.0f / static_cast<float>(pixels) : 0.0f);
    }
  }
  weights.first_run.push_back(weights.runs.size());
  return weights;
}

}  // namespace vegard::fit
