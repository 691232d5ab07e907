// The identity of a parameter: which number of a scene is meant, in any scene and in any copy of one.
//
// It is made once, where a path is read, and says its path again where something is written. In between it is
// compared, and finds its number in whatever scene is at hand.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

struct ParameterRow;

/// What those who work with parameters need to know of one, as its row of the table declares it. Most need to
/// know nothing. Each role but `none` is that of one key.
enum class ParameterRole {
  none,
  // of a sheet
  centre,  ///< component 0 to the east, 1 to the north
  bearing,
  length,
  amplitude,  ///< of its sine
  wavelength,
  phase,
  drift,  ///< component 0 to the east, 1 to the north
  energy,
  energy_spread,
  energy_flux,
  loss_cone,
  pitch_step,
  form_peak,
  form_lower,
  form_upper,
  profile_coefficient,  ///< of a free-form profile
  // of the magnetic field
  inclination,
  declination,
  // of the camera
  camera_azimuth,
  camera_elevation,
  camera_roll,
  field_of_view,  ///< of a pinhole
  focal_length,   ///< of every other lens
  principal_x,
  principal_y,
  lens_aspect,
  lens_k1,
  lens_k2,
  lens_k3,
  lens_p1,
  lens_p2,
  blur_width,
  // of the air and the night sky
  aerosol_depth,
  angstrom_exponent,
  green_airglow,
  red_airglow,
  sodium_airglow,
  town_light,
  // of a footprint
  footprint_centre,  ///< component 0 to the east, 1 to the north
  footprint_east,    ///< of a point of its curve, from the centre
  footprint_north,
  footprint_energy,
  footprint_energy_flux,
  // of the Sun and what stands on it
  sun_azimuth,
  sun_elevation,
  granule_size,
  granule_shift,
  roles  ///< how many there are
};

/// One number. A number of a list by emission line is known by its line, not by its place in the list: scenes
/// of several photographs may have their lines in different orders, or lack some.
struct ParameterId {
  const ParameterRow* row = nullptr;  ///< of parameter_table(); null: no parameter
  int element = -1;                   ///< which of a repeated table's elements, -1 for other tables
  int line = 0;       ///< line_in_angstrom() for a list by emission line, 0 for everything else
  int component = 0;  ///< index within its vector, or among the numbers of its line

  bool any() const { return row != nullptr; }
  ParameterRole role() const;
  int sheet() const;  ///< index into Scene::sheets, -1 for a number of anything else
};

bool operator==(const ParameterId& a, const ParameterId& b);
inline bool operator!=(const ParameterId& a, const ParameterId& b) { return !(a == b); }
/// In the order of the table.
bool operator<(const ParameterId& a, const ParameterId& b);

struct ParameterIdHash {
  std::size_t operator()(const ParameterId& id) const;
};

/// The number with that role, which is not `none`: of a repeated table's element, and of a vector a
/// component. Of a list by emission line it is not enough.
ParameterId parameter_with(ParameterRole role, int element = -1, int component = 0);

/// The one number that a path names in this scene; none if it names a whole vector or nothing.
std::optional<ParameterId> parameter_at(const Scene& scene, const std::string& path);

/// "sheet.main.center_km.east". The scene has the number.
std::string path_of(const Scene& scene, const ParameterId& id);

/// Where a real number stands in this scene, to be read or set; null if the scene has no such element, line
/// or component.
double* number_at(Scene& scene, const ParameterId& id);
const double* number_at(const Scene& scene, const ParameterId& id);

/// Its index in its vector in this scene, 0 for a scalar; -1 if the scene does not have it.
int index_in(const Scene& scene, const ParameterId& id);

}  // namespace vegard::sim
