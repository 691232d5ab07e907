#include "fit/survey/survey_physics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <vector>

#include "fit/report/table/mode_information_json.h"
#include "fit/report/table/sequence_files.h"
#include "sim/base/error.h"

namespace vegard::fit {
namespace {

/// The number that these digits say.
double with_digits(double value, int digits) {
  return std::strtod(fmt::format("{:.{}g}", value, digits).c_str(), nullptr);
}

std::vector<double> with_digits(std::vector<double> values, int digits) {
  for (double& value : values) value = with_digits(value, digits);
  return values;
}

}  // namespace

std::optional<std::string> physics_of_row(const SequenceRow& row) {
  if (row.physics.modes.empty()) return std::nullopt;
  ModeInformation told = row.physics;
  told.information = with_digits(told.information, 9);
  told.towards = with_digits(told.towards, 9);
  for (LineByModes& line : told.lines) line.ln_ratio = with_digits(line.ln_ratio, 6);
  nlohmann::ordered_json json = mode_information_json(told);
  json["numbers"] = nlohmann::ordered_json::object();
  for (const SequenceNumber& n : row.numbers)
    if (is_main_number(n.name) && n.by_mode.size() == told.modes.size())
      json["numbers"][n.name] = {{"relative", n.relative}, {"by_mode", with_digits(n.by_mode, 6)}};
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

FrameOfNight frame_of_night(const WorkAnswer& fit, const std::string& database) {
  FrameOfNight frame;
  frame.converged = fit.verdict == "good" || fit.verdict == "doubtful";
  if (!fit.physics) return frame;
  try {
    const auto json = nlohmann::ordered_json::parse(*fit.physics);
    frame.told = mode_information_of(json);
    for (const SurveyQuantity& q : fit.quantities) {
      const auto found = json.at("numbers").find(q.name);
      if (found == json.at("numbers").end() || !q.value) continue;
      frame.numbers.push_back({q.name, q.unit, *q.value, q.sigma,
                               found->at("by_mode").get<std::vector<double>>(),
                               found->at("relative").get<bool>()});
    }
  } catch (const nlohmann::ordered_json::exception&) {
    throw sim::unreadable(database, "says of the emission tables what no fit says")
        .expected("a database of vegard survey");
  }
  return frame;
}

}  // namespace vegard::fit
