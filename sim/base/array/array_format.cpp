#include "sim/base/array/array_format.h"

#include "sim/base/array/cdf_file.h"
#include "sim/base/array/hdf5_file.h"
#include "sim/base/array/idl_save.h"
#include "sim/base/array/mat_file.h"
#include "sim/base/error.h"
#include "sim/base/file/input_file.h"

namespace vegard::sim {

ArrayFormat array_format(std::string_view beginning) {
  constexpr std::string_view kHdf5("\x89HDF\r\n\x1a\n", 8);
  constexpr std::size_t kUserBlock = 512;
  const auto begins = [&](std::string_view words, std::size_t at = 0) {
    return beginning.size() >= at && beginning.substr(at, words.size()) == words;
  };
  // MATLAB's files of version 7.3 are HDF5 behind a header of 512 bytes.
  if (begins(kHdf5) || begins(kHdf5, kUserBlock)) return ArrayFormat::hdf5;
  if (begins("MATLAB 5.0 MAT-file")) return ArrayFormat::mat;
  if (is_cdf(beginning)) return ArrayFormat::cdf;
  if (begins({"SR\0\4", 4}) || begins({"SR\0\6", 4})) return ArrayFormat::idl_save;
  return ArrayFormat::none;
}

ArrayFormat array_format_of(const std::string& path) {
  constexpr std::size_t kEnough = 1024;
  const InputFile begun = read_beginning(path, kEnough);
  return begun.problem.empty() ? array_format(begun.bytes) : ArrayFormat::none;
}

std::unique_ptr<ArrayFile> open_array_file(const std::string& name, std::string_view bytes) {
  const ArrayFormat format = bytes.data() != nullptr ? array_format(bytes) : array_format_of(name);
  switch (format) {
    case ArrayFormat::hdf5:
      return open_hdf5(name, bytes);
    case ArrayFormat::mat:
      return open_mat(name, bytes);
    case ArrayFormat::cdf:
      return open_cdf(name, bytes);
    case ArrayFormat::idl_save:
      return open_idl_save(name, bytes);
    case ArrayFormat::none:
      break;
  }
  refuse_file(ErrorKind::unreadable_input, name, "this is no file of arrays", "HDF5, MATLAB, CDF");
}

}  // namespace vegard::sim
