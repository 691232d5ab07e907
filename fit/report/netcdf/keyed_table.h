// Reads a text table in vegard's format (comments, names of columns, rows) and converts columns to arrays.
// Key columns, such as band and row, give the place of each row in the array.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vegard::fit {

/// The table as it is in the file.
struct TextTable {
  std::string name;                                           ///< of the file, for messages
  std::vector<std::pair<std::string, std::string>> comments;  ///< comments of the form "# key: words"
  std::string title;                                          ///< the first comment
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  ///< each with as many cells as there are columns
  std::vector<int> lines;                      ///< line number in the file of each row, from 1

  bool has(std::string_view column) const;
  /// The words of the first comment with this key; empty if there is none.
  std::string comment(std::string_view key) const;
};

/// Parses a table; cells are quoted as in RFC 4180. Throws sim::Error(unreadable_input) with file and line
/// for a table without rows, a row with more or fewer cells than columns, and columns of the same name.
TextTable read_text_table(std::string_view text, const std::string& name);

class KeyedTable {
 public:
  /// Largest number of elements of an array.
  static constexpr std::size_t kMaxNumbers = std::size_t{1} << 26;

  /// `keys` are columns of the table, which must outlive this object. Throws sim::Error(unreadable_input) if
  /// arrays by all keys would have more than kMaxNumbers elements, or if two rows have the same keys.
  KeyedTable(const TextTable& table, std::vector<std::string> keys);

  /// The distinct values of the key's column, in the order of the rows.
  const std::vector<std::string>& places(const std::string& key) const;
  /// places() as numbers; throws as numbers() does.
  std::vector<double> place_numbers(const std::string& key) const;

  /// A column as an array with some of the keys as dimensions, the last varying fastest: NaN where the cell
  /// is empty or there is no row. If several rows have the same place, the last one is used. Throws
  /// sim::Error(unreadable_input), with the line, for a cell that is not a number.
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
