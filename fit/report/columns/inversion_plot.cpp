#include "fit/report/columns/inversion_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "sim/base/number/constants.h"

namespace vegard::fit {
namespace {

constexpr int kAcross = 240, kDown = 200;
struct ContourLevel {
  double rise;
  const char* label;
  double width_px;
};
constexpr std::array<ContourLevel, 3> kLevels = {
    {{2.30, "68 %", 2.4}, {6.18, "95 %", 1.7}, {11.83, "99.7 %", 1.0}}};
constexpr double kLogAxis = 1.6;     // of a logarithm: wider axes are logarithmic
constexpr double kMinMargin = 0.15;  // of a logarithm, about the intervals

/// An axis of an unknown, whose limits are logarithms.
struct UnknownAxis {
  double least = 1e9, most = -1e9;

  bool is_log() const { return most - least > kLogAxis; }
  double at(double share) const { return least + (most - least) * share; }
  double shown(double ln) const { return is_log() ? ln / std::log(10.0) : std::exp(ln); }
};

/// All solutions' 95 % intervals with as much again on both sides, inside the tables.
UnknownAxis unknown_axis(const ColumnModel& model, const ColumnInversion& inversion, std::size_t k) {
  UnknownAxis axis;
  for (const ColumnSolution& s : inversion.solutions) {
    const OpenInterval& interval = s.of[k].interval95;
    axis.least = std::min(axis.least, interval.lower ? std::log(*interval.lower) : model.least(k));
    axis.most = std::max(axis.most, interval.upper ? std::log(*interval.upper) : model.most(k));
  }
  const double margin = std::max(kMinMargin, 0.7 * (axis.most - axis.least));
  axis.least = std::max(model.least(k), axis.least - margin);
  axis.most = std::min(model.most(k), axis.most + margin);
  return axis;
}

/// chi2 on a grid, even in the logarithms of energy (to the right) and flux (upwards).
struct ChiGrid {
  UnknownAxis energy, flux;
  std::vector<double> value;  ///< [row * kAcross + column]
  double ln_energy(double column) const { return energy.at(column / (kAcross - 1)); }
  double ln_flux(double row) const { return flux.at(row / (kDown - 1)); }
};

using AxisPoint = std::pair<double, double>;  // as the axes show it

/// A piece of a contour inside of one cell of the grid; its ends lie on edges of the grid, by their numbers.
struct ContourPiece {
  std::array<std::size_t, 2> edge{};
  std::array<AxisPoint, 2> end;
};

std::vector<ContourPiece> contour_pieces(const ChiGrid& grid, double level) {
  std::vector<ContourPiece> pieces;
  const auto at = [&](int column, int row) {
    return grid.value[static_cast<std::size_t>(row) * kAcross + column] - level;
  };
  for (int row = 0; row + 1 < kDown; ++row)
    for (int column = 0; column + 1 < kAcross; ++column) {
      // The lower, right, upper and left edge: where they begin, to the right or upwards.
      constexpr std::array<std::array<int, 3>, 4> kEdges = {{{0, 0, 0}, {1, 0, 1}, {0, 1, 0}, {0, 0, 1}}};
      ContourPiece piece;
      std::size_t ends = 0;
      for (const auto& [right, up, upwards] : kEdges) {
        const int x = column + right, y = row + up;
        const double a = at(x, y), b = at(x + 1 - upwards, y + upwards);
        if ((a < 0.0) == (b < 0.0)) continue;
        const double t = a / (a - b);
        piece.edge[ends] = 2 * (static_cast<std::size_t>(y) * kAcross + x) + upwards;
        piece.end[ends] = {grid.energy.shown(grid.ln_energy(x + t * (1 - upwards))),
                           grid.flux.shown(grid.ln_flux(y + t * upwards))};
        if (++ends < 2) continue;
        pieces.push_back(piece);
        ends = 0;
      }
    }
  return pieces;
}

/// The contour by marching squares, its pieces one behind another.
void add_contour(const ChiGrid& grid, double level, Series& series) {
  const std::vector<ContourPiece> pieces = contour_pieces(grid, level);
  std::multimap<std::size_t, std::size_t> at_edge;
  for (std::size_t p = 0; p < pieces.size(); ++p)
    for (const std::size_t edge : pieces[p].edge) at_edge.emplace(edge, p);
  std::vector<bool> drawn(pieces.size(), false);
  const auto put = [&](const AxisPoint& point) {
    series.x.push_back(point.first);
    series.y.push_back(point.second);
  };
  // The pieces from `piece` on, entered at its end `from`.
  const auto follow = [&](std::size_t piece, std::size_t from) {
    put(pieces[piece].end[from]);
    for (bool goes_on = true; goes_on;) {
      drawn[piece] = true;
      const std::size_t edge = pieces[piece].edge[1 - from];
      put(pieces[piece].end[1 - from]);
      goes_on = false;
      const auto [first, last] = at_edge.equal_range(edge);
      for (auto next = first; next != last && !goes_on; ++next) {
        if (drawn[next->second]) continue;
        piece = next->second;
        from = pieces[piece].edge[0] == edge ? 0 : 1;
        goes_on = true;
      }
    }
    put({sim::kNaN, sim::kNaN});
  };
  // First those that begin at the frame.
  for (std::size_t p = 0; p < pieces.size(); ++p)
    for (const std::size_t from : {0u, 1u})
      if (!drawn[p] && at_edge.count(pieces[p].edge[from]) == 1) follow(p, from);
  for (std::size_t p = 0; p < pieces.size(); ++p)
    if (!drawn[p]) follow(p, 0);
}

/// The energy flux at which one line has its brightness, by energy.
Series line_series(const ColumnChi2& chi2, const ColumnInversion& inversion, std::size_t line,
                   const ChiGrid& grid) {
  Series series;
  series.label = fmt::format("{:.1f} nm alone", inversion.lines_nm[line]);
  series.colour = line_ink(inversion.lines_nm[line]);
  series.mark = Mark::dashed_line;
  const ColumnModel& model = chi2.model();
  const double ln_oxygen = std::log(inversion.solutions.front().of[kLnOxygen].value);
  const double wanted = std::log(inversion.data.rayleigh[line]);
  for (int column = 0; column < kAcross; ++column) {
    const double ln_energy = grid.ln_energy(column);
    double ln_flux = 0.0;
    for (int round = 0; round < 20; ++round)
      ln_flux = std::clamp(ln_flux + wanted - model.at(line, {ln_energy, ln_flux, ln_oxygen}).ln_rayleigh,
                           model.least(kLnFlux), model.most(kLnFlux));
    const bool inside = ln_flux > grid.flux.least && ln_flux < grid.flux.most;
    series.x.push_back(grid.energy.shown(ln_energy));
    series.y.push_back(inside ? grid.flux.shown(ln_flux) : sim::kNaN);
  }
  return series;
}

/// Limits, and of a logarithmic axis ticks at 1, 2 and 5 times powers of ten.
void put_limits(const UnknownAxis& of, Axis& axis) {
  axis.min = of.shown(of.least);
  axis.max = of.shown(of.most);
  if (!of.is_log()) return;
  for (int power = static_cast<int>(std::floor(*axis.min)); power <= *axis.max; ++power)
    for (const double first : {1.0, 2.0, 5.0}) {
      const double place = power + std::log10(first);
      if (place < *axis.min || place > *axis.max) continue;
      axis.tick_places.push_back(place);
      axis.tick_labels.push_back(fmt::format("{:g}", first * std::pow(10.0, power)));
    }
}

}  // namespace

Plot inversion_plot(const ColumnChi2& chi2, const ColumnInversion& inversion, const std::string& note) {
  const ColumnModel& model = chi2.model();
  const double ln_oxygen = std::log(inversion.solutions.front().of[kLnOxygen].value);
  ChiGrid grid{unknown_axis(model, inversion, kLnEnergy), unknown_axis(model, inversion, kLnFlux), {}};
  for (int row = 0; row < kDown; ++row)
    for (int column = 0; column < kAcross; ++column) {
      const ColumnPoint point = {grid.ln_energy(column), grid.ln_flux(row), ln_oxygen};
      grid.value.push_back(chi2.free()[kLnOxygen]
                               ? chi2.descend(inversion.data, point, {false, false, true}).chi2
                               : chi2.at(inversion.data, point));
    }
  Panel panel;
  panel.x.label = "characteristic energy E0 (keV)";
  panel.y.label = "energy flux (mW m⁻²)";
  put_limits(grid.energy, panel.x);
  put_limits(grid.flux, panel.y);
  for (std::size_t l = 0; l < inversion.lines_nm.size(); ++l)
    if (inversion.data.rayleigh[l] > 0.0) panel.series.push_back(line_series(chi2, inversion, l, grid));
  for (const ContourLevel& level : kLevels) {
    Series series;
    series.label = level.label;
    series.colour = {20, 20, 20};
    series.width_px = level.width_px;
    add_contour(grid, inversion.solutions.front().chi2 + level.rise, series);
    if (!series.x.empty()) panel.series.push_back(series);
  }
  Series dots;
  dots.label = inversion.solutions.size() > 1 ? "solutions" : "solution";
  dots.colour = distinct_colour(3);
  dots.mark = Mark::points;
  dots.width_px = 7.0;
  for (const ColumnSolution& s : inversion.solutions) {
    dots.x.push_back(grid.energy.shown(std::log(s.of[kLnEnergy].value)));
    dots.y.push_back(grid.flux.shown(std::log(s.of[kLnFlux].value)));
  }
  panel.series.push_back(dots);
  Plot plot;
  plot.title = std::string("Energy and energy flux by lines: ") + column_verdict_name(inversion.verdict);
  plot.note = note;
  plot.panels = {panel};
  plot.panel_width_px = 560;
  plot.panel_height_px = 400;
  return plot;
}

}  // namespace vegard::fit
