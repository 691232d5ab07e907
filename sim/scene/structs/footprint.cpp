#include "sim/scene/structs/footprint.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/base/number/constants.h"
#include "sim/scene/structs/bulge_points.h"

namespace vegard::sim {
namespace {

constexpr double kPieceWidths = 0.8;
constexpr double kLeastPieces = 16.0;  // between two points
constexpr double kOfChord = 1.5;       // length of the curve between them, at most, seldom longer
constexpr double kCurtainPieceKm = 4.0, kShellCurtainPieceKm = 16.0;

bool is_shell(const Footprint& f) { return f.shape == FootprintShape::shell; }

/// Between two points of the spline.
double chord_km(const Footprint& f, std::size_t a, std::size_t b, double sphere_km) {
  if (!is_shell(f)) return std::hypot(f.east_km[b] - f.east_km[a], f.north_km[b] - f.north_km[a]);
  const double la = f.latitude_deg[a] * kRadiansPerDegree, lb = f.latitude_deg[b] * kRadiansPerDegree;
  const double half = 0.5 * kRadiansPerDegree * (f.longitude_deg[b] - f.longitude_deg[a]);
  const double up = std::sin(0.5 * (lb - la)), aside = std::sin(half);
  return 2.0 * (sphere_km + kFootAltitudeKm) *
         std::sqrt(up * up + std::cos(la) * std::cos(lb) * aside * aside);
}

}  // namespace

double drawn_width_km(const Footprint& f, double sphere_km) {
  // A cube's face spans two radii; its cells are widest in its middle.
  const double cell_km = is_shell(f) ? 2.0 * (sphere_km + kFootAltitudeKm) / f.face_cells : f.cell_km;
  return std::max(f.width_km, kNarrowestCells * cell_km);
}

double longest_piece_km(const Footprint& f, double sphere_km) {
  if (f.model == FootprintModel::curtain) return is_shell(f) ? kShellCurtainPieceKm : kCurtainPieceKm;
  return kPieceWidths * drawn_width_km(f, sphere_km);
}

double spline_pieces(const Footprint& f, double sphere_km) {
  const std::size_t n = is_shell(f) ? f.latitude_deg.size() : f.east_km.size();
  if (n < 2) return 0.0;
  const double longest_km = longest_piece_km(f, sphere_km),
               step_km = f.bulge_length_km / kBulgePointsPerLength;
  const bool has_bulge = f.bulge_km > 0.0;
  const double piece_km = has_bulge ? std::min(longest_km, step_km) : longest_km;
  double sum = 0.0;
  for (std::size_t i = 0; i < (f.closed ? n : n - 1); ++i)
    sum += std::max(kLeastPieces, std::ceil(kOfChord * chord_km(f, i, (i + 1) % n, sphere_km) / piece_km));
  if (!has_bulge) return sum;
  // The bulge moves points of its own, with pieces between them; its front and its tail make the spline
  // longer.
  const double pieces_to_point =
      std::clamp(std::ceil(kOfChord * step_km / piece_km), 2.0, static_cast<double>(kBulgePiecesToPoint));
  return std::ceil(sum * (kLeastPieces / pieces_to_point + kOfChord) +
                   2.0 * kOfChord * f.bulge_km / longest_km);
}

double longest_side_cells(const Footprint& f) {
  return std::ceil(std::max(f.size_km.east, f.size_km.north) / f.cell_km);
}

double map_cells(const Footprint& f) {
  if (is_shell(f)) return 6.0 * (f.face_cells + 2.0) * (f.face_cells + 2.0);
  return std::ceil(f.size_km.east / f.cell_km) * std::ceil(f.size_km.north / f.cell_km);
}

double bytes_per_cell(const Footprint& f, std::size_t number_bytes) {
  const bool is_by_sheets = f.source == FootprintSource::sheets;
  const bool has_energy = is_by_sheets || !f.point_energy.empty() || !f.energy_image.empty();
  const double layers = has_energy ? 2.0 : 1.0;
  double numbers = layers + (is_by_sheets ? 4.0 : 0.0);
  // The flow is worked out from plain numbers.
  double plain = 0.0;
  if (flows(f)) {
    numbers = std::max(numbers, 2.0 * layers);
    plain = 8.0;
  }
  return numbers * static_cast<double>(number_bytes) + plain;
}

}  // namespace vegard::sim
