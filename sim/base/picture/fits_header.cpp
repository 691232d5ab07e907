#include "sim/base/picture/fits_header.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "sim/base/error.h"
#include "sim/base/file/byte_stream.h"
#include "sim/base/picture/fits_cards.h"

namespace vegard::sim {
namespace {

/// Returns the integer after "= ", alone or before a comment.
std::optional<long long> whole_number(std::string_view card) {
  std::string_view text = card.substr(8);
  if (text.substr(0, 2) != "= ") return {};
  text = text.substr(2, text.find('/') - 2);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  while (!text.empty() && (text.front() == ' ' || text.front() == '+')) text.remove_prefix(1);
  long long number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return number;
}

/// True if a Rice stream (FITS standard 4.0, section 10.4.1) has this many pixels in `bytes`. CFITSIO
/// searches for the end of a row of zeros also beyond them.
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
  Packing(const FitsCards& header, std::string_view bytes, const std::string& name)
      : header_(header), data_(bytes.substr(header.size())), name_(name) {}

  void check() {
    check_algorithm();
    check_keys();
    check_tiles();
    check_columns();
    check_descriptors();
  }

 private:
  Error bad_image(const std::string& problem) const {
    return unreadable(name_, "its packed image is damaged: " + problem).hint(kCopyAgain);
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
      throw bad_image(key + " is " + (digits.empty() ? "missing" : digits));
    return value;
  }

  void check_algorithm() {
    const std::string algorithm = text("ZCMPTYPE");
    if (algorithm != "RICE_1" && algorithm != "RICE_ONE")
      throw unreadable(name_, "a FITS image packed as '" + algorithm + "' is not read")
          .expected("RICE_1, or an image that is not packed")
          .hint("unpack it with funpack first");
    const std::string bits = text("ZBITPIX");
    if (bits != "8" && bits != "16" && bits != "32" && bits != "-32" && bits != "-64")
      throw bad_image("ZBITPIX is " + (bits.empty() ? "missing" : bits));
    integer("ZDITHER0", 1, 10000, 1);
    for (int i = 1; !text("ZNAME" + std::to_string(i)).empty(); ++i) {
      const std::string number = std::to_string(i), what = text("ZNAME" + number);
      if (what == "BLOCKSIZE") block_ = integer("ZVAL" + number, 16, 32);
      if (block_ % 16 != 0) throw bad_image("its blocks are odd");
      if (what == "BYTEPIX") number_bytes_ = integer("ZVAL" + number, 1, 4);
      if (number_bytes_ == 3) throw bad_image("its numbers have three bytes");
    }
  }

  /// CFITSIO takes now the one and now the other of two.
  void check_keys() const {
    for (const std::string& key : header_.twice())
      for (const char* start : {"Z", "NAXIS", "TFORM", "TTYPE", "TFIELDS", "THEAP", "PCOUNT", "GCOUNT"})
        if (key.rfind(start, 0) == 0) throw bad_image(key + " is there twice");
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
      if (along > kMaxTiles / tiles) throw bad_image("there are too many tiles");
      tiles *= along;
      axes_.push_back({length, tile, along});
    }
    if (tiles != rows_)
      throw bad_image("it has " + std::to_string(rows_) + " tiles, and " + std::to_string(tiles) +
                      " make its image");
  }

  /// Bytes of a column's entry in a row; `descriptor` is how many bytes each of its two numbers has, or 0.
  long long entry_bytes(const std::string& form, int& descriptor) const {
    const std::size_t letter = form.find_first_not_of("0123456789");
    if (letter == std::string::npos || letter > 4) throw bad_image("a column has the form '" + form + "'");
    const long long repeat = letter == 0 ? 1 : std::strtoll(form.c_str(), nullptr, 10);
    descriptor = form[letter] == 'P' ? 4 : form[letter] == 'Q' ? 8 : 0;
    if (descriptor > 0 && repeat > 1) throw bad_image("a column has the form '" + form + "'");
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
        throw bad_image("a column has the form '" + form + "'");
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
        if (seen || descriptor == 0) throw bad_image("its column COMPRESSED_DATA is none of tiles");
        seen = true;
        tiles_ = {title, row_bytes_, descriptor};
      } else if (descriptor > 0) {
        others_.push_back({title, row_bytes_, descriptor});
      }
      row_bytes_ += bytes;
    }
    if (!seen) throw bad_image("it has no column COMPRESSED_DATA");
    if (integer("NAXIS1", 1, 1 << 20) != row_bytes_) throw bad_image("its columns do not make up a row");
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
    const std::uint64_t value = unsigned_at(data_, at, static_cast<std::size_t>(column.bytes));
    return value >> 62 != 0 ? -1 : static_cast<long long>(value);
  }

  void check_descriptors() const {
    const long long size = static_cast<long long>(data_.size()), table = row_bytes_ * rows_;
    const long long end = table + integer("PCOUNT", 0, 1LL << 40);
    if (end > size) throw truncated(name_, "it ends inside its packed image");
    const long long heap_bytes = end - integer("THEAP", table, end, table);
    for (long long row = 0; row < rows_; ++row) {
      for (const Descriptors& column : others_)
        if (described(column, row, 0) != 0)
          throw unreadable(
              name_, "a packed FITS image with something in its column " + column.title + " is not read")
              .hint("unpack it with funpack first");
      const long long length = described(tiles_, row, 0), place = described(tiles_, row, 1);
      // A tile begins with its first number as it is.
      if (length <= number_bytes_ || place < 0 || place > heap_bytes || length > heap_bytes - place)
        throw bad_image("tile " + std::to_string(row + 1) + " does not lie inside it");
      const auto at = static_cast<std::size_t>(end - heap_bytes + place);
      if (!rice_holds(data_.substr(at, static_cast<std::size_t>(length)), pixels_of(row),
                      static_cast<int>(number_bytes_), block_))
        throw bad_image("tile " + std::to_string(row + 1) + " is cut");
    }
  }

  const FitsCards& header_;
  std::string_view data_;
  const std::string& name_;
  long long rows_ = 0, row_bytes_ = 0, number_bytes_ = 4, block_ = 32;
  std::vector<Axis> axes_;
  Descriptors tiles_;
  std::vector<Descriptors> others_;  ///< of tiles packed otherwise, or not
};

std::map<std::string, std::string> texts_of(const FitsValues& values) {
  std::map<std::string, std::string> texts;
  for (const auto& [key, value] : values) texts.emplace(key, value.text);
  return texts;
}

}  // namespace

std::string with_cards_in_order(std::string_view bytes) {
  std::vector<std::string_view> cards;
  std::size_t at = 0;
  for (; at + kFitsCardBytes <= bytes.size(); at += kFitsCardBytes) {
    const std::string_view card = bytes.substr(at, kFitsCardBytes);
    if (fits_key(card) == "END") break;
    cards.push_back(card);
  }
  if (at + kFitsCardBytes > bytes.size()) return {};
  std::vector<std::size_t> first;  // which card is to be the first, the second ...
  const auto find = [&](std::string_view key) {
    for (std::size_t i = 0; i < cards.size(); ++i)
      if (fits_key(cards[i]) == key) {
        first.push_back(i);
        return true;
      }
    return false;
  };
  if (!find("SIMPLE") || !find("BITPIX") || !find("NAXIS")) return {};
  constexpr int kMaxAxes = 999;
  const int axes = std::atoi(std::string(cards[first.back()].substr(9)).c_str());
  if (axes < 0 || axes > kMaxAxes) return {};
  for (int a = 1; a <= axes; ++a)
    if (!find("NAXIS" + std::to_string(a))) return {};
  bool in_order = true;
  for (std::size_t i = 0; i < first.size(); ++i) in_order = in_order && first[i] == i;
  if (in_order) return {};
  std::string ordered;
  ordered.reserve(bytes.size());
  std::vector<bool> placed(cards.size(), false);
  for (const std::size_t i : first) {
    ordered += cards[i];
    placed[i] = true;
  }
  for (std::size_t i = 0; i < cards.size(); ++i)
    if (!placed[i]) ordered += cards[i];
  ordered += bytes.substr(at);
  return ordered;
}

std::string fault_of_sizes(std::string_view bytes) {
  constexpr std::array<std::string_view, 3> kFirstOfExtension = {"XTENSION", "BITPIX", "NAXIS"};
  std::size_t at = 0;
  while (at < bytes.size()) {
    const bool is_extension = at > 0;
    FitsDataSize data;
    std::size_t number_of_card = 0;
    for (bool ended = false; !ended; at += kFitsCardBytes, ++number_of_card) {
      // CFITSIO itself refuses a first header without an end.
      if (at + kFitsCardBytes > bytes.size())
        return is_extension ? "the header of an extension has no END" : "";
      const std::string_view card = bytes.substr(at, kFitsCardBytes), key = fits_key(card);
      if (is_extension && number_of_card < kFirstOfExtension.size() &&
          key != kFirstOfExtension[number_of_card])
        return std::string(kFirstOfExtension[number_of_card]) + " is not where an extension has it";
      ended = key == "END";
      if (!FitsDataSize::depends_on(key) && key != "TFIELDS") continue;
      const std::optional<long long> number = whole_number(card);
      if (!number) return std::string(key) + " is no whole number";
      data.take(key, static_cast<double>(*number));
    }
    const double blocks = data.blocks();
    if (!(blocks >= 0.0 && blocks <= static_cast<double>(bytes.size() / kFitsBlockBytes))) return {};
    at = ((at + kFitsBlockBytes - 1) / kFitsBlockBytes + static_cast<std::size_t>(blocks)) * kFitsBlockBytes;
    if (bytes.substr(std::min(at, bytes.size()), 8) != "XTENSION") return {};
  }
  return {};
}

void check_fits_packing(std::string_view bytes, const std::string& name) {
  const FitsCards header(bytes);
  if (header.holds("ZIMAGE")) Packing(header, bytes, name).check();
}

std::map<std::string, std::string> fits_image_words(std::string_view bytes) {
  return texts_of(fits_image_values(bytes));
}

std::vector<FitsPart> fits_parts(const RandomBytes& file) {
  constexpr std::size_t kMaxParts = 10000, kMaxHeader = std::size_t{1} << 20;
  std::vector<FitsPart> parts;
  std::uint64_t at = 0;
  while (parts.size() < kMaxParts) {
    const std::string_view begins = parts.empty() ? "SIMPLE  =" : "XTENSION=";
    std::string bytes;
    bool has_end = false;
    while (!has_end && bytes.size() < kMaxHeader) {
      const std::size_t before = bytes.size();
      bytes.resize(before + kFitsBlockBytes);
      if (file.read(at + before, bytes.data() + before, kFitsBlockBytes) < kFitsBlockBytes) return parts;
      if (bytes.compare(0, begins.size(), begins) != 0) return parts;
      for (std::size_t card = before; card < bytes.size(); card += kFitsCardBytes)
        has_end = has_end || fits_key(std::string_view(bytes).substr(card, kFitsCardBytes)) == "END";
    }
    if (!has_end) return parts;
    const FitsCards header(bytes);
    const std::optional<FitsDataSize> data = header.data_size();
    if (!data || data->blocks() > static_cast<double>(file.size() / kFitsBlockBytes)) return parts;
    const auto data_bytes = static_cast<std::uint64_t>(data->blocks()) * kFitsBlockBytes;
    FitsPart part;
    part.begin = at;
    part.data = at + bytes.size();
    // The last block may be short.
    part.end = std::min(part.data + data_bytes, file.size());
    part.words = texts_of(header.values());
    part.is_image = header.is_of_image();
    at = part.data + data_bytes;
    parts.push_back(std::move(part));
    if (at >= file.size()) return parts;
  }
  return parts;
}

}  // namespace vegard::sim
