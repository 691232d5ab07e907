// The light by which a picture changes with the shapes of the sheets' height profiles: derivatives that the
// kernel of beams does not have.
#pragma once

#include <optional>
#include <vector>

#include "sim/base/large_vector.h"
#include "sim/render/film.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/table/parameter_id.h"

namespace vegard::sim {

/// The light of a line grows with a parameter as that of a height profile, a row of SheetShapers::rates.
struct Shaper {
  int parameter = 0, line = 0;
  std::size_t rate = 0;
};
struct SheetShapers {
  std::vector<std::vector<float>> rates;  // each once: lines share their splines' basis
  std::vector<Shaper> shapers;
};
struct ProfileShapers {
  std::vector<SheetShapers> sheets;
  std::vector<bool> alone;  // by parameter: it does nothing but shape a profile
};

/// What the free numbers do to the height profiles. The energy flux scales the light too, which the kernel
/// has.
ProfileShapers profile_shapers(const Scene& scene, const std::vector<ParameterId>& free,
                               const Exposer& exposer);

/// The blurred light of the profiles' slopes on a film. Coefficients of splines do not change it, so it is
/// kept as long as nothing else in the scene changes.
class ProfileLight {
 public:
  /// The exposer must outlive it. The scale on which the slopes' light is rounded goes by the coefficients of
  /// this scene, not by those at which it happens to be asked for first: it is to be the same after a
  /// resumption.
  ProfileLight(const Scene& scene, const FilmGeometry& film, int threads, Exposer& exposer);

  void expose(const Scene& scene, const ProfileShapers& shapers);

  /// The last light of one shaper of a sheet, [row][column].
  const float* plane(std::size_t sheet, const Shaper& shaper) const;

 private:
  /// `rest`: the scene with the first coefficients of its splines.
  bool is_kept(const Scene& rest, const ProfileShapers& shapers) const;
  void expose_sheet(const Scene& scene, const Scene& rest, std::size_t s,
                    const std::vector<float>& transmission);

  const FilmGeometry film_;
  const int threads_;
  Exposer& exposer_;
  std::vector<std::vector<double>> first_rates_;
  std::vector<LargeVector<float>> light_;  // by sheet: [line][rate][row][column]
  std::vector<SheetShapers> shapers_;
  std::optional<Scene> scene_;
};

}  // namespace vegard::sim
