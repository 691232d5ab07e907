#include "sim/base/text.h"

#include <algorithm>
#include <filesystem>

namespace vegard::sim {

std::string_view trimmed(std::string_view text, std::string_view blanks) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string lowered(std::string_view text) {
  std::string small(text);
  for (char& c : small)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return small;
}

std::string lowered_extension(const std::string& path) {
  return lowered(std::filesystem::path(path).extension().string());
}

bool starts_with(std::string_view text, std::string_view beginning) {
  return text.substr(0, beginning.size()) == beginning;
}

bool ends_with(std::string_view text, std::string_view ending) {
  return text.size() >= ending.size() && text.substr(text.size() - ending.size()) == ending;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

std::string joined(const std::vector<std::string>& texts, std::string_view separator) {
  return joined(texts, separator, separator);
}

std::string joined(const std::vector<std::string>& texts, std::string_view separator, std::string_view last) {
  std::string all;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (i > 0) all += i + 1 == texts.size() ? last : separator;
    all += texts[i];
  }
  return all;
}

std::string without_trailing_zeros(std::string decimals) {
  if (decimals.find('.') != std::string::npos) {
    decimals.erase(decimals.find_last_not_of('0') + 1);
    if (decimals.back() == '.') decimals.pop_back();
  }
  return decimals == "-0" ? "0" : decimals;
}

}  // namespace vegard::sim
