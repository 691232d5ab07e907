#include "fit/sky_kind/feature_weights.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

namespace vegard::fit {

sim::Error bad_sky_model(const std::string& file, const std::string& problem) {
  return sim::unreadable(file, problem).expected("what scripts/learn_sky_kind.py or scripts/learn_kinds.py writes");
}

int feature_number(const std::string& name, const std::string& file) {
  for (const SkyFeatureWords& words : sky_feature_words())
    if (name == words.name) return static_cast<int>(words.feature);
  throw bad_sky_model(file, "asks for a feature '" + name + "' that there is not");
}

double FeatureWeights::sum(const SkyFeatures& features) const {
  double sum = constant;
  for (const Term& term : terms) {
    const double value = features[static_cast<std::size_t>(term.feature)];
    sum += std::isnan(value) ? term.missing : term.weight * std::clamp(value, term.least, term.most);
  }
  return sum;
}

FeatureWeights feature_weights(const std::string& text, const std::string& file) {
  const nlohmann::json json = nlohmann::json::parse(text);
  FeatureWeights weights;
  weights.constant = json.at("constant").get<double>();
  for (const nlohmann::json& term : json.at("terms")) {
    FeatureWeights::Term one;
    one.feature = feature_number(term.at("feature").get<std::string>(), file);
    one.weight = term.at("weight").get<double>();
    one.least = term.at("least").get<double>();
    one.most = term.at("most").get<double>();
    one.missing = term.at("missing").get<double>();
    if (!(one.least <= one.most)) throw bad_sky_model(file, "has a weight of no range");
    weights.terms.push_back(one);
  }
  return weights;
}

}  // namespace vegard::fit
