// The inversion of a table of line brightnesses, row by row, as a table and in words.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/columns/column_inversion.h"
#include "fit/columns/common_physics.h"
#include "fit/report/columns/inversion_texts.h"
#include "sim/base/file/csv_table.h"

namespace vegard::fit {

struct InvertedTable {
  std::vector<double> lines_nm;
  std::vector<ColumnInversion> rows;
  /// What the rows have in common told about the tables; nothing where they are taken as exact.
  std::optional<LearntPhysics> learnt;
};

/// Returns a table with the columns of `read` that `is_kept` names, and behind them energy flux, E0 (and
/// oxygen, soft_ratio where they are free), each with the ends of its 68 and 95 % intervals, empty where
/// open, chi2, chance and verdict.
std::string inverted_table_csv(const InvertedTable& inverted, const sim::CsvTable& read,
                               const std::vector<bool>& is_kept, const InversionFacts& facts);

/// Returns the number of rows of each verdict, and what the table asks of the emission tables' light.
std::string inverted_table_text(const InvertedTable& inverted, const InversionFacts& facts);

/// The same as JSON.
std::string inverted_table_json(const InvertedTable& inverted, const InversionFacts& facts);

}  // namespace vegard::fit
