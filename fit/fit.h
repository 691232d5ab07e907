// Fitting a scene to a photograph.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/photo/photo.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

class Journal;

struct FitOptions {
  int threads = 0;             ///< of the simulator; 0: all cores. The result does not depend on it.
  int max_evaluations = 2000;  ///< of the residuals, search and descents together
  /// Told what is going on: stage, evaluations so far, best chi2 / dof so far (infinite while only
  /// smoothed profiles have been looked at), finished share 0..1 (a guess).
  std::function<void(const std::string& stage, int evaluations, double chi2_per_dof, double share)> progress;
  const std::atomic<bool>* stop =
      nullptr;                 ///< set by Ctrl-C: the best so far comes back with verdict interrupted
  Journal* journal = nullptr;  ///< where finished steps are kept and looked up; null: nowhere

  // Judges of the error bars, of a fit that has not failed (docs/fitting.md).
  bool intervals = false;  ///< profile-likelihood intervals of every parameter
  int bootstrap = 0;       ///< draws of the bootstrap over bands; 0: none
  int mcmc = 0;            ///< kept steps of a Markov chain; 0: none
};

/// Fits scene.fit.free to `photo`, by the statistics that scene.fit weighs. The photograph must have the
/// camera's size. Throws sim::Error for input that cannot be used (no free parameter, sizes that differ,
/// nothing usable in the region); numerical trouble is a verdict, never an exception. A sheet that cannot be
/// seen is a verdict too (failed). An unknown transfer curve is taken as sRGB: fit/curve_fit.h finds it.
FitResult fit_photo(const sim::Scene& scene, const Photo& photo, const FitOptions& options);

/// Fits scene.fit.free to several photographs at once: those of scene.fit.photos, in their order. A number
/// that belongs to one photograph moves that one's scene; sheets are given in the frame of the scene's own
/// site and carried over to a photograph's (fit/parameters/photo_frame.h). Throws as fit_photo() does, and
/// for one whose transfer curve is unknown.
FitResult fit_photos(const sim::Scene& scene, const std::vector<Photo>& photos, const FitOptions& options);

}  // namespace vegard::fit
