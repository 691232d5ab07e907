#include "fit/search/step_record.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "sim/base/file/sha256.h"

namespace vegard::fit {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kChecksumDigits = 64;
constexpr std::size_t kDoubleDigits = 16;

std::string bits(const std::vector<double>& values) {
  std::string text;
  text.reserve(kDoubleDigits * values.size());
  for (const double value : values) {
    std::uint64_t word;
    std::memcpy(&word, &value, sizeof word);
    text += fmt::format("{:016x}", word);
  }
  return text;
}

/// Throws std::invalid_argument.
std::vector<double> doubles(const std::string& text) {
  if (text.size() % kDoubleDigits != 0) throw std::invalid_argument("no doubles");
  std::vector<double> values(text.size() / kDoubleDigits);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const char* begin = text.data() + kDoubleDigits * i;
    std::uint64_t word = 0;
    const auto [end, error] = std::from_chars(begin, begin + kDoubleDigits, word, 16);
    if (error != std::errc() || end != begin + kDoubleDigits) throw std::invalid_argument("no doubles");
    std::memcpy(&values[i], &word, sizeof word);
  }
  return values;
}

double one_double(const std::string& text) { return doubles(text).at(0); }

}  // namespace

std::string checked_line(const std::string& text) { return sim::sha256(text) + " " + text + "\n"; }

std::optional<std::string> checked_text(const std::string& line) {
  if (line.size() <= kChecksumDigits || line[kChecksumDigits] != ' ') return {};
  std::string text = line.substr(kChecksumDigits + 1);
  if (line.compare(0, kChecksumDigits, sim::sha256(text)) != 0) return {};
  return text;
}

std::string step_text(const std::string& name, const StepOutput& output) {
  Json json;
  json["step"] = name;
  json["numbers"] = Json::object();
  for (const auto& [key, values] : output.numbers) json["numbers"][key] = bits(values);
  json["words"] = output.words;
  json["flags"] = output.flags;
  json["trace"] = Json::array();
  for (const TraceRow& row : output.trace)
    json["trace"].push_back({row.stage, row.evaluation, bits({row.chi2}), bits(row.values)});
  json["books"] = {output.counters.residuals, output.counters.jacobians, bits({output.counters.best_chi2}),
                   output.counters.best_is_full, bits(output.counters.best_values)};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::optional<std::pair<std::string, StepOutput>> step_of_text(const std::string& text) {
  try {
    const Json json = Json::parse(text);
    StepOutput output;
    for (const auto& [key, values] : json.at("numbers").items())
      output.numbers[key] = doubles(values.get<std::string>());
    output.words = json.at("words").get<std::map<std::string, std::string>>();
    output.flags = json.at("flags").get<std::map<std::string, bool>>();
    for (const Json& row : json.at("trace"))
      output.trace.push_back({row.at(0).get<std::string>(), row.at(1).get<int>(),
                              one_double(row.at(2).get<std::string>()),
                              doubles(row.at(3).get<std::string>())});
    const Json& books = json.at("books");
    output.counters = {books.at(0).get<int>(), books.at(1).get<int>(),
                       one_double(books.at(2).get<std::string>()), books.at(3).get<bool>(),
                       doubles(books.at(4).get<std::string>())};
    return std::make_pair(json.at("step").get<std::string>(), output);
  } catch (const std::exception&) {
    return {};
  }
}

}  // namespace vegard::fit
