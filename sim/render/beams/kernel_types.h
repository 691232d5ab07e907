// The plain numbers and arrays of the kernel's interfaces: beams in groups of sixteen, their common data, and
// the results.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/emit/aurora/foot_field.h"
#include "sim/light/height_profile.h"
#include "sim/light/sample.h"
#include "sim/view/camera/camera.h"

namespace vegard::sim {

inline constexpr int kGroup = 16;  ///< beams that are computed side by side

/// A rayleigh on the value film is 2^20 units of a 64-bit integer: sums do not depend on their order, a
/// thousandth of a rayleigh still has three digits. A cell overflows at 8e12 rayleighs, and one sample may
/// add up to 2e9 (2^31): IBC 4, the brightest aurora, is 1e6 along the field.
inline constexpr double kFilmUnitsPerRayleigh = 1048576.0;

/// A number with its derivatives with respect to the local inputs that it depends on, for sixteen beams.
struct GroupNumber {
  double value[kGroup];
  double tangent[place_inputs][kGroup];
};

/// Unit vectors in east, north, up of beams that each have a direction of their own: along, and two across.
struct GroupAxes {
  GroupNumber axis[3][3];
};

/// Sixteen beams of one layer. Empty places have end_of_path 0.
struct BeamGroup {
  GroupNumber start_in_enu_km[3];
  GroupNumber length_km;
  GroupNumber vertical;  ///< light of a kilometre of path over that of a vertical kilometre
  double flux_km2_mw_m2[kGroup];
  double end_of_path[kGroup];
  double altitude_shift_km[kGroup];  ///< altitude of a point less that at which its profile is read
  double stretch_above[kGroup];      ///< of the height profile above its peak; not 0 if reads_elsewhere
  double first_node[kGroup];         ///< at quadrature nodes: rest of the path at the first, plus the offset
  double tube_along[2][kGroup];      ///< at nodes: PlaceInTube (sim/emit/aurora/place_in_tube.h)
  double tube_across[2][kGroup];     ///< likewise
  double sheet_width_km[kGroup];     ///< likewise
  std::uint32_t index[kGroup];
  bool reads_elsewhere = false;     ///< false: shift and stretch are not used
  double peak_km = 0.0;             ///< of the height profile, which is stretched above it
  std::uint32_t layer_address = 0;  ///< sheet and layer, as in the random streams
  int profile = 0;                  ///< which of KernelScene::profiles
  const GroupAxes* axes = nullptr;  ///< only where KernelScene::beams_own_field

  BeamGroup() {}  // NOLINT: the code that packs a group sets the numbers; they are many
};

/// Returns the altitude at which the height profile is read for a point at `altitude_km`.
inline double altitude_read_km(const BeamGroup& group, int beam, double altitude_km) {
  if (!group.reads_elsewhere) return altitude_km;
  const double off = altitude_km - group.altitude_shift_km[beam] - group.peak_km;
  return group.peak_km + (off > 0.0 ? off / group.stretch_above[beam] : off);
}

/// Returns the inverse: the altitude of a point whose height profile is read at `read_km`.
inline double altitude_of_read_km(const BeamGroup& group, int beam, double read_km) {
  if (!group.reads_elsewhere) return read_km;
  const double off = read_km - group.peak_km;
  return group.peak_km + group.altitude_shift_km[beam] + (off > 0.0 ? off * group.stretch_above[beam] : off);
}

/// Derivatives of a group's local inputs, each beam's foot and log(flux), with respect to the free
/// parameters.
struct GroupChain {
  float foot_east[kGroup][kTangentWidth];
  float foot_north[kGroup][kTangentWidth];
  float log_flux[kGroup][kTangentWidth];
};

/// Data that all beams share.
struct KernelScene {
  FallFrame<PlaceDual> fall;     ///< of the uniform field
  bool beams_own_field = false;  ///< the beams fall along BeamGroup::axes instead
  FootField field;               ///< the field that these beams follow
  Deflection<LocalDual> deflection;
  PathNodes nodes;  ///< if any, paths are evaluated at them and no steps are drawn
  CameraView<LocalDual> view;
  bool plain_pinhole = true;  ///< no distortion, and no derivatives with respect to distortion
  FilmGeometry film;
  FilmEdges edges;  ///< of the film; none where a film without columns leaves nothing out
  double observer_altitude_km = 0.0;
  double sphere_km = kEarthRadiusKm;  ///< radius of the body
  bool earth_hides = false;           ///< some cells of the film look below the horizon
  bool nearest_cell = false;          ///< the paper's forward map, instead of bilinear
  bool unit_weight = false;           ///< every point has the weight 1, instead of rayleighs
  std::uint64_t seed = 0;
  const HeightProfile* profiles = nullptr;  ///< in the order of height_profiles()
};

/// Maps the local inputs that all beams share, and the energies, to free parameters.
struct SharedChain {
  int parameter_of_local[local_inputs];      ///< index of the free parameter, -1 if it is not free
  const int* parameter_of_energy = nullptr;  ///< per height profile, -1 if not free
};

/// Spread of a line's light whose atoms move before they emit, and the films of the levels. The film of the
/// KernelScene has cells of one pixel and covers everything that can fall on any level; no memory is
/// allocated for it.
struct KernelLevels {
  const float* lifetime_s = nullptr;    ///< [HeightProfile::kAltitudes]
  const float* variance_km2 = nullptr;  ///< likewise
  double wind_enu_km_s[3] = {0.0, 0.0, 0.0};
  int count = 0;  ///< number of levels
  const FilmGeometry* films = nullptr;
  const float* variance_px2 = nullptr;
};

/// How far fall_until() goes.
enum class FallPhase {
  path,     ///< up to deflection points in the beams' own frame
  samples,  ///< also place on the film and brightness of the points in view
};

/// The samples that fall_on_film adds to the film, in its order and in the form that splat_on_film takes.
struct SplatRecord {
  std::vector<float> column, row;
  std::vector<float> weights;  ///< [point * stride + line], rayleighs
  std::size_t points() const { return column.size(); }
};

/// A batch of points, in order.
struct EmissionPoints {
  int lines = 0;
  std::vector<float> position_in_enu_km;  ///< [point * 3]: east, north, up of the observer
  std::vector<float> photons_per_s;       ///< [point * lines + line], into all directions

  std::size_t size() const { return position_in_enu_km.size() / 3; }
  void clear() {
    position_in_enu_km.clear();
    photons_per_s.clear();
  }
};

}  // namespace vegard::sim
