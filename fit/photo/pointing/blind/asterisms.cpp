#include "fit/photo/pointing/blind/asterisms.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>

#include "fit/photo/pointing/catalogue_sky.h"

namespace vegard::fit {
namespace {

constexpr int kCellsAcross = 20, kCellsUp = 28;  // x from -0.3 to 1.3, y from -1.12 to 1.12
constexpr double kCodeCell = 0.08, kCodeLeft = -0.3, kCodeBottom = -1.12;
constexpr int kSkyNeighbours = 8, kDeepNeighbours = 5;
constexpr double kMinMiddle = 0.15;  // the middle of directions that surround the observer means nothing

std::vector<Eigen::Vector3d> directions_of(const std::vector<StarSighting>& sky) {
  std::vector<Eigen::Vector3d> directions;
  for (const StarSighting& star : sky) directions.emplace_back(star.enu[0], star.enu[1], star.enu[2]);
  return directions;
}

}  // namespace

bool make_asterism(const std::vector<Eigen::Vector3d>& directions, const AsterismMembers& members,
                   Asterism& asterism) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const int m : members) middle += directions[m];
  const double length = middle.norm();
  if (length < 4.0 * kMinMiddle) return false;
  middle /= length;
  const Eigen::Vector3d across =
      (std::abs(middle[2]) < 0.8 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX())
          .cross(middle)
          .normalized();
  const Eigen::Vector3d up = middle.cross(across);
  std::complex<double> place[4];
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d& v = directions[members[i]];
    const double depth = 1.0 + v.dot(middle);
    if (depth < 0.7) return false;
    place[i] = {2.0 * v.dot(across) / depth, 2.0 * v.dot(up) / depth};
  }
  int a = 0, b = 1;
  double longest = -1.0;
  for (int i = 0; i < 4; ++i)
    for (int j = i + 1; j < 4; ++j)
      if (std::norm(place[i] - place[j]) > longest) {
        longest = std::norm(place[i] - place[j]);
        a = i;
        b = j;
      }
  if (!(longest > 1e-12)) return false;
  int others[2], n = 0;
  for (int i = 0; i < 4; ++i)
    if (i != a && i != b) others[n++] = i;
  std::complex<double> c = (place[others[0]] - place[a]) / (place[b] - place[a]);
  std::complex<double> d = (place[others[1]] - place[a]) / (place[b] - place[a]);
  if (c.real() + d.real() > 1.0) {
    std::swap(a, b);
    c = 1.0 - c;
    d = 1.0 - d;
  }
  if (c.real() > d.real()) {
    std::swap(c, d);
    std::swap(others[0], others[1]);
  }
  asterism.members = {members[a], members[b], members[others[0]], members[others[1]]};
  asterism.code = {c.real(), c.imag(), d.real(), d.imag()};
  const Eigen::Vector3d &va = directions[members[a]], &vb = directions[members[b]];
  asterism.size_rad = std::atan2(va.cross(vb).norm(), va.dot(vb));
  return true;
}

std::vector<Asterism> orders_of(const Asterism& asterism, double tolerance) {
  std::vector<Asterism> orders = {asterism};
  const auto& code = asterism.code;
  const auto swapped_others = [](const Asterism& one) {
    Asterism other = one;
    std::swap(other.members[2], other.members[3]);
    other.code = {one.code[2], one.code[3], one.code[0], one.code[1]};
    return other;
  };
  const bool others = code[2] - code[0] < 2.0 * tolerance;
  if (others) orders.push_back(swapped_others(asterism));
  if (1.0 - code[0] - code[2] < 2.0 * tolerance) {
    // Seen from B, what was left is right.
    Asterism turned = asterism;
    turned.members = {asterism.members[1], asterism.members[0], asterism.members[3], asterism.members[2]};
    turned.code = {1.0 - code[2], -code[3], 1.0 - code[0], -code[1]};
    orders.push_back(turned);
    if (others) orders.push_back(swapped_others(turned));
  }
  return orders;
}

std::vector<AsterismMembers> neighbour_sets(const std::vector<Eigen::Vector3d>& places, int first,
                                            int neighbours) {
  const int n = std::min(first, static_cast<int>(places.size()));
  const int k = std::min(neighbours, n - 1);
  std::vector<AsterismMembers> sets;
  if (n < 4) return sets;
  // A place's neighbours are looked for among those that stand near it by one coordinate.
  constexpr int kSorted = 1;
  std::vector<int> by_height(n);
  for (int i = 0; i < n; ++i) by_height[i] = i;
  std::sort(by_height.begin(), by_height.end(), [&](int a, int b) {
    return places[a][kSorted] != places[b][kSorted] ? places[a][kSorted] < places[b][kSorted] : a < b;
  });
  using Neighbour = std::pair<double, int>;  // the square of the distance, the place
  std::vector<Neighbour> nearest;
  const auto offer = [&](int i, int j) {
    const Neighbour one = {(places[j] - places[i]).squaredNorm(), j};
    if (static_cast<int>(nearest.size()) == k && !(one < nearest.back())) return;
    nearest.insert(std::upper_bound(nearest.begin(), nearest.end(), one), one);
    if (static_cast<int>(nearest.size()) > k) nearest.pop_back();
  };
  const auto may_be_nearer = [&](int i, int j) {
    const double apart = places[j][kSorted] - places[i][kSorted];
    return static_cast<int>(nearest.size()) < k || apart * apart <= nearest.back().first;
  };
  for (int r = 0; r < n; ++r) {
    const int i = by_height[r];
    nearest.clear();
    int below = r - 1, above = r + 1;
    while (below >= 0 || above < n) {
      if (below >= 0 && !may_be_nearer(i, by_height[below])) below = -1;
      if (below >= 0) offer(i, by_height[below--]);
      if (above < n && !may_be_nearer(i, by_height[above])) above = n;
      if (above < n) offer(i, by_height[above++]);
    }
    for (int a = 0; a < k; ++a)
      for (int b = a + 1; b < k; ++b)
        for (int c = b + 1; c < k; ++c) {
          AsterismMembers set = {i, nearest[a].second, nearest[b].second, nearest[c].second};
          std::sort(set.begin(), set.end());
          sets.push_back(set);
        }
  }
  std::sort(sets.begin(), sets.end());
  sets.erase(std::unique(sets.begin(), sets.end()), sets.end());
  return sets;
}

AsterismIndex::AsterismIndex(const std::vector<Eigen::Vector3d>& stars, const std::vector<int>& levels,
                             int neighbours) {
  std::vector<AsterismMembers> sets;
  for (const int first : levels) {
    const std::vector<AsterismMembers> more = neighbour_sets(stars, first, neighbours);
    sets.insert(sets.end(), more.begin(), more.end());
  }
  std::sort(sets.begin(), sets.end());
  sets.erase(std::unique(sets.begin(), sets.end()), sets.end());
  std::vector<Asterism> all;
  for (const AsterismMembers& set : sets) {
    Asterism one;
    if (make_asterism(stars, set, one)) all.push_back(one);
  }
  const std::size_t cells = static_cast<std::size_t>(kCellsAcross) * kCellsUp * kCellsAcross * kCellsUp;
  begin_.assign(cells + 1, 0);
  for (const Asterism& one : all) ++begin_[number_of(cell_of(one.code)) + 1];
  for (std::size_t i = 0; i < cells; ++i) begin_[i + 1] += begin_[i];
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  asterisms_.resize(all.size());
  for (const Asterism& one : all) asterisms_[next[number_of(cell_of(one.code))]++] = one;
  for (const Asterism& one : asterisms_) sizes_rad_.push_back(one.size_rad);
}

std::array<int, 4> AsterismIndex::cell_of(const std::array<double, 4>& code) {
  std::array<int, 4> cell{};
  for (int i = 0; i < 4; ++i) {
    const bool x = i % 2 == 0;
    cell[i] = std::clamp(static_cast<int>(std::floor((code[i] - (x ? kCodeLeft : kCodeBottom)) / kCodeCell)),
                         0, (x ? kCellsAcross : kCellsUp) - 1);
  }
  return cell;
}

std::size_t AsterismIndex::number_of(const std::array<int, 4>& cell) {
  return ((static_cast<std::size_t>(cell[0]) * kCellsUp + cell[1]) * kCellsAcross + cell[2]) * kCellsUp +
         cell[3];
}

void AsterismIndex::find(const Asterism& like, double tolerance, double size_factor,
                         std::vector<const Asterism*>& found) const {
  std::array<double, 4> low = like.code, high = like.code;
  for (int i = 0; i < 4; ++i) {
    low[i] -= tolerance;
    high[i] += tolerance;
  }
  const std::array<int, 4> from = cell_of(low), to = cell_of(high);
  const double largest = like.size_rad * size_factor;
  std::array<int, 4> cell{};
  for (cell[0] = from[0]; cell[0] <= to[0]; ++cell[0])
    for (cell[1] = from[1]; cell[1] <= to[1]; ++cell[1])
      for (cell[2] = from[2]; cell[2] <= to[2]; ++cell[2]) {
        // Cells that are neighbours by the last number stand one behind another.
        cell[3] = from[3];
        const std::size_t first = number_of(cell), last = first + static_cast<std::size_t>(to[3] - from[3]);
        for (std::uint32_t i = begin_[first]; i < begin_[last + 1]; ++i) {
          if (sizes_rad_[i] > largest || like.size_rad > sizes_rad_[i] * size_factor) continue;
          const Asterism& one = asterisms_[i];
          double square = 0.0;
          for (int k = 0; k < 4; ++k) square += (one.code[k] - like.code[k]) * (one.code[k] - like.code[k]);
          if (square <= tolerance * tolerance) found.push_back(&one);
        }
      }
}

const AsterismIndex& bright_star_asterisms() {
  static const AsterismIndex index(directions_of(equatorial_sky()),
                                   {24, 40, 68, 115, 195, 330, 560, kFigureStars}, kSkyNeighbours);
  return index;
}

const AsterismIndex& deep_star_asterisms() {
  static const AsterismIndex index = [] {
    const std::vector<Eigen::Vector3d> stars = directions_of(deep_equatorial_sky());
    std::vector<int> levels;
    for (auto level = static_cast<double>(stars.size()); level > kFigureStars; level /= 1.7)
      levels.push_back(static_cast<int>(level));
    return AsterismIndex(stars, levels, kDeepNeighbours);
  }();
  return index;
}

}  // namespace vegard::fit
