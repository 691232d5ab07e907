// The model's profile of a scene: that of its aurora at unit gain and without the sky, with exact
// derivatives, and that of the night sky's known lights at the scene's own gain. A picture is formed by
// sim/render/picture_model.h and averaged over the photograph's bins.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "fit/measure/bin_grid.h"
#include "fit/measure/profile.h"
#include "fit/photo/photo.h"
#include "sim/render/cell_weights.h"
#include "sim/render/picture_model.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/table/parameter_id.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit {

/// Values indexed as in Profile.
using ModelProfile = sim::PictureMeans;

/// Smooths a model and its derivatives by a Gaussian, as smoothed() in fit/measure/profile.h does for a
/// profile: every band and channel along its rows, sigma in rows. A model has values in all rows.
void smooth(ModelProfile& model, int bands, int rows, double sigma_rows);

/// Smooths a model in the bins of several grids (each grid's bins after those of the one before), sigma in
/// pixels along the positions.
void smooth(ModelProfile& model, const std::vector<std::shared_ptr<const BinGrid>>& grids, double sigma_px,
            int threads = 1);

/// Whether the model of a scene is one random draw of its beams, because fit.model says so or because no mean
/// is available; else it is the mean over all draws (sim/render/beams/sheet_nodes.h).
bool is_drawn(const sim::Scene& scene);

/// Whether only profiles along columns are compared, with a model that is smooth: then the cells of its film
/// are wide, and as high as the bins.
bool has_smooth_bands(const sim::Scene& scene);

/// Renders the region of interest repeatedly. The film's cells are described in docs/fitting.md: profiles
/// average over columns. Out-of-gamut light is clipped in each cell, as in display_picture(), before columns
/// are averaged with the photograph's own mask; it is not clipped if the photograph keeps_negative_light().
class ProfileModel {
 public:
  /// `beams_share` is the fraction of the scene's beams that is used, or of the nodes if nothing is drawn;
  /// the profiles are smoothed by `smooth_rows` (0: not at all). Coarse models are for the search, the full
  /// one is for the answer. `sampling` is the number of the random draw of beams, `fineness` that of the mean
  /// over all draws (sim::BeamSampling).
  ProfileModel(const sim::Scene& scene, const Photo& photo, const Region& region, int bands,
               double beams_share, double smooth_rows, int threads, std::uint64_t sampling = 0,
               double fineness = 1.0);
  /// Gives the model in the bins of several grids of one region, each grid's bins after those of the one
  /// before, from one rendering.
  ProfileModel(const sim::Scene& scene, const Photo& photo,
               const std::vector<std::shared_ptr<const BinGrid>>& grids, double beams_share,
               double smooth_rows, int threads, std::uint64_t sampling = 0, double fineness = 1.0);
  ~ProfileModel();

  /// The scene may differ from the constructor's in continuous parameters only.
  void evaluate(const sim::Scene& scene, ModelProfile& out);
  /// Evaluates with derivatives by the numbers `free` of the scene.
  void evaluate_with_derivatives(const sim::Scene& scene, const std::vector<sim::ParameterId>& free,
                                 ModelProfile& out);

  /// Number of deflection points in the last evaluation.
  std::uint64_t deflection_points() const;

  /// The picture whose cells it averages over bins.
  const sim::PictureModel& picture() const;

 private:
  struct Workspace;
  std::unique_ptr<Workspace> work_;
};

// Bin weights: the weight of each cell of a film in each bin of a profile.

/// Returns weights for means over the usable pixels of the bins of several grids, each grid's bins after
/// those of the one before. The film's cells are whole numbers of pixels high, with a cell border at the
/// upper left corner of the grids' region. A pixel has the light of the cell in which its centre lies.
sim::CellWeights bin_weights(const Photo& photo, const std::vector<std::shared_ptr<const BinGrid>>& grids,
                             const sim::FilmGeometry& film);

}  // namespace vegard::fit
