// Files of named arrays: HDF5, MATLAB, CDF, IDL's saves. What each format has to itself stays behind this
// door; those who read images or directions from it look at names, shapes and words, and ask for a block of
// numbers.
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

/// Bytes of one number; 0 of a text.
std::size_t size_of(ArrayKind kind);

/// What the numbers of an array are, where its format says that they are times.
enum class ArrayClock : std::uint8_t {
  none,
  cdf_epoch,  ///< ms since 0000-01-01, NASA's CDF_EPOCH
  tt2000,     ///< ns of terrestrial time since J2000, NASA's CDF_TIME_TT2000
};

/// Keys and values as text, in the file's order.
using ArrayWords = std::vector<std::pair<std::string, std::string>>;

struct StoredArray {
  std::string name;                 ///< with the groups or structures that it is in: "data/images"
  std::vector<std::uint64_t> dims;  ///< as they lie in memory, the last running fastest; of one number none
  ArrayKind kind = ArrayKind::u8;
  ArrayClock clock = ArrayClock::none;
  /// Of an image in it, the fastest dimension runs down a column: MATLAB's arrays.
  bool columns_first = false;
  ArrayWords words;  ///< its attributes

  std::uint64_t count() const;  ///< of its elements; no more than 2^62
};

/// All that reads throws Error(unreadable_input), naming the file, for what is damaged, larger than the
/// limits here or of a kind that is not read.
class ArrayFile {
 public:
  virtual ~ArrayFile() = default;

  const std::string& name() const { return name_; }
  /// "HDF5", "MATLAB", for messages.
  const char* format() const { return format_; }
  const std::vector<StoredArray>& arrays() const { return arrays_; }
  /// Of the file ("") and its groups by name, those that have words.
  const std::map<std::string, ArrayWords>& words() const { return words_; }

  /// A block of the array, as `start` and `count` of each dimension say: numbers of its kind in the machine's
  /// order of bytes, the last dimension running fastest.
  std::string read(const StoredArray& array, const std::vector<std::uint64_t>& start,
                   const std::vector<std::uint64_t>& count);
  /// All of it.
  std::string read(const StoredArray& array);
  /// All of it, as doubles.
  std::vector<double> read_numbers(const StoredArray& array);
  /// Of an array of texts.
  virtual std::vector<std::string> read_texts(const StoredArray& array);

 protected:
  ArrayFile(std::string name, const char* format) : name_(std::move(name)), format_(format) {}
  virtual std::string read_block(const StoredArray& array, const std::vector<std::uint64_t>& start,
                                 const std::vector<std::uint64_t>& count) = 0;
  [[noreturn]] void refuse(const std::string& problem, const std::string& expected = {},
                           const std::string& hint = {}) const;

  std::string name_;
  const char* format_;
  std::vector<StoredArray> arrays_;
  std::map<std::string, ArrayWords> words_;
};

// Limits of all formats.
constexpr std::size_t kMaxArrays = 20000;
constexpr std::size_t kMaxArrayDims = 8;
/// Of a block that is read at once.
constexpr std::uint64_t kMaxBlockBytes = std::uint64_t{1} << 29;
/// Of all words of a file.
constexpr std::size_t kMaxWordBytes = std::size_t{1} << 24;

/// The block of an array that lies in memory as a whole.
std::string block_of(std::string_view all, const StoredArray& array, const std::vector<std::uint64_t>& start,
                     const std::vector<std::uint64_t>& count);

/// Number `at` of a block.
double number_of(std::string_view block, ArrayKind kind, std::size_t at);

}  // namespace vegard::sim
