// A sum of weighted features of a sky, as models of files have it.
#pragma once

#include <string>
#include <vector>

#include "fit/sky_kind/sky_features.h"
#include "sim/base/error.h"

namespace vegard::fit {

/// Returns the error that a model's file is none; `problem` says why.
sim::Error bad_sky_model(const std::string& file, const std::string& problem);

/// Returns the number of the feature of this name. Throws bad_sky_model() if there is none.
int feature_number(const std::string& name, const std::string& file);

struct FeatureWeights {
  struct Term {
    int feature = 0;
    double weight = 0.0, least = 0.0, most = 0.0;  ///< beyond what was learnt from a feature tells no more
    double missing = 0.0;                          ///< what counts for a feature that there is not
  };
  double constant = 0.0;
  std::vector<Term> terms;

  double sum(const SkyFeatures& features) const;
};

/// Parses {"constant": …, "terms": [{"feature": "green", "weight": …, "least": …, "most": …, "missing": …}]}.
/// Throws bad_sky_model() about `file`, or nlohmann::json::exception.
FeatureWeights feature_weights(const std::string& json, const std::string& file);

}  // namespace vegard::fit
