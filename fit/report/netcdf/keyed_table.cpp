#include "fit/report/netcdf/keyed_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>

#include "sim/base/error.h"
#include "sim/base/number/constants.h"

namespace vegard::fit {
namespace {

sim::Error bad_text_table(const TextTable& table, int line, const std::string& problem) {
  return sim::unreadable(table.name, problem).line(line).expected("a table that vegard wrote");
}

std::vector<std::string> cells_of_line(std::string_view line) {
  std::vector<std::string> cells(1);
  bool is_quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && is_quoted && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back() += c;
      ++i;
    } else if (c == '"') {
      is_quoted = !is_quoted;
    } else if (c == ',' && !is_quoted) {
      cells.emplace_back();
    } else if (c != '\r') {
      cells.back() += c;
    }
  }
  return cells;
}

void take_comment(std::string_view line, TextTable& table) {
  line.remove_prefix(std::min(line.find_first_not_of("# "), line.size()));
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  if (table.title.empty()) {
    table.title = std::string(line);
    return;
  }
  const std::size_t colon = line.find(": ");
  if (colon == std::string_view::npos) return;
  table.comments.emplace_back(std::string(line.substr(0, colon)), std::string(line.substr(colon + 2)));
}

}  // namespace

bool TextTable::has(std::string_view column) const {
  return std::find(columns.begin(), columns.end(), column) != columns.end();
}

std::string TextTable::comment(std::string_view key) const {
  for (const auto& [found, words] : comments)
    if (found == key) return words;
  return {};
}

TextTable read_text_table(std::string_view text, const std::string& name) {
  TextTable table;
  table.name = name;
  int line_number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = text.substr(begin, end - begin);
    begin = end + 1;
    ++line_number;
    if (line.empty() || line == "\r") continue;
    if (line[0] == '#') {
      take_comment(line, table);
      continue;
    }
    std::vector<std::string> cells = cells_of_line(line);
    if (table.columns.empty()) {
      if (std::set<std::string>(cells.begin(), cells.end()).size() != cells.size())
        throw bad_text_table(table, line_number, "two columns have one name");
      table.columns = std::move(cells);
      continue;
    }
    if (cells.size() != table.columns.size())
      throw bad_text_table(table, line_number,
                           std::to_string(cells.size()) + " cells in a table of " +
                               std::to_string(table.columns.size()) + " columns");
    table.rows.push_back(std::move(cells));
    table.lines.push_back(line_number);
  }
  if (table.rows.empty()) throw bad_text_table(table, 0, "there is no table in it");
  return table;
}

KeyedTable::KeyedTable(const TextTable& table, std::vector<std::string> keys)
    : table_(table), keys_(std::move(keys)) {
  std::size_t most = 1;
  for (const std::string& key : keys_) {
    const auto found = std::find(table.columns.begin(), table.columns.end(), key);
    if (found == table.columns.end()) throw bad_text_table(table, 0, "there is no column " + key);
    const auto column = static_cast<std::size_t>(found - table.columns.begin());
    std::map<std::string, std::size_t> known;
    places_.emplace_back();
    place_of_row_.emplace_back();
    for (const std::vector<std::string>& row : table.rows) {
      const auto [at, is_new] = known.emplace(row[column], places_.back().size());
      if (is_new) places_.back().push_back(row[column]);
      place_of_row_.back().push_back(at->second);
    }
    most *= places_.back().size();
    if (most > kMaxNumbers)
      throw bad_text_table(table, 0, "its rows are no grid: it would have more than 2^26 places")
          .expected("rows for every pair of a few values");
  }
  std::vector<char> is_taken(most, 0);
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    std::size_t at = 0;
    for (std::size_t k = 0; k < keys_.size(); ++k) at = at * places_[k].size() + place_of_row_[k][r];
    if (is_taken[at] != 0) throw bad_text_table(table, table.lines[r], "a second row of the same place");
    is_taken[at] = 1;
  }
}

std::size_t KeyedTable::key_index(const std::string& key) const {
  return static_cast<std::size_t>(std::find(keys_.begin(), keys_.end(), key) - keys_.begin());
}

const std::vector<std::string>& KeyedTable::places(const std::string& key) const {
  return places_.at(key_index(key));
}

std::vector<double> KeyedTable::place_numbers(const std::string& key) const { return numbers(key, {key}); }

double KeyedTable::number_in(std::size_t row, std::size_t column) const {
  const std::string& cell = table_.rows[row][column];
  if (cell.empty()) return sim::kNaN;
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value))
    throw bad_text_table(table_, table_.lines[row],
                         "'" + cell + "' of " + table_.columns[column] + " is no number")
        .expected("a number, or nothing");
  return value;
}

std::vector<double> KeyedTable::numbers(const std::string& column, const std::vector<std::string>& by) const {
  const auto found = std::find(table_.columns.begin(), table_.columns.end(), column);
  if (found == table_.columns.end()) throw bad_text_table(table_, 0, "there is no column " + column);
  const auto at = static_cast<std::size_t>(found - table_.columns.begin());
  std::size_t count = 1;
  for (const std::string& key : by) count *= places(key).size();
  std::vector<double> values(count, sim::kNaN);
  for (std::size_t r = 0; r < table_.rows.size(); ++r) {
    std::size_t place = 0;
    for (const std::string& key : by) place = place * places(key).size() + place_of_row_[key_index(key)][r];
    values[place] = number_in(r, at);
  }
  return values;
}

}  // namespace vegard::fit
