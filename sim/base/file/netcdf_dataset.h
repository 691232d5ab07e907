// A netCDF file as values: put together variable by variable, looked at, and written as a whole.
//
// Attributes follow the CF conventions, version 1.8 (https://cfconventions.org): long_name and units of every
// variable, flag_values and flag_meanings of words of a few kinds, ancillary_variables for errors.
#pragma once

#include <cstddef>
#include <deque>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sim/base/file/netcdf_file.h"

namespace vegard::sim {

/// Names as netcdf_name() has them, no two alike: the second gets _2.
class NetcdfNames {
 public:
  std::string of(const std::string& words);

 private:
  std::set<std::string> taken_;
};

/// Words of a flag as CF's flag_meanings has them: blanks between them, and none inside.
std::string netcdf_flag_meanings(const std::vector<std::string>& words);

/// The place of a word among those of a flag; kNetcdfNoFlag if it is none of them.
int flag_number(const std::vector<std::string>& words, const std::string& word);

/// A unit as UDUNITS has it: "mW m-2" of "mW m\u207b\u00b2", "degree" of "deg", "1" of none.
std::string udunits_of(const std::string& unit);

struct NetcdfVariable {
  std::string name;
  NetcdfType type = NetcdfType::real;
  std::vector<std::string> dimensions;  ///< none: one number
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<std::string> flag_words;  ///< of flags: what 0, 1, 2 ... mean
  // One of these, by its type; the last dimension runs fastest. NaN is what is missing.
  std::vector<double> reals;
  std::vector<int> numbers;
  std::vector<std::string> texts;

  /// Sets an attribute, in the place of one of that name; returns the variable itself.
  NetcdfVariable& with(const std::string& attribute, const std::string& words);
  /// Empty if there is none.
  std::string attribute(const std::string& name) const;
};

class NetcdfDataset {
 public:
  /// A dataset with its Conventions and its title; `source`: what has made the numbers.
  NetcdfDataset(const std::string& title, const std::string& source);

  void attribute(const std::string& name, const std::string& words);
  /// A name that exists already must have the same size.
  void dimension(const std::string& name, std::size_t size);

  /// `name`: any words; the variable's own name follows by netcdf_name(), and is in what is returned. An
  /// empty `unit` gives no units attribute, which is for texts and for numbers of several units. References
  /// stay good.
  NetcdfVariable& real(const std::string& name, const std::string& long_name, const std::string& unit,
                       const std::vector<std::string>& dimensions, std::vector<double> values);
  NetcdfVariable& whole(const std::string& name, const std::string& long_name, const std::string& unit,
                        const std::vector<std::string>& dimensions, std::vector<int> values);
  /// Values are places in the list of words (flag_number()), or kNetcdfNoFlag.
  NetcdfVariable& flags(const std::string& name, const std::string& long_name,
                        const std::vector<std::string>& words, const std::vector<std::string>& dimensions,
                        std::vector<int> values);
  NetcdfVariable& text(const std::string& name, const std::string& long_name,
                       const std::vector<std::string>& dimensions, std::vector<std::string> values);

  const std::deque<NetcdfVariable>& variables() const { return variables_; }
  /// Null if there is none.
  const NetcdfVariable* find(const std::string& name) const;
  /// 0 if there is none.
  std::size_t size_of(const std::string& dimension) const;

  /// Into `file`, which is replaced; errors name `shown_name`. The same dataset gives the same bytes, of one
  /// version of netCDF and HDF5. Throws Error(unwritable_output).
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

/// The whole way of a file: whole or not at all. Throws as WholeFile and NetcdfDataset::write() do.
void write_netcdf(const NetcdfDataset& dataset, const std::string& path, bool overwrite);

}  // namespace vegard::sim
