// A table of text in the form that vegard writes (comments, names of columns, rows), by the columns that say
// where a row belongs: what was written line by line becomes arrays of as many dimensions.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vegard::fit {

/// As it stands in the file.
struct TextTable {
  std::string name;                                           ///< of the file, for messages
  std::vector<std::pair<std::string, std::string>> comments;  ///< "# key: words", those alone
  std::string title;                                          ///< the first comment
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  ///< as many cells each as there are columns
  std::vector<int> lines;                      ///< of every row in the file, from 1

  bool has(std::string_view column) const;
  /// The words of the first comment of that key; empty if there is none.
  std::string comment(std::string_view key) const;
};

/// Cells as RFC 4180 has them. Throws sim::Error(unreadable_input) with file and line for a table without
/// rows, a row of more or fewer cells than there are columns, and columns of one name.
TextTable read_text_table(std::string_view text, const std::string& name);

class KeyedTable {
 public:
  /// Most numbers of an array.
  static constexpr std::size_t kMaxNumbers = std::size_t{1} << 26;

  /// `keys`: columns of the table. Throws sim::Error(unreadable_input) if arrays by all keys would have more
  /// than kMaxNumbers, or two rows have one place.
  KeyedTable(const TextTable& table, std::vector<std::string> keys);

  /// What stands in the key's column, each once, in the order of the rows.
  const std::vector<std::string>& places(const std::string& key) const;
  /// The same as numbers; throws as numbers() does.
  std::vector<double> place_numbers(const std::string& key) const;

  /// A column by some of the keys, the last running fastest: NaN where the cell is empty or there is no row.
  /// Of several rows of one place the last counts. Throws sim::Error(unreadable_input), with the line, for a
  /// cell that is no number.
  std::vector<double> numbers(const std::string& column, const std::vector<std::string>& by) const;

 private:
  std::size_t key_index(const std::string& key) const;
  double number_in(std::size_t row, std::size_t column) const;

  const TextTable& table_;
  std::vector<std::string> keys_;
  std::vector<std::vector<std::string>> places_;        ///< of each key
  std::vector<std::vector<std::size_t>> place_of_row_;  ///< [key][row]
};

}  // namespace vegard::fit
