#include "fit/uncertainty/trade_off.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sim/base/file/number_text.h"
#include "sim/base/text.h"
#include "sim/scene/emitters/emitter_kinds.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::fit {
namespace {

constexpr double kNoticeableShare = 0.1, kNoticeableDegrees = 10.0, kNoticeableRadians = 0.2;
constexpr double kUnnoticed = 0.02;  // of what the most noticeable number of a direction changes by
constexpr std::size_t kMaxMembers = 3;
constexpr double kNearlyAll = 0.9;  // of a step: along the line of sight, or across it

std::string noun_of(const FreeNumber& number) {
  if (!number.has_path()) return number.name;
  const sim::ParameterRow& row = *number.id.row;
  // One of several of a kind: the line of a blur, the coefficient of a profile.
  const std::size_t at = number.path.rfind(row.key + ".");
  const bool one_of_several = !row.component.empty() && at != std::string::npos;
  return one_of_several ? row.noun + " " + number.path.substr(at + row.key.size() + 1) : row.noun;
}

/// Which of the centres of sheets and footprints, one after the other, a number is a component of; -1: none.
int centre_of(const sim::Scene& scene, const sim::ParameterId& id) {
  if (id.role() == sim::ParameterRole::centre) return id.element;
  if (id.role() != sim::ParameterRole::footprint_centre) return -1;
  return static_cast<int>(scene.sheets.size()) + id.element;
}

std::string owner_of(const sim::Scene& scene, const sim::ParameterId& id) {
  if (!id.any() || id.row->table.empty()) return {};
  std::string table = id.row->table;
  std::replace(table.begin(), table.end(), '_', ' ');
  const std::string name = sim::element_name(scene, id);
  // "the bright loop", but not "the loop loop"
  const sim::EmitterKind* emitter = sim::kind_of_table(id.row->table);
  const bool is_spoken = emitter != nullptr && emitter->table == id.row->table && !emitter->spoken.empty();
  const std::string kind = is_spoken ? emitter->spoken : table;
  return "the " + (name.empty() || name == kind ? "" : name + " ") + kind;
}

double noticeable_change(const FreeNumber& number, double value) {
  if (number.unit() == "deg") return kNoticeableDegrees;
  if (number.unit() == "rad") return kNoticeableRadians;
  const double share = kNoticeableShare * std::abs(value);
  if (share > 0.0) return share;
  const double range = number.max - number.min;
  return std::isfinite(range) && range > 0.0 ? 0.1 * kNoticeableShare * range : 1.0;
}

/// One change in words, "10 km further", with its size for their order.
struct Member {
  std::string noun, owner;
  double change = 0.0;      ///< in the unit
  double noticeable = 1.0;  ///< in the unit
  std::string unit, more, less;
  bool is_place = false;
  std::vector<std::size_t> of;  ///< the numbers it stands for
  double size() const { return std::abs(change) / noticeable; }
};

Member member_of(const DescribedNumber& n, double change, std::size_t index) {
  Member m;
  m.noun = n.noun;
  m.owner = n.owner;
  m.change = change;
  m.noticeable = n.noticeable;
  m.unit = n.unit;
  m.of = {index};
  m.more = n.is_altitude ? "higher" : "more";
  m.less = n.is_altitude ? "lower" : "less";
  if (n.of_profile) {
    // Its unit and size say nothing to anyone.
    m.change = 100.0 * change / n.value;
    m.noticeable = 100.0 * kNoticeableShare;
    m.unit = "%";
  }
  return m;
}

/// A step of a sheet's centre, as the observer sees it.
Member place_member(const DescribedNumber& n, double east, double north, std::vector<std::size_t> of) {
  Member m;
  m.owner = n.owner;
  m.unit = n.unit;
  m.is_place = true;
  m.of = std::move(of);
  const double away = std::hypot(n.centre_km.east, n.centre_km.north);
  m.noticeable = away > 0.0 ? kNoticeableShare * away : 1.0;
  const double u = away > 0.0 ? n.centre_km.east / away : 0.0;
  const double v = away > 0.0 ? n.centre_km.north / away : 1.0;
  const double outwards = u * east + v * north, rightwards = v * east - u * north;
  const bool radial = std::abs(outwards) >= std::abs(rightwards);
  m.noun = radial ? "distance" : "place";
  m.change = radial ? outwards : rightwards;
  m.more = radial ? "further" : "to the right";
  m.less = radial ? "nearer" : "to the left";
  return m;
}

/// East or north by itself. Where the other component is free too and neither points at the observer, only
/// the compass tells them apart.
Member lone_place_member(const DescribedNumber& n, double change, std::size_t index) {
  const bool east = n.place == DescribedNumber::Place::east;
  Member m = place_member(n, east ? change : 0.0, east ? 0.0 : change, {index});
  if (!n.other_component_free || std::abs(m.change) > kNearlyAll * std::abs(change)) return m;
  m.noun = east ? "place to the east" : "place to the north";
  m.change = change;
  m.more = east ? "to the east" : "to the north";
  m.less = east ? "to the west" : "to the south";
  return m;
}

std::string quantity(double amount, const std::string& unit, int digits) {
  const std::string number = sim::short_number(amount, digits);
  if (unit == "deg") return number + "\u00b0";
  return unit.empty() ? number : number + " " + unit;
}

std::string change_words(const Member& m, double change, int digits, bool with_noun) {
  const std::string noun = with_noun && !m.is_place ? " " + m.noun : "";
  const std::string amount = quantity(std::abs(change), m.unit, digits);
  const std::string& way = change < 0.0 ? m.less : m.more;
  return m.is_place ? amount + " " + way : amount + " " + way + noun;
}

std::string listed(const std::vector<std::string>& words) { return sim::joined(words, ", ", " and "); }

/// "distance and energy of the main sheet", "distance of the main sheet and azimuth of the camera".
std::string names_of(const std::vector<Member>& members) {
  const bool one_owner = std::all_of(members.begin(), members.end(),
                                     [&](const Member& m) { return m.owner == members.front().owner; });
  const auto of = [](const std::string& owner) { return owner.empty() ? "" : " of " + owner; };
  std::vector<std::string> names;
  for (const Member& m : members) names.push_back(m.noun + (one_owner ? "" : of(m.owner)));
  return listed(names) + (one_owner ? of(members.front().owner) : "");
}

/// 1, 2 or 5 times a power of ten, the nearest by ratio.
double round_amount(double amount) {
  const double power = std::pow(10.0, std::floor(std::log10(amount)));
  double best = power;
  for (const double step : {1.0, 2.0, 5.0, 10.0})
    if (std::abs(std::log(step * power / amount)) < std::abs(std::log(best / amount))) best = step * power;
  return best;
}

std::vector<Member> members_of(const std::vector<DescribedNumber>& numbers,
                               const std::vector<double>& direction) {
  std::vector<Member> members;
  std::vector<bool> told(numbers.size(), false);
  for (std::size_t j = 0; j < numbers.size(); ++j) {
    if (told[j] || direction[j] == 0.0 || !std::isfinite(direction[j])) continue;
    if (numbers[j].place == DescribedNumber::Place::none) {
      members.push_back(member_of(numbers[j], direction[j], j));
      continue;
    }
    double east = 0.0, north = 0.0;
    std::vector<std::size_t> numbers_moved;
    for (std::size_t k = j; k < numbers.size(); ++k) {
      if (numbers[k].centre != numbers[j].centre || numbers[k].place == DescribedNumber::Place::none)
        continue;
      (numbers[k].place == DescribedNumber::Place::east ? east : north) += direction[k];
      told[k] = true;
      numbers_moved.push_back(k);
    }
    members.push_back(place_member(numbers[j], east, north, numbers_moved));
  }
  return members;
}

}  // namespace

std::vector<DescribedNumber> described_numbers(const sim::Scene& scene, const std::vector<FreeNumber>& free,
                                               const std::vector<double>& values) {
  std::vector<sim::EastNorth> centres;
  for (const sim::Sheet& sheet : scene.sheets) centres.push_back(sheet.center_km);
  for (const sim::Footprint& footprint : scene.footprints) centres.push_back(footprint.center_km);
  for (std::size_t j = 0; j < free.size(); ++j)
    if (const int c = centre_of(scene, free[j].id); c >= 0)
      (free[j].id.component == 0 ? centres[c].east : centres[c].north) = values[j];
  std::vector<DescribedNumber> numbers;
  for (std::size_t j = 0; j < free.size(); ++j) {
    const sim::ParameterId& id = free[j].id;
    DescribedNumber n;
    n.path = free[j].label();
    n.noun = noun_of(free[j]);
    n.owner = owner_of(scene, id);
    n.unit = free[j].unit();
    n.value = values[j];
    n.noticeable = noticeable_change(free[j], values[j]);
    n.centre = centre_of(scene, id);
    n.of_profile = id.role() == sim::ParameterRole::profile_coefficient;
    n.is_altitude = id.role() == sim::ParameterRole::form_peak;
    if (n.centre >= 0) {
      n.place = id.component == 0 ? DescribedNumber::Place::east : DescribedNumber::Place::north;
      n.centre_km = centres[n.centre];
    }
    numbers.push_back(n);
  }
  for (DescribedNumber& n : numbers)
    n.other_component_free = n.place != DescribedNumber::Place::none &&
                             std::count_if(numbers.begin(), numbers.end(), [&](const DescribedNumber& other) {
                               return other.centre == n.centre && other.place != DescribedNumber::Place::none;
                             }) > 1;
  return numbers;
}

std::string trade_off_text(const std::vector<DescribedNumber>& numbers, const std::vector<double>& direction,
                           int always) {
  std::vector<Member> members = members_of(numbers, direction);
  const auto must_stay = [&](const Member& m) {
    return std::find(m.of.begin(), m.of.end(), static_cast<std::size_t>(always)) != m.of.end() && always >= 0;
  };
  double largest = 0.0;
  for (const Member& m : members) largest = std::max(largest, m.size());
  members.erase(
      std::remove_if(members.begin(), members.end(),
                     [&](const Member& m) { return m.size() < kUnnoticed * largest && !must_stay(m); }),
      members.end());
  if (members.empty()) return {};
  if (members.size() == 1) return "the data do not constrain the " + names_of(members);
  std::stable_sort(members.begin(), members.end(), [&](const Member& a, const Member& b) {
    if (must_stay(a) != must_stay(b)) return must_stay(a);
    return a.size() > b.size();
  });
  const std::size_t more = members.size() > kMaxMembers ? members.size() - kMaxMembers : 0;
  members.resize(members.size() - more);
  // Places first: they are what one imagines best. Then what changes most.
  std::stable_sort(members.begin(), members.end(), [](const Member& a, const Member& b) {
    if (a.is_place != b.is_place) return a.is_place;
    return a.size() > b.size();
  });
  // So far that what changes most is just noticed; then the first one rounded.
  const Member& first = members.front();
  const double told = round_amount(std::abs(first.change) / largest);
  const double scale = told / first.change;
  std::vector<std::string> changes;
  for (const Member& m : members) changes.push_back(change_words(m, scale * m.change, 2, members.size() > 2));
  const std::string others = changes.size() > 1 ? listed({changes.begin() + 1, changes.end()}) : "";
  return names_of(members) + (more > 0 ? fmt::format(" (and {} more)", more) : "") +
         " trade off: " + changes.front() + " with " + others + (more > 0 ? " and so on" : "") +
         " looks the same";
}

std::string why_undetermined(const sim::Scene& scene, const std::vector<FreeNumber>& free,
                             const std::vector<double>& values, const Uncertainty& u, std::size_t j) {
  const std::vector<double>* most = nullptr;
  for (const std::vector<double>& direction : u.undetermined)
    if (most == nullptr || std::abs(direction[j]) > std::abs((*most)[j])) most = &direction;
  if (most == nullptr || (*most)[j] == 0.0) return "the data do not bound it";
  std::vector<double> in_values = *most;
  std::size_t members = 0;
  for (std::size_t k = 0; k < free.size(); ++k) {
    in_values[k] *= free[k].slope(free[k].coordinate(values[k]));
    members += in_values[k] != 0.0;
  }
  if (members < 2) return "the data do not bound it";
  return trade_off_text(described_numbers(scene, free, values), in_values, static_cast<int>(j));
}

std::vector<std::string> strong_correlations(const std::vector<DescribedNumber>& numbers,
                                             const std::vector<double>& sigma,
                                             const std::vector<std::vector<double>>& correlation,
                                             double least, std::size_t most) {
  struct Pair {
    std::size_t i, k;
    double r;
  };
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    for (std::size_t k = i + 1; k < numbers.size(); ++k) {
      const bool told = std::isfinite(sigma[i]) && std::isfinite(sigma[k]) && !numbers[i].of_profile &&
                        !numbers[k].of_profile;
      if (told && std::abs(correlation[i][k]) > least) pairs.push_back({i, k, correlation[i][k]});
    }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return std::abs(a.r) > std::abs(b.r); });
  if (pairs.size() > most) pairs.resize(most);
  std::vector<std::string> sentences;
  for (const Pair& p : pairs) {
    const auto member = [&](std::size_t j, double change) {
      return numbers[j].place == DescribedNumber::Place::none ? member_of(numbers[j], change, j)
                                                              : lone_place_member(numbers[j], change, j);
    };
    // The regression line: one standard deviation of the first goes with r of the second's.
    std::vector<Member> members = {member(p.i, sigma[p.i]), member(p.k, p.r * sigma[p.k])};
    if (members[1].is_place && !members[0].is_place)
      members = {member(p.k, sigma[p.k]), member(p.i, p.r * sigma[p.i])};
    const double sign = members[0].change < 0.0 ? -1.0 : 1.0;
    const std::string r = fmt::format("{}{:.2f}", p.r < 0.0 ? "\u2212" : "", std::abs(p.r));
    sentences.push_back(names_of(members) + " are correlated by " + r + ": " +
                        change_words(members[0], sign * members[0].change, 2, false) +
                        " (one standard deviation) goes with " +
                        change_words(members[1], sign * members[1].change, 2, false));
  }
  return sentences;
}

}  // namespace vegard::fit
