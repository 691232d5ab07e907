#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/commands/inversion/invert_request.h"
#include "apps/options/exit_code.h"
#include "apps/options/json_answer.h"
#include "apps/options/refusals.h"
#include "apps/options/standard_streams.h"
#include "fit/columns/common_physics.h"
#include "fit/columns/line_measurement.h"
#include "fit/report/columns/table_texts.h"
#include "sim/base/file/csv_table.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/parallel.h"

namespace vegard::apps {
namespace {

/// A line of the table: its column, and that of its error if there is one.
struct LineColumns {
  double wavelength_nm = 0.0;
  std::size_t brightness = 0;
  std::optional<std::size_t> error;
};

bool is_number(const std::string& name) {
  char* end = nullptr;
  std::strtod(name.c_str(), &end);
  return !name.empty() && end == name.c_str() + name.size();
}

std::vector<LineColumns> line_columns(const sim::CsvTable& table) {
  std::vector<LineColumns> lines;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    if (!is_number(table.columns[c])) continue;
    LineColumns line;
    line.wavelength_nm =
        fit::line_word(table.columns[c] + "=column", "--table", "a line's wavelength in nm").wavelength_nm;
    line.brightness = c;
    for (std::size_t e = 0; e < table.columns.size(); ++e)
      if (table.columns[e] == table.columns[c] + "_error") line.error = e;
    lines.push_back(line);
  }
  if (lines.empty())
    throw sim::unreadable(table.name, "no column is named by a line")
        .expected("columns such as 427.8, 427.8_error, 557.7, 630.0, in rayleighs");
  return lines;
}

std::vector<fit::ColumnData> measurements(const sim::CsvTable& table, const std::vector<LineColumns>& lines,
                                          const InvertRequest& request) {
  const double relative = share_of(request.relative_error, "--relative-error");
  const double model = share_of(request.model_error, "--model-error");
  std::vector<fit::ColumnData> rows(table.rows());
  for (std::size_t l = 0; l < lines.size(); ++l)
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const double rayleigh = table.numbers[lines[l].brightness][r];
      const double error = lines[l].error ? table.numbers[*lines[l].error][r] : relative * rayleigh;
      if (!(error > 0.0))
        throw table
            .bad_row(
                r, fmt::format("the error of {:.1f} nm is not known, or not above 0", lines[l].wavelength_nm))
            .hint(
                fmt::format("a column {}_error, or --relative-error 5", table.columns[lines[l].brightness]));
      rows[r].rayleigh[l] = rayleigh;
      rows[r].sigma[l] = std::hypot(error, model * rayleigh);
    }
  return rows;
}

}  // namespace

int invert_table(const InvertRequest& request) {
  if (!request.plot.empty()) throw usage_error("--plot", "it is of one set of lines", "no --table with it");
  if (request.outputs.size() != 1)
    throw usage_error("--output", "a table has one output, a table", "-o OUT.csv once");
  const sim::CsvTable table = sim::read_csv_table(sim::input_bytes(request.table, "a table"), request.table);
  const std::vector<LineColumns> lines = line_columns(table);
  fit::InvertedTable inverted;
  for (const LineColumns& line : lines) inverted.lines_nm.push_back(line.wavelength_nm);
  fit::require_different_lines(inverted.lines_nm, "--table");
  const std::vector<fit::ColumnData> data = measurements(table, lines, request);
  spare_inputs(request, {request.table});
  const Inversion inversion(request, inverted.lines_nm);
  sim::WholeFiles files(request.outputs, request.overwrite);

  const fit::ColumnChi2 chi2 = inversion.chi2(1);
  if (inversion.model().modes() > 0) inverted.learnt = fit::learn_physics(chi2, data, request.threads);
  inverted.rows.resize(data.size());
  sim::parallel_for(data.size(), request.threads, [&](std::size_t r, int) {
    if (!inverted.learnt) {
      inverted.rows[r] = fit::invert_columns(chi2, data[r]);
      return;
    }
    const fit::ColumnModel model(inversion.model(), inverted.learnt->without[r]);
    inverted.rows[r] = fit::invert_columns({model, inversion.free(), inversion.fixed()}, data[r]);
  });

  std::vector<bool> is_kept(table.columns.size(), true);
  for (const LineColumns& line : lines) {
    is_kept[line.brightness] = false;
    if (line.error) is_kept[*line.error] = false;
  }
  const fit::InversionFacts facts = inversion.facts(request);
  files.write(request.outputs.front(), fit::inverted_table_csv(inverted, table, is_kept, facts));
  files.commit();
  answer_with(fit::inverted_table_json(inverted, facts));
  say_result(fit::inverted_table_text(inverted, facts));
  std::size_t contradicting = 0;
  for (const fit::ColumnInversion& row : inverted.rows)
    contradicting += row.verdict == fit::ColumnVerdict::contradiction ? 1 : 0;
  return 2 * contradicting > inverted.rows.size() ? doubted : good;
}

}  // namespace vegard::apps
