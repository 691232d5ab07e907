#include "sim/emit/sun/strand/strand_grid.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <tuple>

#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/emit/sun/strand/strand_pieces.h"

namespace vegard::sim {
namespace {

constexpr double kStrandGridBricksAtOnce =
    2e6;  // of find_bricks(), times some 24 bytes and as many to sort them
constexpr std::size_t kStrandsAtOnce = 512;

/// Voxels of a brick, [low, high) along each axis.
struct VoxelRange {
  int low[3], high[3];
};

VoxelRange voxels_about(const StrandPiece& piece, double reach, const int corner[3]) {
  VoxelRange range;
  for (int a = 0; a < 3; ++a) {
    const double low = piece.from[a] + std::min(0.0, piece.way[a]) - reach - corner[a];
    const double high = piece.from[a] + std::max(0.0, piece.way[a]) + reach - corner[a];
    range.low[a] = static_cast<int>(std::clamp(std::ceil(low), 0.0, 1.0 * SparseGrid::kEdge));
    range.high[a] = static_cast<int>(std::clamp(std::floor(high) + 1.0, 0.0, 1.0 * SparseGrid::kEdge));
  }
  return range;
}

void try_piece(const PiecesOfStrand& cut_strand, std::uint32_t index, const int corner[3],
               NearestPiece* nearest) {
  const VoxelRange range = voxels_about(cut_strand.pieces[index], cut_strand.radius + cut_strand.off, corner);
  const double inverse = inverse_square(cut_strand.pieces[index]);
  for (int i = range.low[0]; i < range.high[0]; ++i)
    for (int j = range.low[1]; j < range.high[1]; ++j)
      for (int k = range.low[2]; k < range.high[2]; ++k) {
        const double place[3] = {1.0 * corner[0] + i, 1.0 * corner[1] + j, 1.0 * corner[2] + k};
        update_nearest(cut_strand, index, inverse, place, nearest[SparseGrid::within(i, j, k)]);
      }
}

/// Reaches of one brick, ordered by strand: their densities, added to `sum`.
void fill_brick(const std::vector<PiecesOfStrand>& strands, RadialFalloff falloff, const ReachOfStrand* first,
                const ReachOfStrand* last, double* sum) {
  const int corner[3] = {first->brick.x * SparseGrid::kEdge, first->brick.y * SparseGrid::kEdge,
                         first->brick.z * SparseGrid::kEdge};
  std::vector<NearestPiece> nearest(SparseGrid::kVoxels);
  while (first != last) {
    const PiecesOfStrand& cut_strand = strands[first->strand];
    const std::uint32_t strand = first->strand;
    std::fill(nearest.begin(), nearest.end(), NearestPiece{});
    for (; first != last && first->strand == strand; ++first)
      for (std::uint32_t p = first->first; p < first->last; ++p)
        try_piece(cut_strand, p, corner, nearest.data());
    for (int v = 0; v < SparseGrid::kVoxels; ++v) {
      const int i = v / (SparseGrid::kEdge * SparseGrid::kEdge),
                j = v / SparseGrid::kEdge % SparseGrid::kEdge;
      if (nearest[v].square < NearestPiece::kNone)
        sum[v] +=
            density_from(cut_strand, falloff, nearest[v],
                         {1.0 * corner[0] + i, 1.0 * corner[1] + j, 1.0 * corner[2] + v % SparseGrid::kEdge});
    }
  }
}

Error too_large_strand_grid(double bytes) {
  char text[96];
  std::snprintf(text, sizeof text, "its grid would take more than the %.3g GB that it may",
                bytes / (1024.0 * 1024.0 * 1024.0));
  return Error(ErrorKind::usage, text).expected("larger voxels");
}

/// The strands of a block, whose numbers count from its beginning.
void add_block(const std::vector<PiecesOfStrand>& strands, RadialFalloff falloff,
               const std::vector<double>& gain, const StrandGridOptions& options, SparseGrid& grid) {
  std::vector<std::vector<ReachOfStrand>> of_strand(strands.size());
  parallel_for(strands.size(), options.threads, [&](std::size_t s, int) {
    find_bricks(strands[s], static_cast<std::uint32_t>(s), BrickPart::centres, of_strand[s]);
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
  const double brick_bytes = static_cast<double>(channels * SparseGrid::kVoxels * sizeof(float));
  const auto limit = static_cast<double>(options.memory_limit);
  // Some at a time, so that the limit is met early.
  constexpr std::size_t kAtOnce = 2048;
  for (std::size_t from = 0; from + 1 < begin.size(); from += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, begin.size() - 1 - from);
    std::vector<SparseGrid::Brick> made(count);
    parallel_for(count, options.threads, [&](std::size_t b, int) {
      double sum[SparseGrid::kVoxels] = {};
      fill_brick(strands, falloff, all.data() + begin[from + b], all.data() + begin[from + b + 1], sum);
      if (std::none_of(sum, sum + SparseGrid::kVoxels, [](double x) { return x != 0.0; })) return;
      made[b].resize(channels * SparseGrid::kVoxels);
      for (std::size_t c = 0; c < channels; ++c)
        for (int v = 0; v < SparseGrid::kVoxels; ++v)
          made[b][c * SparseGrid::kVoxels + v] = static_cast<float>(gain[c] * sum[v]);
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
    if (static_cast<double>(grid.bricks.size()) * brick_bytes > limit) throw too_large_strand_grid(limit);
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
    if (bricks > kStrandGridBricksAtOnce || block.size() == kStrandsAtOnce) flush();
  }
  if (!block.empty()) flush();
}

}  // namespace vegard::sim
