// One photograph of a fit, with what is compared in it.
#pragma once

#include <memory>
#include <vector>

#include "fit/compare/comparison.h"
#include "fit/compare/profile_cost.h"
#include "fit/photo/photo.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// By how many pixels (standard deviation) profiles are smoothed even for the last word. A sampling of beams
/// leaves noise in a model's derivatives, independent from row to row, which roughens chi2 so that descents
/// creep and its curvature is too large; what the sheet does to a profile is as smooth as this.
inline constexpr double kProfileSmoothing_px = 2.0;

/// How fine the mean over all draws is for the last word (sim::BeamSampling): what its own error moves an
/// answer by is then small beside error bars.
inline constexpr double kLastFineness = 1.25;

struct Observation {
  const Photo* photo = nullptr;
  sim::Scene scene;  ///< as this photograph sees it, in its pixels, at the start
  PhotoFrame frame;  ///< what sets it apart from others
  Region region;
  double sum_of_weights = 0.0;               ///< of the profile's 1 / sigma^2, the model's sampling left out
  double sampling_error = 0.0;               ///< of the model, as a fraction of the brightness
  std::unique_ptr<Comparison> coarse, full;  ///< for the search, and for the last word
};

/// The scene in the pixels of a photograph that may have been averaged (fit/photo/averaging.h). Throws
/// sim::Error(scene) if the file's size is not the camera's.
sim::Scene scene_of_pixels(const sim::Scene& scene, const Photo& photo);

/// Prepares a photograph. It must outlive the observation. Throws sim::Error(scene) if its size is not the
/// camera's, the region does not lie inside, or the scene's film or blur has no derivative.
Observation observed(const sim::Scene& scene, const Photo& photo, int threads, const PhotoFrame& frame = {});

/// The same photograph decoded otherwise, which must outlive the observation: for the last word alone,
/// nothing coarse. What the model's sampling leaves is taken as it was.
Observation with_other_decoding(const Observation& before, const Photo& photo, int threads);

/// The terms of a cost over observations, which must outlive it, as `free` must.
enum class Detail { coarse, full };
std::vector<CostTerm> cost_terms(const std::vector<Observation>& observations,
                                 const std::vector<FreeNumber>& free, Detail detail);

}  // namespace vegard::fit
