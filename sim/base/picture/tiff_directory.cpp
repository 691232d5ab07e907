#include "sim/base/picture/tiff_directory.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "sim/base/text.h"

namespace vegard::sim {
namespace {

constexpr int kByte = 1, kAscii = 2, kShort = 3, kLong = 4, kRational = 5, kSignedByte = 6, kSignedShort = 8,
              kSignedLong = 9, kSignedRational = 10, kFloat = 11, kDouble = 12, kPointer = 13, kUtf8 = 129;

/// Bytes of one value; 0 for a type that is not read.
std::size_t size_of(int type) {
  switch (type) {
    case kByte:
    case kAscii:
    case kSignedByte:
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

TiffDirectory::TiffDirectory(std::string_view tiff, bool big_endian, std::size_t offset)
    : tiff_(tiff), big_endian_(big_endian) {
  constexpr std::size_t kEntryBytes = 12;
  if (offset > tiff.size() || tiff.size() - offset < 2) return;
  const std::size_t said = word(offset, 2);
  const std::size_t count = std::min(said, (tiff.size() - offset - 2) / kEntryBytes);
  entries_.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = offset + 2 + i * kEntryBytes;
    entries_.push_back(
        {static_cast<int>(word(at, 2)), static_cast<int>(word(at + 2, 2)), word(at + 4, 4), at + 8});
  }
}

std::optional<TiffDirectory> TiffDirectory::first(std::string_view tiff) {
  using namespace std::string_view_literals;
  constexpr std::string_view kStarts[] = {"II\x2a\0"sv, "MM\0\x2a"sv, "IIRO"sv,
                                          "IIRS"sv,     "MMOR"sv,     "IIU\0"sv};
  if (tiff.size() < 8 ||
      std::find(std::begin(kStarts), std::end(kStarts), tiff.substr(0, 4)) == std::end(kStarts))
    return std::nullopt;
  const bool big_endian = tiff[0] == 'M';
  const TiffDirectory reader(tiff, big_endian, tiff.size());  // for its words only
  return TiffDirectory(tiff, big_endian, reader.word(4, 4));
}

std::optional<TiffDirectory> TiffDirectory::at_tag(int tag) const {
  const Entry* entry = find(tag);
  if (entry == nullptr || (entry->type != kLong && entry->type != kPointer) || entry->count == 0)
    return std::nullopt;
  const auto place = values_of(*entry, 1);
  if (!place) return std::nullopt;
  return TiffDirectory(tiff_, big_endian_, word(*place, 4));
}

std::vector<double> TiffDirectory::numbers(int tag, std::size_t most) const {
  std::vector<double> list;
  const Entry* entry = find(tag);
  if (entry == nullptr || entry->type == kAscii || entry->type == kUtf8) return list;
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

std::optional<std::string> TiffDirectory::text(int tag) const {
  constexpr std::size_t kMax = 200;
  const Entry* entry = find(tag);
  if (entry == nullptr || (entry->type != kAscii && entry->type != kUtf8)) return std::nullopt;
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

const TiffDirectory::Entry* TiffDirectory::find(int tag) const {
  const auto found =
      std::find_if(entries_.begin(), entries_.end(), [tag](const Entry& entry) { return entry.tag == tag; });
  return found == entries_.end() ? nullptr : &*found;
}

std::optional<std::size_t> TiffDirectory::values_of(const Entry& entry, std::size_t wanted) const {
  const std::size_t size = size_of(entry.type);
  if (size == 0) return std::nullopt;
  // Up to four bytes stand in the entry itself, by its own count, not by how many are wanted.
  const bool inside = entry.count <= 4 / size;
  const std::size_t place = inside ? entry.place : word(entry.place, 4);
  if (place > tiff_.size() || wanted > (tiff_.size() - place) / size) return std::nullopt;
  return place;
}

std::uint32_t TiffDirectory::word(std::size_t place, int size) const {
  std::uint32_t value = 0;
  for (int i = 0; i < size; ++i)
    value = value << 8 | static_cast<unsigned char>(tiff_[place + (big_endian_ ? i : size - 1 - i)]);
  return value;
}

std::optional<double> TiffDirectory::number_at(std::size_t place, int type) const {
  const auto signed_long = [&](std::size_t at) {
    return static_cast<double>(static_cast<std::int32_t>(word(at, 4)));
  };
  switch (type) {
    case kByte:
      return word(place, 1);
    case kSignedByte:
      return static_cast<std::int8_t>(word(place, 1));
    case kShort:
      return word(place, 2);
    case kSignedShort:
      return static_cast<std::int16_t>(word(place, 2));
    case kLong:
    case kPointer:
      return word(place, 4);
    case kSignedLong:
      return signed_long(place);
    case kRational:
      return fraction(word(place, 4), word(place + 4, 4));
    case kSignedRational:
      return fraction(signed_long(place), signed_long(place + 4));
    case kFloat: {
      const std::uint32_t bits = word(place, 4);
      float value = 0.0f;
      std::memcpy(&value, &bits, sizeof value);
      return finite(value);
    }
    case kDouble: {
      const std::uint64_t high = word(place + (big_endian_ ? 0 : 4), 4),
                          low = word(place + (big_endian_ ? 4 : 0), 4);
      const std::uint64_t bits = high << 32 | low;
      double value = 0.0;
      std::memcpy(&value, &bits, sizeof value);
      return finite(value);
    }
    default:
      return std::nullopt;
  }
}

}  // namespace vegard::sim
