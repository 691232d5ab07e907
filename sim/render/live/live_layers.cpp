#include "sim/render/live/live_layers.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "sim/base/error.h"
#include "sim/base/number/constants.h"
#include "sim/emit/aurora/motion.h"
#include "sim/emit/aurora/place_in_tube.h"
#include "sim/emit/aurora/sheet.h"
#include "sim/emit/aurora/sheet_curve.h"
#include "sim/emit/footprint/foot_projection.h"
#include "sim/emit/footprint/lit_map.h"
#include "sim/light/emitter.h"
#include "sim/light/sheet_profile.h"
#include "sim/render/emitters/footprint_volumes.h"
#include "sim/scene/structs/site_axes.h"

namespace vegard::sim {
namespace {

constexpr double kMostColumns = 8192.0, kMostTexels = 4.0e6;  // of a map
constexpr int kMostFaceCells = 1024;

/// A rectangle of texels.
struct Texels {
  int first_column = 0, end_column = 0, first_row = 0, end_row = 0;
  int columns() const { return end_column - first_column; }
  int rows() const { return end_row - first_row; }
};

/// The texels that are lit at any instant, with a dark border where the grid has one.
Texels lit_part(const std::vector<std::uint8_t>& lit, int columns, int rows) {
  Texels part{columns, 0, rows, 0};
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      if (lit[static_cast<std::size_t>(row) * columns + column] == 0) continue;
      part.first_column = std::min(part.first_column, column);
      part.end_column = std::max(part.end_column, column + 1);
      part.first_row = std::min(part.first_row, row);
      part.end_row = std::max(part.end_row, row + 1);
    }
  if (part.end_column == 0) return {0, 1, 0, 1};
  return {std::max(0, part.first_column - 1), std::min(columns, part.end_column + 1),
          std::max(0, part.first_row - 1), std::min(rows, part.end_row + 1)};
}

void append_part(const std::vector<double>& values, int columns, const Texels& part, std::vector<float>& to) {
  if (values.empty()) return;
  for (int row = part.first_row; row < part.end_row; ++row)
    for (int column = part.first_column; column < part.end_column; ++column)
      to.push_back(static_cast<float>(values[static_cast<std::size_t>(row) * columns + column]));
}

void mark_lit(const FootprintGrid<double>& grid, std::vector<std::uint8_t>& lit) {
  double most = 0.0;
  for (const double flux : grid.flux_mw_m2) most = std::max(most, flux);
  lit.resize(grid.cells(), 0);
  for (std::size_t i = 0; i < grid.flux_mw_m2.size(); ++i)
    if (grid.flux_mw_m2[i] > kDarkShare * most) lit[i] = 1;
}

void take_dark(const LitMap& dark, LiveLayer& layer) {
  layer.dark_columns = dark.columns(), layer.dark_rows = dark.rows();
  layer.dark_texels = LitMap::kCellTexels;
  layer.dark_first_column = dark.first_x(), layer.dark_first_row = dark.first_y();
  layer.dark.insert(layer.dark.end(), dark.dark(),
                    dark.dark() + static_cast<std::size_t>(dark.columns()) * dark.rows());
}

/// Cuts the lit part out of planes of one size.
void take_planes(const std::vector<SheetMap>& planes, int threads, LiveLayer& layer) {
  const PlaneFootprint<double>& first = planes.front().plane;
  const int columns = first.grid.columns, rows = first.grid.rows;
  std::vector<std::uint8_t> lit;
  for (const SheetMap& one : planes)
    if (one.plane.grid.columns != columns || one.plane.grid.rows != rows)
      throw Error(ErrorKind::scene, layer.name + " changes the size of its map with time")
          .expected("a scene without --seconds, or another cell_km");
  for (const SheetMap& one : planes) mark_lit(one.plane.grid, lit);
  const Texels part = lit_part(lit, columns, rows);
  layer.cell_km = first.cell_km;
  layer.columns = part.columns(), layer.rows = part.rows();
  layer.first_column = first.west_km + (part.first_column + 0.5) * first.cell_km;
  layer.first_row = first.south_km + (part.first_row + 0.5) * first.cell_km;
  std::vector<std::uint8_t> lit_inside;
  for (int row = part.first_row; row < part.end_row; ++row)
    lit_inside.insert(lit_inside.end(),
                      lit.begin() + static_cast<std::ptrdiff_t>(row) * columns + part.first_column,
                      lit.begin() + static_cast<std::ptrdiff_t>(row) * columns + part.end_column);
  take_dark(plane_lit_map(layer.columns, layer.rows, lit_inside, threads), layer);
  for (const SheetMap& one : planes) {
    LiveMap& map = layer.maps.emplace_back();
    append_part(one.plane.grid.flux_mw_m2, columns, part, map.flux);
    append_part(one.plane.grid.ln_energy, columns, part, map.ln_energy);
    append_part(one.shift_km, columns, part, map.shift_km);
    append_part(one.ln_stretch, columns, part, map.ln_stretch);
  }
}

/// The direction of fall at a foot in the plane of a site.
void fall_at_foot(const FootRule<double>& rule, double east_km, double north_km, double fall[3]) {
  const double radius = rule.sphere_km + kFootAltitudeKm;
  const double level2 = std::min(1.0 - 1e-6, (east_km * east_km + north_km * north_km) / (radius * radius));
  const double up[3] = {east_km / radius, north_km / radius, std::sqrt(1.0 - level2)};
  fall_at_place(rule, up, fall);
}

EastNorth foot_of_texel(const LiveLayer& layer, double column, double row) {
  const double along = layer.first_column + column * layer.cell_km,
               left = layer.first_row + row * layer.cell_km;
  return {along * layer.along.east - left * layer.along.north,
          along * layer.along.north + left * layer.along.east};
}

void take_fall(const FootRule<double>& rule, LiveLayer& layer) {
  for (int face = 0; face < layer.faces; ++face)
    for (int j = 0; j < kFallNodes; ++j)
      for (int i = 0; i < kFallNodes; ++i) {
        const double x = static_cast<double>(i) / (kFallNodes - 1),
                     y = static_cast<double>(j) / (kFallNodes - 1);
        double fall[3];
        if (layer.is_shell) {
          double up[3];
          direction_on_face(face, 2.0 * x - 1.0, 2.0 * y - 1.0, up);
          fall_at_place(rule, up, fall);
        } else {
          const EastNorth foot = foot_of_texel(layer, x * (layer.columns - 1), y * (layer.rows - 1));
          fall_at_foot(rule, foot.east, foot.north, fall);
        }
        for (const double component : fall) layer.fall.push_back(static_cast<float>(component));
      }
}

/// Profiles as the layer has them; light is above its bottom and below `top_km`.
void take_profiles(const std::vector<HeightProfile>& profiles, double top_km, LiveLayer& layer) {
  constexpr int kEvery = static_cast<int>(kProfileStep_km / HeightProfile::kStepKm);
  constexpr double kDark = 1e-5;
  layer.energies = static_cast<int>(profiles.size());
  layer.top_km = top_km;
  layer.bottom_km = top_km;
  for (const HeightProfile& profile : profiles) {
    std::vector<float> most(profile.lines, 0.0f);
    for (int row = 0; row < HeightProfile::kAltitudes; ++row)
      for (int line = 0; line < profile.lines; ++line)
        most[line] =
            std::max(most[line], profile.rate[static_cast<std::size_t>(row) * profile.stride + line]);
    bool is_dark = true;
    for (int row = 0; row < HeightProfile::kAltitudes; ++row)
      for (int line = 0; line < profile.lines; ++line) {
        const float rate = profile.rate[static_cast<std::size_t>(row) * profile.stride + line];
        if (is_dark && rate > kDark * most[line]) {
          is_dark = false;
          layer.bottom_km = std::min(layer.bottom_km, HeightProfile::altitude_km(row - 1));
        }
        if (row % kEvery == 0) layer.rate.push_back(static_cast<float>(rate * kRayleighsPerKm * 1e-3));
      }
  }
  layer.peak_km = peak_altitude_km(profiles.front());
}

/// The altitudes of light are those of the profiles, moved by what the maps say.
void widen_by_shifts(LiveLayer& layer) {
  double lowest = 0.0;
  for (const LiveMap& map : layer.maps)
    for (const float shift : map.shift_km) lowest = std::min(lowest, static_cast<double>(shift));
  layer.bottom_km += lowest;
}

void set_axes_of_observer(LiveLayer& layer) {
  for (int i = 0; i < 3; ++i)
    for (int a = 0; a < 3; ++a) layer.axes[i][a] = i == a ? 1.0 : 0.0;
}

double narrowest_km(const Sheet& sheet, double tube_km) {
  double width = sheet.width_km;
  for (const double one : sheet.point_width_km) width = std::min(width, one);
  double narrowest = std::hypot(width, tube_km);
  if (sheet.ray_contrast > 0.0 || sheet.ray_length_contrast > 0.0)
    narrowest = std::min(narrowest, std::hypot(0.42 * sheet.ray_width_km, tube_km));
  return narrowest;
}

/// Standard deviation across of the tube about a beam at the altitude of the light.
double tube_km(const Scene& scene, const Sheet& sheet, double peak_km) {
  Deflection<LocalDual> deflection;
  deflection.law = sheet.pitch_law;
  deflection.loss_cone_rad.v = sheet.loss_cone_deg * kRadiansPerDegree;
  deflection.pitch_step_rad.v = sheet.pitch_step_rad;
  deflection.path_step = path_step_of(sheet);
  const double vertical = std::max(0.2, std::sin(scene.field.inclination_deg * kRadiansPerDegree));
  const double length = (sheet.top_km - HeightProfile::kBottomKm) / vertical,
               gone = (sheet.top_km - peak_km) / (sheet.top_km - HeightProfile::kBottomKm);
  return length * std::sqrt(tube_variance_at_end(deflection) * std::clamp(gone, 0.0, 1.0));
}

LiveLayer layer_of_sheet(const Scene& scene, int index, const std::vector<double>& instants_s, int threads) {
  const Sheet& sheet = scene.sheets[index];
  LiveLayer layer;
  layer.name = "sheet '" + sheet.name + "'";
  set_axes_of_observer(layer);
  const EnergyLadder ladder = energy_ladder(scene, index);
  const std::vector<HeightProfile> profiles =
      ladder.count > 0 ? ladder_profiles(scene.emission.lines, scene, index)
                       : std::vector<HeightProfile>{sheet_profile(scene.emission.lines, scene, index)};
  take_profiles(profiles, sheet.top_km, layer);
  if (ladder.count > 0) {
    layer.ln_step = EnergyLadder::kLnStep;
    layer.ln_first = ladder.first * EnergyLadder::kLnStep - std::log(sheet.energy_kev);
  }
  const double tube = tube_km(scene, sheet, layer.peak_km);
  Sheet at_rest = sheet;
  at_rest.drift_km_s = {};
  const bool changes = soonest_change_s(at_rest, scene.substorm) < std::numeric_limits<double>::infinity();
  const std::vector<double> looked_at = changes ? instants_s : std::vector<double>{instants_s.front()};
  const SheetMapWindow window =
      sheet_map_window(scene, index, looked_at, 2.0 + 4.0 * tube + 3.0 * sheet.width_km);
  const double length = window.last.east - window.first.east,
               breadth = window.last.north - window.first.north;
  const double texels = kMostTexels / static_cast<double>(looked_at.size());  // all are in memory at once
  const double cell = std::max({0.5 * narrowest_km(sheet, tube), length / kMostColumns,
                                breadth / kMostColumns, std::sqrt(length * breadth / texels)});
  std::vector<SheetMap> planes;
  for (const double instant : looked_at)
    planes.push_back(sheet_map(scene, index, window, instant, cell, tube, threads));
  layer.along = window.along;
  layer.drift_km_s = sheet.drift_km_s;
  take_planes(planes, threads, layer);
  widen_by_shifts(layer);
  const FootRule<double> rule = rule_of_foot<double>(scene, Footprint{}, plain_number);
  take_fall(rule, layer);
  // A sheet of given brightness has it along the field, not straight up.
  if (has_given_brightness(sheet))
    for (LiveMap& map : layer.maps)
      for (int row = 0; row < layer.rows; ++row)
        for (int column = 0; column < layer.columns; ++column) {
          float& flux = map.flux[static_cast<std::size_t>(row) * layer.columns + column];
          if (flux == 0.0f) continue;
          const EastNorth foot = foot_of_texel(layer, column, row);
          const double radius = rule.sphere_km + kFootAltitudeKm;
          double fall[3];
          fall_at_foot(rule, foot.east, foot.north, fall);
          const double up = std::sqrt(
              std::max(0.0, 1.0 - (foot.east * foot.east + foot.north * foot.north) / (radius * radius)));
          flux *= static_cast<float>(
              -(fall[0] * foot.east / radius + fall[1] * foot.north / radius + fall[2] * up));
        }
  return layer;
}

/// The same cube with cells of twice the edge, each the mean of four.
CubeFootprint<double> halved(const CubeFootprint<double>& cube) {
  const bool has_energy = !cube.face[0].ln_energy.empty();
  CubeFootprint<double> half = cube_grid<double>(cube.face_cells / 2, has_energy);
  half.turned_deg = cube.turned_deg;
  const int pitch = cube.face_cells + 2;
  for (int face = 0; face < 6; ++face) {
    const FootprintGrid<double>& from = cube.face[face];
    FootprintGrid<double>& to = half.face[face];
    if (from.flux_mw_m2.empty()) {
      to.flux_mw_m2.clear();
      continue;
    }
    for (int row = 0; row < half.face_cells; ++row)
      for (int column = 0; column < half.face_cells; ++column) {
        const std::size_t at = static_cast<std::size_t>(row + 1) * (half.face_cells + 2) + column + 1;
        double flux = 0.0, weighted = 0.0, plain = 0.0;
        for (int k = 0; k < 4; ++k) {
          const std::size_t one =
              static_cast<std::size_t>(2 * row + 1 + k / 2) * pitch + 2 * column + 1 + k % 2;
          flux += from.flux_mw_m2[one];
          if (from.ln_energy.empty()) continue;
          weighted += from.flux_mw_m2[one] * from.ln_energy[one];
          plain += from.ln_energy[one];
        }
        to.flux_mw_m2[at] = 0.25 * flux;
        if (!to.ln_energy.empty()) to.ln_energy[at] = flux > 0.0 ? weighted / flux : 0.25 * plain;
      }
  }
  fill_borders(half);
  return half;
}

void take_cubes(std::vector<CubeFootprint<double>> cubes, int threads, LiveLayer& layer) {
  for (CubeFootprint<double>& cube : cubes)
    while (cube.face_cells > kMostFaceCells && cube.face_cells % 2 == 0) cube = halved(cube);
  layer.is_shell = true;
  layer.faces = 6;
  layer.face_cells = cubes.front().face_cells;
  const int pitch = layer.face_cells + 2;
  std::array<std::vector<std::uint8_t>, 6> lit;
  Texels part{pitch, 0, pitch, 0};
  for (int face = 0; face < 6; ++face) {
    for (const CubeFootprint<double>& cube : cubes)
      if (!cube.face[face].flux_mw_m2.empty()) mark_lit(cube.face[face], lit[face]);
    if (std::find(lit[face].begin(), lit[face].end(), 1) == lit[face].end()) {
      lit[face].clear();
      continue;
    }
    const Texels here = lit_part(lit[face], pitch, pitch);
    part = {std::min(part.first_column, here.first_column), std::max(part.end_column, here.end_column),
            std::min(part.first_row, here.first_row), std::max(part.end_row, here.end_row)};
  }
  if (part.end_column == 0) part = {0, 1, 0, 1};
  for (const LitMap& dark : cube_lit_maps(layer.face_cells, lit, threads)) take_dark(dark, layer);
  layer.columns = part.columns(), layer.rows = part.rows();
  layer.first_column = part.first_column, layer.first_row = part.first_row;
  layer.dark_first_column -= part.first_column, layer.dark_first_row -= part.first_row;
  const std::vector<double> nothing(static_cast<std::size_t>(pitch) * pitch, 0.0);
  for (const CubeFootprint<double>& cube : cubes) {
    LiveMap& map = layer.maps.emplace_back();
    bool has_energy = false;
    for (const FootprintGrid<double>& face : cube.face) has_energy = has_energy || !face.ln_energy.empty();
    for (const FootprintGrid<double>& face : cube.face) {
      append_part(face.flux_mw_m2.empty() ? nothing : face.flux_mw_m2, pitch, part, map.flux);
      if (has_energy)
        append_part(face.ln_energy.empty() ? nothing : face.ln_energy, pitch, part, map.ln_energy);
    }
  }
}

LiveLayer layer_of_look(const Scene& scene, const Footprint& f, const VolumeFiles& files,
                        const FootprintLook& look, const std::vector<double>& instants_s, int threads) {
  LiveLayer layer;
  layer.name = "footprint '" + f.name + "'";
  const double start_s = instants_s.front();
  const bool changes = !only_drifts(f) || scene.substorm.quiet < 1.0;
  std::vector<SheetMap> planes;
  std::vector<CubeFootprint<double>> cubes;
  ProfileTable profiles;
  Footprint drawn = f;
  for (std::size_t i = 0; i < (changes ? instants_s.size() : 1); ++i) {
    // Later maps of the same past: the look moves with the clock.
    FootprintLook then = look;
    if (then.instants_s.empty()) then.instants_s = {scene.time.start_s};
    for (double& instant : then.instants_s) instant += instants_s[i] - start_s;
    if (i > 0 && look.instants_s.size() < 2)
      then.share *=
          substorm_share(scene, f, then.instants_s.front()) /
          std::max(1e-30, substorm_share(scene, f, then.instants_s.front() - instants_s[i] + start_s));
    FootprintParts parts = footprint_parts(scene, f, files, threads, then);
    if (i == 0 || parts.profiles.of_energy.size() > profiles.of_energy.size()) profiles = parts.profiles;
    drawn = parts.drawn;
    if (f.shape == FootprintShape::shell) {
      cubes.push_back(std::move(parts.cube));
    } else {
      // The layer's own drift moves it.
      parts.plane.west_km -= f.drift_km_s.east * (instants_s[i] - start_s);
      parts.plane.south_km -= f.drift_km_s.north * (instants_s[i] - start_s);
      planes.push_back({std::move(parts.plane), {}, {}});
    }
  }
  take_profiles(profiles.of_energy, f.top_km, layer);
  layer.ln_first = profiles.ln_first, layer.ln_step = profiles.ln_step;
  const double turned = f.shape == FootprintShape::shell ? turned_deg(scene, f, start_s) : 0.0;
  if (f.shape == FootprintShape::shell) {
    layer.turn_deg_s = turned_deg(scene, f, start_s + 1.0) - turned;
    // As MarchRays: the shell turned to the east is seen from a site farther west.
    Site site = scene.site;
    site.longitude_deg -= turned;
    const SiteAxes axes = axes_at(site);
    for (int i = 0; i < 3; ++i) std::copy_n(axes.axis[i], 3, layer.axes[i]);
    take_cubes(std::move(cubes), threads, layer);
  } else {
    layer.drift_km_s = f.drift_km_s;
    set_axes_of_observer(layer);
    if (is_given_elsewhere(scene, drawn)) {
      const SiteTurn home = turn_between(scene.site, *drawn.home, scene.body.radius_km);
      for (int i = 0; i < 3; ++i)
        for (int a = 0; a < 3; ++a) layer.axes[i][a] = home.turn[a][i];
    }
    take_planes(planes, threads, layer);
  }
  take_fall(rule_of_foot<double>(scene, drawn, plain_number, turned), layer);
  return layer;
}

}  // namespace

std::vector<LiveLayer> live_layers(const Scene& scene, const std::vector<double>& instants_s, int threads) {
  std::vector<LiveLayer> layers;
  const bool in_footprints = std::any_of(scene.footprints.begin(), scene.footprints.end(),
                                         [](const auto& f) { return f.source == FootprintSource::sheets; });
  if (!in_footprints)
    for (std::size_t i = 0; i < scene.sheets.size(); ++i)
      layers.push_back(layer_of_sheet(scene, static_cast<int>(i), instants_s, threads));
  const VolumeFiles files = read_volume_files(scene);
  for (const Footprint& f : scene.footprints)
    for (const FootprintLook& look : footprint_looks(scene, f))
      layers.push_back(layer_of_look(scene, f, files, look, instants_s, threads));
  return layers;
}

}  // namespace vegard::sim
