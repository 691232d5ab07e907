// From sheets to groups of beams that the kernel lets fall.
#pragma once

#include <vector>

#include "sim/emit/aurora/sheet.h"
#include "sim/render/kernel.h"
#include "sim/render/kernel_scene.h"
#include "sim/scene/scene.h"

namespace vegard::sim {

/// A stretch of one arc at one instant, all its layers.
struct Chunk {
  int instant, sheet, arc, first, count;
};

/// The beams of a chunk that can be seen, packed into groups of one layer each.
struct PackedChunk {
  std::vector<BeamGroup> groups;
  std::vector<GroupChain> chains;  ///< one per group, if derivatives are wanted
  std::vector<BeamPlace> places;   ///< room to work in
};

/// How a scene's beams are laid out: how many there are and where on their layers they stand. It stays as it
/// is while the scene's continuous parameters change.
class BeamLayout {
 public:
  /// `beyond` lays out dark beams past the sheets' ends, so many sheet lengths on either side.
  BeamLayout(const Scene& scene, double beyond);

  const std::vector<Chunk>& chunks() const { return chunks_; }
  int instants() const { return static_cast<int>(instants_s_.size()); }

  /// Packs a chunk; the first for the light alone, the second with what derivatives need. What lies outside
  /// the film of `kernel`, or below the horizon, is left out; a film without columns leaves nothing out.
  void pack(const Scene& scene, const Chunk& chunk, const KernelScene& kernel, PackedChunk& out) const;
  void pack(const Scene& scene, const Chunk& chunk, const KernelScene& kernel, const Seeds& seeds,
            PackedChunk& out) const;

 private:
  template <class T>
  void pack_as(const Scene& scene, const Chunk& chunk, const KernelScene& kernel, const Seeds* seeds,
               PackedChunk& out) const;

  std::vector<double> instants_s_;
  std::vector<std::vector<StretchOfSheet>> stretches_;         ///< [instant][sheet]
  std::vector<std::vector<std::vector<LayerPlaces>>> places_;  ///< [sheet][arc][layer]
  std::vector<Chunk> chunks_;
};

}  // namespace vegard::sim
