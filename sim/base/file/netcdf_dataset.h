// NetcdfDataset: the content of a netCDF file in memory, built variable by variable and written as a whole.
//
// Attributes follow the CF conventions, version 1.8 (https://cfconventions.org): long_name and units of every
// variable, flag_values and flag_meanings of enumerations, ancillary_variables for errors.
#pragma once

#include <cstddef>
#include <deque>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sim/base/file/netcdf_file.h"

namespace vegard::sim {

/// Makes names by netcdf_name() that are all different: the second of equal names gets _2.
class NetcdfNames {
 public:
  std::string of(const std::string& words);

 private:
  std::set<std::string> taken_;
};

/// Returns the words of a flag in the form of CF's flag_meanings: separated by blanks, without blanks inside.
std::string netcdf_flag_meanings(const std::vector<std::string>& words);

/// Returns the index of a word among those of a flag; kNetcdfNoFlag if it is none of them.
int flag_number(const std::vector<std::string>& words, const std::string& word);

/// Returns a unit in the form of UDUNITS: "mW m-2" for "mW m\u207b\u00b2", "degree" for "deg", "1" for none.
std::string udunits_of(const std::string& unit);

struct NetcdfVariable {
  std::string name;
  NetcdfType type = NetcdfType::real;
  std::vector<std::string> dimensions;  ///< empty: one number
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<std::string> flag_words;  ///< of flags: the meanings of 0, 1, 2 ...
  // One of these is used, by type; the last dimension varies fastest. NaN is a missing number.
  std::vector<double> reals;
  std::vector<int> numbers;
  std::vector<std::string> texts;

  /// Sets or replaces an attribute; returns the variable itself.
  NetcdfVariable& with(const std::string& attribute, const std::string& words);
  /// Returns an attribute; empty if there is none.
  std::string attribute(const std::string& name) const;
};

class NetcdfDataset {
 public:
  /// Makes a dataset with the attributes Conventions, title and source; `source` is what has made the
  /// numbers.
  NetcdfDataset(const std::string& title, const std::string& source);

  void attribute(const std::string& name, const std::string& words);
  /// Adds a dimension. If the name exists, the size must be the same.
  void dimension(const std::string& name, std::size_t size);

  /// Adds a variable and returns it. `name` is any text; the variable's name is netcdf_name(name). An empty
  /// `unit` gives no units attribute, for numbers with several units. References stay valid.
  NetcdfVariable& real(const std::string& name, const std::string& long_name, const std::string& unit,
                       const std::vector<std::string>& dimensions, std::vector<double> values);
  NetcdfVariable& whole(const std::string& name, const std::string& long_name, const std::string& unit,
                        const std::vector<std::string>& dimensions, std::vector<int> values);
  /// Values are indices in the list of words (flag_number()), or kNetcdfNoFlag.
  NetcdfVariable& flags(const std::string& name, const std::string& long_name,
                        const std::vector<std::string>& words, const std::vector<std::string>& dimensions,
                        std::vector<int> values);
  NetcdfVariable& text(const std::string& name, const std::string& long_name,
                       const std::vector<std::string>& dimensions, std::vector<std::string> values);

  const std::deque<NetcdfVariable>& variables() const { return variables_; }
  /// Returns a variable; null if there is none.
  const NetcdfVariable* find(const std::string& name) const;
  /// Returns the size of a dimension; 0 if there is none.
  std::size_t size_of(const std::string& dimension) const;

  /// Writes to `file`, which is replaced; errors name `shown_name`. The same dataset gives the same bytes
  /// with the same versions of netCDF and HDF5. Throws Error(unwritable_output).
  void write(const std::string& file, const std::string& shown_name) const;

 private:
  NetcdfVariable& add(const std::string& name, NetcdfType type, const std::string& long_name,
                      const std::string& unit, const std::vector<std::string>& dimensions);
  std::size_t count_of(const std::vector<std::string>& dimensions) const;

  std::vector<std::pair<std::string, std::string>> attributes_;
  std::vector<std::pair<std::string, std::size_t>> dimensions_;
  std::deque<NetcdfVariable> variables_;
  NetcdfNames names_;
};

/// Writes a file completely or not at all. Throws as WholeFile and NetcdfDataset::write() do.
void write_netcdf(const NetcdfDataset& dataset, const std::string& path, bool overwrite);

}  // namespace vegard::sim
