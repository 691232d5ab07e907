#include "sim/scene/rows/decoding_word.h"

#include <cmath>
#include <cstdlib>
#include <vector>

#include "sim/scene/rows/complaint.h"
#include "sim/scene/rows/parameter_rules.h"

namespace vegard::sim {
namespace {

using DecodingKind = DecodingWord::Kind;

constexpr double kMin = 0.2, kMax = 5.0;  // of gammas and exponents, as sensor.gamma
const char* const kWords =
    "\"auto\", \"srgb\", \"srgb:1.3\", \"linear\", \"gamma:2.2\", \"curve:FILE.csv\", \"sensor\", "
    "\"unknown\" or "
    "\"unknown:2\"";

/// The parts between colons.
std::vector<std::string> parts_of(const std::string& text) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == ':')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

std::optional<double> number_of(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(value)) return {};
  return value;
}

std::optional<Complaint> exponent_complaint(const std::string& what, const std::string& text) {
  const std::optional<double> value = number_of(text);
  const std::string expected = "a number from 0.2 to 5";
  if (!value) return Complaint{what + " \"" + text + "\" is no number", expected, ""};
  if (*value <= 0.0) return Complaint{what + " " + text + " makes no increasing curve", expected, ""};
  if (*value < kMin || *value > kMax)
    return Complaint{what + " " + text + " is outside the limits", expected, ""};
  return {};
}

}  // namespace

std::optional<Complaint> decoding_complaint(const std::string& text) {
  if (text.compare(0, kCurveWord.size(), kCurveWord) == 0) {
    if (is_table_file(text.substr(kCurveWord.size()))) return {};
    return Complaint{"\"" + text + "\" names no table",
                     "\"curve:FILE.csv\", with the columns linear and encoded", ""};
  }
  const std::vector<std::string> parts = parts_of(text);
  const std::size_t numbers = parts.size() - 1;
  const std::string& word = parts.front();
  if (word == "gamma") {
    if (numbers != 1) return Complaint{"\"" + text + "\" does not say which gamma", "\"gamma:2.2\", say", ""};
    return exponent_complaint("the gamma", parts[1]);
  }
  if (word == "srgb" && numbers >= 1 && numbers <= 2) {
    for (std::size_t i = 1; i < parts.size(); ++i)
      if (auto complaint = exponent_complaint("the exponent", parts[i])) return complaint;
    return {};
  }
  if (text == "unknown:1" || text == "unknown:2") return {};
  const std::vector<std::string> plain = {"auto", "srgb", "linear", "sensor", "unknown"};
  for (const std::string& known : plain)
    if (text == known) return {};
  return Complaint{"\"" + text + "\" is no decoding", kWords, nearest_hint(text, plain)};
}

DecodingWord decoding_word(const std::string& text) {
  DecodingWord word;
  if (text.compare(0, kCurveWord.size(), kCurveWord) == 0) {
    word.kind = DecodingKind::curve;
    word.file = text.substr(kCurveWord.size());
    return word;
  }
  const std::vector<std::string> parts = parts_of(text);
  const std::string& name = parts.front();
  if (name == "srgb" && parts.size() > 1) {
    word.kind = DecodingKind::bent;
    word.black = *number_of(parts[1]);
    word.white = *number_of(parts.back());
  } else if (name == "gamma") {
    word.kind = DecodingKind::gamma;
    word.gamma = *number_of(parts[1]);
  } else if (name == "unknown") {
    word.kind = DecodingKind::unknown;
    word.unknowns = parts.size() > 1 ? static_cast<int>(*number_of(parts[1])) : 1;
  } else if (name != "auto") {
    word.kind = name == "srgb"     ? DecodingKind::srgb
                : name == "linear" ? DecodingKind::linear
                                   : DecodingKind::sensor;
  }
  return word;
}

}  // namespace vegard::sim
