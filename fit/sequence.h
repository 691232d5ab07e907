// Fits a sequence of photographs, each from the answer of the one before.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/fit.h"
#include "fit/photo/photo.h"

namespace vegard::fit {

/// A number of a frame's answer that is followed over time.
struct SequenceNumber {
  std::string name;  ///< path of a free parameter, or name of a derived number
  std::string unit;
  double value = 0.0;
  std::optional<double> sigma;
  std::vector<double> by_mode{};  ///< as FittedParameter::by_mode (fit/answer/fit_result.h)
  bool relative = false;          ///< its changes are factors, to first order
};

/// The results of one frame that are kept.
struct SequenceRow {
  std::string frame;  ///< the photograph's name without its ending
  double time_s = 0.0;
  std::string photo_sha256;
  std::string decoding;
  Verdict verdict = Verdict::failed;
  bool searched = false;  ///< whether the full search found it, not a descent from the frame before
  double chi2_per_dof = 0.0;
  std::vector<double> values;  ///< of the free numbers, in their order: where the next frame starts
  std::vector<SequenceNumber> numbers;
  ModeInformation physics{};  ///< as FitResult::physics
};

struct FrameFit {
  FitResult result;
  bool searched = false;
};

/// Fits a frame taken at `time_s` on the scene's clock. If the frame before has an answer, a descent from it
/// comes first. If there is none, or the verdict of the descent is not good, the scene's whole search follows
/// (about the answer before if that was good), and the better of both results is returned: by verdict, then
/// by chi2.
FrameFit fit_frame(const sim::Scene& scene, const Photo& photo, double time_s, const SequenceRow* before,
                   const FitOptions& options);

/// Returns the row of a frame with all free and derived numbers. If a sheet's energy flux was not free but
/// the sensor's scale is known, the row has the flux that follows from the fitted gain
/// (fit/answer/energy_flux.h).
SequenceRow sequence_row(const std::string& frame, double time_s, const sim::Scene& scene,
                         const FrameFit& fit, const Photo& photo);

}  // namespace vegard::fit
