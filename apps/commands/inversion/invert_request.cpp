#include "apps/commands/inversion/invert_request.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "apps/options/file_names.h"
#include "apps/options/refusals.h"
#include "fit/columns/line_measurement.h"
#include "sim/base/error.h"
#include "sim/scene/table/emission_folder.h"

namespace vegard::apps {
namespace {

constexpr const char* kFreeWords[fit::kColumnUnknowns] = {"energy", "flux", "oxygen", "soft"};

fit::ColumnFreedom freedom_of(const InvertRequest& request) {
  fit::ColumnFreedom free{};
  for (const std::string& word : request.free)
    for (std::size_t k = 0; k < fit::kColumnUnknowns; ++k) free[k] = free[k] || word == kFreeWords[k];
  for (std::size_t k = 0; k < fit::kColumnUnknowns; ++k) {
    if (free[k] && request.held[k])
      throw usage_error(kHoldOptions[k], std::string("the ") + kFreeWords[k] + " is to be found",
                        "no " + std::string(kFreeWords[k]) + " in --free with it");
    if (!free[k] && !request.held[k] && (k == fit::kLnEnergy || k == fit::kLnFlux))
      throw usage_error("--free", std::string("the ") + kFreeWords[k] + " is neither free nor given",
                        std::string(kHoldOptions[k]) + " beside it");
  }
  return free;
}

fit::ColumnModelOptions options_of(const InvertRequest& request) {
  fit::ColumnModelOptions options;
  options.spectrum = electron_spectrum(request.spectrum);
  const bool is_free = freedom_of(request)[fit::kLnSoft];
  if (is_free || request.held[fit::kLnSoft])
    options.soft_kev = request.soft_kev.value_or(fit::kUsualSoftKev);
  else if (request.soft_kev)
    throw usage_error("--soft-kev", "how much of the soft component there is, is neither free nor given",
                      "soft in --free, or --soft-ratio beside it");
  options.has_modes = request.uncertainty != "none";
  return options;
}

}  // namespace

const sim::EmissionTables& inversion_tables(const InvertRequest& request) {
  sim::Scene scene;
  scene.emission.tables = request.tables;
  try {
    sim::read_emission_folder(scene, request.tables);
    return sim::emission_tables(scene);
  } catch (const sim::Error& error) {
    if (error.details().key != "emission.tables") throw;
    throw sim::Error(error).key("--tables");
  }
}

double share_of(const std::string& text, const char* option) {
  if (text.empty()) return 0.0;
  const bool has_sign = text.back() == '%';
  return fit::brightness_error(has_sign ? text : text + "%", option).relative;
}

Inversion::Inversion(const InvertRequest& request, const std::vector<double>& lines_nm)
    : free_(freedom_of(request)),
      tables_(inversion_tables(request)),
      options_(options_of(request)),
      model_(tables_, lines_nm, options_, request.threads) {
  for (std::size_t k = 0; k < fit::kColumnUnknowns; ++k) {
    if (request.held[k]) fixed_[k] = std::log(*request.held[k]);
    require_inside(k, request);
  }
  require_enough_lines(request);
}

fit::InversionFacts Inversion::facts(const InvertRequest& request) const {
  fit::InversionFacts facts;
  facts.spectrum = request.spectrum.spectrum;
  facts.soft_kev = options_.soft_kev.value_or(0.0);
  facts.tables = request.tables;
  facts.uncertainty = model_.modes() > 0 ? "modes" : "none";  // tables without modes are exact
  facts.model_error = share_of(request.model_error, "--model-error");
  return facts;
}

void Inversion::require_inside(std::size_t k, const InvertRequest& request) const {
  if (k == fit::kLnOxygen && free_[k] && !model_.knows(k))
    throw usage_error("--free", "the tables '" + request.tables + "' are for one amount of atomic oxygen",
                      "no oxygen in --free, or tables of several");
  const double least = std::exp(model_.least(k)), most = std::exp(model_.most(k));
  if (request.held[k] && !(fixed_[k] >= model_.least(k) - 1e-9 && fixed_[k] <= model_.most(k) + 1e-9))
    throw usage_error(kHoldOptions[k], fmt::format("{:g} is outside of the tables", *request.held[k]),
                      fmt::format("from {:.4g} to {:.4g}", least, most));
}

/// Lines of one upper state count once.
void Inversion::require_enough_lines(const InvertRequest& request) const {
  const char* const key = request.lines.empty() ? "--map" : "--line";
  std::size_t different = 0;
  std::string same;
  for (std::size_t l = 0; l < model_.lines(); ++l) {
    bool is_new = true;
    for (std::size_t other = 0; other < l && is_new; ++other)
      if (model_.is_multiple(l, other)) {
        is_new = false;
        same = fmt::format("; {:.1f} and {:.1f} nm have one upper state, and a fixed ratio",
                           model_.lines_nm()[other], model_.lines_nm()[l]);
      }
    different += is_new ? 1 : 0;
  }
  const auto unknowns = static_cast<std::size_t>(std::count(free_.begin(), free_.end(), true));
  if (unknowns == 0)
    throw usage_error("--free", "nothing is free", "energy, flux, oxygen or several of them");
  if (different >= unknowns) return;
  std::string hint = "--free flux --energy-kev E0 needs one line only";
  if (free_[fit::kLnOxygen])
    hint = "844.6 or 777.4 nm with 427.8 and 630.0 nm determine atomic oxygen; --free energy,flux holds it";
  else if (unknowns == 2)
    hint = "a line whose ratio to this one depends on the energy, such as 630.0 with 427.8 nm; " + hint;
  throw usage_error(key,
                    fmt::format("{} {} not enough for {} unknowns{}", different,
                                different == 1 ? "line is" : "lines are", unknowns, same),
                    fmt::format("{} different lines or more", unknowns), hint);
}

void spare_inputs(const InvertRequest& request, const std::vector<std::string>& inputs) {
  std::vector<std::pair<std::string, std::string>> outputs;
  for (const std::string& output : request.outputs) outputs.emplace_back("--output", output);
  outputs.emplace_back("--plot", request.plot);
  protect_outputs(outputs, inputs);
}

}  // namespace vegard::apps
