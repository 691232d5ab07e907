#include "fit/sky_kind/kind_model.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <nlohmann/json.hpp>

#include "sim/base/data_folders.h"

namespace vegard::fit {

KindModel::KindModel(const std::string& text, const std::string& name) {
  try {
    const nlohmann::json json = nlohmann::json::parse(text);
    if (json.at("kind") != "vegard kinds of pictures")
      throw bad_sky_model(name, "is no model of kinds of sky");
    grey_aurora_ = feature_weights(json.at("aurora").at("grey").dump(), name);
    colour_aurora_ = feature_weights(json.at("aurora").at("colour").dump(), name);
    for (int k = 0; k < kSkyKinds; ++k) {
      const auto kind = static_cast<SkyKind>(k);
      if (kind == SkyKind::black) continue;
      kinds_[static_cast<std::size_t>(k)] =
          feature_weights(json.at("kinds").at(sky_kind_name(kind)).dump(), name);
    }
  } catch (const nlohmann::json::exception&) {
    throw bad_sky_model(name, "is no model of kinds of sky, or a damaged one");
  }
}

const KindModel& KindModel::built_in() {
  static const KindModel model(std::string(sim::embedded_table("kinds.json")), "kinds.json");
  return model;
}

std::array<double, kSkyKinds> KindModel::probabilities(const SkyFeatures& features) const {
  const bool is_grey = std::isnan(feature(features, SkyFeature::green_spread));
  const double odds = (is_grey ? grey_aurora_ : colour_aurora_).sum(features);
  const double aurora = 1.0 / (1.0 + std::exp(-odds));
  std::array<double, kSkyKinds> sums{}, result{};
  for (const bool has_aurora : {true, false}) {
    double most = -1e300, all = 0.0;
    const auto each = [&](const auto& what) {
      for (std::size_t k = 0; k < kSkyKinds; ++k) {
        const auto kind = static_cast<SkyKind>(k);
        if (kind != SkyKind::black && is_aurora(kind) == has_aurora) what(k);
      }
    };
    each([&](std::size_t k) { most = std::max(most, sums[k] = kinds_[k].sum(features)); });
    each([&](std::size_t k) { all += sums[k] = std::exp(sums[k] - most); });
    each([&](std::size_t k) { result[k] = (has_aurora ? aurora : 1.0 - aurora) * sums[k] / all; });
  }
  return result;
}

}  // namespace vegard::fit
