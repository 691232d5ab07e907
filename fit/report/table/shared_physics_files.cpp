#include "fit/report/table/shared_physics_files.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>

#include "fit/answer/tables_correction.h"
#include "fit/report/table/mode_information_json.h"
#include "sim/base/file/csv_table.h"
#include "sim/base/version.h"
#include "sim/scene/lines/emission_lines.h"

namespace vegard::fit {
namespace {

using PhysicsJson = nlohmann::ordered_json;

PhysicsJson number_json(double value) {
  return std::isfinite(value) ? PhysicsJson(value) : PhysicsJson(nullptr);
}

}  // namespace

const char* physics_use_name(PhysicsUse use) {
  switch (use) {
    case PhysicsUse::used:
      return "used";
    case PhysicsUse::unknown:
      return "unknown";
    case PhysicsUse::contradicts:
      break;
  }
  return "contradicts";
}

std::string shared_physics_csv(const SharedPhysics& shared, const NamesOfFrames& names) {
  std::string text = sim::csv_comment("answers with what the other pictures say of the emission tables");
  text += sim::csv_comment("vegard: " + sim::version());
  text += sim::csv_comment(shared_physics_words(shared));
  text += sim::csv_comment("alone: the fit's own answer; sigma_common does not become smaller in a mean");
  text += names.head + ",physics,name,unit,alone,alone_sigma,value,sigma,sigma_own,sigma_common\n";
  for (std::size_t i = 0; i < shared.frames.size(); ++i)
    for (const SharedNumber& n : shared.frames[i].numbers) {
      text += names.rows.at(i) + "," + physics_use_name(shared.frames[i].use) + "," + sim::csv_cell(n.name) +
              "," + sim::csv_cell(n.unit);
      for (const double value : {n.alone, n.alone_sigma, n.value, n.sigma(), n.sigma_own, n.sigma_common})
        text += "," + sim::csv_number(value);
      text += "\n";
    }
  return text;
}

std::string shared_physics_json(const SharedPhysics& shared, const std::vector<std::string>& names) {
  PhysicsJson json;
  json["words"] = shared_physics_words(shared);
  json["consistent"] = shared.is_consistent;
  json["used"] = shared.used;
  json["chi2"] = number_json(shared.chi2);
  json["degrees_of_freedom"] = shared.degrees_of_freedom;
  json["chance"] = number_json(shared.chance);
  json["factor"] = number_json(shared.factor);
  json["tables"] = corrections_json(shared.tables);
  json["means"] = PhysicsJson::array();
  for (const SharedMean& m : shared.means)
    json["means"].push_back({{"name", m.name},
                             {"unit", m.unit},
                             {"frames", m.frames},
                             {"value", number_json(m.value)},
                             {"sigma", number_json(m.sigma())},
                             {"sigma_own", number_json(m.sigma_own)},
                             {"sigma_common", number_json(m.sigma_common)},
                             {"scatter", number_json(m.scatter)}});
  json["frames"] = PhysicsJson::array();
  for (std::size_t i = 0; i < shared.frames.size(); ++i)
    json["frames"].push_back({{"name", names.at(i)},
                              {"physics", physics_use_name(shared.frames[i].use)},
                              {"chi2", number_json(shared.frames[i].chi2)},
                              {"degrees_of_freedom", shared.frames[i].degrees_of_freedom},
                              {"chance", number_json(shared.frames[i].chance)}});
  return json.dump(2, ' ', false, PhysicsJson::error_handler_t::replace) + "\n";
}

std::vector<std::string> asked_of_tables(const SharedPhysics& shared) {
  std::vector<std::string> sentences;
  for (const TablesCorrection& c : shared.tables) sentences.push_back(correction_words(c));
  return sentences;
}

}  // namespace vegard::fit
