#include "sim/emit/sun/strand/strand_field.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "sim/base/error.h"
#include "sim/emit/sun/strand/strand_pieces.h"
#include "sim/light/emitter.h"

namespace vegard::sim {
namespace {

constexpr double kFieldMaxCells = 2e9;  // to a side; they are counted by 32 bits

Error too_thin() {
  return Error(ErrorKind::usage, "its strands are so thin that to know where they are takes too much memory")
      .expected("thicker or shorter strands, or fewer");
}

struct BeforeCell {
  bool operator()(const ReachOfStrand& a, const BrickCoordinate& b) const { return a.brick < b; }
  bool operator()(const BrickCoordinate& a, const ReachOfStrand& b) const { return a < b.brick; }
};

}  // namespace

StrandField::StrandField(const Strands<double>& strands, const Sun& sun, const std::vector<double>& light,
                         int lines, std::uint64_t memory_limit)
    : falloff_(strands.falloff),
      unit_cm_(sun.unit_km * kCmPerKm),
      sun_radius_(sun.radius),
      rate_(static_cast<std::size_t>(lines), 0.0),
      bounds_{{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}} {
  for (std::size_t l = 0; l < light.size(); ++l) rate_[l] = photons_per_volume(light[l], unit_cm_);
  // A cell is as wide as a mean tube: few pieces to a cell, few cells to a piece.
  double radii = 0.0;
  bool first = true;
  for (const Strand<double>& strand : strands.all) {
    const double radius = std::max(strand.radius_first, strand.radius_last);
    radii += radius;
    for (const auto& point : strand.points)
      for (int a = 0; a < 3; ++a) {
        bounds_.low[a] = first ? point[a] - radius : std::min(bounds_.low[a], point[a] - radius);
        bounds_.high[a] = first ? point[a] + radius : std::max(bounds_.high[a], point[a] + radius);
        if (a == 2) first = false;
      }
  }
  if (!(radii > 0.0)) return;
  lattice_.voxel = 2.0 * radii / static_cast<double>(strands.all.size()) / SparseGrid::kEdge;
  for (int a = 0; a < 3; ++a)
    if (!(std::max(-bounds_.low[a], bounds_.high[a]) < kFieldMaxCells * SparseGrid::kEdge * lattice_.voxel))
      throw too_thin();
  double bytes = 0.0;
  for (std::size_t s = 0; s < strands.all.size(); ++s) {
    strands_.push_back(pieces_of(strands.all[s], lattice_));
    gain_.insert(gain_.end(), strands.all[s].line_gain.begin(), strands.all[s].line_gain.end());
    bytes += static_cast<double>(strands_.back().pieces.size() * sizeof(StrandPiece)) +
             bricks_about(strands_.back()) * sizeof(ReachOfStrand);
    if (bytes > static_cast<double>(memory_limit)) throw too_thin();
    find_bricks(strands_.back(), static_cast<std::uint32_t>(s), BrickPart::whole, reaches_);
  }
  std::sort(reaches_.begin(), reaches_.end(), [](const ReachOfStrand& a, const ReachOfStrand& b) {
    return std::tie(a.brick, a.strand, a.first) < std::tie(b.brick, b.strand, b.first);
  });
}

bool StrandField::is_dark(const Box3& box) const {
  BrickCoordinate low, high;
  double cells = 1.0;
  for (int a = 0; a < 3; ++a) {
    if (box.low[a] > bounds_.high[a] || box.high[a] < bounds_.low[a]) return true;
    const double edge = SparseGrid::kEdge * lattice_.voxel;
    const double from = std::floor(std::max(box.low[a], bounds_.low[a]) / edge);
    const double to = std::floor(std::min(box.high[a], bounds_.high[a]) / edge);
    (a == 0 ? low.x : a == 1 ? low.y : low.z) = static_cast<std::int32_t>(from);
    (a == 0 ? high.x : a == 1 ? high.y : high.z) = static_cast<std::int32_t>(to);
    cells *= to - from + 1.0;
  }
  if (reaches_.empty()) return true;
  if (cells > 4096.0) return false;  // too many to look at: whoever asks will ask for its parts
  for (int x = low.x; x <= high.x; ++x)
    for (int y = low.y; y <= high.y; ++y) {
      const auto found =
          std::lower_bound(reaches_.begin(), reaches_.end(), BrickCoordinate{x, y, low.z}, BeforeCell());
      if (found != reaches_.end() && !(BrickCoordinate{x, y, high.z} < found->brick)) return false;
    }
  return true;
}

template <class Use>
void StrandField::visit(const double place[3], const Use& use) const {
  if (reaches_.empty()) return;
  if (place[0] * place[0] + place[1] * place[1] + place[2] * place[2] < sun_radius_ * sun_radius_) return;
  std::array<double, 3> at;
  int cell[3];
  for (int a = 0; a < 3; ++a) {
    if (!(place[a] >= bounds_.low[a] && place[a] <= bounds_.high[a])) return;
    at[a] = place[a] / lattice_.voxel - 0.5;  // counted as centres of voxels are
    cell[a] = static_cast<int>(std::floor((at[a] + 0.5) / SparseGrid::kEdge));
  }
  auto [first, last] = std::equal_range(reaches_.begin(), reaches_.end(),
                                        BrickCoordinate{cell[0], cell[1], cell[2]}, BeforeCell());
  while (first != last) {
    const std::uint32_t strand = first->strand;
    const PiecesOfStrand& cut_strand = strands_[strand];
    NearestPiece nearest;
    for (; first != last && first->strand == strand; ++first)
      for (std::uint32_t p = first->first; p < first->last; ++p)
        update_nearest(cut_strand, p, inverse_square(cut_strand.pieces[p]), at.data(), nearest);
    if (nearest.square < NearestPiece::kNone) use(strand, density_from(cut_strand, falloff_, nearest, at));
  }
}

double StrandField::density_at(const double place[3]) const {
  double sum = 0.0;
  visit(place, [&](std::uint32_t, double density) { sum += density; });
  return sum;
}

void StrandField::sample(std::size_t count, const double* const point[3], float* const emission[],
                         float* density) const {
  for (std::size_t i = 0; i < count; ++i) {
    const double place[3] = {point[0][i], point[1][i], point[2][i]};
    density[i] = 0.0f;
    if (gain_.empty()) {
      const double here = density_at(place);
      for (std::size_t l = 0; l < rate_.size(); ++l) emission[l][i] = static_cast<float>(here * rate_[l]);
      continue;
    }
    double of_line[kMaxLines] = {};
    visit(place, [&](std::uint32_t strand, double here) {
      for (std::size_t l = 0; l < rate_.size(); ++l) of_line[l] += here * gain_[strand * rate_.size() + l];
    });
    for (std::size_t l = 0; l < rate_.size(); ++l) emission[l][i] = static_cast<float>(of_line[l] * rate_[l]);
  }
}

}  // namespace vegard::sim
