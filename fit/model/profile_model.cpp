#include "fit/model/profile_model.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "fit/measure/profile_bins.h"
#include "fit/model/bin_weights.h"
#include "sim/emit/aurora/sheet.h"
#include "sim/render/film.h"
#include "sim/view/film/blur.h"

namespace vegard::fit {
namespace {

constexpr int kWidestCell = 4;
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

/// One grid's values, from the index `first` on.
void smooth_part(ModelProfile& model, std::size_t first, int bands, int rows, double sigma_rows) {
  const sim::BlurKernel kernel = sim::gaussian_kernel(sigma_rows);
  // One band's rows at a time: value and derivatives lie side by side, three channels to a row.
  const auto smooth_rows = [&](std::vector<double>& data, std::size_t per_value) {
    const std::size_t per_row = 3 * per_value;
    std::vector<double> from(per_row * rows);
    for (int b = 0; b < bands; ++b) {
      double* band = data.data() + first * per_value + static_cast<std::size_t>(b) * rows * per_row;
      std::copy_n(band, from.size(), from.begin());
      for (int r = 0; r < rows; ++r) {
        double* to = band + r * per_row;
        std::fill_n(to, per_row, 0.0);
        double weight = 0.0;
        for (int k = std::max(-kernel.radius(), -r); k <= std::min(kernel.radius(), rows - 1 - r); ++k) {
          const double w = kernel.weights[std::abs(k)];
          weight += w;
          const double* row = from.data() + (r + k) * per_row;
          for (std::size_t i = 0; i < per_row; ++i) to[i] += w * row[i];
        }
        for (std::size_t i = 0; i < per_row; ++i) to[i] /= weight;
      }
    }
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
  w.smooth_rows = smooth_rows;
  w.scene = scene;
  w.scene.march.shrink = 1;
  for (sim::Sheet& sheet : w.scene.sheets) {
    sheet.beams = std::max(1, static_cast<int>(std::lround(sim::beams_per_layer(sheet) * beams_share)));
    sheet.beams_per_km = 0.0;
    sheet.spacing_jitter = 0.0;  // the expectation is wanted, not one realisation
  }
  const Region& region = grids.front()->region;
  const sim::FilmGeometry film =
      sim::film_for(scene, region.x, region.y, region.width, region.height, cell_width(grids), 1.0);
  sim::PictureModelOptions options;
  options.keeps_negative_light = keeps_negative_light(photo);
  options.beyond = kBeyond;
  options.sampling = sampling;
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
  if (w.smooth_rows > 0.0) smooth(out, w.grids, w.smooth_rows);
}

void ProfileModel::evaluate_with_derivatives(const sim::Scene& scene,
                                             const std::vector<sim::ParameterId>& free, ModelProfile& out) {
  Workspace& w = *work_;
  w.adopt(scene);
  w.picture->evaluate_with_derivatives(w.scene, free, out);
  if (w.smooth_rows > 0.0) smooth(out, w.grids, w.smooth_rows);
}

void smooth(ModelProfile& model, int bands, int rows, double sigma_rows) {
  smooth_part(model, 0, bands, rows, sigma_rows);
}

void smooth(ModelProfile& model, const std::vector<std::shared_ptr<const BinGrid>>& grids, double sigma_px) {
  std::size_t first = 0;
  for (const std::shared_ptr<const BinGrid>& grid : grids) {
    if (grid->position_px > 0.0)
      smooth_part(model, first, grid->groups, grid->positions, sigma_px / grid->position_px);
    first += grid->bins() * 3;
  }
}

}  // namespace vegard::fit
