// CLI::Range lets "nan" through, which is neither below nor above anything.
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>

namespace vegard::apps {

/// CLI::Range(low, high) that refuses what is no number.
inline CLI::Validator finite_range(double low, double high) {
  const CLI::Range range(low, high);
  return CLI::Validator(
      [range](std::string& word) {
        double number = 0.0;
        if (CLI::detail::lexical_cast(word, number) && std::isnan(number))
          return "'" + word + "' is no number";
        return range(word);
      },
      range.get_description());
}

}  // namespace vegard::apps
