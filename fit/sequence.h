// A sequence of photographs: each fitted from where the last one ended.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/fit.h"
#include "fit/photo/photo.h"

namespace vegard::fit {

/// A number of a frame's answer, as it is followed over time.
struct SequenceNumber {
  std::string name;  ///< a free parameter's path, or a derived number's words
  std::string unit;
  double value = 0.0;
  std::optional<double> sigma;
};

/// What is kept of a frame.
struct SequenceRow {
  std::string frame;  ///< the photograph's name without its ending
  double time_s = 0.0;
  std::string photo_sha256;
  std::string decoding;
  Verdict verdict = Verdict::failed;
  bool searched = false;  ///< by the full search, not by a descent from the frame before
  double chi2_per_dof = 0.0;
  std::vector<double> values;  ///< of the free numbers, in their order: where the next frame starts
  std::vector<SequenceNumber> numbers;
};

struct FrameFit {
  FitResult result;
  bool searched = false;
};

/// Fits a frame taken at `time_s` on the scene's clock. With a frame before it that has an answer, first by a
/// descent from that answer; if the verdict is not good, or there is none, by the scene's whole search (about
/// that answer if it was a good one), and the better of the two stays: by verdict, then by chi2.
FrameFit fit_frame(const sim::Scene& scene, const Photo& photo, double time_s, const SequenceRow* before,
                   const FitOptions& options);

/// All free numbers, and what follows from them; and where it was not free but the sensor's scale is
/// known, the energy flux of each sheet by the gain that the fit found (fit/answer/energy_flux.h).
SequenceRow sequence_row(const std::string& frame, double time_s, const sim::Scene& scene,
                         const FrameFit& fit, const Photo& photo);

}  // namespace vegard::fit
