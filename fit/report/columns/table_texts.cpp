#include "fit/report/columns/table_texts.h"

#include <array>
#include <cstddef>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "fit/answer/tables_correction.h"
#include "sim/base/version.h"

namespace vegard::fit {
namespace {

struct TableColumn {
  std::size_t unknown;
  const char* name;
};
constexpr std::array<TableColumn, kColumnUnknowns> kTableColumns = {{{kLnFlux, "energy_flux_mw_m2"},
                                                                     {kLnEnergy, "energy_kev"},
                                                                     {kLnOxygen, "oxygen_factor"},
                                                                     {kLnSoft, "soft_ratio"}}};

std::string end_text(const std::optional<double>& end) { return end ? fmt::format("{:.5g}", *end) : ""; }

std::map<ColumnVerdict, std::size_t> counted(const InvertedTable& inverted) {
  std::map<ColumnVerdict, std::size_t> counts;
  for (const ColumnInversion& row : inverted.rows) ++counts[row.verdict];
  return counts;
}

}  // namespace

std::string inverted_table_csv(const InvertedTable& inverted, const sim::CsvTable& read,
                               const std::vector<bool>& is_kept, const InversionFacts& facts) {
  std::string text =
      sim::csv_comment(fmt::format("vegard invert {}, {} electrons, tables {}, uncertainty {}",
                                   sim::version(), facts.spectrum, facts.tables, facts.uncertainty));
  const std::array<ColumnEstimate, kColumnUnknowns>& first = inverted.rows.front().solutions.front().of;
  for (std::size_t c = 0; c < read.columns.size(); ++c)
    if (is_kept[c]) text += sim::csv_cell(read.columns[c]) + ",";
  for (const TableColumn& column : kTableColumns)
    if (first[column.unknown].is_free)
      text += fmt::format("{0},{0}_68_low,{0}_68_high,{0}_95_low,{0}_95_high,", column.name);
  text += "chi2,chance,verdict\n";
  for (std::size_t r = 0; r < inverted.rows.size(); ++r) {
    const ColumnInversion& row = inverted.rows[r];
    const ColumnSolution& best = row.solutions.front();
    for (std::size_t c = 0; c < read.columns.size(); ++c)
      if (is_kept[c]) text += sim::csv_number(read.numbers[c][r]) + ",";
    const bool has_answer = row.verdict != ColumnVerdict::contradiction;
    for (const TableColumn& column : kTableColumns) {
      const ColumnEstimate& e = best.of[column.unknown];
      if (!e.is_free) continue;
      text += has_answer ? fmt::format("{:.5g},{},{},{},{},", e.value, end_text(e.interval68.lower),
                                       end_text(e.interval68.upper), end_text(e.interval95.lower),
                                       end_text(e.interval95.upper))
                         : ",,,,,";
    }
    text += fmt::format("{:.4g},{},{}\n", best.chi2,
                        row.degrees_of_freedom > 0 ? fmt::format("{:.3g}", row.p_value) : "",
                        sim::csv_cell(column_verdict_name(row.verdict)));
  }
  return text;
}

std::string inverted_table_text(const InvertedTable& inverted, const InversionFacts& facts) {
  std::string text =
      fmt::format("electrons: {}, tables {}\n{} rows\n", facts.spectrum, facts.tables, inverted.rows.size());
  for (const auto& [verdict, count] : counted(inverted))
    text += fmt::format("  {:>6}  {}\n", count, column_verdict_name(verdict));
  if (!inverted.learnt) return text;
  text += fmt::format("physics in common, by {} rows:\n", inverted.learnt->used);
  for (std::size_t l = 0; l < inverted.learnt->corrections.size(); ++l) {
    const LineCorrection& line = inverted.learnt->corrections[l];
    text += "  " +
            correction_words(fmt::format("{:.1f} nm", inverted.lines_nm[l]), line.factor, line.ln_sigma,
                             line.ln_sigma_of_tables) +
            "\n";
  }
  return text;
}

std::string inverted_table_json(const InvertedTable& inverted, const InversionFacts& facts) {
  using Json = nlohmann::ordered_json;
  Json json;
  json["kind"] = "vegard invert --table";
  json["version"] = sim::version();
  json["spectrum"] = facts.spectrum;
  json["tables"] = facts.tables;
  json["uncertainty"] = facts.uncertainty;
  json["rows"] = inverted.rows.size();
  json["verdicts"] = Json::object();
  for (const auto& [verdict, count] : counted(inverted))
    json["verdicts"][column_verdict_name(verdict)] = count;
  json["lines"] = Json::array();
  for (std::size_t l = 0; l < inverted.lines_nm.size(); ++l) {
    Json line = {{"wavelength_nm", inverted.lines_nm[l]}};
    if (inverted.learnt) {
      const LineCorrection& correction = inverted.learnt->corrections[l];
      line["factor"] = correction.factor;
      line["sigma_ln"] = correction.ln_sigma;
      line["sigma_ln_of_tables"] = correction.ln_sigma_of_tables;
    }
    json["lines"].push_back(line);
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace vegard::fit
