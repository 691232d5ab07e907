#include "sim/base/picture/tiff_directory.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "sim/base/file/byte_stream.h"
#include "sim/base/text.h"

namespace vegard::sim {
namespace {

constexpr int kByte = 1, kAscii = 2, kShort = 3, kLong = 4, kRational = 5, kSignedByte = 6, kUndefined = 7,
              kSignedShort = 8, kSignedLong = 9, kSignedRational = 10, kFloat = 11, kDouble = 12,
              kPointer = 13, kLong8 = 16, kUtf8 = 129;

/// Bytes of one value; 0 for a type that is not read.
std::size_t size_of(int type) {
  switch (type) {
    case kByte:
    case kAscii:
    case kSignedByte:
    case kUndefined:
    case kUtf8:
      return 1;
    case kShort:
    case kSignedShort:
      return 2;
    case kLong:
    case kSignedLong:
    case kFloat:
    case kPointer:
      return 4;
    case kRational:
    case kSignedRational:
    case kDouble:
    case kLong8:
      return 8;
    default:
      return 0;
  }
}

std::optional<double> fraction(double above, double below) {
  if (below == 0.0) return std::nullopt;
  return above / below;
}

std::optional<double> finite(double value) {
  return std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
}

}  // namespace

TiffDirectory::TiffDirectory(std::string_view tiff, std::uint64_t offset) : tiff_(tiff) {
  constexpr std::uint64_t kBigTiff = 43;
  if (tiff.size() < 8) return;
  big_endian_ = tiff[0] == 'M';
  big_ = word(2, 2) == kBigTiff;
  if (big_ && tiff.size() < 16) return;
  read_head(offset != 0 ? offset : big_ ? word(8, 8) : word(4, 4));
}

void TiffDirectory::read_head(std::uint64_t place) {
  const std::size_t count_bytes = big_ ? 8 : 2, entry_bytes = big_ ? 20 : 12;
  if (place > tiff_.size() || tiff_.size() - place < count_bytes) return;
  begin_ = place + count_bytes;
  const std::uint64_t said = word(place, static_cast<int>(count_bytes)),
                      room = (tiff_.size() - begin_) / entry_bytes;
  complete_ = said <= room;
  count_ = std::min(said, room);
}

std::optional<TiffDirectory> TiffDirectory::first(std::string_view tiff) {
  using namespace std::string_view_literals;
  constexpr std::string_view kStarts[] = {"II\x2a\0"sv, "MM\0\x2a"sv, "IIRO"sv,
                                          "IIRS"sv,     "MMOR"sv,     "IIU\0"sv};
  if (tiff.size() < 8 ||
      std::find(std::begin(kStarts), std::end(kStarts), tiff.substr(0, 4)) == std::end(kStarts))
    return std::nullopt;
  return TiffDirectory(tiff);
}

std::optional<TiffDirectory> TiffDirectory::at_tag(int tag) const {
  const auto entry = find(tag);
  if (!entry || (entry->type != kLong && entry->type != kPointer) || entry->count == 0) return std::nullopt;
  const auto place = values_of(*entry, 1);
  if (!place) return std::nullopt;
  TiffDirectory directory = *this;
  directory.begin_ = directory.count_ = 0;
  directory.complete_ = false;
  directory.read_head(word(*place, 4));
  return directory;
}

std::vector<double> TiffDirectory::numbers(int tag, std::size_t most) const {
  std::vector<double> list;
  const auto entry = find(tag);
  if (!entry || entry->type == kAscii || entry->type == kUtf8) return list;
  const std::size_t wanted = std::min<std::size_t>(entry->count, most);
  const auto place = values_of(*entry, wanted);
  if (!place) return list;
  for (std::size_t i = 0; i < wanted; ++i) {
    const auto value = number_at(*place + i * size_of(entry->type), entry->type);
    if (!value) return {};
    list.push_back(*value);
  }
  return list;
}

std::optional<double> TiffDirectory::number(int tag) const {
  const std::vector<double> list = numbers(tag, 1);
  return list.empty() ? std::nullopt : std::optional<double>(list.front());
}

std::optional<std::string_view> TiffDirectory::bytes(int tag) const {
  const auto entry = find(tag);
  if (!entry || (entry->type != kByte && entry->type != kUndefined)) return std::nullopt;
  const auto place = values_of(*entry, entry->count);
  return place ? std::optional(tiff_.substr(*place, static_cast<std::size_t>(entry->count))) : std::nullopt;
}

std::optional<std::string> TiffDirectory::text(int tag) const {
  constexpr std::size_t kMax = 200;
  const auto entry = find(tag);
  if (!entry || (entry->type != kAscii && entry->type != kUtf8)) return std::nullopt;
  const std::size_t wanted = std::min<std::size_t>(entry->count, kMax);
  const auto place = values_of(*entry, wanted);
  if (!place) return std::nullopt;
  std::string text(tiff_.substr(*place, wanted));
  text.resize(std::min(text.size(), text.find('\0')));
  for (char& c : text)
    if (c < 0x20 || c > 0x7e) c = '?';
  text = std::string(trimmed(text, " "));
  return text.empty() ? std::nullopt : std::optional(text);
}

std::optional<std::vector<std::uint64_t>> TiffDirectory::values(int tag, std::size_t most) const {
  const auto entry = find(tag);
  if (!entry) return std::nullopt;
  const bool unsigned_integer = entry->type == kByte || entry->type == kShort || entry->type == kLong ||
                                entry->type == kPointer || entry->type == kLong8;
  if (!unsigned_integer) return std::nullopt;
  const auto place = values_of(*entry, entry->count);
  inside_ = inside_ && place;
  if (!place) return std::nullopt;
  const int size = static_cast<int>(size_of(entry->type));
  std::vector<std::uint64_t> list(std::min<std::uint64_t>(entry->count, most));
  for (std::size_t k = 0; k < list.size(); ++k) list[k] = word(*place + k * size, size);
  return list;
}

std::uint64_t TiffDirectory::value(int tag, std::uint64_t if_absent) const {
  const auto list = values(tag, 1);
  return list && !list->empty() ? list->front() : if_absent;
}

std::optional<TiffDirectory::Entry> TiffDirectory::find(int tag) const {
  for (std::size_t i = 0; i < count_; ++i) {
    const std::size_t at = begin_ + i * (big_ ? 20 : 12);
    if (static_cast<int>(word(at, 2)) == tag)
      return Entry{static_cast<int>(word(at + 2, 2)), word(at + 4, big_ ? 8 : 4), at + (big_ ? 12 : 8)};
  }
  return std::nullopt;
}

std::optional<std::size_t> TiffDirectory::values_of(const Entry& entry, std::uint64_t wanted) const {
  const std::size_t size = size_of(entry.type), of_offset = big_ ? 8 : 4;
  if (size == 0) return std::nullopt;
  // Values that need no more bytes than an offset are in the entry itself; all of them count, not only those
  // wanted.
  const bool inside = entry.count <= of_offset / size;
  const std::size_t place = inside ? entry.place : word(entry.place, static_cast<int>(of_offset));
  if (place > tiff_.size() || wanted > (tiff_.size() - place) / size) return std::nullopt;
  return place;
}

std::uint64_t TiffDirectory::word(std::size_t place, int size) const {
  return unsigned_at(tiff_, place, static_cast<std::size_t>(size), big_endian_);
}

std::optional<double> TiffDirectory::number_at(std::size_t place, int type) const {
  const auto signed_long = [&](std::size_t at) {
    return static_cast<double>(static_cast<std::int32_t>(word(at, 4)));
  };
  switch (type) {
    case kByte:
      return static_cast<double>(word(place, 1));
    case kSignedByte:
      return static_cast<std::int8_t>(word(place, 1));
    case kShort:
      return static_cast<double>(word(place, 2));
    case kSignedShort:
      return static_cast<std::int16_t>(word(place, 2));
    case kLong:
    case kPointer:
      return static_cast<double>(word(place, 4));
    case kSignedLong:
      return signed_long(place);
    case kRational:
      return fraction(static_cast<double>(word(place, 4)), static_cast<double>(word(place + 4, 4)));
    case kSignedRational:
      return fraction(signed_long(place), signed_long(place + 4));
    case kFloat: {
      const auto bits = static_cast<std::uint32_t>(word(place, 4));
      float value = 0.0f;
      std::memcpy(&value, &bits, sizeof value);
      return finite(value);
    }
    case kDouble: {
      const std::uint64_t bits = word(place, 8);
      double value = 0.0;
      std::memcpy(&value, &bits, sizeof value);
      return finite(value);
    }
    default:
      return std::nullopt;
  }
}

}  // namespace vegard::sim
