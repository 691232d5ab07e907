#include "sim/base/picture/fits_card_order.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <vector>

namespace vegard::sim {
namespace {

constexpr std::size_t kOrderedCard = 80;
constexpr std::size_t kFitsBlockBytes = 2880;

std::string_view key_of(std::string_view card) {
  const std::string_view key = card.substr(0, 8);
  return key.substr(0, key.find(' '));
}

bool is_length(std::string_view key) {
  return key.size() > 5 && key.substr(0, 5) == "NAXIS" && key.find_first_not_of("0123456789", 5) == key.npos;
}

bool is_of_size(std::string_view key) {
  return key == "BITPIX" || key == "NAXIS" || key == "PCOUNT" || key == "GCOUNT" || key == "TFIELDS" ||
         is_length(key);
}

/// What stands behind "= ", alone or before a comment.
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

/// The size of the data behind a header.
class DataSize {
 public:
  void take(std::string_view key, long long number) {
    const auto value = static_cast<double>(number);
    if (key == "BITPIX") bytes_ = std::abs(value) / 8.0;
    if (key == "PCOUNT") beside_ = value;
    if (key == "GCOUNT") groups_ = value;
    if (key == "NAXIS") has_axes_ = number > 0;
    if (is_length(key)) values_ *= value;
  }

  /// Rounded above 2^53 bytes, of which no file has so many.
  double blocks() const {
    return has_axes_ ? std::ceil((values_ + beside_) * groups_ * bytes_ / kFitsBlockBytes) : 0.0;
  }

 private:
  double bytes_ = 0.0, values_ = 1.0, beside_ = 0.0, groups_ = 1.0;
  bool has_axes_ = false;
};

}  // namespace

std::string with_cards_in_order(std::string_view bytes) {
  std::vector<std::string_view> cards;
  std::size_t at = 0;
  for (; at + kOrderedCard <= bytes.size(); at += kOrderedCard) {
    const std::string_view card = bytes.substr(at, kOrderedCard);
    if (key_of(card) == "END") break;
    cards.push_back(card);
  }
  if (at + kOrderedCard > bytes.size()) return {};
  std::vector<std::size_t> first;  // which card is to be the first, the second ...
  const auto find = [&](std::string_view key) {
    for (std::size_t i = 0; i < cards.size(); ++i)
      if (key_of(cards[i]) == key) {
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
    DataSize data;
    std::size_t number_of_card = 0;
    for (bool ended = false; !ended; at += kOrderedCard, ++number_of_card) {
      // CFITSIO itself refuses a first header without an end.
      if (at + kOrderedCard > bytes.size())
        return is_extension ? "the header of an extension has no END" : "";
      const std::string_view card = bytes.substr(at, kOrderedCard), key = key_of(card);
      if (is_extension && number_of_card < kFirstOfExtension.size() &&
          key != kFirstOfExtension[number_of_card])
        return std::string(kFirstOfExtension[number_of_card]) + " is not where an extension has it";
      ended = key == "END";
      if (!is_of_size(key)) continue;
      const std::optional<long long> number = whole_number(card);
      if (!number) return std::string(key) + " is no whole number";
      data.take(key, *number);
    }
    const double blocks = data.blocks();
    if (!(blocks >= 0.0 && blocks <= static_cast<double>(bytes.size() / kFitsBlockBytes))) return {};
    at = ((at + kFitsBlockBytes - 1) / kFitsBlockBytes + static_cast<std::size_t>(blocks)) * kFitsBlockBytes;
    if (bytes.substr(std::min(at, bytes.size()), 8) != "XTENSION") return {};
  }
  return {};
}

}  // namespace vegard::sim
