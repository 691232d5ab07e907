#include "fit/survey/followed_quantity.h"

#include <array>

#include "sim/base/text.h"

namespace vegard::fit {
namespace {

struct FollowedWords {
  SurveyWork work;
  const char* beginning;
  FollowedKind kind;
};
constexpr std::array<FollowedWords, 12> kFollowed = {{
    {SurveyWork::border, "highest elevation", FollowedKind::border},
    {SurveyWork::border, "nearest azimuth", FollowedKind::border_azimuth},
    {SurveyWork::border, "distance if 105 km high", FollowedKind::distance},
    {SurveyWork::fit, "mean electron energy of the ", FollowedKind::energy},
    {SurveyWork::fit, "energy flux Q of the ", FollowedKind::flux},
    {SurveyWork::fit, "distance of the ", FollowedKind::distance},
    {SurveyWork::fit, "lower border of ", FollowedKind::altitude},
    {SurveyWork::fit, "azimuth of the nearest point of the ", FollowedKind::sheet_azimuth},
    {SurveyWork::map, "characteristic energy E0", FollowedKind::characteristic},
    {SurveyWork::map, "energy flux", FollowedKind::flux},
    {SurveyWork::map, "distance of the nearest point", FollowedKind::distance},
    {SurveyWork::map, "lower border", FollowedKind::altitude},
}};

}  // namespace

std::optional<FollowedKind> followed_kind(SurveyWork work, const SurveyQuantity& quantity) {
  if (quantity.item > 1) return std::nullopt;
  for (const FollowedWords& words : kFollowed)
    if (words.work == work && sim::starts_with(quantity.name, words.beginning)) return words.kind;
  return std::nullopt;
}

std::string owner_of_quantity(const std::string& name) {
  const std::string of = " of the ";
  const std::size_t begin = name.rfind(of);
  if (begin == std::string::npos) return {};
  const std::size_t from = begin + of.size(), end = name.rfind(' ');
  return end == std::string::npos || end <= from ? name.substr(from) : name.substr(from, end - from);
}

}  // namespace vegard::fit
