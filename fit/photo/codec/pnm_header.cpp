#include "fit/photo/codec/pnm_header.h"

#include "sim/base/error.h"

namespace vegard::fit {
namespace {

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

}  // namespace

long long next_pnm_number(std::string_view bytes, std::size_t& at) {
  while (at < bytes.size() && (is_space(bytes[at]) || bytes[at] == '#')) {
    if (bytes[at] == '#')
      while (at < bytes.size() && bytes[at] != '\n' && bytes[at] != '\r') ++at;
    else
      ++at;
  }
  constexpr long long kMax = 1LL << 40;
  long long value = -1;
  for (; at < bytes.size() && bytes[at] >= '0' && bytes[at] <= '9'; ++at)
    value = value < 0 ? bytes[at] - '0' : value < kMax ? value * 10 + (bytes[at] - '0') : kMax;
  return value;
}

PnmHeader pnm_header(std::string_view bytes, const std::string& file) {
  PnmHeader header;
  const char kind = bytes[1];
  header.in_words = kind == '2' || kind == '3';
  header.channels = kind == '3' || kind == '6' ? 3 : 1;
  std::size_t at = 2;
  const auto number = [&](const char* what) {
    const long long value = next_pnm_number(bytes, at);
    if (value >= 0 && at < bytes.size()) return value;
    if (at >= bytes.size()) throw sim::truncated(file, "it ends inside its header");
    throw sim::damaged(file, std::string("its header has no ") + what);
  };
  header.width = number("width");
  header.height = number("height");
  const long long largest = number("largest value");
  if (largest < 1 || largest > 65535)
    throw sim::damaged(file, "its largest value is " + std::to_string(largest) + ", not 1 to 65535");
  header.largest = static_cast<int>(largest);
  if (!is_space(bytes[at])) throw sim::damaged(file, "its header does not end with a space");
  header.data = at + 1;
  return header;
}

}  // namespace vegard::fit
