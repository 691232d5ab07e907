// Makes the kernel's data that all beams of a sheet share, and turns parameters of a scene into dual numbers.
#pragma once

#include <cstddef>
#include <vector>

#include "sim/emit/aurora/sheet.h"
#include "sim/light/sheet_profile.h"
#include "sim/render/beams/kernel_types.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/table/parameter_id.h"

namespace vegard::sim {

/// Turns parameters of a scene into dual numbers: a free parameter has the tangent 1 for itself. One object
/// covers one pass of the kernel, `count` free parameters from `first` on. The code that computes light uses
/// plain structs of the scene and passes their members; only here is a member's address looked up among those
/// of the free parameters.
class Seeds {
 public:
  Seeds(const Scene& scene, const std::vector<ParameterId>& free, std::size_t first, std::size_t count);

  /// `number` is a member of the scene.
  FreeDual operator()(const double& number, double scale = 1.0) const;

 private:
  std::vector<const double*> places_;
};

/// Replaces Seeds where no derivatives are wanted.
struct NoSeeds {
  double operator()(const double& number, double scale = 1.0) const { return number * scale; }
};

/// Returns the shape of one arc of a sheet's system at an instant.
SheetShape<double> shape_of(const Scene& scene, int sheet, int arc, double instant_s, const NoSeeds& seed);
SheetShape<FreeDual> shape_of(const Scene& scene, int sheet, int arc, double instant_s, const Seeds& seed);

/// Returns the data that all beams of a sheet share; only the deflections differ between sheets. `path_step`
/// is that of BeamLayout (sim/render/beams/beams.h). `profiles` must live as long as the result.
KernelScene kernel_scene(const Scene& scene, const Sheet& sheet, double path_step, const FilmGeometry& film,
                         const std::vector<HeightProfile>& profiles);

/// Returns which LocalInput a parameter is for the beams of a sheet; -1 if it is none, or one that differs
/// from beam to beam.
int local_input_of(const Scene& scene, int sheet, const ParameterId& id);

/// Returns one height profile per sheet, in their order, and after them those of the energy ladders, sheet by
/// sheet.
std::vector<HeightProfile> height_profiles(const Scene& scene);

/// Which of height_profiles() belong to a sheet: the one at the sheet's index, or those of its ladder.
struct ProfilesOfSheet {
  int first = 0;
  EnergyLadder ladder;
  int count() const { return ladder.count == 0 ? 1 : ladder.count; }
};
ProfilesOfSheet profiles_of_sheet(const Scene& scene, int sheet);

/// Returns the number of height_profiles().
int profile_count(const Scene& scene);

}  // namespace vegard::sim
