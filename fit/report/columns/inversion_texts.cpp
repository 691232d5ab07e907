#include "fit/report/columns/inversion_texts.h"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "sim/base/number/constants.h"
#include "sim/base/version.h"

namespace vegard::fit {
namespace {

using Json = nlohmann::ordered_json;

struct UnknownWords {
  const char* words;
  const char* key;
};
constexpr UnknownWords kUnknownWords[kColumnUnknowns] = {{"E0 (keV)", "energy_kev"},
                                                         {"energy flux (mW m⁻²)", "energy_flux_mw_m2"},
                                                         {"oxygen factor", "oxygen_factor"}};
constexpr std::size_t kShownOrder[kColumnUnknowns] = {kLnFlux, kLnEnergy, kLnOxygen};

std::string column_interval_text(const OpenInterval& interval) {
  if (interval.lower && interval.upper)
    return fmt::format("{:.4g} to {:.4g}", *interval.lower, *interval.upper);
  if (interval.upper) return fmt::format("below {:.4g}", *interval.upper);
  if (interval.lower) return fmt::format("above {:.4g}", *interval.lower);
  return "any of the tables'";
}

/// Padded by characters, of which a sign such as ² has several bytes.
std::string padded(const std::string& text, std::size_t width) {
  std::size_t characters = 0;
  for (const char c : text) characters += (static_cast<unsigned char>(c) & 0xC0u) != 0x80u ? 1 : 0;
  return text + std::string(characters < width ? width - characters : 1, ' ');
}

std::string chance_text(double chance) {
  const double per_cent = 100.0 * chance;
  if (per_cent < 0.01) return "below 0.01 %";
  return per_cent < 1.0 ? fmt::format("{:.2f} %", per_cent) : fmt::format("{:.0f} %", per_cent);
}

std::string solution_text(const ColumnInversion& inversion, const ColumnSolution& solution) {
  std::string text = padded("", 24) + padded("value", 11) + padded("68 %", 20) + "95 %\n";
  for (const std::size_t k : kShownOrder) {
    const ColumnEstimate& e = solution.of[k];
    if (!e.is_free && k == kLnOxygen && e.value == 1.0) continue;
    text += "  " + padded(kUnknownWords[k].words, 22) + padded(fmt::format("{:.4g}", e.value), 11);
    text += e.is_free
                ? padded(column_interval_text(e.interval68), 20) + column_interval_text(e.interval95) + "\n"
                : "held\n";
  }
  for (std::size_t l = 0; l < inversion.lines_nm.size(); ++l)
    text += fmt::format("  {:.1f} nm: {:.5g} ± {:.3g} R, by these electrons {:.5g} R ({:+.1f} σ)\n",
                        inversion.lines_nm[l], inversion.data.rayleigh[l], inversion.data.sigma[l],
                        solution.rayleigh[l],
                        (inversion.data.rayleigh[l] - solution.rayleigh[l]) / inversion.data.sigma[l]);
  return text;
}

Json json_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json interval_json(const OpenInterval& interval) {
  return {interval.lower ? Json(*interval.lower) : Json(nullptr),
          interval.upper ? Json(*interval.upper) : Json(nullptr)};
}

Json solution_json(const ColumnSolution& solution) {
  Json json;
  for (const std::size_t k : kShownOrder) {
    const ColumnEstimate& e = solution.of[k];
    Json one = {{"value", json_or_null(e.value)}, {"free", e.is_free}};
    if (e.is_free) {
      one["sigma_ln"] = json_or_null(e.sigma_ln);
      one["sigma_ln_if_others_known"] = json_or_null(e.sigma_ln_alone);
      one["interval68"] = interval_json(e.interval68);
      one["interval95"] = interval_json(e.interval95);
    }
    json[kUnknownWords[k].key] = one;
  }
  json["chi2"] = json_or_null(solution.chi2);
  json["correlations"] = Json::object();
  for (std::size_t a = 0; a < kColumnUnknowns; ++a)
    for (std::size_t b = a + 1; b < kColumnUnknowns; ++b)
      if (solution.of[a].is_free && solution.of[b].is_free)
        json["correlations"][std::string(kUnknownWords[a].key) + "," + kUnknownWords[b].key] =
            json_or_null(solution.correlation(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)));
  json["rayleigh"] = solution.rayleigh;
  return json;
}

}  // namespace

std::string inversion_text(const ColumnInversion& inversion, const InversionFacts& facts) {
  std::string text = fmt::format("electrons: {}, tables {}\n", facts.spectrum, facts.tables);
  for (std::size_t s = 0; s < inversion.solutions.size(); ++s) {
    const ColumnSolution& solution = inversion.solutions[s];
    if (inversion.solutions.size() > 1)
      text += fmt::format("solution {}: chi² {:.3g}\n", s + 1, solution.chi2);
    text += solution_text(inversion, solution);
  }
  const ColumnSolution& best = inversion.solutions.front();
  text += fmt::format("chi² {:.3g}, {} degree{} of freedom", best.chi2, inversion.degrees_of_freedom,
                      inversion.degrees_of_freedom == 1 ? "" : "s");
  if (inversion.degrees_of_freedom > 0)
    text += " (so much or more by chance: " + chance_text(inversion.p_value) + ")";
  else if (inversion.verdict != ColumnVerdict::contradiction)
    text += ": whether the lines agree is not known";
  text += "\n";
  for (std::size_t a = 0; a < kColumnUnknowns; ++a)
    for (std::size_t b = a + 1; b < kColumnUnknowns; ++b)
      if (best.of[a].is_free && best.of[b].is_free)
        text += fmt::format("correlation of ln {} and ln {}: {:+.2f}\n", kUnknownWords[a].words,
                            kUnknownWords[b].words,
                            best.correlation(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)));
  text += fmt::format("verdict: {}; {}\n", column_verdict_name(inversion.verdict), inversion.reason);
  for (const std::string& words : inversion.degeneracies) text += words + "\n";
  if (facts.model_error == 0.0) text += "errors of the tables are not in this: see --model-error\n";
  return text;
}

std::string inversion_json(const ColumnInversion& inversion, const InversionFacts& facts) {
  Json json;
  json["kind"] = "vegard invert";
  json["version"] = sim::version();
  json["spectrum"] = facts.spectrum;
  json["tables"] = facts.tables;
  json["model_error"] = facts.model_error;
  json["lines"] = Json::array();
  for (std::size_t l = 0; l < inversion.lines_nm.size(); ++l)
    json["lines"].push_back({{"wavelength_nm", inversion.lines_nm[l]},
                             {"rayleigh", inversion.data.rayleigh[l]},
                             {"sigma_rayleigh", inversion.data.sigma[l]}});
  json["verdict"] = column_verdict_name(inversion.verdict);
  json["reason"] = inversion.reason;
  json["degrees_of_freedom"] = inversion.degrees_of_freedom;
  json["chance"] = inversion.degrees_of_freedom > 0 ? Json(inversion.p_value) : Json(nullptr);
  json["degeneracies"] = inversion.degeneracies;
  json["solutions"] = Json::array();
  for (const ColumnSolution& solution : inversion.solutions)
    json["solutions"].push_back(solution_json(solution));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace vegard::fit
