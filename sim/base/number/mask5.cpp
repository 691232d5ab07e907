#include "sim/base/number/mask5.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

#include "sim/base/error.h"

namespace vegard::sim {
namespace {

constexpr std::string_view kBetween = " \t\r,;";

}  // namespace

double Mask5::sum() const { return std::accumulate(weights.begin(), weights.end(), 0.0); }

Mask5 blur_mask() {
  constexpr double kRow[Mask5::kSide] = {1.0 / 16.0, 4.0 / 16.0, 6.0 / 16.0, 4.0 / 16.0, 1.0 / 16.0};
  Mask5 mask;
  for (int i = 0; i < Mask5::kSide; ++i)
    for (int j = 0; j < Mask5::kSide; ++j)
      for (int k = 0; k < Mask5::kSide; ++k)
        mask.weights[(i * Mask5::kSide + j) * Mask5::kSide + k] = kRow[i] * kRow[j] * kRow[k];
  return mask;
}

Mask5 sharpen_mask() {
  Mask5 mask = blur_mask();
  for (double& weight : mask.weights) weight = -weight;
  mask.weights[Mask5::at(0, 0, 0)] += 2.0;
  return mask;
}

Mask5 read_mask5(std::string_view text, const std::string& name) {
  Mask5 mask;
  int count = 0, line_number = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    ++line_number;
    line = line.substr(0, std::min(line.find('#'), line.size()));
    for (;;) {
      const std::size_t first = line.find_first_not_of(kBetween);
      if (first == std::string_view::npos) break;
      line.remove_prefix(first);
      std::string_view word = line.substr(0, std::min(line.find_first_of(kBetween), line.size()));
      line.remove_prefix(word.size());
      const std::string whole(word);
      if (word.front() == '+') word.remove_prefix(1);
      double number = 0.0;
      const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), number);
      if (error != std::errc() || stop != word.data() + word.size() || !std::isfinite(number))
        throw unreadable(name, "'" + whole + "' is no number")
            .line(line_number)
            .expected("125 finite numbers");
      if (count == Mask5::kWeights)
        throw unreadable(name, "more than 125 numbers").line(line_number).expected("5 x 5 x 5 of them");
      if (std::abs(number) > Mask5::kMaxWeight)
        throw unreadable(name, "the weight " + whole + " is too large")
            .line(line_number)
            .expected("from -1e6 to 1e6");
      mask.weights[count++] = number;
    }
  }
  if (count < Mask5::kWeights)
    throw unreadable(name, std::to_string(count) + " numbers")
        .line(line_number)
        .expected("125 of them, 5 x 5 x 5");
  return mask;
}

}  // namespace vegard::sim
