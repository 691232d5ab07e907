#include "apps/options/site_words.h"

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string_view>

#include "apps/options/refusals.h"
#include "sim/base/text.h"

namespace vegard::apps {
namespace {

constexpr const char* kSiteForm =
    "latitude and longitude in degrees, such as 78.148,16.043 or 78.148N,16.043E";

struct SiteAngle {
  double degrees = 0.0;
  char letter = 0;  ///< 'N', 'S', 'E', 'W', or 0
};

/// Reads a word from its beginning on.
class AngleReader {
 public:
  explicit AngleReader(std::string_view word) : rest_(word) { trim(); }

  std::optional<SiteAngle> read() {
    SiteAngle angle;
    angle.letter = letter_at(rest_.empty() ? 0 : rest_.front());
    if (angle.letter != 0) rest_.remove_prefix(1), trim();
    const char last = letter_at(rest_.empty() ? 0 : rest_.back());
    if (last != 0) {
      if (angle.letter != 0) return std::nullopt;
      angle.letter = last;
      rest_.remove_suffix(1);
      trim();
    }
    const bool negative = !rest_.empty() && rest_.front() == '-';
    // Either a sign or a letter says which side it is.
    if (!rest_.empty() && (rest_.front() == '-' || rest_.front() == '+')) {
      if (angle.letter != 0) return std::nullopt;
      rest_.remove_prefix(1);
    }
    const std::optional<double> degrees = number();
    if (!degrees) return std::nullopt;
    angle.degrees = *degrees;
    if (mark({"\u00b0", "d"})) {
      if (!add_part(angle.degrees, 60.0, {"'", "\u2032"})) return std::nullopt;
      if (!add_part(angle.degrees, 3600.0, {"\"", "\u2033", "''"})) return std::nullopt;
    }
    if (!rest_.empty()) return std::nullopt;
    if (negative || angle.letter == 'S' || angle.letter == 'W') angle.degrees = -angle.degrees;
    return angle;
  }

 private:
  static char letter_at(char c) {
    const char upper = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return std::string_view("NSEW").find(upper) != std::string_view::npos && upper != 0 ? upper : char{0};
  }
  void trim() { rest_ = sim::trimmed(rest_, " "); }
  /// Of digits and one point.
  std::optional<double> number() {
    const std::size_t end = std::min(rest_.find_first_not_of("0123456789."), rest_.size());
    const std::string digits(rest_.substr(0, end));
    if (digits.empty() || digits.find_first_of("0123456789") == std::string::npos) return std::nullopt;
    char* stop = nullptr;
    const double value = std::strtod(digits.c_str(), &stop);
    if (*stop != '\0' || !std::isfinite(value)) return std::nullopt;
    rest_.remove_prefix(end);
    trim();
    return value;
  }
  bool mark(std::initializer_list<std::string_view> marks) {
    for (const std::string_view one : marks)
      if (rest_.substr(0, one.size()) == one) {
        rest_.remove_prefix(one.size());
        trim();
        return true;
      }
    return false;
  }
  /// Minutes or seconds, if there are any.
  bool add_part(double& degrees, double parts, std::initializer_list<std::string_view> marks) {
    if (rest_.empty()) return true;
    const std::string_view before = rest_;
    const std::optional<double> value = number();
    if (!value || *value >= 60.0) return false;
    if (!mark(marks)) {
      rest_ = before;  // seconds without minutes
      return true;
    }
    degrees += *value / parts;
    return true;
  }

  std::string_view rest_;
};

bool is_latitude(const SiteAngle& angle) { return angle.letter == 'N' || angle.letter == 'S'; }

}  // namespace

namespace {

const char* const kSiteWords =
    "Site: degrees north and east (78.148,16.043 or 78.148N,16.043E), metres above the sea";

}  // namespace

void add_site_option(const Command& command, std::vector<std::string>& words) {
  command.option("--site", words, kSiteWords).delimiter(',').expected(2, 3).type_name("LAT,LON[,HEIGHT]");
}

void add_repeated_site_option(const Command& command, std::vector<std::string>& sites) {
  // One word an occurrence: else a picture that follows would be taken for the height.
  command.option("--site", sites, kSiteWords).repeated().one_an_occurrence().type_name("LAT,LON[,HEIGHT]");
}

sim::Observer site_place(const std::vector<std::string>& words, const std::string& key) {
  const std::string all = sim::joined(words, ",");
  if (words.size() < 2 || words.size() > 3) throw usage_error(key, "'" + all + "' is no place", kSiteForm);
  std::optional<SiteAngle> first = AngleReader(words[0]).read(), second = AngleReader(words[1]).read();
  for (int i = 0; i < 2; ++i)
    if (!(i == 0 ? first : second)) throw usage_error(key, "'" + words[i] + "' is no angle", kSiteForm);
  // Letters win over the order.
  if (first->letter != 0 && second->letter != 0 && !is_latitude(*first)) std::swap(first, second);
  if ((first->letter != 0 && !is_latitude(*first)) || (second->letter != 0 && is_latitude(*second)))
    throw usage_error(key, "'" + all + "' is no latitude and longitude", kSiteForm);
  sim::Observer place;
  place.latitude_deg = first->degrees;
  place.longitude_deg = second->degrees;
  if (!(std::abs(place.latitude_deg) <= 90.0) ||
      !(place.longitude_deg >= -180.0 && place.longitude_deg <= 360.0))
    throw usage_error(key, "no such place", "latitude -90 to 90, longitude -180 to 360");
  if (words.size() > 2) {
    std::string height = words[2];
    if (!height.empty() && height.back() == 'm') height.pop_back();
    char* stop = nullptr;
    place.height_m = std::strtod(height.c_str(), &stop);
    while (*stop == ' ') ++stop;
    if (stop == height.c_str() || *stop != '\0' || !std::isfinite(place.height_m))
      throw usage_error(key, "'" + words[2] + "' is no height", "metres above the sea");
  }
  return place;
}

sim::Observer site_of_text(const std::string& text, const std::string& key) {
  std::vector<std::string> words;
  for (const std::string_view word : sim::split(text, ',')) words.emplace_back(word);
  return site_place(words, key);
}

}  // namespace vegard::apps
