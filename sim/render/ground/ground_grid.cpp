#include "sim/render/ground/ground_grid.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "sim/base/number/constants.h"

namespace vegard::sim {
namespace {

/// Of numbers of moderate size: std::hypot() takes several times as long.
double length_of(double x, double y) { return std::sqrt(x * x + y * y); }

constexpr double kLookUpStep_km = 0.25;
constexpr double kTurn = 6.283185307179586;

}  // namespace

GroundGrid::GroundGrid(RingCells rings) : round_(true), rings_(std::move(rings)) {
  int places = 0;
  for (const int arcs : rings_.arcs) {
    first_of_ring_.push_back(places);
    places += arcs;
  }
  first_of_ring_.push_back(places);
  const int steps = static_cast<int>(rings_.edge_km.back() / kLookUpStep_km) + 1;
  int ring = 0;
  for (int i = 0; i < steps; ++i) {
    while (ring + 1 < static_cast<int>(rings_.arcs.size()) &&
           rings_.edge_km[static_cast<std::size_t>(ring) + 1] <= i * kLookUpStep_km)
      ++ring;
    ring_by_step_.push_back(ring);
  }
  for (int i = 0; i < places; ++i) {
    cell_of_.push_back(i);
    place_of_.push_back(i);
  }
}

GroundGrid::GroundGrid(const SquareCells& squares) : round_(false), squares_(squares) {
  for (int i = 0; i < squares.columns * squares.rows; ++i) {
    cell_of_.push_back(i);
    place_of_.push_back(i);
  }
}

void GroundGrid::keep(const std::vector<bool>& kept) {
  assert(kept.size() == place_of_.size());
  std::vector<int> places;
  std::fill(cell_of_.begin(), cell_of_.end(), -1);
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (kept[i]) {
      cell_of_[static_cast<std::size_t>(place_of_[i])] = static_cast<int>(places.size());
      places.push_back(place_of_[i]);
    }
  place_of_ = std::move(places);
}

int GroundGrid::ring_of(double distance_km) const {
  if (distance_km < rings_.edge_km.front() || !(distance_km < rings_.edge_km.back())) return -1;
  int ring = ring_by_step_[static_cast<std::size_t>(distance_km / kLookUpStep_km)];
  while (rings_.edge_km[static_cast<std::size_t>(ring) + 1] <= distance_km) ++ring;
  return ring;
}

int GroundGrid::ring_of_place(int place) const {
  return static_cast<int>(std::upper_bound(first_of_ring_.begin(), first_of_ring_.end(), place) -
                          first_of_ring_.begin()) -
         1;
}

int GroundGrid::place_at(double east_km, double north_km) const {
  if (!round_) {
    const double x = (east_km - squares_.west_km) / squares_.step_km;
    const double y = (north_km - squares_.south_km) / squares_.step_km;
    if (!(x >= 0.0 && y >= 0.0 && x < squares_.columns && y < squares_.rows)) return -1;
    return static_cast<int>(y) * squares_.columns + static_cast<int>(x);
  }
  const int ring = ring_of(length_of(east_km, north_km));
  if (ring < 0) return -1;
  const int arcs = rings_.arcs[static_cast<std::size_t>(ring)];
  double turn = std::atan2(east_km, north_km) / kTurn;
  if (turn < 0.0) turn += 1.0;
  return first_of_ring_[static_cast<std::size_t>(ring)] + std::min(static_cast<int>(turn * arcs), arcs - 1);
}

EastNorth GroundGrid::middle_km(int cell) const {
  const int place = place_of_[static_cast<std::size_t>(cell)];
  if (!round_)
    return {squares_.west_km + (place % squares_.columns + 0.5) * squares_.step_km,
            squares_.south_km + (place / squares_.columns + 0.5) * squares_.step_km};
  const auto ring = static_cast<std::size_t>(ring_of_place(place));
  const double distance = 0.5 * (rings_.edge_km[ring] + rings_.edge_km[ring + 1]);
  const double azimuth = kTurn * (place - first_of_ring_[ring] + 0.5) / rings_.arcs[ring];
  return {distance * std::sin(azimuth), distance * std::cos(azimuth)};
}

double GroundGrid::area_km2(int cell) const { return depth_km(cell) * breadth_km(cell); }

double GroundGrid::depth_km(int cell) const {
  if (!round_) return squares_.step_km;
  const auto ring = static_cast<std::size_t>(ring_of_place(place_of_[static_cast<std::size_t>(cell)]));
  return rings_.edge_km[ring + 1] - rings_.edge_km[ring];
}

double GroundGrid::breadth_km(int cell) const {
  if (!round_) return squares_.step_km;
  const auto ring = static_cast<std::size_t>(ring_of_place(place_of_[static_cast<std::size_t>(cell)]));
  return kTurn * 0.5 * (rings_.edge_km[ring] + rings_.edge_km[ring + 1]) / rings_.arcs[ring];
}

double GroundGrid::finest_km(double east_km, double north_km) const {
  if (!round_) return squares_.step_km;
  const double distance = length_of(east_km, north_km);
  const auto rings = static_cast<int>(rings_.arcs.size());
  const int ring = distance < rings_.edge_km.front() ? 0 : ring_of(distance);
  const auto i = static_cast<std::size_t>(ring < 0 ? rings - 1 : ring);
  const double middle = 0.5 * (rings_.edge_km[i] + rings_.edge_km[i + 1]);
  return std::min(rings_.edge_km[i + 1] - rings_.edge_km[i], kTurn * middle / rings_.arcs[i]);
}

std::vector<GroundGrid::Neighbour> GroundGrid::near(int cell, double reach_km) const {
  const EastNorth here = middle_km(cell);
  std::vector<Neighbour> found;
  const auto take = [&](int place) {
    const int other = cell_of_[static_cast<std::size_t>(place)];
    if (other < 0) return;
    const EastNorth there = middle_km(other);
    const double east = there.east - here.east, north = there.north - here.north;
    if (length_of(east, north) <= reach_km) found.push_back({other, east, north});
  };
  if (!round_) {
    const int place = place_of_[static_cast<std::size_t>(cell)];
    const int column = place % squares_.columns, row = place / squares_.columns;
    const int reach = static_cast<int>(reach_km / squares_.step_km);
    for (int y = std::max(0, row - reach); y <= std::min(squares_.rows - 1, row + reach); ++y)
      for (int x = std::max(0, column - reach); x <= std::min(squares_.columns - 1, column + reach); ++x)
        take(y * squares_.columns + x);
    return found;
  }
  const double distance = std::hypot(here.east, here.north);
  double turn = std::atan2(here.east, here.north) / kTurn;
  if (turn < 0.0) turn += 1.0;
  for (std::size_t ring = 0; ring < rings_.arcs.size(); ++ring) {
    const double middle = 0.5 * (rings_.edge_km[ring] + rings_.edge_km[ring + 1]);
    if (std::abs(middle - distance) > reach_km) continue;
    const int arcs = rings_.arcs[ring];
    const double arc_km = kTurn * middle / arcs;
    const int reach = std::min(static_cast<int>(reach_km / arc_km) + 1, (arcs - 1) / 2);
    const int at = static_cast<int>(turn * arcs);
    for (int i = -reach; i <= reach; ++i) take(first_of_ring_[ring] + (at + i + arcs) % arcs);
  }
  std::sort(found.begin(), found.end(),
            [](const Neighbour& a, const Neighbour& b) { return a.cell < b.cell; });
  return found;
}

RingCells rings_resolved(double resolution_rad, double min_km, double farthest_km) {
  RingCells rings;
  rings.edge_km.push_back(0.0);
  while (rings.edge_km.back() < farthest_km) {
    const double at = rings.edge_km.back();
    // Seen from the site on a flat Earth, a border at the height H and the distance d stands atan(H/d) high,
    // which changes by H/(d² + H²) per kilometre.
    const double depth = resolution_rad * (at * at + kFootAltitudeKm * kFootAltitudeKm) / kFootAltitudeKm;
    rings.edge_km.push_back(at + std::max(depth, min_km));
    const double middle = 0.5 * (at + rings.edge_km.back());
    const double slant = std::hypot(middle, kFootAltitudeKm);
    const double breadth = std::max(resolution_rad * slant, min_km);
    rings.arcs.push_back(std::max(3, static_cast<int>(kTurn * middle / breadth)));
  }
  return rings;
}

}  // namespace vegard::sim
