#include "sim/base/file/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "sim/base/data_folders.h"
#include "sim/base/error.h"
#include "sim/base/text.h"

namespace vegard::sim {
namespace {

std::vector<std::string_view> cells_of(std::string_view line, char separator) {
  std::vector<std::string_view> cells = split(line, separator);
  for (std::string_view& cell : cells) cell = trimmed(cell);
  return cells;
}

std::optional<double> number_in(std::string_view cell) {
  if (!cell.empty() && cell.front() == '+') cell.remove_prefix(1);
  double number = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
  if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(number)) return std::nullopt;
  return number;
}

void read_header(std::string_view line, int line_number, char separator, CsvTable& table) {
  for (const std::string_view cell : cells_of(line, separator)) {
    if (cell.empty())
      throw unreadable(table.name, "a column without a name")
          .line(line_number)
          .expected("names in the first line");
    if (std::find(table.columns.begin(), table.columns.end(), cell) != table.columns.end())
      throw unreadable(table.name, "two columns are called '" + std::string(cell) + "'")
          .line(line_number)
          .expected("a name of its own for each column");
    table.columns.emplace_back(cell);
  }
  if (number_in(table.columns.front()))
    throw unreadable(table.name, "the first line begins with the number " + table.columns.front())
        .line(line_number)
        .expected("names of columns in the first line");
  table.numbers.resize(table.columns.size());
}

/// The numbers of a row that has nothing but numbers and commas, as most have; false for any other, of which
/// nothing is known.
bool read_plain_row(std::string_view line, std::vector<double>& row) {
  const char *at = line.data(), *const end = at + line.size();
  for (std::size_t c = 0; c < row.size(); ++c) {
    const auto [after, error] = std::from_chars(at, end, row[c]);
    if (error != std::errc() || !std::isfinite(row[c])) return false;
    if (c + 1 == row.size()) return after == end;
    if (after == end || *after != ',') return false;
    at = after + 1;
  }
  return false;
}

void read_row(std::string_view line, int line_number, char separator, CsvTable& table,
              std::vector<double>& row) {
  row.resize(table.columns.size());
  if (separator == ',' && read_plain_row(line, row)) {
    for (std::size_t c = 0; c < row.size(); ++c) table.numbers[c].push_back(row[c]);
    table.lines.push_back(line_number);
    return;
  }
  const std::vector<std::string_view> cells = cells_of(line, separator);
  if (cells.size() != table.columns.size())
    throw unreadable(table.name, std::to_string(cells.size()) + (cells.size() == 1 ? " cell" : " cells") +
                                     " for " + std::to_string(table.columns.size()) + " columns")
        .line(line_number)
        .expected(std::string("a number for each column, with ") +
                  (separator == ';'    ? "semicolons"
                   : separator == '\t' ? "tabs"
                                       : "commas") +
                  " between");
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const std::optional<double> number = number_in(with_decimal_point(cells[c], separator));
    if (!number)
      throw unreadable(table.name,
                       "'" + std::string(cells[c]) + "' in column '" + table.columns[c] + "' is no number")
          .line(line_number)
          .expected("a finite number such as 1.5e-3");
    table.numbers[c].push_back(*number);
  }
  table.lines.push_back(line_number);
}

/// The index of a column; the number of columns if there is none.
std::size_t find_column(const std::vector<std::string>& columns, std::string_view name) {
  const auto found = std::find(columns.begin(), columns.end(), name);
  if (found != columns.end()) return static_cast<std::size_t>(found - columns.begin());
  const std::string small = lowered(name);
  std::size_t index = columns.size();
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (lowered(columns[i]) != small) continue;
    if (index != columns.size()) return columns.size();
    index = i;
  }
  return index;
}

}  // namespace

char table_separator(std::string_view names) {
  for (const char separator : {',', ';', '\t'})
    if (names.find(separator) != std::string_view::npos) return separator;
  return ',';
}

std::string with_decimal_point(std::string_view cell, char separator) {
  std::string text(cell);
  if (separator == ',' || std::count(text.begin(), text.end(), ',') != 1 || text.find('.') != text.npos)
    return text;
  text[text.find(',')] = '.';
  return text;
}

bool CsvTable::has(std::string_view column_name) const {
  return find_column(columns, column_name) != columns.size();
}

const std::vector<double>& CsvTable::column(std::string_view column_name) const {
  const std::size_t found = find_column(columns, column_name);
  if (found == columns.size())
    throw unreadable(name, "there is no column '" + std::string(column_name) + "'")
        .expected("that column; it has " + joined(columns));
  return numbers[found];
}

Error CsvTable::bad_row(std::size_t row, const std::string& problem) const {
  return unreadable(name, problem).line(lines.at(row));
}

void CsvTable::require_increasing(std::string_view column_name) const {
  const std::vector<double>& values = column(column_name);
  for (std::size_t r = 1; r < values.size(); ++r)
    if (!(values[r] > values[r - 1]))
      throw unreadable(name, "'" + std::string(column_name) + "' does not increase")
          .line(lines[r])
          .expected("rows in the order of that column");
}

void CsvTable::require_within(std::string_view column_name, double min, double max) const {
  const std::vector<double>& values = column(column_name);
  for (std::size_t r = 0; r < values.size(); ++r)
    if (!(values[r] >= min && values[r] <= max)) {
      const auto text = [](double number) {
        char buffer[32];
        const auto end = std::to_chars(buffer, buffer + sizeof buffer, number).ptr;
        return std::string(buffer, end);
      };
      throw unreadable(name, text(values[r]) + " in column '" + std::string(column_name) + "'")
          .line(lines[r])
          .expected("from " + text(min) + " to " + text(max));
    }
}

CsvTable read_csv_table(std::string_view text, const std::string& name) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.substr(0, kByteOrderMark.size()) == kByteOrderMark) text.remove_prefix(kByteOrderMark.size());
  CsvTable table;
  table.name = name;
  int line_number = 0;
  char separator = ',';
  std::vector<double> row;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    ++line_number;
    if (line.empty() || line.front() == '#') continue;
    if (table.columns.empty()) {
      separator = table_separator(line);
      read_header(line, line_number, separator, table);
    } else {
      read_row(line, line_number, separator, table, row);
    }
  }
  if (table.columns.empty())
    throw unreadable(name, "is empty").expected("a line of column names, then numbers");
  if (table.lines.empty())
    throw unreadable(name, "has no rows").expected("numbers below the line of column names");
  return table;
}

CsvTable embedded_csv_table(const std::string& name) { return read_csv_table(embedded_table(name), name); }

std::string csv_cell(const std::string& text) {
  // A spreadsheet would take such a text for a formula and compute it; an apostrophe says that it is text.
  const bool is_formula =
      !text.empty() && std::string_view("=+-@\t\r").find(text[0]) != std::string_view::npos;
  if (!is_formula && text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = is_formula ? "\"'" : "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + "\"";
}

std::string csv_number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

std::string csv_comment(const std::string& words) {
  std::string line = "# " + words;
  for (char& c : line)
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  return line + "\n";
}

}  // namespace vegard::sim
