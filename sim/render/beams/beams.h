// Lays out the beams of sheets and packs them into groups for the kernel.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/emit/aurora/motion.h"
#include "sim/emit/aurora/sheet.h"
#include "sim/emit/aurora/sheet_curve.h"
#include "sim/render/beams/kernel_scene.h"
#include "sim/render/beams/kernel_types.h"
#include "sim/render/beams/light_ages.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Beams of a stretch of one arc, in all its layers, at one instant; or, for an interval of age above 0,
/// those of them that represent the light of this age.
struct Chunk {
  int instant, sheet, arc, first, count;
  int age = 0;  ///< interval of the sheet's LightAges
};

/// The beams of a chunk that can be seen, packed into groups of one layer each.
struct PackedChunk {
  std::vector<BeamGroup> groups;
  std::vector<GroupChain> chains;  ///< one per group, if derivatives are wanted
  std::vector<GroupAxes> axes;     ///< one per group, where beams have a field of their own
  std::vector<BeamPlace> places;   ///< scratch memory
};

/// True if a footprint replaces the scene's sheets (source = "sheets"). Then there are no beams, as their
/// light would be there twice.
bool has_footprint_of_sheets(const Scene& scene);

/// The layout of a scene's beams: their number, their places on their layers and the steps of their paths. It
/// does not change with the scene's continuous parameters.
class BeamLayout {
 public:
  /// `beyond`: dark beams are laid out past the sheets' ends, for this many sheet lengths on either side.
  /// There are no chunks if has_footprint_of_sheets(). `nodes`, one per sheet: lays out a quadrature for the
  /// mean over all draws.
  BeamLayout(const Scene& scene, double beyond, std::vector<SheetNodes> nodes = {});

  const std::vector<Chunk>& chunks() const { return chunks_; }
  /// Returns d_t of a sheet's beams: as given, or from its electrons' mean energy.
  double path_step(int sheet) const { return path_steps_[sheet]; }
  /// Returns the quadrature nodes of a sheet's paths; none where steps are drawn at random.
  PathNodes path_nodes(int sheet) const { return nodes_.empty() ? PathNodes{} : nodes_[sheet].path; }
  int instants() const { return static_cast<int>(instants_s_.size()); }
  const LightAges& ages() const { return ages_; }
  /// Returns height_profiles() of a scene, split by the ages of the light.
  std::vector<HeightProfile> profiles(const Scene& scene) const;

  /// Packs a chunk: the first function for light only, the second with the data for derivatives. Beams
  /// outside the film of `kernel` or below the horizon are left out; if the film has no columns, none is.
  void pack(const Scene& scene, const Chunk& chunk, const KernelScene& kernel, PackedChunk& out) const;
  void pack(const Scene& scene, const Chunk& chunk, const KernelScene& kernel, const Seeds& seeds,
            PackedChunk& out) const;

 private:
  /// Returns the peak altitude of the present profile of a rung of the sheet's energy ladder, or of its only
  /// profile.
  double peak_km(int sheet, const EnergyLadder& ladder, int rung) const;

  template <class T>
  class Packer;

  std::vector<SheetNodes> nodes_;  ///< [sheet], or none
  std::vector<double> instants_s_;
  LightAges ages_;
  std::vector<std::vector<SheetOverTime>> past_;  ///< [sheet][age], determines the structures
  std::vector<Sheet> sheets_;                     ///< as laid out; they determine the structures
  std::vector<CurveLayout> curves_;               ///< [sheet], for sheets whose course is a curve
  /// Peak altitudes of the height profiles, [sheet][rung of its energy ladder], where a structure needs them.
  std::vector<std::vector<double>> peak_km_;
  std::vector<int> first_rung_;  ///< [sheet], where peak altitudes are needed
  std::uint64_t seed_;
  std::vector<double> path_steps_;                             ///< [sheet]
  std::vector<std::vector<StretchOfSheet>> stretches_;         ///< [instant][sheet]
  std::vector<std::vector<std::vector<LayerPlaces>>> places_;  ///< [sheet][arc][layer]
  std::vector<Chunk> chunks_;
};

}  // namespace vegard::sim
