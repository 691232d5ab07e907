#include "fit/photo/codec/hevc_size.h"

#include <cstddef>
#include <cstdint>
#include <string>

#include "sim/base/file/byte_stream.h"

namespace vegard::fit {
namespace {

/// Bit by bit, the highest first. Beyond the end there is nothing good.
class Bits {
 public:
  /// Drops the last of three bytes 0, 0, 3, which only keeps the first two from being taken for a start code.
  explicit Bits(std::string_view escaped) {
    for (const char byte : escaped) {
      const std::size_t size = bytes_.size();
      if (byte == '\x03' && size >= 2 && bytes_[size - 1] == '\0' && bytes_[size - 2] == '\0' &&
          !just_skipped_) {
        just_skipped_ = true;
        continue;
      }
      just_skipped_ = false;
      bytes_ += byte;
    }
  }

  std::uint64_t next(int count) {
    std::uint64_t value = 0;
    for (int i = 0; i < count; ++i, ++at_) {
      const std::size_t byte = at_ / 8;
      good_ = good_ && byte < bytes_.size();
      value = value << 1 | (good_ ? static_cast<unsigned char>(bytes_[byte]) >> (7 - at_ % 8) & 1u : 0u);
    }
    return value;
  }

  /// Exponential Golomb code (H.265, 9.2).
  long long number() {
    int zeros = 0;
    while (good_ && zeros < 32 && next(1) == 0) ++zeros;
    good_ = good_ && zeros < 32;
    return good_ ? static_cast<long long>((std::uint64_t{1} << zeros) - 1 + next(zeros)) : 0;
  }

  void skip(std::size_t count) { at_ += count; }
  bool good() const { return good_ && at_ <= 8 * bytes_.size(); }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
  bool good_ = true, just_skipped_ = false;
};

void skip_profiles(Bits& bits, int sub_layers) {
  constexpr std::size_t kProfile = 88, kLevel = 8;
  bits.skip(kProfile + kLevel);
  bool profile[8] = {}, level[8] = {};
  for (int i = 0; i < sub_layers; ++i) profile[i] = bits.next(1) != 0, level[i] = bits.next(1) != 0;
  if (sub_layers > 0) bits.skip(2 * static_cast<std::size_t>(8 - sub_layers));
  for (int i = 0; i < sub_layers; ++i) bits.skip((profile[i] ? kProfile : 0) + (level[i] ? kLevel : 0));
}

std::optional<std::pair<long long, long long>> size_of(std::string_view parameter_set) {
  Bits bits(parameter_set);
  bits.skip(16 + 4);  // the unit's head, and a number
  const int sub_layers = static_cast<int>(bits.next(3));
  bits.skip(1);
  skip_profiles(bits, sub_layers);
  bits.number();
  const long long chroma = bits.number();
  if (chroma == 3) bits.skip(1);
  long long width = bits.number(), height = bits.number();
  if (bits.next(1) != 0) {
    const long long across = chroma == 1 || chroma == 2 ? 2 : 1, down = chroma == 1 ? 2 : 1;
    width -= across * bits.number();
    width -= across * bits.number();
    height -= down * bits.number();
    height -= down * bits.number();
  }
  if (!bits.good() || chroma > 3 || width < 1 || height < 1) return std::nullopt;
  return std::pair(width, height);
}

}  // namespace

std::optional<std::pair<long long, long long>> hevc_size(std::string_view configuration) {
  constexpr std::size_t kHead = 22;
  constexpr int kParameterSet = 33;
  const auto number = [&](std::size_t at, std::size_t size) {
    return sim::unsigned_at(configuration, at, size);
  };
  if (configuration.size() <= kHead) return std::nullopt;
  const std::size_t arrays = number(kHead, 1);
  std::size_t at = kHead + 1;
  for (std::size_t a = 0; a < arrays; ++a) {
    if (at + 3 > configuration.size()) return std::nullopt;
    const bool wanted = (number(at, 1) & 0x3f) == kParameterSet;
    const std::size_t units = number(at + 1, 2);
    at += 3;
    for (std::size_t u = 0; u < units; ++u) {
      if (at + 2 > configuration.size()) return std::nullopt;
      const std::size_t length = number(at, 2);
      at += 2;
      if (length > configuration.size() - at) return std::nullopt;
      if (wanted) return size_of(configuration.substr(at, length));
      at += length;
    }
  }
  return std::nullopt;
}

}  // namespace vegard::fit
