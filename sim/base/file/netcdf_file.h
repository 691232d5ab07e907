// NetcdfFile: writes a netCDF-4 file. Only netcdf_file.cpp includes the library.
//
// The same calls give the same bytes with the same versions of netCDF and HDF5: no times are stored. The
// caller is responsible for the meaning of attributes (the CF conventions, https://cfconventions.org). While
// a file is created, the environment of the process is changed for a moment; no other thread may read it
// then.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace vegard::sim {

enum class NetcdfType {
  real,   ///< double
  whole,  ///< 32-bit integer
  flag,   ///< 8-bit integer
  text,   ///< strings of any length
};

/// The values of missing numbers (_FillValue), which are the library's defaults.
extern const double kNetcdfNoReal;
inline constexpr int kNetcdfNoFlag = -127;

/// A file that is created or replaced. Call dimension(), variable() and the attributes first, then put(), and
/// close() last. Throws sim::Error(unwritable_output) that names `shown_name` if writing fails.
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
  /// Adds a variable. Numbers are compressed without loss; reals and flags have a _FillValue.
  Variable variable(const std::string& name, NetcdfType type, const std::vector<Dimension>& dimensions);

  /// Set an attribute of the file, or of a variable.
  void attribute(const std::string& name, const std::string& text);
  void attribute(const Variable& variable, const std::string& name, const std::string& text);
  void attribute(const Variable& variable, const std::string& name, double value);
  /// Sets an attribute of the flag's type, such as flag_values.
  void flags(const Variable& variable, const std::string& name, const std::vector<int>& values);

  /// Write values: of a variable with one dimension from the index `first` on; of one with several dimensions
  /// the whole, the last dimension varying fastest, with `first` 0. Reals that are not finite become
  /// _FillValue.
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
  mutable bool has_failed_ = false;  ///< the library cannot close the file any more
  bool defines_ = true;
  std::vector<std::size_t> sizes_;            ///< by dimension
  std::vector<std::vector<int>> dimensions_;  ///< by variable
};

/// Returns a name that all programs and the CF conventions accept: letters, digits and _, with a letter
/// first; other characters in `words` become one _.
std::string netcdf_name(const std::string& words);

}  // namespace vegard::sim
