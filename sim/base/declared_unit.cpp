#include "sim/base/declared_unit.h"

#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>

#include "sim/base/error.h"
#include "sim/base/shown_text.h"
#include "sim/base/text.h"

namespace vegard::sim {
namespace declared_unit {

/// Powers of photons, metres, seconds, radians, steradians and joules.
using Dimensions = std::array<double, 6>;

struct Unit {
  double factor = 1.0;
  Dimensions dimensions{};
};

constexpr double kTau = 6.283185307179586476925;
constexpr double kJoulesPerEv = 1.602176634e-19;

struct Named {
  const char* name;
  Unit unit;
};

/// Symbols, as they are written.
const Named kSymbols[] = {
    {"R", {1e10, {1, -2, -1, 0, 0, 0}}},
    {"ph", {1.0, {1}}},
    {"m", {1.0, {0, 1}}},
    {"s", {1.0, {0, 0, 1}}},
    {"rad", {1.0, {0, 0, 0, 1}}},
    {"deg", {kTau / 360.0, {0, 0, 0, 1}}},
    {"arcmin", {kTau / 21600.0, {0, 0, 0, 1}}},
    {"arcsec", {kTau / 1296000.0, {0, 0, 0, 1}}},
    {"sr", {1.0, {0, 0, 0, 0, 1}}},
    {"J", {1.0, {0, 0, 0, 0, 0, 1}}},
    {"W", {1.0, {0, 0, -1, 0, 0, 1}}},
    {"erg", {1e-7, {0, 0, 0, 0, 0, 1}}},
    {"eV", {kJoulesPerEv, {0, 0, 0, 0, 0, 1}}},
};

/// Names in words, in small letters; an s may stand behind them.
const Named kNames[] = {
    {"rayleigh", {1e10, {1, -2, -1, 0, 0, 0}}},
    {"photon", {1.0, {1}}},
    {"quanta", {1.0, {1}}},
    {"metre", {1.0, {0, 1}}},
    {"meter", {1.0, {0, 1}}},
    {"sec", {1.0, {0, 0, 1}}},
    {"second", {1.0, {0, 0, 1}}},
    {"radian", {1.0, {0, 0, 0, 1}}},
    {"degree", {kTau / 360.0, {0, 0, 0, 1}}},
    {"deg", {kTau / 360.0, {0, 0, 0, 1}}},
    {"degrees_north", {kTau / 360.0, {0, 0, 0, 1}}},
    {"degrees_east", {kTau / 360.0, {0, 0, 0, 1}}},
    {"degree_north", {kTau / 360.0, {0, 0, 0, 1}}},
    {"degree_east", {kTau / 360.0, {0, 0, 0, 1}}},
    {"steradian", {1.0, {0, 0, 0, 0, 1}}},
    {"joule", {1.0, {0, 0, 0, 0, 0, 1}}},
    {"watt", {1.0, {0, 0, -1, 0, 0, 1}}},
    {"electronvolt", {kJoulesPerEv, {0, 0, 0, 0, 0, 1}}},
};

struct Prefix {
  const char *symbol, *name;
  double factor;
};
constexpr Prefix kPrefixes[] = {{"k", "kilo", 1e3},        {"M", "mega", 1e6},   {"G", "giga", 1e9},
                                {"m", "milli", 1e-3},      {"u", "micro", 1e-6}, {"\u00b5", "micro", 1e-6},
                                {"\u03bc", "micro", 1e-6}, {"n", "nano", 1e-9},  {"c", "centi", 1e-2},
                                {"d", "deci", 1e-1},       {"h", "hecto", 1e2},  {"p", "pico", 1e-12}};

std::optional<Unit> unit_called(const std::string& word) {
  for (const Named& one : kSymbols)
    if (word == one.name) return one.unit;
  for (const Named& one : kSymbols)
    for (const Prefix& prefix : kPrefixes)
      if (word == std::string(prefix.symbol) + one.name)
        return Unit{prefix.factor * one.unit.factor, one.unit.dimensions};
  const std::string low = lowered(word);
  for (const Named& one : kNames) {
    const std::string name = one.name;
    if (low == name || low == name + "s") return one.unit;
    for (const Prefix& prefix : kPrefixes)
      if (low == prefix.name + name || low == prefix.name + name + "s")
        return Unit{prefix.factor * one.unit.factor, one.unit.dimensions};
  }
  return std::nullopt;
}

Unit power(Unit unit, double exponent) {
  unit.factor = std::pow(unit.factor, exponent);
  for (double& one : unit.dimensions) one *= exponent;
  return unit;
}

Unit product(Unit a, const Unit& b) {
  a.factor *= b.factor;
  for (std::size_t i = 0; i < a.dimensions.size(); ++i) a.dimensions[i] += b.dimensions[i];
  return a;
}

/// Raised digits and minus as plain ones, the degree sign and the middle dot as words.
std::string plain(std::string_view unit) {
  static const std::pair<const char*, const char*> kSigns[] = {
      {"\u207b", "-"}, {"\u2070", "0"}, {"\u00b9", "1"}, {"\u00b2", "2"}, {"\u00b3", "3"},
      {"\u2074", "4"}, {"\u2212", "-"}, {"\u00b7", "*"}, {"\u22c5", "*"}, {"\u00b0", "deg"}};
  std::string text(unit);
  for (const auto& [sign, stand_in] : kSigns)
    for (std::size_t at = text.find(sign); at != std::string::npos; at = text.find(sign, at))
      text.replace(at, std::string_view(sign).size(), stand_in);
  return text;
}

/// Products, quotients and powers; empty for what is none.
class Reader {
 public:
  explicit Reader(std::string text) : text_(std::move(text)) {}

  std::optional<Unit> read() {
    std::optional<Unit> unit = terms(0);
    skip_blanks();
    return at_ == text_.size() ? unit : std::nullopt;
  }

 private:
  char next() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  void skip_blanks() {
    while (next() == ' ' || next() == '_') ++at_;
  }

  std::optional<Unit> terms(int depth) {
    constexpr int kDeepest = 8;
    if (depth > kDeepest) return std::nullopt;
    Unit all;
    bool any = false;
    while (true) {
      skip_blanks();
      bool divides = false;
      if (next() == '/') {
        divides = true;
        ++at_;
      } else if (any && (next() == '*' || next() == '.')) {
        ++at_;
      }
      skip_blanks();
      if (next() == '\0' || next() == ')') return any && !divides ? std::optional(all) : std::nullopt;
      const std::optional<Unit> one = factor(depth);
      if (!one) return std::nullopt;
      all = product(all, divides ? power(*one, -1.0) : *one);
      any = true;
    }
  }

  std::optional<Unit> factor(int depth) {
    std::optional<Unit> unit;
    if (next() == '(') {
      ++at_;
      unit = terms(depth + 1);
      if (!unit || next() != ')') return std::nullopt;
      ++at_;
    } else if (std::isdigit(static_cast<unsigned char>(next())) != 0) {
      const std::optional<double> number = real();
      if (!number) return std::nullopt;
      unit = Unit{*number, {}};
    } else {
      std::size_t end = at_;
      while (end < text_.size() && is_letter(text_[end])) ++end;
      unit = unit_called(text_.substr(at_, end - at_));
      at_ = end;
    }
    if (!unit) return std::nullopt;
    const std::optional<double> exponent = exponent_behind();
    return exponent ? std::optional(power(*unit, *exponent)) : std::nullopt;
  }

  static bool is_letter(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0 || (static_cast<unsigned char>(c) & 0x80) != 0 ||
           c == '_';
  }

  std::optional<double> real() {
    char* end = nullptr;
    const double value = std::strtod(text_.c_str() + at_, &end);
    const auto to = static_cast<std::size_t>(end - text_.c_str());
    if (to == at_ || !std::isfinite(value)) return std::nullopt;
    at_ = to;
    return value;
  }

  /// 1 without one; none for a sign that nothing follows.
  std::optional<double> exponent_behind() {
    bool is_marked = false;
    if (next() == '^') {
      is_marked = true;
      ++at_;
    } else if (text_.compare(at_, 2, "**") == 0) {
      is_marked = true;
      at_ += 2;
    }
    const bool in_brackets = is_marked && next() == '(';
    if (in_brackets) ++at_;
    const bool has_sign = next() == '-' || next() == '+';
    if (!is_marked && !has_sign && std::isdigit(static_cast<unsigned char>(next())) == 0) return 1.0;
    const double sign = next() == '-' ? -1.0 : 1.0;
    if (has_sign) ++at_;
    double value = 0.0;
    bool any = false;
    for (; std::isdigit(static_cast<unsigned char>(next())) != 0 && value < 100.0; ++at_) {
      value = 10.0 * value + (next() - '0');
      any = true;
    }
    if (in_brackets && next() != ')') return std::nullopt;
    if (in_brackets) ++at_;
    return any ? std::optional(sign * value) : std::nullopt;
  }

  std::string text_;
  std::size_t at_ = 0;
};

struct Target {
  const char* words;
  std::array<Unit, 2> units;  ///< the second: another form of the same quantity
};

const Target& target_of(Quantity quantity) {
  static const Target brightness = {
      "R, kR, or photons cm-2 s-1",
      {Unit{1e10, {1, -2, -1, 0, 0, 0}}, Unit{1e10 / (2.0 * kTau), {1, -2, -1, 0, -1, 0}}}};
  static const Target angle = {"deg or rad",
                               {Unit{kTau / 360.0, {0, 0, 0, 1}}, Unit{kTau / 360.0, {0, 0, 0, 1}}}};
  static const Target flux = {"mW m-2, or erg cm-2 s-1",
                              {Unit{1e-3, {0, -2, -1, 0, 0, 1}}, Unit{1e-3, {0, -2, -1, 0, 0, 1}}}};
  static const Target energy = {
      "keV or eV",
      {Unit{1e3 * kJoulesPerEv, {0, 0, 0, 0, 0, 1}}, Unit{1e3 * kJoulesPerEv, {0, 0, 0, 0, 0, 1}}}};
  static const Target length = {"km or m", {Unit{1e3, {0, 1}}, Unit{1e3, {0, 1}}}};
  switch (quantity) {
    case Quantity::brightness_rayleigh:
      return brightness;
    case Quantity::angle_deg:
      return angle;
    case Quantity::energy_flux_mw_m2:
      return flux;
    case Quantity::energy_kev:
      return energy;
    case Quantity::length_km:
      break;
  }
  return length;
}

}  // namespace declared_unit

std::optional<double> factor_of_unit(std::string_view text, Quantity quantity) {
  using namespace declared_unit;
  const std::optional<Unit> unit = Reader(plain(text)).read();
  if (!unit || !(unit->factor > 0.0) || !std::isfinite(unit->factor)) return std::nullopt;
  for (const Unit& target : target_of(quantity).units) {
    if (unit->dimensions != target.dimensions) continue;
    const double factor = unit->factor / target.factor;
    // A thousand of something is a thousand, not a bit less.
    const double whole = factor >= 1.0 ? std::round(factor) : 1.0 / std::round(1.0 / factor);
    constexpr double kRounding = 1e-12;
    return std::abs(factor / whole - 1.0) < kRounding ? whole : factor;
  }
  return std::nullopt;
}

double declared_factor(std::string_view unit, Quantity quantity, const std::string& file,
                       const std::string& key) {
  const std::string text(trimmed(unit, " "));
  if (text.empty()) return 1.0;
  if (const auto factor = factor_of_unit(text, quantity)) return *factor;
  throw unreadable(file, key + " is '" + shown_text(text) + "'")
      .key(key)
      .expected(declared_unit::target_of(quantity).words)
      .hint("convert its values, or correct or remove what it declares");
}

std::string unit_of_plane(const std::map<std::string, std::string>& keywords, int plane, bool is_of_all,
                          std::string& key) {
  const auto text = [&](const std::string& name) {
    const auto found = keywords.find(name);
    return found == keywords.end() ? std::string() : found->second;
  };
  key = "BUNIT" + std::to_string(plane + 1);
  if (const std::string own = text(key); !own.empty()) return own;
  key = "BUNIT";
  std::string rest = text(key);
  const bool is_list = rest.find_first_of(",;") != std::string::npos;
  for (int p = 0; is_list && p < plane; ++p) {
    const std::size_t end = rest.find_first_of(",;");
    rest = end == std::string::npos ? std::string() : rest.substr(end + 1);
  }
  if (is_list) return std::string(trimmed(rest.substr(0, rest.find_first_of(",;"))));
  return plane == 0 || is_of_all ? rest : std::string();
}

}  // namespace vegard::sim
