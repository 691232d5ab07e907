// What a scene's beams share, in the kernel's terms; and how the numbers of a scene become dual numbers.
#pragma once

#include <cstddef>
#include <vector>

#include "sim/emit/aurora/sheet.h"
#include "sim/light/sheet_profile.h"
#include "sim/render/beams/kernel_types.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/table/parameter_id.h"

namespace vegard::sim {

/// Turns numbers of a scene into dual numbers: the tangent is 1 for a free parameter's own number. Stands for
/// `count` free parameters from `first` on, one pass of the kernel. Whoever works out light holds plain
/// structs of the scene and asks for their members: here alone a member is looked up among the places of the
/// free.
class Seeds {
 public:
  Seeds(const Scene& scene, const std::vector<ParameterId>& free, std::size_t first, std::size_t count);

  /// `number` is a member of the scene.
  FreeDual operator()(const double& number, double scale = 1.0) const;

 private:
  std::vector<const double*> places_;
};

/// The same for who wants no derivatives.
struct NoSeeds {
  double operator()(const double& number, double scale = 1.0) const { return number * scale; }
};

/// The shape of one arc of a sheet's system at an instant.
SheetShape<double> shape_of(const Scene& scene, int sheet, int arc, double instant_s, const NoSeeds& seed);
SheetShape<FreeDual> shape_of(const Scene& scene, int sheet, int arc, double instant_s, const Seeds& seed);

/// What all beams of a sheet share. Kernel scenes differ between sheets in their deflections only.
/// `path_step` is the layout's (sim/render/beams/beams.h). `profiles` must live as long as the result.
KernelScene kernel_scene(const Scene& scene, const Sheet& sheet, double path_step, const FilmGeometry& film,
                         const std::vector<HeightProfile>& profiles);

/// The LocalInput that a parameter is for the beams of a sheet; -1 for one that is none, or each beam's own.
int local_input_of(const Scene& scene, int sheet, const ParameterId& id);

/// One height profile per sheet, in their order; behind them those of the ladders of energies, sheet by
/// sheet.
std::vector<HeightProfile> height_profiles(const Scene& scene);

/// Where among them the profiles of a sheet are: the one at the sheet's index, or the ladder's.
struct ProfilesOfSheet {
  int first = 0;
  EnergyLadder ladder;
  int count() const { return ladder.count == 0 ? 1 : ladder.count; }
};
ProfilesOfSheet profiles_of_sheet(const Scene& scene, int sheet);

/// How many there are in all.
int profile_count(const Scene& scene);

}  // namespace vegard::sim
