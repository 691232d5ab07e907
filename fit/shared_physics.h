// Pictures that have the physics behind their light in common, as those of a night: what they say together of
// the emission tables, and their answers with what the others say.
//
// Of the variance of each coefficient of the tables' modes (sim/light/tables/light_modes.h), the share
// kOwnShare belongs to the picture (fit/columns/common_physics.h), the rest to all of them:
// a_i = sqrt(1 - s) c + sqrt(s) d_i. A picture says of a_i what ModeInformation holds; linear as that is, and
// with d_i eliminated, what the pictures say of c adds up with its prior. So one pass over stored answers is
// the least squares of all pictures together.
//
// An answer is corrected by what the *others* say of its coefficients, and its own picture is not asked: of
// one that has another shape of light than any mode, the modes would take up the difference. Its error bar
// has a part of its own, and one that it has in common with the others, which no mean makes smaller.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/sequence.h"
#include "fit/uncertainty/physics_uncertainty.h"

namespace vegard::fit {

/// A picture's answer.
struct FrameOfNight {
  bool converged = false;  ///< its verdict is good or doubtful
  ModeInformation told;
  std::vector<SequenceNumber> numbers;
};

/// A number with what the other pictures say.
struct SharedNumber {
  std::string name, unit;
  double alone = 0.0, alone_sigma = 0.0;  ///< the fit's own answer
  double value = 0.0;
  double sigma_own = 0.0, sigma_common = 0.0;
  std::vector<double> by_common{};  ///< changes by each coefficient that the pictures have in common
  double sigma() const;
};

enum class PhysicsUse {
  used,
  unknown,      ///< of a fit that failed, takes its tables as exact, or has other modes than the rest
  contradicts,  ///< it asks for other physics than the rest
};

struct SharedFrame {
  PhysicsUse use = PhysicsUse::unknown;
  double chi2 = 0.0;  ///< of what it asks for, against what the others say
  int degrees_of_freedom = 0;
  double chance = 1.0;                ///< of so large a chi2
  std::vector<SharedNumber> numbers;  ///< those of which the error by the modes is known
};

/// A number's mean over the pictures, with weights 1 / (own variance + scatter^2).
struct SharedMean {
  std::string name, unit;
  std::size_t frames = 0;
  double value = 0.0;
  double sigma_own = 0.0, sigma_common = 0.0;
  double scatter = 0.0;  ///< standard deviation from picture to picture beyond their own errors
  double sigma() const;
};

struct SharedPhysics {
  std::vector<SharedFrame> frames;  ///< one for each given
  std::size_t used = 0;
  double chi2 = 0.0;  ///< of all that is asked for, against the physics in common and its prior
  int degrees_of_freedom = 0;
  double chance = 1.0;
  double factor = 1.0;         ///< on the standard deviations of what is in common (Birge 1932)
  bool is_consistent = false;  ///< else each picture keeps its own answer, whose error is only split
  std::string why_not;
  LearntModes common;                    ///< the coefficients c, with the factor
  std::vector<TablesCorrection> tables;  ///< what the pictures together ask of the tables
  std::vector<SharedMean> means;
};

/// Pictures of the tables that most of them have are taken together. One whose chi2 against the others a
/// share of 0.27 % of pictures exceed, by the number of pictures, is left out; if this leaves fewer than two
/// thirds of them, or two, or chi2 of the rest contradicts, the combination is not consistent. Where chi2 is
/// above its degrees of freedom, the standard deviations in common are multiplied by sqrt(chi2 / degrees).
SharedPhysics share_physics(const std::vector<FrameOfNight>& frames);

/// Returns a sentence about the combination: how many pictures, whether they agree, by what the errors grow.
std::string shared_physics_words(const SharedPhysics& shared);

}  // namespace vegard::fit
