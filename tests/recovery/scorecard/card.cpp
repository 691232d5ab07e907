#include "tests/recovery/scorecard/card.h"

#include <fstream>
#include <map>
#include <stdexcept>

#include "sim/base/file/csv_table.h"

namespace vegard::scorecard {
namespace {

std::string cell(const std::string& text) { return sim::csv_cell(text); }
std::string cell(int number) { return std::to_string(number); }
std::string cell(double number) { return sim::csv_number(number); }

void put(const std::string& text, std::string& value) { value = text; }
void put(const std::string& text, int& value) { value = std::stoi(text); }
void put(const std::string& text, double& value) { value = text.empty() ? kNone : std::stod(text); }

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') {
      if (quoted && i + 1 < line.size() && line[i + 1] == '"')
        cells.back() += line[i++];
      else
        quoted = !quoted;
    } else if (line[i] == ',' && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += line[i];
    }
  }
  return cells;
}

std::string joined(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& text : cells) line += (line.empty() ? "" : ",") + text;
  return line + "\n";
}

}  // namespace

std::string csv_header() {
  std::vector<std::string> cells;
  const Row row;
  each_column(row, [&](const std::string& name, const auto&) { cells.push_back(name); });
  return joined(cells);
}

std::string csv_row(const Row& row) {
  std::vector<std::string> cells;
  each_column(row, [&](const std::string&, const auto& value) { cells.push_back(cell(value)); });
  return joined(cells);
}

std::vector<Row> read_card(const std::string& file) {
  std::ifstream stream(file);
  std::string line;
  if (!std::getline(stream, line)) throw std::runtime_error("no card: " + file);
  const std::vector<std::string> names = cells_of(line);
  std::vector<Row> rows;
  while (std::getline(stream, line)) {
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() != names.size()) throw std::runtime_error("a broken line in " + file + ": " + line);
    std::map<std::string, std::string> by_name;
    for (std::size_t i = 0; i < names.size(); ++i) by_name[names[i]] = cells[i];
    Row row;
    each_column(row, [&](const std::string& name, auto& value) {
      const auto found = by_name.find(name);
      if (found == by_name.end()) throw std::runtime_error("no column " + name + " in " + file);
      put(found->second, value);
    });
    rows.push_back(row);
  }
  return rows;
}

}  // namespace vegard::scorecard
