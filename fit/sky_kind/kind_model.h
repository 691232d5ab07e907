// Probabilities of the kinds of sky of a picture by itself, by a model that is learnt from made skies and
// from pictures marked by eye (scripts/learn_kinds.py).
#pragma once

#include <array>
#include <string>

#include "fit/sky_kind/feature_weights.h"
#include "fit/sky_kind/kinds.h"

namespace vegard::fit {

/// Aurora or none by a logistic regression, of grey and of coloured pictures apart; then the kinds with
/// aurora, and those without, by a multinomial one each.
class KindModel {
 public:
  /// Parses the text of a file. Throws sim::Error(unreadable_input) with its name if it is no such file.
  KindModel(const std::string& text, const std::string& name);

  /// The model that is compiled in (data/filter/kinds.json).
  static const KindModel& built_in();

  /// The probability of each kind; black has none.
  std::array<double, kSkyKinds> probabilities(const SkyFeatures& features) const;

 private:
  FeatureWeights grey_aurora_, colour_aurora_;
  std::array<FeatureWeights, kSkyKinds> kinds_;
};

}  // namespace vegard::fit
