#include "sim/scene/freedom/expression.h"

#include <muParser.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <mutex>

#include "sim/base/error.h"
#include "sim/base/number/constants.h"
#include "sim/scene/rows/complaint.h"

namespace vegard::sim {
namespace {

constexpr double kExpressionStep = 1.0 / 4096.0;  // of a value
constexpr double kMinValue = 1e-3;  // for the step of values near 0, unless that leads out of the domain
constexpr const char* kPiWord = "pi";
constexpr const char* kOperators = "+-*/^(), \t";

struct Function {
  const char* name;
  double (*of_one)(double);
  double (*of_two)(double, double);
};

const std::vector<Function>& functions() {
  static const std::vector<Function> all = {
      {"sin", [](double x) { return std::sin(x); }, nullptr},
      {"cos", [](double x) { return std::cos(x); }, nullptr},
      {"tan", [](double x) { return std::tan(x); }, nullptr},
      {"sin_deg", [](double x) { return std::sin(x * kPi / 180.0); }, nullptr},
      {"cos_deg", [](double x) { return std::cos(x * kPi / 180.0); }, nullptr},
      {"tan_deg", [](double x) { return std::tan(x * kPi / 180.0); }, nullptr},
      {"exp", [](double x) { return std::exp(x); }, nullptr},
      {"log", [](double x) { return std::log(x); }, nullptr},
      {"sqrt", [](double x) { return std::sqrt(x); }, nullptr},
      {"abs", [](double x) { return std::abs(x); }, nullptr},
      {"pow", nullptr, [](double x, double y) { return std::pow(x, y); }},
      {"min", nullptr, [](double x, double y) { return std::min(x, y); }},
      {"max", nullptr, [](double x, double y) { return std::max(x, y); }},
      {"atan2", nullptr, [](double y, double x) { return std::atan2(y, x); }},
  };
  return all;
}

bool is_decimal(char c) { return c >= '0' && c <= '9'; }
bool begins_word(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_in_word(char c) { return begins_word(c) || is_decimal(c) || c == '.'; }

std::string place_text(const std::string& text, std::size_t at) {
  if (at >= text.size()) return "at its end";
  return "at character " + std::to_string(at + 1) + ", '" + text.substr(at, 20) + "'";
}

/// Where a number that begins at `at` ends: digits, a point, an exponent.
std::size_t end_of_number(const std::string& text, std::size_t at) {
  const auto skip_digits = [&] {
    while (at < text.size() && is_decimal(text[at])) ++at;
  };
  skip_digits();
  if (at < text.size() && text[at] == '.') {
    ++at;
    skip_digits();
  }
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    std::size_t exponent = at + 1;
    if (exponent < text.size() && (text[exponent] == '+' || text[exponent] == '-')) ++exponent;
    if (exponent < text.size() && is_decimal(text[exponent])) {
      at = exponent;
      skip_digits();
    }
  }
  return at;
}

/// A word that nobody knows. A hyphen belongs to the name of a sheet: "sheet.far-off.enrgy_kev".
std::string unknown_word(const std::string& text, std::size_t at) {
  const auto end_of_word = [&](std::size_t i) {
    while (i < text.size() && is_in_word(text[i])) ++i;
    return i;
  };
  const std::size_t end = end_of_word(at);
  std::string word = text.substr(at, end - at);
  if (word.compare(0, 6, "sheet.") != 0 || std::count(word.begin(), word.end(), '.') != 1) return word;
  std::size_t i = end;
  while (i < text.size() && (is_in_word(text[i]) || text[i] == '-') && text[i] != '.') ++i;
  return i < text.size() && text[i] == '.' ? text.substr(at, end_of_word(i) - at) : word;
}

}  // namespace

/// The formula as muParser has it: names with dots and hyphens are called v0, v1, ... there.
class Expression::Formula {
 public:
  Formula(const std::string& text, const std::vector<std::string>& known, std::vector<std::string>& names) {
    translate(text, known, names);
    numbers_.assign(names.size(), 1.0);
    parser_.ClearFun();
    parser_.ClearConst();
    parser_.DefineConst(kPiWord, kPi);
    for (const Function& f : functions()) {
      if (f.of_one != nullptr) parser_.DefineFun(f.name, f.of_one);
      if (f.of_two != nullptr) parser_.DefineFun(f.name, f.of_two);
    }
    try {
      for (std::size_t i = 0; i < numbers_.size(); ++i) parser_.DefineVar(variable(i), &numbers_[i]);
      parser_.SetExpr(translated_);
      parser_.Eval();
      if (parser_.GetNumResults() != 1)
        throw Error(ErrorKind::scene, "the expression has several values")
            .expected("one value")
            .hint("a decimal point, not a comma?");
    } catch (const mu::ParserError& error) {
      throw parser_error(text, error);
    }
  }
  Formula(const Formula&) = delete;
  Formula& operator=(const Formula&) = delete;

  double value(const std::vector<double>& values) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::copy(values.begin(), values.end(), numbers_.begin());
    try {
      return parser_.Eval();
    } catch (const mu::ParserError&) {
      return std::numeric_limits<double>::quiet_NaN();
    }
  }

 private:
  static std::string variable(std::size_t i) { return "v" + std::to_string(i); }

  void append(const std::string& piece, std::size_t at) {
    translated_ += piece;
    origin_.resize(translated_.size(), at);
  }

  void translate(const std::string& text, const std::vector<std::string>& known,
                 std::vector<std::string>& names) {
    for (std::size_t at = 0; at < text.size();) {
      const char c = text[at];
      if (is_decimal(c) || c == '.') {
        const std::size_t end = std::max(at + 1, end_of_number(text, at));
        for (std::size_t i = at; i < end; ++i) append(text.substr(i, 1), i);
        at = end;
      } else if (begins_word(c)) {
        at += translate_word(text, at, known, names);
      } else {
        if (std::string(kOperators).find(c) == std::string::npos)
          throw Error(ErrorKind::scene, "the expression cannot be understood " + place_text(text, at))
              .expected("numbers, names, functions, + - * / ^ and parentheses");
        append(std::string(1, c), at++);
      }
    }
  }

  /// Its length.
  std::size_t translate_word(const std::string& text, std::size_t at, const std::vector<std::string>& known,
                             std::vector<std::string>& names) {
    const std::string* longest = nullptr;
    for (const std::string& name : known) {
      if (text.compare(at, name.size(), name) != 0) continue;
      const std::size_t end = at + name.size();
      if (end < text.size() && is_in_word(text[end])) continue;
      if (longest == nullptr || name.size() > longest->size()) longest = &name;
    }
    if (longest != nullptr) {
      const auto found = std::find(names.begin(), names.end(), *longest);
      append(variable(static_cast<std::size_t>(found - names.begin())), at);
      if (found == names.end()) names.push_back(*longest);
      return longest->size();
    }
    const std::string word = unknown_word(text, at);
    const std::vector<std::string>& reserved = reserved_words();
    if (std::find(reserved.begin(), reserved.end(), word) == reserved.end()) {
      std::vector<std::string> candidates = known;
      candidates.insert(candidates.end(), reserved.begin(), reserved.end());
      throw Error(ErrorKind::scene, "the expression has an unknown name, '" + word + "'")
          .expected("a path, a name of an entry of fit.free, or a function")
          .hint(nearest_hint(word, candidates));
    }
    append(word, at);
    return word.size();
  }

  Error parser_error(const std::string& text, const mu::ParserError& error) const {
    const int position = error.GetPos();
    const bool is_inside = position >= 0 && static_cast<std::size_t>(position) < origin_.size();
    const std::string place = place_text(text, is_inside ? origin_[position] : text.size());
    switch (error.GetCode()) {
      case mu::ecMISSING_PARENS:
        return Error(ErrorKind::scene, "the expression has a parenthesis that is not closed")
            .expected("as many ')' as '('");
      case mu::ecTOO_MANY_PARAMS:
        return Error(ErrorKind::scene, "the expression gives a function too many arguments " + place)
            .hint("a decimal point, not a comma?");
      case mu::ecTOO_FEW_PARAMS:
        return Error(ErrorKind::scene, "the expression gives a function too few arguments " + place);
      case mu::ecEMPTY_EXPRESSION:
        return Error(ErrorKind::scene, "the expression is empty")
            .expected("such as \"0.8 * sheet.a.energy_kev\"");
      default:
        return Error(ErrorKind::scene, "the expression cannot be understood " + place)
            .expected("numbers, names, functions, + - * / ^ and parentheses");
    }
  }

  std::string translated_;
  std::vector<std::size_t> origin_;  // of every character of that
  mutable std::mutex mutex_;         // of the numbers, which the parser reads in their place
  mutable std::vector<double> numbers_;
  mu::Parser parser_;
};

Expression::Expression(const std::string& text, const std::vector<std::string>& known)
    : text_(text), formula_(std::make_shared<const Formula>(text, known, names_)) {}

double Expression::value(const std::vector<double>& values) const { return formula_->value(values); }

std::vector<double> Expression::slopes(const std::vector<double>& values) const {
  std::vector<double> result, moved = values;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto difference = [&](double step) {
      moved[i] = values[i] + step;
      const double above = moved[i], up = value(moved);
      moved[i] = values[i] - step;
      const double below = moved[i], down = value(moved);
      moved[i] = values[i];
      return (up - down) / (above - below);
    };
    const auto extrapolated = [&](double step) {
      return (4.0 * difference(0.5 * step) - difference(step)) / 3.0;
    };
    const double size = std::abs(values[i]);
    double slope = extrapolated(kExpressionStep * std::max(size, kMinValue));
    if (!std::isfinite(slope) && size > 0.0) slope = extrapolated(kExpressionStep * size);
    result.push_back(slope);
  }
  return result;
}

const std::vector<std::string>& Expression::reserved_words() {
  static const std::vector<std::string> words = [] {
    std::vector<std::string> all = {kPiWord};
    for (const Function& f : functions()) all.push_back(f.name);
    return all;
  }();
  return words;
}

}  // namespace vegard::sim
