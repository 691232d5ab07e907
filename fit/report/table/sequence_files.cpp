#include "fit/report/table/sequence_files.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "fit/report/table/mode_information_json.h"
#include "sim/base/error.h"
#include "sim/base/file/csv_table.h"
#include "sim/base/number/constants.h"
#include "sim/base/version.h"

namespace vegard::fit {
namespace {

using Json = nlohmann::ordered_json;

bool contains(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

bool is_plotted(const std::string& name) {
  return contains(name, ".energy_kev") || contains(name, ".energy_flux_mw_m2") ||
         name.compare(0, 8, "distance") == 0 || name.compare(0, 12, "lower border") == 0;
}

double number_or_nan(const Json& json) { return json.is_null() ? sim::kNaN : json.get<double>(); }

}  // namespace

bool is_main_number(const std::string& name) {
  return is_plotted(name) || contains(name, "electron energy of the ") ||
         contains(name, "characteristic energy E0 of the ");
}

const SequenceNumber* find_number(const SequenceRow& row, const std::string& name) {
  for (const SequenceNumber& number : row.numbers)
    if (number.name == name) return &number;
  return nullptr;
}

std::vector<SequenceNumber> sequence_numbers(const std::vector<SequenceRow>& rows) {
  std::vector<SequenceNumber> all;
  for (const SequenceRow& row : rows)
    for (const SequenceNumber& number : row.numbers) {
      const auto same = [&](const SequenceNumber& other) { return other.name == number.name; };
      if (std::none_of(all.begin(), all.end(), same)) all.push_back(number);
    }
  return all;
}

std::string sequence_csv(const std::vector<SequenceRow>& rows) {
  const std::vector<SequenceNumber> columns = sequence_numbers(rows);
  std::string text = sim::csv_comment("a sequence of photographs, each fitted from where the last one ended");
  text += sim::csv_comment("vegard: " + sim::version());
  text += sim::csv_comment("time_s: on the scene's clock");
  text += sim::csv_comment("search: full, or warm: a descent from the frame before");
  std::vector<std::string> decodings;
  for (const SequenceRow& row : rows)
    if (std::find(decodings.begin(), decodings.end(), row.decoding) == decodings.end())
      decodings.push_back(row.decoding);
  for (const std::string& decoding : decodings) text += sim::csv_comment("decoding: " + decoding);
  text += "frame,time_s,verdict,search,chi2_per_dof";
  for (const SequenceNumber& column : columns) {
    const std::string unit = column.unit.empty() ? "" : " (" + column.unit + ")";
    text += "," + sim::csv_cell(column.name + unit) + "," + sim::csv_cell("sigma of " + column.name + unit);
  }
  text += "\n";
  for (const SequenceRow& row : rows) {
    text += sim::csv_cell(row.frame) + "," + sim::csv_number(row.time_s) + "," + verdict_name(row.verdict) +
            "," + (row.searched ? "full" : "warm") + "," + sim::csv_number(row.chi2_per_dof);
    for (const SequenceNumber& column : columns) {
      const SequenceNumber* number = find_number(row, column.name);
      text += "," + sim::csv_number(number != nullptr ? number->value : sim::kNaN) + "," +
              sim::csv_number(number != nullptr ? number->sigma.value_or(sim::kNaN) : sim::kNaN);
    }
    text += "\n";
  }
  return text;
}

Plot sequence_plot(const std::vector<SequenceRow>& rows) {
  Plot plot;
  plot.title = "The sequence";
  plot.note = "Shaded: \u00b11 \u03c3. Grey dots: the verdict is doubtful.";
  plot.columns = 1;
  plot.panel_width_px = 640;
  plot.panel_height_px = 190;
  for (const SequenceNumber& column : sequence_numbers(rows)) {
    if (!is_plotted(column.name)) continue;
    Panel panel;
    Series line, good, doubtful;
    line.colour = good.colour = distinct_colour(static_cast<int>(plot.panels.size()));
    line.width_px = 1.2;
    good.mark = doubtful.mark = Mark::points;
    good.width_px = doubtful.width_px = 6.0;
    doubtful.colour = {130, 130, 130};
    for (const SequenceRow& row : rows) {
      const SequenceNumber* number = find_number(row, column.name);
      const bool shown =
          number != nullptr && (row.verdict == Verdict::good || row.verdict == Verdict::doubtful);
      const double value = shown ? number->value : sim::kNaN;
      const double sigma = shown ? number->sigma.value_or(sim::kNaN) : sim::kNaN;
      line.x.push_back(row.time_s);
      line.y.push_back(value);
      line.low.push_back(value - sigma);
      line.high.push_back(value + sigma);
      if (!shown) continue;
      Series& points = row.verdict == Verdict::good ? good : doubtful;
      points.x.push_back(row.time_s);
      points.y.push_back(value);
    }
    panel.series = {line, good, doubtful};
    panel.title = column.name;
    panel.x.label = "time (s)";
    panel.y.label = column.unit;
    plot.panels.push_back(std::move(panel));
  }
  return plot;
}

std::string sequence_row_json(const SequenceRow& row) {
  Json json;
  json["frame"] = row.frame;
  json["time_s"] = row.time_s;
  json["photo_sha256"] = row.photo_sha256;
  json["decoding"] = row.decoding;
  json["verdict"] = verdict_name(row.verdict);
  json["searched"] = row.searched;
  json["chi2_per_dof"] = row.chi2_per_dof;
  json["values"] = row.values;
  json["numbers"] = Json::array();
  for (const SequenceNumber& n : row.numbers) {
    json["numbers"].push_back({{"name", n.name},
                               {"unit", n.unit},
                               {"value", n.value},
                               {"sigma", n.sigma ? Json(*n.sigma) : Json(nullptr)}});
    if (n.by_mode.empty()) continue;
    json["numbers"].back()["by_mode"] = n.by_mode;
    json["numbers"].back()["relative"] = n.relative;
  }
  if (!row.physics.modes.empty()) json["physics"] = mode_information_json(row.physics);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

SequenceRow sequence_row_of(const std::string& text, const std::string& file) {
  try {
    const Json json = Json::parse(text);
    SequenceRow row;
    row.frame = json.at("frame").get<std::string>();
    row.time_s = json.at("time_s").get<double>();
    row.photo_sha256 = json.at("photo_sha256").get<std::string>();
    row.decoding = json.at("decoding").get<std::string>();
    const std::string verdict = json.at("verdict").get<std::string>();
    for (const Verdict known : kVerdicts)
      if (verdict == verdict_name(known)) row.verdict = known;
    row.searched = json.at("searched").get<bool>();
    row.chi2_per_dof = number_or_nan(json.at("chi2_per_dof"));
    row.values = json.at("values").get<std::vector<double>>();
    for (const Json& n : json.at("numbers")) {
      SequenceNumber number{n.at("name"), n.at("unit"), number_or_nan(n.at("value")), {}};
      if (!n.at("sigma").is_null()) number.sigma = n.at("sigma").get<double>();
      if (n.contains("by_mode")) {
        number.by_mode = n.at("by_mode").get<std::vector<double>>();
        number.relative = n.at("relative").get<bool>();
      }
      row.numbers.push_back(number);
    }
    if (json.contains("physics")) row.physics = mode_information_of(json.at("physics"));
    return row;
  } catch (const Json::exception&) {
    throw sim::Error(sim::ErrorKind::unreadable_input, "is no row of a sequence")
        .file(file)
        .expected("what vegard sequence wrote")
        .hint("remove it, and the frame is fitted again");
  }
}

}  // namespace vegard::fit
