// The statistics by which photograph and model are compared: a row for each. Its key fit.NAME_weight and its
// limits follow from it; how it is computed is said in fit/compare/statistics.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace vegard::sim {

enum class StatisticKind { profile, colour, horizontal, border, image, texture, granulation };

struct StatisticFacts {
  StatisticKind kind;
  const char* name;     ///< of the key fit.NAME_weight, and in results
  const char* meaning;  ///< of the key
  double usual_weight;  ///< without the key
  bool needs_pixels;    ///< larger photographs are not averaged for it
  const char*
      nonsense;  ///< why it means nothing beside profiles across a loop or away from the limb; or null
};

/// In the order of their kinds, of their keys and of their residuals.
inline constexpr std::array kStatistics = {
    StatisticFacts{StatisticKind::profile, "profile", "of intensity profiles in chi2; 0: not used", 1.0,
                   false, nullptr},
    StatisticFacts{StatisticKind::colour, "colour", "of ln(red/green) and ln(blue/green)", 0.0, false,
                   "colours of an aurora's heights mean nothing"},
    StatisticFacts{StatisticKind::horizontal, "horizontal", "of intensity profiles across the picture", 0.0,
                   false, "strips along the picture's rows mean nothing"},
    StatisticFacts{StatisticKind::border, "border", "of the lower border from band to band", 0.0, false,
                   "lower borders, sought down the columns, mean nothing"},
    StatisticFacts{StatisticKind::image, "image", "of a picture of low resolution", 0.0, false,
                   "cells with gains of the picture's columns mean nothing"},
    StatisticFacts{StatisticKind::texture, "texture", "of the autocovariance along the arc", 0.0, true,
                   "texture along the picture's rows means nothing"},
    StatisticFacts{StatisticKind::granulation, "granulation",
                   "of the angular power spectrum of the Sun's disc", 0.0, true, nullptr},
};

constexpr const StatisticFacts& facts_of(StatisticKind kind) {
  return kStatistics[static_cast<std::size_t>(kind)];
}

/// "fit.colour_weight"
inline std::string weight_key(StatisticKind kind) {
  return "fit." + std::string(facts_of(kind).name) + "_weight";
}

/// Weights of the statistics in chi2; 0: not compared.
class StatisticWeights {
 public:
  StatisticWeights();  ///< the usual ones
  double& operator[](StatisticKind kind) { return weights_[static_cast<std::size_t>(kind)]; }
  double operator[](StatisticKind kind) const { return weights_[static_cast<std::size_t>(kind)]; }

  /// Whether any statistic other than the profile for which `wanted` is true has a weight.
  template <class Wanted>
  bool any_beside_profile(const Wanted& wanted) const {
    for (const StatisticFacts& facts : kStatistics)
      if (facts.kind != StatisticKind::profile && (*this)[facts.kind] > 0.0 && wanted(facts)) return true;
    return false;
  }

 private:
  std::vector<double> weights_;
};

}  // namespace vegard::sim
