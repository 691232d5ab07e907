#include "sim/base/picture/fits_checksum.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <vector>

#include "sim/base/picture/fits_cards.h"

namespace vegard::sim {
namespace {

/// One header and the data behind it.
struct SummedPart {
  FitsCards header;
  std::size_t data_begin = 0;
  double data_bytes = 0.0;  ///< without the filling of the last block
};

/// All parts whose headers are whole and have sizes; data may be missing of the last.
std::vector<SummedPart> parts_of(std::string_view fits) {
  std::vector<SummedPart> parts;
  for (std::size_t at = 0; at < fits.size();) {
    if (at > 0 && fits.substr(at, 8) != "XTENSION") break;
    const FitsCards header(fits.substr(at));
    const std::optional<FitsDataSize> size = header.data_size();
    if (!header.has_end() || !size) break;
    parts.push_back({header, at + header.size(), size->bytes()});
    at = parts.back().data_begin + static_cast<std::size_t>(size->blocks()) * kFitsBlockBytes;
  }
  return parts;
}

/// The sum in ones' complement of 32-bit words, the highest byte first; what is missing of a word is 0.
std::uint32_t sum_of(std::string_view bytes, std::uint32_t before = 0) {
  std::uint64_t sum = before;
  const auto byte = [&](std::size_t i) -> std::uint64_t {
    return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0u;
  };
  for (std::size_t i = 0; i < bytes.size(); i += 4) {
    sum += byte(i) << 24 | byte(i + 1) << 16 | byte(i + 2) << 8 | byte(i + 3);
    sum = (sum & 0xffffffffu) + (sum >> 32);
  }
  return static_cast<std::uint32_t>(sum);
}

/// The complement of a sum as sixteen letters and digits, by which the sum of the whole becomes -0: each byte
/// in four characters that add up to it, and none of them a sign between the ranges (appendix J.2).
std::string encoded(std::uint32_t sum) {
  const std::uint32_t complement = ~sum;
  std::string text(16, '0');
  for (int i = 0; i < 4; ++i) {
    const int value = static_cast<int>(complement >> (24 - 8 * i) & 0xffu);
    constexpr int kOffset = '0';
    int quarter[4];
    for (int& q : quarter) q = value / 4 + kOffset;
    quarter[0] += value % 4;
    const auto is_sign = [](int c) { return (c > '9' && c < 'A') || (c > 'Z' && c < 'a'); };
    for (bool again = true; again;) {
      again = false;
      for (int j = 0; j < 4; j += 2)
        if (is_sign(quarter[j]) || is_sign(quarter[j + 1])) {
          ++quarter[j];
          --quarter[j + 1];
          again = true;
        }
    }
    for (int j = 0; j < 4; ++j) text[static_cast<std::size_t>(4 * j + i)] = static_cast<char>(quarter[j]);
  }
  // The value begins in the third byte of a word: behind "CHECKSUM= '".
  return text.substr(15) + text.substr(0, 15);
}

std::string text_card(const char* key, const std::string& text, const char* comment) {
  char card[kFitsCardBytes + 1];
  std::snprintf(card, sizeof card, "%-8s= '%s' / %s", key, text.c_str(), comment);
  std::string padded = card;
  padded.resize(kFitsCardBytes, ' ');
  return padded;
}

std::string_view data_of(std::string_view fits, const SummedPart& part) {
  const std::size_t begin = std::min(part.data_begin, fits.size());
  return fits.substr(begin, (static_cast<std::size_t>(part.data_bytes) + kFitsBlockBytes - 1) /
                                kFitsBlockBytes * kFitsBlockBytes);
}

}  // namespace

std::string with_fits_checksums(std::string_view fits) {
  std::string out;
  for (const SummedPart& part : parts_of(fits)) {
    const std::string_view data = data_of(fits, part);
    const std::uint32_t data_sum = sum_of(data);
    const auto header_with = [&](const std::string& sum) {
      std::string header;
      for (const std::string_view card : part.header.cards())
        if (fits_key(card) != "CHECKSUM" && fits_key(card) != "DATASUM") header += card;
      header += text_card("CHECKSUM", sum, "sum of this part, by which it is -0");
      header += text_card("DATASUM", std::to_string(data_sum), "sum of its data");
      header += "END";
      header.resize((header.size() + kFitsBlockBytes - 1) / kFitsBlockBytes * kFitsBlockBytes, ' ');
      return header;
    };
    const std::uint32_t whole = sum_of(header_with(std::string(16, '0')), data_sum);
    out += header_with(encoded(whole));
    out += data;
  }
  return out;
}

std::string fault_of_fits_sums(std::string_view fits) {
  int number = 0;
  for (const SummedPart& part : parts_of(fits)) {
    ++number;
    const std::string told = part.header.text("DATASUM");
    std::uint64_t expected = 0;
    const auto [end, error] = std::from_chars(told.data(), told.data() + told.size(), expected);
    if (told.empty() || error != std::errc() || end != told.data() + told.size()) continue;
    const std::uint32_t found = sum_of(data_of(fits, part));
    // 0 and its complement are the same number.
    if (found == expected || (found + 1u <= 1u && (expected == 0u || expected == 0xffffffffu))) continue;
    return std::string("the data of its ") + (number == 1 ? "first part" : "part " + std::to_string(number)) +
           " are not those that were written: their sum is " + std::to_string(found) + ", DATASUM says " +
           told;
  }
  return {};
}

std::string missing_fits_data(std::string_view fits) {
  for (const SummedPart& part : parts_of(fits)) {
    const double there =
        fits.size() > part.data_begin ? static_cast<double>(fits.size() - part.data_begin) : 0.0;
    if (part.data_bytes <= there) continue;
    char words[120];
    std::snprintf(words, sizeof words, "a header promises %.0f bytes of data, and %.0f are there",
                  part.data_bytes, there);
    return words;
  }
  return {};
}

}  // namespace vegard::sim
