// One photograph of a fit, with the statistics that are compared in it.
#pragma once

#include <memory>
#include <vector>

#include "fit/compare/comparison.h"
#include "fit/compare/profile_cost.h"
#include "fit/compare/radars.h"
#include "fit/photo/photo.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// Standard deviation in pixels by which profiles are smoothed even for the final evaluation. The sampling of
/// beams leaves noise in a model's derivatives, independent from row to row. It would make chi2 rough, so
/// that descents become slow, and its curvature too large. The sheet's effect on a profile is at least as
/// smooth as this.
inline constexpr double kProfileSmoothing_px = 2.0;

/// Fineness of the mean over all draws of beams for the final evaluation (sim::BeamSampling): its error then
/// shifts an answer by little compared with the error bars.
inline constexpr double kLastFineness = 1.25;

/// What is compared beside the photographs, with the shared scene in its site's frame, at the start.
struct SceneRadars {
  Radars radars;
  sim::Scene scene;
};

struct Observation {
  const Photo* photo = nullptr;
  sim::Scene scene;  ///< in this photograph's frame and pixels, at the start
  PhotoFrame frame;  ///< what belongs to this photograph alone
  Region region;
  double sum_of_weights = 0.0;  ///< of the profile's 1 / sigma^2, sampling noise of the model excluded
  double sampling_error = 0.0;  ///< sampling noise of the model, as a fraction of the brightness
  std::unique_ptr<Comparison> coarse, full;   ///< for the search, and for the final evaluation
  std::shared_ptr<const SceneRadars> radars;  ///< of the whole fit; only the first observation may have them
};

/// Gives the first observation the scene's radars, if it has any. Throws what Radars throws.
void add_radars(const sim::Scene& scene, std::vector<Observation>& observations);

/// The scene in the pixels of a photograph that may have been averaged (fit/photo/averaging.h). Throws
/// sim::Error(scene) if the file's size is not the camera's.
sim::Scene scene_of_pixels(const sim::Scene& scene, const Photo& photo);

/// Prepares a photograph. It must outlive the observation. Throws sim::Error(scene) if its size is not the
/// camera's, the region does not lie inside, or the scene's film or blur has no derivative.
Observation observed(const sim::Scene& scene, const Photo& photo, int threads, const PhotoFrame& frame = {});

/// Returns the observation of the same photograph with another decoding, for the final evaluation only
/// (`coarse` is empty). The sampling error of the model is copied. `photo` must outlive the observation.
Observation with_other_decoding(const Observation& before, const Photo& photo, int threads);

/// Returns the terms of a cost over `observations`. Both `observations` and `free` must outlive the terms.
enum class Detail { coarse, full };
std::vector<CostTerm> cost_terms(const std::vector<Observation>& observations,
                                 const std::vector<FreeNumber>& free, Detail detail);

}  // namespace vegard::fit
