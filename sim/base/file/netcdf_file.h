// A netCDF-4 file that is written: the front of the library, which is compiled in netcdf_file.cpp alone.
//
// The same calls give the same bytes, of one version of netCDF and HDF5: the library keeps no times, neither
// of the file nor of what is in it. What attributes mean is up to who writes them (the CF conventions,
// https://cfconventions.org). The environment is changed for a moment while a file is made, so that no other
// thread may read it then.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace vegard::sim {

enum class NetcdfType {
  real,   ///< double
  whole,  ///< 32 bits
  flag,   ///< 8 bits
  text,   ///< strings of any length
};

/// What stands where a number is missing (_FillValue), as the library has it for its types.
extern const double kNetcdfNoReal;
inline constexpr int kNetcdfNoFlag = -127;

/// One that is made again. First dimensions, variables and attributes, then numbers; close() last. Whatever
/// cannot be written throws sim::Error(unwritable_output) that names `shown_name`.
class NetcdfFile {
 public:
  struct Dimension {
    int id = -1;
  };
  struct Variable {
    int id = -1;
    NetcdfType type = NetcdfType::real;
  };

  NetcdfFile(const std::string& file, const std::string& shown_name);
  ~NetcdfFile();
  NetcdfFile(const NetcdfFile&) = delete;
  NetcdfFile& operator=(const NetcdfFile&) = delete;

  Dimension dimension(const std::string& name, std::size_t size);
  /// Numbers are compressed, without loss; reals and flags have a _FillValue.
  Variable variable(const std::string& name, NetcdfType type, const std::vector<Dimension>& dimensions);

  /// Of the file itself.
  void attribute(const std::string& name, const std::string& text);
  void attribute(const Variable& of, const std::string& name, const std::string& text);
  void attribute(const Variable& of, const std::string& name, double value);
  /// Of a flag's type: flag_values.
  void flags(const Variable& of, const std::string& name, const std::vector<int>& values);

  /// Of a variable of one dimension, from `first` on; of several the whole, the last running fastest, with
  /// `first` 0. Reals that are not finite become _FillValue.
  void put(const Variable& to, std::size_t first, const std::vector<double>& values);
  void put(const Variable& to, std::size_t first, const std::vector<int>& values);
  void put(const Variable& to, std::size_t first, const std::vector<std::string>& values);

  void close();

 private:
  void require(int code) const;
  void end_of_definitions();
  std::vector<std::size_t> counts_of(const Variable& to, std::size_t values) const;

  std::string shown_name_;
  int id_ = -1;
  bool defines_ = true;
  std::vector<std::size_t> sizes_;            ///< by dimension
  std::vector<std::vector<int>> dimensions_;  ///< by variable
};

/// A name as all programs and the CF conventions take it: letters, digits and _, a letter first; what else is
/// in `words` becomes one _.
std::string netcdf_name(const std::string& words);

}  // namespace vegard::sim
