#include "sim/base/picture/fits_card_order.h"

#include <cstddef>
#include <cstdlib>
#include <vector>

namespace vegard::sim {
namespace {

constexpr std::size_t kOrderedCard = 80;

std::string_view key_of(std::string_view card) {
  const std::string_view key = card.substr(0, 8);
  return key.substr(0, key.find(' '));
}

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
  constexpr int kMostAxes = 999;
  const int axes = std::atoi(std::string(cards[first.back()].substr(9)).c_str());
  if (axes < 0 || axes > kMostAxes) return {};
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

}  // namespace vegard::sim
