#include "sim/render/beams/kernel_scene.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/base/number/constants.h"
#include "sim/emit/aurora/beam.h"
#include "sim/emit/aurora/sheet.h"
#include "sim/light/sheet_profile.h"
#include "sim/render/beams/altitude_slabs.h"

namespace vegard::sim {
namespace {

/// A scene number (in degrees) as a local input, in radians.
template <class T>
T local(double degrees, int input, double scale = kRadiansPerDegree) {
  T dual(degrees * scale);
  dual.d.t[input] = scale;
  return dual;
}

/// Returns whether a fit frees a pinhole's distortion, which may be 0 at present: the light is then the same
/// to the last bit with and without derivatives.
bool may_be_distorted(const Fit& fit) {
  static const std::vector<std::string> distortions = [] {
    std::vector<std::string> paths;
    for (const ParameterRole role : {ParameterRole::lens_k1, ParameterRole::lens_k2, ParameterRole::lens_k3,
                                     ParameterRole::lens_p1, ParameterRole::lens_p2})
      paths.push_back(path_of({}, parameter_with(role)));
    return paths;
  }();
  const auto is_distortion = [](const std::string& path) {
    return std::find(distortions.begin(), distortions.end(), path) != distortions.end();
  };
  return std::any_of(fit.free.begin(), fit.free.end(),
                     [&](const FreeParameter& free) { return is_distortion(free.path); }) ||
         std::any_of(fit.tied.begin(), fit.tied.end(),
                     [&](const TiedParameter& tied) { return is_distortion(tied.path); });
}

/// Returns whether the film sees anything below the horizon, on its border or at the nadir.
bool looks_below_horizon(const CameraView<double>& view, const FilmGeometry& film, double altitude_km,
                         double sphere_km) {
  const double radius = sphere_km / (sphere_km + std::max(0.0, altitude_km));
  const double lowest = -std::sqrt(1.0 - radius * radius);
  const auto below = [&](double column, double row) {
    double enu[3];
    return !enu_of_pixel(view, film.x0_px + column * film.cell_width_px,
                         film.y0_px + row * film.cell_height_px, enu) ||
           enu[2] <= lowest;
  };
  constexpr int kPieces = 64;
  for (int i = 0; i <= kPieces; ++i) {
    const double across = static_cast<double>(film.columns) * i / kPieces,
                 down = static_cast<double>(film.rows) * i / kPieces;
    if (below(across, 0.0) || below(across, film.rows) || below(0.0, down) || below(film.columns, down))
      return true;
  }
  const double nadir[3] = {0.0, 0.0, -1.0};
  double x_px = 0.0, y_px = 0.0;
  return pixel_of_enu(view, nadir, x_px, y_px) && x_px >= film.x0_px && y_px >= film.y0_px &&
         x_px <= film.x0_px + film.columns * film.cell_width_px &&
         y_px <= film.y0_px + film.rows * film.cell_height_px;
}

}  // namespace

Seeds::Seeds(const Scene& scene, const std::vector<ParameterId>& free, std::size_t first, std::size_t count) {
  for (std::size_t i = first; i < first + count; ++i) places_.push_back(number_at(scene, free[i]));
}

FreeDual Seeds::operator()(const double& number, double scale) const {
  FreeDual dual(number * scale);
  const auto found = std::find(places_.begin(), places_.end(), &number);
  if (found != places_.end()) dual.d.t[found - places_.begin()] = scale;
  return dual;
}

SheetShape<double> shape_of(const Scene& scene, int sheet, int arc, double instant_s, const NoSeeds& seed) {
  return sheet_shape<double>(scene, sheet, arc, instant_s, seed);
}
SheetShape<FreeDual> shape_of(const Scene& scene, int sheet, int arc, double instant_s, const Seeds& seed) {
  return sheet_shape<FreeDual>(scene, sheet, arc, instant_s, seed);
}

KernelScene kernel_scene(const Scene& scene, const Sheet& sheet, double path_step, const FilmGeometry& film,
                         const std::vector<HeightProfile>& profiles) {
  KernelScene k;
  k.fall = fall_frame(local<PlaceDual>(scene.field.inclination_deg, inclination),
                      local<PlaceDual>(scene.field.declination_deg, declination));
  k.field = FootField(scene);
  k.beams_own_field = k.field.varies();
  k.deflection.law = sheet.pitch_law;
  k.deflection.loss_cone_rad = local<LocalDual>(sheet.loss_cone_deg, loss_cone);
  k.deflection.pitch_step_rad = local<LocalDual>(sheet.pitch_step_rad, pitch_step, 1.0);
  k.deflection.path_step = path_step;
  k.deflection.rule = sheet.path_rule;
  k.view = camera_view<LocalDual>(scene.camera, [&](CameraNumber which) {
    return local<LocalDual>(camera_number(scene.camera, which), first_camera_input + which, 1.0);
  });
  k.plain_pinhole = is_plain_pinhole(k.view.lens) && !may_be_distorted(scene.fit);
  k.film = film;
  k.observer_altitude_km = scene.site.altitude_m * 1e-3;
  k.sphere_km = scene.body.radius_km;
  if (film.columns > 0) {
    const CameraView<double> plain = camera_view(scene.camera);
    k.edges = film_edges(plain.lens, film);
    k.earth_hides = looks_below_horizon(plain, film, k.observer_altitude_km, k.sphere_km);
  }
  k.nearest_cell = scene.film.splat == SplatRule::nearest;
  k.unit_weight = scene.film.weight == PointWeight::unit;
  k.seed = scene.seed;
  k.profiles = profiles.data();
  return k;
}

int local_input_of(const Scene& scene, int sheet, const ParameterId& id) {
  static_assert(static_cast<int>(camera_inputs) == static_cast<int>(camera_numbers));
  switch (id.role()) {
    case ParameterRole::none:
      return -1;
    case ParameterRole::inclination:
      return inclination;
    case ParameterRole::declination:
      return declination;
    case ParameterRole::loss_cone:
      return id.element == sheet ? loss_cone : -1;
    case ParameterRole::pitch_step:
      return id.element == sheet ? pitch_step : -1;
    default:
      break;
  }
  const int of_camera = camera_number_of(scene.camera, id);
  return of_camera < 0 ? -1 : first_camera_input + of_camera;
}

std::vector<HeightProfile> height_profiles(const Scene& scene) {
  std::vector<HeightProfile> all;
  for (std::size_t s = 0; s < scene.sheets.size(); ++s)
    all.push_back(sheet_profile(scene.emission.lines, scene, static_cast<int>(s)));
  for (std::size_t s = 0; s < scene.sheets.size(); ++s)
    for (HeightProfile& profile : ladder_profiles(scene.emission.lines, scene, static_cast<int>(s)))
      all.push_back(std::move(profile));
  for (HeightProfile& profile : all) take_altitude_share(scene.emission, profile);
  return all;
}

ProfilesOfSheet profiles_of_sheet(const Scene& scene, int sheet) {
  ProfilesOfSheet profiles{sheet, energy_ladder(scene, sheet)};
  if (profiles.ladder.count == 0) return profiles;
  profiles.first = static_cast<int>(scene.sheets.size());
  for (int before = 0; before < sheet; ++before) profiles.first += energy_ladder(scene, before).count;
  return profiles;
}

int profile_count(const Scene& scene) {
  const int sheets = static_cast<int>(scene.sheets.size());
  int count = sheets;
  for (int sheet = 0; sheet < sheets; ++sheet) count += energy_ladder(scene, sheet).count;
  return count;
}

}  // namespace vegard::sim
