// From sheets to groups of beams that the kernel lets fall.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/emit/aurora/change_times.h"
#include "sim/emit/aurora/sheet.h"
#include "sim/emit/aurora/sheet_curve.h"
#include "sim/render/beams/kernel_scene.h"
#include "sim/render/beams/kernel_types.h"
#include "sim/render/beams/light_ages.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// A stretch of one arc at one instant, all its layers; or of the beams whose light of that instant has an
/// age, of which only some of a layer's stand for all.
struct Chunk {
  int instant, sheet, arc, first, count;
  int age = 0;  ///< interval of the sheet's LightAges
};

/// The beams of a chunk that can be seen, packed into groups of one layer each.
struct PackedChunk {
  std::vector<BeamGroup> groups;
  std::vector<GroupChain> chains;  ///< one per group, if derivatives are wanted
  std::vector<GroupAxes> axes;     ///< one per group, where beams have a field of their own
  std::vector<BeamPlace> places;   ///< room to work in
};

/// Whether a footprint stands in the place of the scene's sheets (source = "sheets"), so that no beam falls:
/// their light would be there twice.
bool has_footprint_of_sheets(const Scene& scene);

/// How a scene's beams are laid out: how many there are, where on their layers they stand and in what steps
/// they fall. It stays as it is while the scene's continuous parameters change.
class BeamLayout {
 public:
  /// `beyond` lays out dark beams past the sheets' ends, so many sheet lengths on either side. Without chunks
  /// if has_footprint_of_sheets(). `nodes`, one per sheet, lay out the mean over all draws.
  BeamLayout(const Scene& scene, double beyond, std::vector<SheetNodes> nodes = {});

  const std::vector<Chunk>& chunks() const { return chunks_; }
  /// d_t of a sheet's beams: as given, or by its electrons' mean energy.
  double path_step(int sheet) const { return path_steps_[sheet]; }
  /// The nodes of a sheet's paths; none where steps are drawn.
  PathNodes path_nodes(int sheet) const { return nodes_.empty() ? PathNodes{} : nodes_[sheet].path; }
  int instants() const { return static_cast<int>(instants_s_.size()); }
  const LightAges& ages() const { return ages_; }
  /// height_profiles() of a scene, split by the ages of the light.
  std::vector<HeightProfile> profiles(const Scene& scene) const;

  /// Packs a chunk; the first for the light alone, the second with what derivatives need. What lies outside
  /// the film of `kernel`, or below the horizon, is left out; a film without columns leaves nothing out.
  void pack(const Scene& scene, const Chunk& chunk, const KernelScene& kernel, PackedChunk& out) const;
  void pack(const Scene& scene, const Chunk& chunk, const KernelScene& kernel, const Seeds& seeds,
            PackedChunk& out) const;

 private:
  /// Of the profile of a rung of the sheet's ladder as it now is, or of its only one.
  double peak_km(int sheet, const EnergyLadder& ladder, int rung) const;

  template <class T>
  void pack_as(const Scene& scene, const Chunk& chunk, const KernelScene& kernel, const Seeds* seeds,
               PackedChunk& out) const;

  std::vector<SheetNodes> nodes_;  ///< [sheet], or none
  std::vector<double> instants_s_;
  LightAges ages_;
  std::vector<std::vector<SheetOverTime>> past_;  ///< [sheet][age], what its structures go by
  std::vector<Sheet> sheets_;                     ///< as they were laid out: what their structures go by
  std::vector<CurveLayout> curves_;               ///< [sheet], of those whose course is a curve
  /// Of their height profiles, [sheet][rung of its ladder of energies], where a structure asks for it.
  std::vector<std::vector<double>> peak_km_;
  std::vector<int> first_rung_;  ///< of each sheet, where there are peaks
  std::uint64_t seed_;
  std::vector<double> path_steps_;                             ///< [sheet]
  std::vector<std::vector<StretchOfSheet>> stretches_;         ///< [instant][sheet]
  std::vector<std::vector<std::vector<LayerPlaces>>> places_;  ///< [sheet][arc][layer]
  std::vector<Chunk> chunks_;
};

}  // namespace vegard::sim
