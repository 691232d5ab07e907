// A common interface to files of named arrays: HDF5, MATLAB, CDF and IDL save files. Code that reads images
// or directions looks at names, shapes and attributes, and asks for blocks of numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vegard::sim {

enum class ArrayKind : std::uint8_t { u8, i8, u16, i16, u32, i32, u64, i64, f32, f64, text };

/// Returns the bytes of one number; 0 for texts.
std::size_t size_of(ArrayKind kind);

/// The kind of time that the numbers of an array are, if the format says so.
enum class ArrayClock : std::uint8_t {
  none,
  cdf_epoch,  ///< ms since 0000-01-01, NASA's CDF_EPOCH
  tt2000,     ///< ns of terrestrial time since J2000, NASA's CDF_TIME_TT2000
};

/// Attributes: keys and values as text, in the file's order.
using ArrayWords = std::vector<std::pair<std::string, std::string>>;

struct StoredArray {
  std::string name;                 ///< with its groups or structures: "data/images"
  std::vector<std::uint64_t> dims;  ///< in memory order, the last varies fastest; empty for one number
  ArrayKind kind = ArrayKind::u8;
  ArrayClock clock = ArrayClock::none;
  /// True if the fastest dimension of an image runs down its columns, as in MATLAB.
  bool columns_first = false;
  ArrayWords words;  ///< attributes of the array

  std::uint64_t count() const;  ///< number of elements, at most 2^62
};

/// All reading functions throw Error(unreadable_input), naming the file, for data that are damaged, beyond
/// the limits below or of an unsupported kind.
class ArrayFile {
 public:
  virtual ~ArrayFile() = default;

  const std::string& name() const { return name_; }
  /// Returns the name of the format for messages, "HDF5", "MATLAB".
  const char* format() const { return format_; }
  const std::vector<StoredArray>& arrays() const { return arrays_; }
  /// Returns the attributes of the file ("") and of its groups, by name; only of those that have any.
  const std::map<std::string, ArrayWords>& words() const { return words_; }

  /// Returns a block of the array, given by `start` and `count` for each dimension: numbers of the array's
  /// kind in native byte order; the last dimension varies fastest.
  std::string read(const StoredArray& array, const std::vector<std::uint64_t>& start,
                   const std::vector<std::uint64_t>& count);
  /// Returns the whole array.
  std::string read(const StoredArray& array);
  /// Returns the whole array as doubles.
  std::vector<double> read_numbers(const StoredArray& array);
  /// Returns an array of texts.
  virtual std::vector<std::string> read_texts(const StoredArray& array);

 protected:
  ArrayFile(std::string name, const char* format) : name_(std::move(name)), format_(format) {}
  virtual std::string read_block(const StoredArray& array, const std::vector<std::uint64_t>& start,
                                 const std::vector<std::uint64_t>& count) = 0;

  std::string name_;
  const char* format_;
  std::vector<StoredArray> arrays_;
  std::map<std::string, ArrayWords> words_;
};

// Limits of all formats.
constexpr std::size_t kMaxArrays = 20000;
constexpr std::size_t kMaxArrayDims = 8;
/// Largest block that is read at once.
constexpr std::uint64_t kMaxBlockBytes = std::uint64_t{1} << 29;
/// Largest size of all attributes of a file.
constexpr std::size_t kMaxWordBytes = std::size_t{1} << 24;

/// Returns a block of an array that is in memory as a whole.
std::string block_of(std::string_view all, const StoredArray& array, const std::vector<std::uint64_t>& start,
                     const std::vector<std::uint64_t>& count);

/// Returns the number at index `at` of a block.
double number_of(std::string_view block, ArrayKind kind, std::size_t at);

}  // namespace vegard::sim
