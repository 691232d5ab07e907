#include "sim/base/picture/fits_cards.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "sim/base/text.h"

namespace vegard::sim {
namespace {

constexpr std::size_t kKeyBytes = 8;

bool is_length(std::string_view key) {
  return key.size() > 5 && key.substr(0, 5) == "NAXIS" && key.find_first_not_of("0123456789", 5) == key.npos;
}

/// Of what stands behind "= ".
FitsValue value_of(std::string_view field) {
  FitsValue value;
  field.remove_prefix(std::min(field.find_first_not_of(' '), field.size()));
  value.is_quoted = !field.empty() && field[0] == '\'';
  if (value.is_quoted) field.remove_prefix(1);
  const std::size_t end = std::min(field.find(value.is_quoted ? '\'' : '/'), field.size());
  const std::string_view text = field.substr(0, end), comment = trimmed(field.substr(end), "'/ ");
  value.text = std::string(text.substr(0, text.find_last_not_of(' ') + 1));
  if (!comment.empty() && comment[0] == '[' && comment.find(']') != comment.npos)
    value.unit = std::string(trimmed(comment.substr(1, comment.find(']') - 1), " "));
  return value;
}

}  // namespace

std::string_view fits_key(std::string_view card) {
  const std::string_view key = card.substr(0, kKeyBytes);
  return key.substr(0, key.find(' '));
}

bool FitsDataSize::depends_on(std::string_view key) {
  return key == "BITPIX" || key == "NAXIS" || key == "PCOUNT" || key == "GCOUNT" || is_length(key);
}

void FitsDataSize::take(std::string_view key, double number) {
  if (key == "BITPIX") value_bytes_ = std::abs(number) / 8.0;
  if (key == "PCOUNT") beside_ = number;
  if (key == "GCOUNT") groups_ = number;
  if (key == "NAXIS") has_axes_ = number > 0.0;
  if (is_length(key)) values_ *= number;
}

double FitsDataSize::blocks() const { return std::ceil(bytes() / kFitsBlockBytes); }

FitsCards::FitsCards(std::string_view bytes) {
  std::size_t at = 0;
  for (; at + kFitsCardBytes <= bytes.size() && !has_end_; at += kFitsCardBytes) {
    const std::string_view card = bytes.substr(at, kFitsCardBytes);
    const std::string key(fits_key(card));
    has_end_ = key == "END";
    if (has_end_) continue;
    cards_.push_back(card);
    if (card.substr(kKeyBytes, 2) != "= ") continue;
    if (!values_.emplace(key, value_of(card.substr(kKeyBytes + 2))).second) twice_.insert(key);
  }
  size_ = std::min(bytes.size(), (at + kFitsBlockBytes - 1) / kFitsBlockBytes * kFitsBlockBytes);
}

std::string FitsCards::text(std::string_view key) const {
  const auto found = values_.find(key);
  return found == values_.end() ? std::string() : found->second.text;
}

bool FitsCards::is_of_image() const {
  const std::string kind = text("XTENSION");
  if (text("ZIMAGE") == "T") return true;
  return (kind.empty() || kind == "IMAGE") && fits_number(values_, "NAXIS").value_or(0.0) >= 2.0;
}

std::optional<FitsDataSize> FitsCards::data_size() const {
  constexpr double kLargest = 1e15;
  FitsDataSize size;
  for (const auto& [key, value] : values_) {
    if (!FitsDataSize::depends_on(key)) continue;
    const std::optional<double> number = fits_number(values_, key);
    if (!number || std::abs(*number) >= kLargest) return std::nullopt;
    size.take(key, *number);
  }
  if (!(size.bytes() >= 0.0 && size.bytes() < kLargest)) return std::nullopt;
  return size;
}

std::optional<double> fits_number(const FitsValues& values, std::string_view key) {
  const auto found = values.find(key);
  if (found == values.end()) return std::nullopt;
  std::string digits(trimmed(found->second.text, " "));
  if (digits.rfind('+', 0) == 0) digits.erase(0, 1);
  std::replace(digits.begin(), digits.end(), 'D', 'E');
  double number = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (digits.empty() || error != std::errc() || end != digits.data() + digits.size() ||
      !std::isfinite(number))
    return std::nullopt;
  return number;
}

FitsValues fits_image_values(std::string_view bytes) {
  constexpr std::string_view kBegins = "SIMPLE  =", kExtension = "XTENSION";
  if (bytes.substr(0, kBegins.size()) != kBegins) return {};
  const FitsCards first(bytes);
  if (first.is_of_image()) return first.values();
  std::size_t at = first.size();
  std::optional<FitsDataSize> data = first.data_size();
  while (data && data->blocks() < static_cast<double>(bytes.size() / kFitsBlockBytes)) {
    at += static_cast<std::size_t>(data->blocks()) * kFitsBlockBytes;
    if (bytes.substr(std::min(at, bytes.size()), kExtension.size()) != kExtension) break;
    const FitsCards header(bytes.substr(at));
    if (header.is_of_image()) {
      FitsValues values = header.values();
      values.insert(first.values().begin(), first.values().end());
      return values;
    }
    at += header.size();
    data = header.data_size();
  }
  return first.values();
}

}  // namespace vegard::sim
