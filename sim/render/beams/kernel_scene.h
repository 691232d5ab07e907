// What a scene's beams share, in the kernel's terms; and how the numbers of a scene become dual numbers.
#pragma once

#include <cstddef>
#include <vector>

#include "sim/emit/aurora/sheet.h"
#include "sim/render/beams/kernel_types.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Turns numbers of a scene into dual numbers: the tangent is 1 for the parameter that lives at that address.
/// Stands for `count` free parameters from `first` on, one pass of the kernel.
class Seeds {
 public:
  Seeds(const std::vector<const double*>& free, std::size_t first, std::size_t count)
      : free_(free), first_(first), count_(count) {}

  /// Which of these parameters lives there; -1 if none.
  int parameter_at(const double* address) const;

  FreeDual operator()(const double& number, double scale = 1.0) const;

 private:
  const std::vector<const double*>& free_;
  std::size_t first_, count_;
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

/// Where in the scene the local inputs live, by LocalInput; null for those of a beam.
std::vector<const double*> local_input_addresses(const Scene& scene, const Sheet& sheet);

/// One height profile per sheet.
std::vector<HeightProfile> height_profiles(const Scene& scene);

}  // namespace vegard::sim
