// The profile that a scene's aurora would have, at unit gain and without the sky, with its exact derivatives;
// and that of the night sky's known lights, at the scene's own gain: a picture, formed by
// sim/render/picture_model.h, in the photograph's bins.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "fit/measure/profile.h"
#include "fit/photo/photo.h"
#include "sim/render/picture_model.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/table/parameter_id.h"

namespace vegard::fit {

/// Values indexed as in Profile.
using ModelProfile = sim::PictureMeans;

/// Gaussian smoothing of a model, derivatives included, as smoothed() of fit/measure/smoothing.h has it of a
/// profile: of every band and channel along its rows, sigma in rows. A model has every row.
void smooth(ModelProfile& model, int bands, int rows, double sigma_rows);

/// The same of a model in the bins of several grids, one grid's after the other's, sigma in pixels along the
/// positions.
void smooth(ModelProfile& model, const std::vector<std::shared_ptr<const BinGrid>>& grids, double sigma_px,
            int threads = 1);

/// Whether the model of a scene is one draw of its beams, by fit.model or because there is no other; else it
/// is the mean over all draws (sim/render/beams/sheet_nodes.h).
bool is_drawn(const sim::Scene& scene);

/// Whether nothing but profiles along columns is compared, of a model that is smooth: then the cells of its
/// film are wide, and as high as the bins are.
bool has_smooth_bands(const sim::Scene& scene);

/// Renders the region of interest again and again. The film's cells are as docs/fitting.md says:
/// profiles average over columns. Out-of-gamut light is clipped per cell, as in display_picture(), before
/// columns are averaged with the photograph's own mask; of a photograph that keeps_negative_light() it is
/// not.
class ProfileModel {
 public:
  /// `beams_share` of the scene's beams are used, or of the nodes where nothing is drawn, and the profiles
  /// are smoothed by `smooth_rows` (0: not at all): coarse models search, the full one decides. `sampling`:
  /// another draw of the beams; `fineness`: of the mean over all draws (sim::BeamSampling).
  ProfileModel(const sim::Scene& scene, const Photo& photo, const Region& region, int bands,
               double beams_share, double smooth_rows, int threads, std::uint64_t sampling = 0,
               double fineness = 1.0);
  /// In the bins of some grids of one region, one grid's after the other's, from one rendering.
  ProfileModel(const sim::Scene& scene, const Photo& photo,
               const std::vector<std::shared_ptr<const BinGrid>>& grids, double beams_share,
               double smooth_rows, int threads, std::uint64_t sampling = 0, double fineness = 1.0);
  ~ProfileModel();

  /// The scene may differ from the constructor's in continuous parameters only.
  void evaluate(const sim::Scene& scene, ModelProfile& out);
  /// By `free`, numbers of the scene.
  void evaluate_with_derivatives(const sim::Scene& scene, const std::vector<sim::ParameterId>& free,
                                 ModelProfile& out);

  /// Deflection points of the last evaluation.
  std::uint64_t deflection_points() const;

  /// What it bins.
  const sim::PictureModel& picture() const;

 private:
  struct Workspace;
  std::unique_ptr<Workspace> work_;
};

}  // namespace vegard::fit
