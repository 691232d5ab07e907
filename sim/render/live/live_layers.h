// The sheets and footprints of a scene as layers of a live view (live_view.h).
#pragma once

#include <string>
#include <vector>

#include "sim/base/number/vec3.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// The values of a map's texels at an instant, [face][row][column] (one face, or the six of a shell). All but
/// the flux are empty where they are 0 everywhere.
struct LiveMap {
  std::vector<float> flux;        ///< mW m^-2, or in the unit of the layer's profiles
  std::vector<float> ln_energy;   ///< as in the layer's profiles
  std::vector<float> shift_km;    ///< of the altitude at which the profile is read, downwards
  std::vector<float> ln_stretch;  ///< of the profile above peak_km
};

/// A sheet, or a look at a footprint. Its axes are those of the site of its map; of a shell, the body's.
struct LiveLayer {
  std::string name;
  bool is_shell = false;
  double axes[3][3]{};  ///< [east, north, up of the scene's observer][component in the layer's axes]
  /// Of a shell: rotation of the map to the east in degrees per second of the scene's clock.
  double turn_deg_s = 0.0;

  /// Middle of texel (0, 0). Of a plane: in km along `along` and to its left, over the plane of the feet's
  /// east and north; of a shell: columns and rows in a face's texels (footprint_map.h, without its border).
  double first_column = 0.0, first_row = 0.0;
  EastNorth along{1.0, 0.0};
  EastNorth drift_km_s{};  ///< of the map
  double cell_km = 1.0;    ///< of a plane
  int face_cells = 0;      ///< of a shell
  int columns = 0, rows = 0, faces = 1;
  std::vector<LiveMap> maps;  ///< one, or as many as the view has instants

  /// Radius in texels around a place within which no instant has light, [face][row][column]: a cell holds
  /// dark_texels x dark_texels texels, the first one from (dark_first_column, dark_first_row) on. Beyond the
  /// cells the value at their edge is a lower bound.
  std::vector<float> dark;
  int dark_columns = 0, dark_rows = 0, dark_texels = 8;
  double dark_first_column = 0.0, dark_first_row = 0.0;

  /// Unit vectors of the fall at the feet, on kFallNodes x kFallNodes nodes of every face,
  /// [face][row][column] [component], from the map's first to its last texel; of a shell over whole faces, u
  /// and v from -1 to 1.
  std::vector<float> fall;

  double bottom_km = 0.0, top_km = 0.0;  ///< there is no light outside
  double peak_km = 0.0;                  ///< above which profiles are stretched
  double ln_first = 0.0, ln_step = 0.0;  ///< of the profiles' energies; the step is 0 if there is one
  int energies = 1;
  /// Kilorayleighs per km of path, per unit of flux, every kProfileStep_km from HeightProfile::kBottomKm up,
  /// [energy][altitude][line].
  std::vector<float> rate;
};

inline constexpr int kFallNodes = 33;
inline constexpr double kProfileStep_km = 0.5;

/// Returns the layers at the instants of the scene's clock. Throws as reading the footprints' files does.
std::vector<LiveLayer> live_layers(const Scene& scene, const std::vector<double>& instants_s, int threads);

}  // namespace vegard::sim
