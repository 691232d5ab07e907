#include "sim/emit/sun/strand_grid.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <tuple>

#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/emit/sun/closest_point.h"
#include "sim/emit/sun/strand_density.h"
#include "sim/emit/sun/strand_pieces.h"

namespace vegard::sim {
namespace {

using Place = std::array<double, 3>;

constexpr int kEdge = SparseGrid::kEdge, kVoxels = SparseGrid::kVoxels;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kBricksAtOnce = 2e6;  // of find_bricks(), times some 24 bytes and as many to sort them
constexpr std::size_t kStrandsAtOnce = 512;

/// What a voxel knows of a strand's lines.
struct Nearest {
  double square = kInfinity;  ///< of the distance
  double rival = kInfinity;   ///< the same of the nearest line that is not next to that one in its cubic
  double t = 0.0;
  std::uint32_t piece = 0;
};

/// Voxels of a brick, [low, high) along each axis.
struct VoxelRange {
  int low[3], high[3];
};

VoxelRange voxels_about(const StrandPiece& piece, double reach, const int corner[3]) {
  VoxelRange range;
  for (int a = 0; a < 3; ++a) {
    const double low = piece.from[a] + std::min(0.0, piece.way[a]) - reach - corner[a];
    const double high = piece.from[a] + std::max(0.0, piece.way[a]) + reach - corner[a];
    range.low[a] = static_cast<int>(std::clamp(std::ceil(low), 0.0, 1.0 * kEdge));
    range.high[a] = static_cast<int>(std::clamp(std::floor(high) + 1.0, 0.0, 1.0 * kEdge));
  }
  return range;
}

void try_piece(const PiecesOfStrand& of, std::uint32_t index, const int corner[3], Nearest* nearest) {
  const StrandPiece& piece = of.pieces[index];
  const double reach = of.radius + of.off;
  const VoxelRange range = voxels_about(piece, reach, corner);
  double square = 0.0;
  for (const double w : piece.way) square += w * w;
  const double inverse = square > 0.0 ? 1.0 / square : 0.0, most = reach * reach;
  for (int i = range.low[0]; i < range.high[0]; ++i)
    for (int j = range.low[1]; j < range.high[1]; ++j)
      for (int k = range.low[2]; k < range.high[2]; ++k) {
        const double to[3] = {corner[0] + i - piece.from[0], corner[1] + j - piece.from[1],
                              corner[2] + k - piece.from[2]};
        const double s = std::clamp(
            (to[0] * piece.way[0] + to[1] * piece.way[1] + to[2] * piece.way[2]) * inverse, 0.0, 1.0);
        double d = 0.0;
        for (int a = 0; a < 3; ++a) d += (to[a] - s * piece.way[a]) * (to[a] - s * piece.way[a]);
        if (d > most) continue;
        Nearest& here = nearest[SparseGrid::within(i, j, k)];
        const std::uint32_t before = of.pieces[here.piece].number;
        const bool next = before == piece.number || before + 1 == piece.number;
        if (d < here.square) {
          if (!next) here.rival = std::min(here.rival, here.square);
          here.square = d;
          here.t = piece.t + s * piece.t_way;
          here.piece = index;
        } else if (!next) {
          here.rival = std::min(here.rival, d);
        }
      }
}

/// From a place near to it to the nearest point of the curve by Newton's method, within the cubic of the
/// piece. False where another minimum may be next to it, which is about the centre of curvature and farther
/// out: there `second` / `speed` = 1 - distance / (radius of curvature) falls to 0 and below. False as well
/// where the way leads to the next cubic.
bool polish(const PiecesOfStrand& of, const Nearest& from, const Place& place, ClosestPoint& closest) {
  constexpr int kMostSteps = 8;
  const int curves = of.strand.pieces();
  const StrandPiece& piece = of.pieces[from.piece];
  const int curve = std::min(static_cast<int>((piece.t + 0.5 * piece.t_way) * curves), curves - 1);
  const Place* p = of.strand.points.data() + 3 * static_cast<std::size_t>(curve);
  double t = std::clamp(from.t * curves - curve, 0.0, 1.0);
  for (int step = 0; step < kMostSteps; ++step) {
    const double u = 1.0 - t;
    double square = 0.0, first = 0.0, second = 0.0, speed = 0.0;
    for (int i = 0; i < 3; ++i) {
      const double a = p[1][i] - p[0][i], b = p[2][i] - p[1][i], c = p[3][i] - p[2][i];
      const double at =
          u * u * (u * p[0][i] + 3.0 * t * p[1][i]) + t * t * (3.0 * u * p[2][i] + t * p[3][i]) - place[i];
      const double velocity = 3.0 * (u * u * a + 2.0 * u * t * b + t * t * c);
      square += at * at;
      first += at * velocity;
      second += at * 6.0 * (u * (b - a) + t * (c - b));
      speed += velocity * velocity;
    }
    second += speed;
    if (!(second > 0.5 * speed)) return false;
    const double next = t - first / second, held = std::clamp(next, 0.0, 1.0);
    if (next != held && (held == 0.0 ? curve > 0 : curve + 1 < curves)) return false;
    // What is left moves the place by less than a millionth of the radius.
    if ((held - t) * (held - t) * speed < 1e-12 * of.radius * of.radius) {
      closest = {(curve + t) / curves, std::sqrt(square)};
      return true;
    }
    t = held;
  }
  return false;
}

double density_of(const PiecesOfStrand& of, RadialFalloff falloff, const Nearest& nearest,
                  const Place& place) {
  const bool contested = std::sqrt(nearest.rival) < std::sqrt(nearest.square) + 2.0 * of.off;
  ClosestPoint closest;
  if (contested || !polish(of, nearest, place, closest)) return density_at(of.strand, falloff, place);
  if (closest.t <= 0.0 && beyond_end(of.strand, false, place)) return 0.0;
  if (closest.t >= 1.0 && beyond_end(of.strand, true, place)) return 0.0;
  const double radius = of.strand.radius_first + closest.t * (of.strand.radius_last - of.strand.radius_first);
  if (!(radius > 0.0)) return 0.0;
  return density_in_middle(of.strand, closest.t) * falloff_across(falloff, closest.distance / radius);
}

/// Reaches of one brick, ordered by strand: their densities, added to `sum`.
void fill_brick(const std::vector<PiecesOfStrand>& strands, RadialFalloff falloff, const ReachOfStrand* first,
                const ReachOfStrand* last, double* sum) {
  const int corner[3] = {first->brick.x * kEdge, first->brick.y * kEdge, first->brick.z * kEdge};
  std::vector<Nearest> nearest(kVoxels);
  while (first != last) {
    const PiecesOfStrand& of = strands[first->strand];
    const std::uint32_t strand = first->strand;
    std::fill(nearest.begin(), nearest.end(), Nearest{});
    for (; first != last && first->strand == strand; ++first)
      for (std::uint32_t p = first->first; p < first->last; ++p) try_piece(of, p, corner, nearest.data());
    for (int v = 0; v < kVoxels; ++v)
      if (nearest[v].square < kInfinity)
        sum[v] += density_of(of, falloff, nearest[v],
                             {1.0 * corner[0] + v / (kEdge * kEdge), 1.0 * corner[1] + v / kEdge % kEdge,
                              1.0 * corner[2] + v % kEdge});
  }
}

[[noreturn]] void refuse_memory(double bytes, const StrandGridOptions& options) {
  char text[96];
  std::snprintf(text, sizeof text, "its grid would take more than the %.3g GB that it may",
                bytes / (1024.0 * 1024.0 * 1024.0));
  throw Error(ErrorKind::usage, {text, "", 0, options.name, "larger voxels", ""});
}

/// The strands of a block, whose numbers count from its beginning.
void add_block(const std::vector<PiecesOfStrand>& strands, RadialFalloff falloff,
               const std::vector<double>& gain, const StrandGridOptions& options, SparseGrid& grid) {
  std::vector<std::vector<ReachOfStrand>> of_strand(strands.size());
  parallel_for(strands.size(), options.threads, [&](std::size_t s, int) {
    find_bricks(strands[s], static_cast<std::uint32_t>(s), of_strand[s]);
  });
  std::vector<ReachOfStrand> all;
  for (std::vector<ReachOfStrand>& some : of_strand) {
    all.insert(all.end(), some.begin(), some.end());
    some = {};
  }
  std::sort(all.begin(), all.end(), [](const ReachOfStrand& a, const ReachOfStrand& b) {
    return std::tie(a.brick, a.strand, a.first) < std::tie(b.brick, b.strand, b.first);
  });
  std::vector<std::size_t> begin;
  for (std::size_t r = 0; r < all.size(); ++r)
    if (r == 0 || !(all[r].brick == all[r - 1].brick)) begin.push_back(r);
  begin.push_back(all.size());

  const std::size_t channels = grid.channels.size();
  const double brick_bytes = static_cast<double>(channels * kVoxels * sizeof(float));
  const auto limit = static_cast<double>(options.memory_limit);
  // Some at a time, so that the limit is met early.
  constexpr std::size_t kAtOnce = 16384;
  for (std::size_t from = 0; from + 1 < begin.size(); from += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, begin.size() - 1 - from);
    std::vector<SparseGrid::Brick> made(count);
    parallel_for(count, options.threads, [&](std::size_t b, int) {
      double sum[kVoxels] = {};
      fill_brick(strands, falloff, all.data() + begin[from + b], all.data() + begin[from + b + 1], sum);
      if (std::none_of(sum, sum + kVoxels, [](double x) { return x != 0.0; })) return;
      made[b].resize(channels * kVoxels);
      for (std::size_t c = 0; c < channels; ++c)
        for (int v = 0; v < kVoxels; ++v) made[b][c * kVoxels + v] = static_cast<float>(gain[c] * sum[v]);
    });
    for (std::size_t b = 0; b < count; ++b) {
      if (made[b].empty()) continue;
      SparseGrid::Brick& there = grid.bricks[all[begin[from + b]].brick];
      if (there.empty()) {
        there = std::move(made[b]);
        continue;
      }
      for (std::size_t n = 0; n < there.size(); ++n) there[n] += made[b][n];
    }
    if (static_cast<double>(grid.bricks.size()) * brick_bytes > limit) refuse_memory(limit, options);
  }
}

}  // namespace

void add_strands(const Strands<double>& strands, const std::vector<double>& gain,
                 const StrandGridOptions& options, SparseGrid& grid) {
  std::vector<PiecesOfStrand> block;
  double bricks = 0.0;
  const auto flush = [&] {
    add_block(block, strands.falloff, gain, options, grid);
    block.clear();
    bricks = 0.0;
  };
  for (const Strand<double>& strand : strands.all) {
    block.push_back(pieces_of(strand, grid));
    bricks += bricks_about(block.back());
    if (bricks > kBricksAtOnce || block.size() == kStrandsAtOnce) flush();
  }
  if (!block.empty()) flush();
}

}  // namespace vegard::sim
