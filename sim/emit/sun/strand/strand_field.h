// The light of strands as a field in space, in the Sun's frame and unit: loops, bundles, ropes.
//
// The cells of a lattice list the pieces of strands that reach into them, so that a place is compared with
// these only. A place has the light of a voxel there (strand_grid.h): each strand contributes once, from its
// nearest point.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/emit/sun/strand/strand_pieces.h"
#include "sim/light/emitter.h"

namespace vegard::sim {

class StrandField : public LightField {
 public:
  /// `light`: rayleighs of density 1 per unit of path, per line, or empty. The field absorbs nothing, and is
  /// dark within the photosphere. Throws Error(usage) if pieces and cells would take more than `memory_limit`
  /// bytes, or if strands are so thin that the cells cannot be numbered.
  StrandField(const Strands<double>& strands, const Sun& sun, const std::vector<double>& light, int lines,
              std::uint64_t memory_limit = std::uint64_t{4} << 30);

  double unit_cm() const override { return unit_cm_; }
  Box3 bounds() const override { return bounds_; }
  bool is_dark(const Box3& box) const override;
  void sample(std::size_t count, const double* const point[3], float* const emission[],
              float* density) const override;

  /// Returns the density of all strands at a place.
  double density_at(const double place[3]) const;

 private:
  /// Calls use(number of a strand, its density there) for the strands that contribute at the place.
  template <class Use>
  void visit(const double place[3], const Use& use) const;

  RadialFalloff falloff_;
  double unit_cm_, sun_radius_;
  std::vector<double> rate_;  ///< photons cm^-3 s^-1 for density 1, per line
  Box3 bounds_;
  SparseGrid lattice_;  ///< its brick coordinates define the cells; no bricks are stored
  std::vector<PiecesOfStrand> strands_;
  std::vector<double> gain_;            ///< [strand][line], for strands with factors per line; else empty
  std::vector<ReachOfStrand> reaches_;  ///< sorted by cell, then strand, then piece
};

}  // namespace vegard::sim
