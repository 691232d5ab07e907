// The cards of a FITS header, read without CFITSIO (FITS standard 4.0, section 4): keywords with their
// values, and how many bytes of data they say follow.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace vegard::sim {

inline constexpr std::size_t kFitsCardBytes = 80, kFitsBlockBytes = 2880;

/// Returns the keyword of a card.
std::string_view fits_key(std::string_view card);

struct FitsValue {
  std::string text;  ///< without quotes, and without spaces behind it
  bool is_quoted = false;
  std::string unit;  ///< "ms" of a comment that begins with [ms]
};
using FitsValues = std::map<std::string, FitsValue, std::less<>>;

/// The size of the data behind a header, by its keywords one after the other.
class FitsDataSize {
 public:
  static bool depends_on(std::string_view key);
  void take(std::string_view key, double number);
  /// Without the filling of the last block; rounded above 2^53 bytes, of which no file has so many.
  double bytes() const { return has_axes_ ? (values_ + beside_) * groups_ * value_bytes_ : 0.0; }
  double blocks() const;

 private:
  double value_bytes_ = 0.0, values_ = 1.0, beside_ = 0.0, groups_ = 1.0;
  bool has_axes_ = false;
};

/// One header; its cards are part of the bytes that it was made of, which must outlive it.
class FitsCards {
 public:
  /// The bytes begin with the header. A keyword that is there twice has its first value.
  explicit FitsCards(std::string_view bytes);

  bool has_end() const { return has_end_; }
  /// Bytes in whole blocks, at most those that there are.
  std::size_t size() const { return size_; }
  const std::vector<std::string_view>& cards() const { return cards_; }  ///< without END
  const FitsValues& values() const { return values_; }
  const std::set<std::string>& twice() const { return twice_; }

  bool holds(std::string_view key) const { return values_.find(key) != values_.end(); }
  /// Empty if there is none.
  std::string text(std::string_view key) const;

  /// True for the header of an image, and for that of a table in which an image is packed.
  bool is_of_image() const;
  /// Nothing for sizes that are none.
  std::optional<FitsDataSize> data_size() const;

 private:
  std::vector<std::string_view> cards_;
  FitsValues values_;
  std::set<std::string> twice_;
  std::size_t size_ = 0;
  bool has_end_ = false;
};

/// A value as a number, whose exponent may be written with D; nothing if it is none, or not finite.
std::optional<double> fits_number(const FitsValues& values, std::string_view key);

/// Returns the values of a file's first image, in the first header or an extension, and those of the first
/// header that it lacks; of the first header alone if there is no image, or if its header lies beyond the
/// bytes; none for bytes that are not FITS. Never throws.
FitsValues fits_image_values(std::string_view bytes);

}  // namespace vegard::sim
