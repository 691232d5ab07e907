// Tables of numbers as comma-separated text (or with semicolons or tabs) with a line of column names, from
// users and from data/, and the cells of tables to be written (RFC 4180).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/error.h"

namespace vegard::sim {

/// Numbers by column, in the order of the file. All columns have the same number of rows, at least one.
struct CsvTable {
  std::string name;                          ///< name of the file, for messages
  std::vector<std::string> columns;          ///< names of the columns, without blanks around them
  std::vector<std::vector<double>> numbers;  ///< [column][row]
  std::vector<int> lines;                    ///< line of every row in the file, from 1

  std::size_t rows() const { return lines.size(); }
  /// Names in other letters, capital or small, are the same unless two columns differ by them alone.
  bool has(std::string_view column) const;

  /// Returns the numbers of a column. Throws Error(unreadable_input) that lists the columns if it is not one
  /// of them.
  const std::vector<double>& column(std::string_view column) const;

  /// Returns Error(unreadable_input) about a row, with its line.
  Error bad_row(std::size_t row, const std::string& problem) const;

  /// Throws Error(unreadable_input), at the row's line, unless the column's numbers increase.
  void require_increasing(std::string_view column) const;

  /// Throws Error(unreadable_input), at the row's line, unless the column's numbers are within the limits.
  void require_within(std::string_view column, double min, double max) const;
};

/// Returns the character between the cells of a table by its line of names: a comma, or without one a
/// semicolon or a tab, as spreadsheets write where the comma is a decimal point.
char table_separator(std::string_view names);

/// Returns a cell of a table with this separator with a decimal point for a decimal comma.
std::string with_decimal_point(std::string_view cell, char separator);

/// Reads a table. Cells are separated by commas, or by semicolons or tabs (table_separator()). Empty lines
/// and those that begin with # are skipped; a byte order mark, carriage returns and blanks around a cell are
/// allowed. Throws Error(unreadable_input) with file and line if there is no row, a row has more or fewer
/// cells than there are columns, a cell is not a finite number, or two columns have one name.
CsvTable read_csv_table(std::string_view text, const std::string& name);

/// Reads an embedded table of data/ (embedded_table()).
CsvTable embedded_csv_table(const std::string& name);

/// Returns a text cell, in quotes if it contains a comma, a quote or a line break. A text that a spreadsheet
/// would take for a formula, by its first character (= + - @), gets an apostrophe before it.
std::string csv_cell(const std::string& text);

/// Returns the shortest number that reads back as the same double; empty if it is not finite.
std::string csv_number(double value);

/// Returns "# words" and a line break on a single line; line breaks in `words` become blanks.
std::string csv_comment(const std::string& words);

}  // namespace vegard::sim
