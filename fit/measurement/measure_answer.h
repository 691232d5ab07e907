// The answer of a measurement in sentences that a layman understands, and how far it is to be trusted. The
// traces and the map decide together.
#pragma once

#include <string>
#include <vector>

#include "fit/answer/trust.h"
#include "fit/measurement/measurement.h"

namespace vegard::fit {

struct MeasureAnswer {
  Trust trust = Trust::unconstrained;
  std::string word;                    ///< of the banner: "Measured", "With care"
  std::vector<std::string> sentences;  ///< what is there, how sure that is, and why not surer
  std::vector<AnswerPart> parts;       ///< of a claimed border
  std::vector<std::string> not_known;  ///< what the picture alone does not tell, and what would
};

/// Needs all but the answer's own members of the measurement.
MeasureAnswer measure_answer(const Measurement& m);

}  // namespace vegard::fit
