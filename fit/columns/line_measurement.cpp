#include "fit/columns/line_measurement.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "fit/columns/column_chi2.h"
#include "sim/base/error.h"
#include "sim/scene/lines/emission_lines.h"

namespace vegard::fit {
namespace {

constexpr const char* kLineForm =
    "NM=RAYLEIGHS±ERROR, such as 427.8=2300±50, 427.8=2300+-50 or 427.8=2300±2%";

/// Reads a finite number at the beginning of the text from `at` on; `at` moves behind it and the blanks about
/// it.
std::optional<double> leading_number(const std::string& text, std::size_t& at) {
  const char* begin = text.c_str() + at;
  char* end = nullptr;
  const double number = std::strtod(begin, &end);
  if (end == begin || !std::isfinite(number)) return std::nullopt;
  at += static_cast<std::size_t>(end - begin);
  while (at < text.size() && text[at] == ' ') ++at;
  return number;
}

std::string auroral_line_list() {
  std::string list;
  for (const sim::EmissionLine& line : sim::emission_lines())
    if (sim::is_auroral(line)) list += fmt::format("{}{:.1f}", list.empty() ? "" : ", ", line.wavelength_nm);
  return list;
}

sim::Error brightness_fault(const std::string& option, const std::string& problem) {
  return sim::Error(sim::ErrorKind::usage, problem).key(option);
}

}  // namespace

double BrightnessError::of(double brightness_rayleigh) const {
  return std::hypot(rayleigh, relative * std::max(0.0, brightness_rayleigh));
}

LineWord line_word(const std::string& text, const std::string& option, const std::string& expected) {
  std::size_t at = 0;
  const std::optional<double> wavelength_nm = leading_number(text, at);
  if (!wavelength_nm || at >= text.size() || text[at] != '=' || at + 1 == text.size())
    throw brightness_fault(option, "'" + text + "' is not understood").expected(expected);
  const sim::EmissionLine* line = sim::find_emission_line(*wavelength_nm);
  if (line == nullptr || !sim::is_auroral(*line))
    throw brightness_fault(option, fmt::format("no line of the aurora is known at {:g} nm", *wavelength_nm))
        .expected("one of " + auroral_line_list() + " nm");
  return {line->wavelength_nm, text.substr(at + 1)};
}

BrightnessError brightness_error(const std::string& text, const std::string& option) {
  std::size_t at = 0;
  const std::optional<double> number = leading_number(text, at);
  const bool is_percent = at < text.size() && text[at] == '%';
  if (!number || at + (is_percent ? 1 : 0) != text.size())
    throw brightness_fault(option, "'" + text + "' is no error")
        .expected("rayleighs such as 50, or per cent such as 5%");
  if (*number <= 0.0)
    throw brightness_fault(option, "an error of " + text + " is none")
        .expected("above 0")
        .hint("what is not known better than this cannot be weighed against other lines");
  return is_percent ? BrightnessError{0.0, 0.01 * *number} : BrightnessError{*number, 0.0};
}

LineMeasurement line_measurement(const std::string& text) {
  const LineWord word = line_word(text, "--line", kLineForm);
  std::size_t at = 0;
  const std::optional<double> rayleigh = leading_number(word.rest, at);
  if (!rayleigh) throw brightness_fault("--line", "'" + text + "' is not understood").expected(kLineForm);
  if (*rayleigh < 0.0)
    throw brightness_fault("--line",
                           fmt::format("the brightness of {:.1f} nm is {:g}", word.wavelength_nm, *rayleigh))
        .expected("0 or more rayleighs")
        .hint("for what cannot be seen give 0 with the error of the measurement");
  LineMeasurement line{word.wavelength_nm, *rayleigh, std::nullopt};
  if (at == word.rest.size()) return line;
  for (const std::string sign : {"±", "+-", "+/-"}) {
    if (word.rest.compare(at, sign.size(), sign) != 0) continue;
    std::size_t begin = at + sign.size();
    while (begin < word.rest.size() && word.rest[begin] == ' ') ++begin;
    line.error = brightness_error(word.rest.substr(begin), "--line");
    if (line.error->of(line.rayleigh) <= 0.0)
      throw brightness_fault(
          "--line", fmt::format("per cent of a brightness of 0 are no error ({:.1f} nm)", line.wavelength_nm))
          .expected("an error in rayleighs");
    return line;
  }
  throw brightness_fault("--line", "'" + text + "' is not understood").expected(kLineForm);
}

void require_different_lines(const std::vector<double>& lines_nm, const std::string& option) {
  for (std::size_t i = 0; i < lines_nm.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (lines_nm[i] == lines_nm[j])
        throw brightness_fault(option, fmt::format("{:.1f} nm is given twice", lines_nm[i]))
            .expected("each line once");
  if (lines_nm.size() > kMaxColumnLines)
    throw brightness_fault(option, fmt::format("{} lines are given", lines_nm.size()))
        .expected(fmt::format("{} at most", kMaxColumnLines));
}

}  // namespace vegard::fit
