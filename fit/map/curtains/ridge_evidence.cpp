#include "fit/map/curtains/ridge_evidence.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/base/number/constants.h"

namespace vegard::fit {
namespace {

constexpr double kEnd_km = 25.0;          // of a line, from which its direction at an end follows
constexpr double kSameDirection = 0.707;  // cosine: of each end and the way to the other
constexpr double kUnresolved = 0.8;       // of the resolution: how far two pieces may be beside each other
constexpr double kCorner_km = 10.0, kSharpTurn = 0.5;  // cosine
constexpr double kCornerGap = 0.5;    // of the resolution: ends that meet in a corner are a fold
constexpr double kCornerCost = 10.0;  // what goes on straight comes first
constexpr double kNotAcross = 0.5;    // cosine to the line of sight: 30 degrees from a course across it
constexpr double kHookTurn = 0.866;   // cosine: a course that goes on more nearly straight is no hook
constexpr double kShareOfLength = 1.0 / 3.0;
constexpr std::size_t kEnoughMeans = 4;
constexpr double kWidePerResolution = 3.0, kLongPerWidth = 3.0;

double length_between(sim::EastNorth a, sim::EastNorth b) {
  return std::hypot(b.east - a.east, b.north - a.north);
}

double length_of(const RidgeLine& line) {
  double sum = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) sum += length_between(line[i - 1], line[i]);
  return sum;
}

/// The end of a line and the direction, of length 1, in which it goes on there.
struct LineEnd {
  sim::EastNorth at, onward;
};

LineEnd end_of(const RidgeLine& line, bool last) {
  const auto point = [&](std::size_t i) { return line[last ? line.size() - 1 - i : i]; };
  std::size_t i = 1;
  while (i + 1 < line.size() && length_between(point(0), point(i)) < kEnd_km) ++i;
  const sim::EastNorth at = point(0), before = point(i);
  const double length = std::max(1e-9, length_between(before, at));
  return {at, {(at.east - before.east) / length, (at.north - before.north) / length}};
}

struct Joint {
  std::size_t a = 0, b = 0;
  bool a_last = true, b_last = false;
  double cost = -1.0;  // below 0: none
};

/// How far apart two ends are, in what their gap may be; below 0 if they are not in line.
double joint_cost(const RidgeLine& one, bool one_last, const RidgeLine& other, bool other_last,
                  const std::function<double(sim::EastNorth)>& resolution_km) {
  const LineEnd a = end_of(one, one_last), b = end_of(other, other_last);
  const double gap = length_between(a.at, b.at);
  const double resolution = std::max(resolution_km(a.at), resolution_km(b.at));
  const double most =
      std::max(kJoinedGap * resolution, kShareOfLength * std::min(length_of(one), length_of(other)));
  if (gap > most) return -1.0;
  const double facing = -(a.onward.east * b.onward.east + a.onward.north * b.onward.north);
  if (gap < kCornerGap * resolution && facing < kSameDirection) return kCornerCost + gap / most - facing;
  if (facing < kSameDirection) return -1.0;
  // Aside of either course by less than half of its way, or by what is not resolved; pieces may overlap by as
  // much.
  const sim::EastNorth way{b.at.east - a.at.east, b.at.north - a.at.north};
  for (const auto& [onward, sign] : {std::pair{a.onward, 1.0}, std::pair{b.onward, -1.0}}) {
    const double ahead = sign * (way.east * onward.east + way.north * onward.north);
    const double aside = std::abs(way.east * onward.north - way.north * onward.east);
    if (ahead < -kUnresolved * resolution || aside > std::max(kUnresolved * resolution, kSameDirection * gap))
      return -1.0;
  }
  return gap / most + (1.0 - facing);
}

/// Cuts lines where they turn sharply: there one may have gone on into a branch.
std::vector<RidgeLine> cut_at_corners(const std::vector<RidgeLine>& lines) {
  std::vector<RidgeLine> pieces;
  for (const RidgeLine& line : lines) {
    std::size_t from = 0;
    for (std::size_t i = 1; i + 1 < line.size(); ++i) {
      std::size_t before = i, after = i;
      while (before > from && length_between(line[before], line[i]) < kCorner_km) --before;
      while (after + 1 < line.size() && length_between(line[i], line[after]) < kCorner_km) ++after;
      const sim::EastNorth u{line[i].east - line[before].east, line[i].north - line[before].north};
      const sim::EastNorth v{line[after].east - line[i].east, line[after].north - line[i].north};
      const double lengths = std::hypot(u.east, u.north) * std::hypot(v.east, v.north);
      if (std::hypot(u.east, u.north) < kCorner_km ||
          u.east * v.east + u.north * v.north >= kSharpTurn * lengths)
        continue;
      pieces.emplace_back(line.begin() + static_cast<std::ptrdiff_t>(from),
                          line.begin() + static_cast<std::ptrdiff_t>(i) + 1);
      from = i;
    }
    pieces.emplace_back(line.begin() + static_cast<std::ptrdiff_t>(from), line.end());
  }
  return pieces;
}

Joint best_joint(const std::vector<RidgeLine>& lines,
                 const std::function<double(sim::EastNorth)>& resolution_km) {
  Joint best;
  for (std::size_t a = 0; a < lines.size(); ++a)
    for (std::size_t b = a + 1; b < lines.size(); ++b)
      for (const bool a_last : {false, true})
        for (const bool b_last : {false, true}) {
          const double cost = joint_cost(lines[a], a_last, lines[b], b_last, resolution_km);
          if (cost >= 0.0 && (best.cost < 0.0 || cost < best.cost)) best = {a, b, a_last, b_last, cost};
        }
  return best;
}

/// The tail of Student's distribution, by the normal one of like probability (Wallace 1959,
/// doi:10.1214/aoms/1177706096).
double tail_of_student(double t, double freedom) {
  const double normal =
      std::sqrt(freedom * std::log1p(t * t / freedom)) * (8.0 * freedom + 1.0) / (8.0 * freedom + 3.0);
  return 0.5 * std::erfc((t < 0.0 ? -normal : normal) / std::sqrt(2.0));
}

struct Moments {
  double mean = 0.0, deviation = 0.0;
};

Moments moments_of(const std::vector<double>& values) {
  Moments m;
  const auto count = static_cast<double>(values.size());
  for (const double v : values) m.mean += v / count;
  for (const double v : values) m.deviation += (v - m.mean) * (v - m.mean);
  m.deviation = count > 1.0 ? std::sqrt(m.deviation / (count - 1.0)) : 0.0;
  return m;
}

/// The first point at least this far along a line from one of its points, or its last.
std::size_t farther_on(const RidgeLine& line, std::size_t from, double way_km) {
  std::size_t to = from;
  while (to + 1 < line.size() && (to == from || length_between(line[from], line[to]) < way_km)) ++to;
  return to;
}

double cosine_between(sim::EastNorth u, sim::EastNorth v) {
  const double lengths = std::hypot(u.east, u.north) * std::hypot(v.east, v.north);
  return lengths > 0.0 ? (u.east * v.east + u.north * v.north) / lengths : 0.0;
}

/// How many points at the beginning of a line are a hook along the line of sight.
std::size_t hooked_points(const RidgeLine& line,
                          const std::function<double(sim::EastNorth)>& along_sight_km) {
  const auto way = [&](std::size_t a, std::size_t b) {
    return sim::EastNorth{line[b].east - line[a].east, line[b].north - line[a].north};
  };
  std::size_t bend = 0;
  while (bend + 1 < line.size() &&
         std::abs(cosine_between(way(bend, farther_on(line, bend, kCorner_km)), line[bend])) > kNotAcross)
    ++bend;
  if (bend == 0) return 0;
  const double depth =
      std::abs(std::hypot(line[0].east, line[0].north) - std::hypot(line[bend].east, line[bend].north));
  if (!(depth < along_sight_km(line[bend]))) return 0;
  if (bend + 1 >= line.size()) return line.size();
  const bool turns = cosine_between(way(0, bend), way(bend, farther_on(line, bend, kEnd_km))) < kHookTurn;
  return turns ? bend : 0;
}

}  // namespace

std::vector<RidgeLine> joined_lines(std::vector<RidgeLine> lines,
                                    const std::function<double(sim::EastNorth)>& resolution_km) {
  lines.erase(std::remove_if(lines.begin(), lines.end(), [](const RidgeLine& l) { return l.size() < 2; }),
              lines.end());
  lines = cut_at_corners(lines);
  for (;;) {
    const Joint joint = best_joint(lines, resolution_km);
    if (joint.cost < 0.0) return lines;
    RidgeLine &a = lines[joint.a], b = lines[joint.b];
    if (!joint.a_last) std::reverse(a.begin(), a.end());
    if (joint.b_last) std::reverse(b.begin(), b.end());
    // What overlaps is taken from the first.
    const sim::EastNorth onward = end_of(a, true).onward;
    while (a.size() > 2 && (b.front().east - a.back().east) * onward.east +
                                   (b.front().north - a.back().north) * onward.north <
                               0.0)
      a.pop_back();
    a.insert(a.end(), b.begin(), b.end());
    lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(joint.b));
  }
}

RidgeLine without_ends_along_sight(const RidgeLine& line,
                                   const std::function<double(sim::EastNorth)>& along_sight_km) {
  RidgeLine kept = line;
  // From one end, then from the other; both times back in the old order.
  for (int end = 0; end < 2; ++end) {
    kept.erase(kept.begin(), kept.begin() + static_cast<std::ptrdiff_t>(hooked_points(kept, along_sight_km)));
    std::reverse(kept.begin(), kept.end());
  }
  return kept;
}

double ridge_probability(double mean_height, const std::vector<std::vector<double>>& null_heights,
                         double pieces, double places) {
  std::vector<double> all, means;
  for (const std::vector<double>& map : null_heights) {
    if (map.empty()) continue;
    all.insert(all.end(), map.begin(), map.end());
    means.push_back(moments_of(map).mean);
  }
  if (all.size() < 2) return sim::kNaN;
  // The spread of a mean by that of its pieces, or by that of the means, if there are enough and it is
  // larger.
  const Moments of_all = moments_of(all), of_means = moments_of(means);
  const double independent = std::max(1.0, pieces);
  const double by_pieces = of_all.deviation / std::sqrt(independent);
  const bool by_means = means.size() >= kEnoughMeans && of_means.deviation > by_pieces;
  const double deviation = std::max(by_means ? of_means.deviation : by_pieces, 1e-12);
  const double freedom = std::max(1.0, by_means ? static_cast<double>(means.size()) - 1.0
                                                : independent * static_cast<double>(means.size()) - 1.0);
  return std::exp(-std::max(1.0, places) * tail_of_student((mean_height - of_all.mean) / deviation, freedom));
}

bool is_diffuse_patch(double width_km, double length_km, double resolution_km) {
  return width_km > kWidePerResolution * resolution_km && length_km < kLongPerWidth * width_km;
}

}  // namespace vegard::fit
