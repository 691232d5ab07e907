#include "sim/base/picture/fits_packing.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "sim/base/error.h"

namespace vegard::sim {
namespace {

/// The cards of one header as text.
class Header {
 public:
  explicit Header(std::string_view bytes) {
    constexpr std::size_t kCard = 80, kKey = 8, kBlock = 2880;
    std::size_t at = 0;
    for (; at + kCard <= bytes.size(); at += kCard) {
      const std::string_view card = bytes.substr(at, kCard);
      std::string key(card.substr(0, kKey));
      key.erase(key.find_last_not_of(' ') + 1);
      if (key == "END") break;
      if (card.substr(kKey, 2) != "= ") continue;
      if (!values_.emplace(key, value_of(card.substr(kKey + 2))).second) twice_.insert(key);
    }
    size_ = std::min(bytes.size(), (at / kBlock + 1) * kBlock);
  }

  bool holds(const std::string& key) const { return values_.count(key) > 0; }
  std::string text(const std::string& key) const {
    const auto found = values_.find(key);
    return found == values_.end() ? std::string() : found->second;
  }
  const std::set<std::string>& twice() const { return twice_; }
  std::size_t size() const { return size_; }

 private:
  /// Without quotes, comment and spaces around it.
  static std::string value_of(std::string_view field) {
    const std::size_t begin = field.find_first_not_of(' ');
    if (begin == std::string_view::npos) return {};
    const bool quoted = field[begin] == '\'';
    std::string value(field.substr(begin + (quoted ? 1 : 0)));
    value.resize(std::min(value.size(), value.find(quoted ? '\'' : '/')));
    value.erase(value.find_last_not_of(' ') + 1);
    return value;
  }

  std::map<std::string, std::string> values_;
  std::set<std::string> twice_;
  std::size_t size_ = 0;
};

/// Whether a Rice stream (FITS standard 4.0, section 10.4.1) of `bytes` holds that many pixels. CFITSIO looks
/// for the end of a row of zeros wherever it may be.
bool rice_holds(std::string_view bytes, long long pixels, int number_bytes, long long block) {
  const int bits_of_shift = number_bytes == 1 ? 3 : number_bytes == 2 ? 4 : 5;
  const int plain = number_bytes == 1 ? 6 : number_bytes == 2 ? 14 : 25;
  const std::size_t end = 8 * bytes.size();
  std::size_t at = 8 * static_cast<std::size_t>(number_bytes);  // the first number, as it is
  const auto bit = [&] { return static_cast<unsigned char>(bytes[at / 8]) >> (7 - at % 8) & 1; };
  for (long long done = 0; done < pixels; done += block) {
    if (at + bits_of_shift > end) return false;
    int shift = -1, code = 0;
    for (int i = 0; i < bits_of_shift; ++i, ++at) code = code << 1 | bit();
    shift += code;
    const long long here = std::min(block, pixels - done);
    if (shift < 0) continue;  // all the same
    if (shift > plain) return false;
    if (shift == plain) {
      at += static_cast<std::size_t>(8 * number_bytes * here);
    } else {
      for (long long i = 0; i < here; ++i) {
        while (at < end && bit() == 0) ++at;
        at += 1 + static_cast<std::size_t>(shift);
        if (at > end) return false;
      }
    }
    if (at > end) return false;
  }
  return true;
}

class Packing {
 public:
  Packing(const Header& header, std::string_view bytes, const std::string& name)
      : header_(header), data_(bytes.substr(header.size())), name_(name) {}

  void check() {
    check_algorithm();
    check_keys();
    check_tiles();
    check_columns();
    check_descriptors();
  }

 private:
  [[noreturn]] void refuse(const std::string& problem, const std::string& expected,
                           const std::string& hint) const {
    throw unreadable(name_, problem).expected(expected).hint(hint);
  }

  [[noreturn]] void damaged(const std::string& problem) const {
    refuse("its packed image is damaged: " + problem, "", kCopyAgain);
  }

  std::string text(const std::string& key) const { return header_.text(key); }

  /// An integer between these; `if_absent` where there is none.
  long long integer(const std::string& key, long long least, long long most,
                    std::optional<long long> if_absent = {}) const {
    const std::string digits = text(key);
    if (digits.empty() && if_absent) return *if_absent;
    char* end = nullptr;
    const long long value = std::strtoll(digits.c_str(), &end, 10);
    if (digits.empty() || *end != '\0' || value < least || value > most)
      damaged(key + " is " + (digits.empty() ? "missing" : digits));
    return value;
  }

  void check_algorithm() {
    const std::string algorithm = text("ZCMPTYPE");
    if (algorithm != "RICE_1" && algorithm != "RICE_ONE")
      refuse("a FITS image packed as '" + algorithm + "' is not read",
             "RICE_1, or an image that is not packed", "unpack it with funpack first");
    const std::string bits = text("ZBITPIX");
    if (bits != "8" && bits != "16" && bits != "32" && bits != "-32" && bits != "-64")
      damaged("ZBITPIX is " + (bits.empty() ? "missing" : bits));
    integer("ZDITHER0", 1, 10000, 1);
    for (int i = 1; !text("ZNAME" + std::to_string(i)).empty(); ++i) {
      const std::string number = std::to_string(i), what = text("ZNAME" + number);
      if (what == "BLOCKSIZE") block_ = integer("ZVAL" + number, 16, 32);
      if (block_ % 16 != 0) damaged("its blocks are odd");
      if (what == "BYTEPIX") number_bytes_ = integer("ZVAL" + number, 1, 4);
      if (number_bytes_ == 3) damaged("its numbers have three bytes");
    }
  }

  /// CFITSIO takes now the one and now the other of two.
  void check_keys() const {
    for (const std::string& key : header_.twice())
      for (const char* start : {"Z", "NAXIS", "TFORM", "TTYPE", "TFIELDS", "THEAP", "PCOUNT", "GCOUNT"})
        if (key.rfind(start, 0) == 0) damaged(key + " is there twice");
  }

  void check_tiles() {
    constexpr long long kMaxAxes = 6, kMaxTiles = 1LL << 28;
    rows_ = integer("NAXIS2", 1, kMaxTiles);
    long long tiles = 1;
    const long long axes = integer("ZNAXIS", 1, kMaxAxes);
    for (long long a = 1; a <= axes; ++a) {
      const std::string axis = std::to_string(a);
      const long long length = integer("ZNAXIS" + axis, 1, 1LL << 30);
      const long long tile = integer("ZTILE" + axis, 1, length, a == 1 ? length : 1);
      const long long along = (length + tile - 1) / tile;
      if (along > kMaxTiles / tiles) damaged("there are too many tiles");
      tiles *= along;
      axes_.push_back({length, tile, along});
    }
    if (tiles != rows_)
      damaged("it has " + std::to_string(rows_) + " tiles, and " + std::to_string(tiles) + " make its image");
  }

  /// Bytes of a column's entry in a row; `descriptor` is how many bytes each of its two numbers has, or 0.
  long long entry_bytes(const std::string& form, int& descriptor) const {
    const std::size_t letter = form.find_first_not_of("0123456789");
    if (letter == std::string::npos || letter > 4) damaged("a column has the form '" + form + "'");
    const long long repeat = letter == 0 ? 1 : std::strtoll(form.c_str(), nullptr, 10);
    descriptor = form[letter] == 'P' ? 4 : form[letter] == 'Q' ? 8 : 0;
    if (descriptor > 0 && repeat > 1) damaged("a column has the form '" + form + "'");
    switch (form[letter]) {
      case 'B':
      case 'A':
      case 'L':
        return repeat;
      case 'I':
        return 2 * repeat;
      case 'J':
      case 'E':
        return 4 * repeat;
      case 'K':
      case 'D':
      case 'P':
        return 8 * repeat;
      case 'Q':
        return 16 * repeat;
      default:
        damaged("a column has the form '" + form + "'");
    }
  }

  void check_columns() {
    constexpr long long kMaxColumns = 999;
    const long long columns = integer("TFIELDS", 1, kMaxColumns);
    bool seen = false;
    for (long long c = 1; c <= columns; ++c) {
      const std::string column = std::to_string(c), title = text("TTYPE" + column);
      int descriptor = 0;
      const long long bytes = entry_bytes(text("TFORM" + column), descriptor);
      if (title == "COMPRESSED_DATA") {
        if (seen || descriptor == 0) damaged("its column COMPRESSED_DATA is none of tiles");
        seen = true;
        tiles_ = {title, row_bytes_, descriptor};
      } else if (descriptor > 0) {
        others_.push_back({title, row_bytes_, descriptor});
      }
      row_bytes_ += bytes;
    }
    if (!seen) damaged("it has no column COMPRESSED_DATA");
    if (integer("NAXIS1", 1, 1 << 20) != row_bytes_) damaged("its columns do not make up a row");
  }

  struct Axis {
    long long length = 1, tile = 1, along = 1;
  };

  /// Tiles at the far ends may be smaller.
  long long pixels_of(long long row) const {
    long long pixels = 1;
    for (const Axis& axis : axes_) {
      const long long begin = row % axis.along * axis.tile;
      pixels *= std::min(axis.tile, axis.length - begin);
      row /= axis.along;
    }
    return pixels;
  }

  struct Descriptors {
    std::string title;
    long long at = 0;  ///< in a row
    int bytes = 4;     ///< of a number
  };

  /// The length (0) or the place (1) of what a row has in the column; -1 for what is too large to be either.
  long long described(const Descriptors& column, long long row, int which) const {
    const auto at = static_cast<std::size_t>(row * row_bytes_ + column.at + which * column.bytes);
    std::uint64_t value = 0;
    for (int i = 0; i < column.bytes; ++i) value = value << 8 | static_cast<unsigned char>(data_[at + i]);
    return value >> 62 != 0 ? -1 : static_cast<long long>(value);
  }

  void check_descriptors() const {
    const long long size = static_cast<long long>(data_.size()), table = row_bytes_ * rows_;
    const long long end = table + integer("PCOUNT", 0, 1LL << 40);
    if (end > size) refuse("the file is truncated: it ends inside its packed image", "", kCopyAgain);
    const long long heap_bytes = end - integer("THEAP", table, end, table);
    for (long long row = 0; row < rows_; ++row) {
      for (const Descriptors& column : others_)
        if (described(column, row, 0) != 0)
          refuse("a packed FITS image with something in its column " + column.title + " is not read", "",
                 "unpack it with funpack first");
      const long long length = described(tiles_, row, 0), place = described(tiles_, row, 1);
      // A tile begins with its first number as it is.
      if (length <= number_bytes_ || place < 0 || place > heap_bytes || length > heap_bytes - place)
        damaged("tile " + std::to_string(row + 1) + " does not lie inside it");
      const auto at = static_cast<std::size_t>(end - heap_bytes + place);
      if (!rice_holds(data_.substr(at, static_cast<std::size_t>(length)), pixels_of(row),
                      static_cast<int>(number_bytes_), block_))
        damaged("tile " + std::to_string(row + 1) + " is cut");
    }
  }

  const Header& header_;
  std::string_view data_;
  const std::string& name_;
  long long rows_ = 0, row_bytes_ = 0, number_bytes_ = 4, block_ = 32;
  std::vector<Axis> axes_;
  Descriptors tiles_;
  std::vector<Descriptors> others_;  ///< of tiles packed otherwise, or not
};

}  // namespace

void check_fits_packing(std::string_view bytes, const std::string& name) {
  const Header header(bytes);
  if (header.holds("ZIMAGE")) Packing(header, bytes, name).check();
}

}  // namespace vegard::sim
