#include "sim/render/beams/sheet_nodes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sim/base/number/constants.h"
#include "sim/emit/aurora/beam.h"
#include "sim/emit/aurora/dipole.h"
#include "sim/emit/aurora/foot_line.h"
#include "sim/emit/aurora/motion.h"
#include "sim/emit/aurora/sheet_curve.h"
#include "sim/light/height_profile.h"

namespace vegard::sim {
namespace {

constexpr double kAlongCells = 0.5, kAlongWideCells = 0.2, kAlongPerSmoothing = 0.5;  // from beam to beam
// From node to node in the lower part of a path. Of a lattice of nodes with the distance d a Gaussian of the
// standard deviation d / 2 leaves exp(-pi^2 / 2), 0.7 %, and many beams with nodes at other places a tenth of
// it.
constexpr double kDownPerBlur = 2.0, kLeastDownCells = 1.0;
// A standard deviation of the width, in what is seen of a node, up to which 1, 2, ... nodes across will do.
constexpr double kWidthOfGauss[kMostGaussAcross] = {0.15, 1.0, 1.5, 2.0};
constexpr int kAcrossTrapezium = 6;
constexpr double kNarrowTube = 1.0;
constexpr double kMoreBeams = 3.0;  // where more is drawn than the place in a narrow cross-section
constexpr double kHat = 0.41;       // standard deviation of a hat, in cells
constexpr double kFurthestNodesKm = 4.0;
constexpr double kFurthestBeamsKm = 8.0;
constexpr int kLeastBeams = 64, kMostBeams = 1000000;
constexpr double kStretchKm = 100.0;  // above the bottom nodes stand twice as far apart, and so on upwards
constexpr double kNearKm = 100.0;     // of a sheet that is not in view
constexpr int kPlaces = 129;
constexpr double kLowKm = 105.0, kHighKm = 125.0;  // where most light is

/// Where a camera sees a point of the field line through a foot.
struct Sight {
  double x = 0.0, y = 0.0;
  bool seen = false;
};

class Sights {
 public:
  Sights(const Scene& scene, const FilmGeometry& film)
      : scene_(scene), film_(film), view_(camera_view(scene.camera)) {
    own_field_ = scene.field.model == FieldModel::dipole;
    if (own_field_)
      axis_ = dipole_axis(scene.field, scene.site);
    else
      fall_ = fall_frame(scene.field.inclination_deg * kRadiansPerDegree,
                         scene.field.declination_deg * kRadiansPerDegree);
  }

  Sight at(const EastNorth& foot, double altitude_km) const {
    Sight sight;
    const double up = scene_.site.altitude_m * 1e-3;
    if (foot.east * foot.east + foot.north * foot.north > kEarthRadiusKm * kEarthRadiusKm) return sight;
    const FallFrame<double> fall = own_field_ ? dipole_fall_frame(axis_, foot.east, foot.north) : fall_;
    const Beam<double> beam =
        start_beam(foot.east, foot.north, fall, up, altitude_km, HeightProfile::kBottomKm);
    if (!(beam.vertical > 0.0)) return sight;
    sight.seen = pixel_of_enu(view_, beam.start_in_enu_km, sight.x, sight.y) && beam.start_in_enu_km[2] > 0.0;
    const double margin_x = 0.1 * film_.columns * film_.cell_width_px;
    const double margin_y = 0.1 * film_.rows * film_.cell_height_px;
    sight.seen = sight.seen && sight.x > film_.x0_px - margin_x && sight.y > film_.y0_px - margin_y &&
                 sight.x < film_.x0_px + film_.columns * film_.cell_width_px + margin_x &&
                 sight.y < film_.y0_px + film_.rows * film_.cell_height_px + margin_y;
    return sight;
  }

 private:
  const Scene& scene_;
  const FilmGeometry& film_;
  CameraView<double> view_;
  bool own_field_ = false;
  DipoleAxis axis_{};
  FallFrame<double> fall_{};
};

/// Pixels per kilometre along a sheet and along its field lines, where they are most; and across it, by
/// columns and rows.
struct Scale {
  double along_px_km = 0.0, down_px_km = 0.0, across_columns_px_km = 0.0, across_rows_px_km = 0.0;
};

Scale scale_of(const Scene& scene, const Sheet& sheet, const Sights& sights) {
  Scale scale;
  for (const double instant : instants_s(scene.time)) {
    for (int arc = 0; arc < sheet.arcs; ++arc) {
      const std::vector<EastNorth> feet = is_curve(sheet) ? curve_feet(sheet, instant, kPlaces)
                                                          : sine_feet(scene, sheet, instant, arc, kPlaces);
      const double step_km = line_length_km(sheet) / (kPlaces - 1);
      Sight before;
      EastNorth foot_before;
      for (const EastNorth& foot : feet) {
        const Sight low = sights.at(foot, kLowKm), high = sights.at(foot, kHighKm);
        const double east = foot.east - foot_before.east, north = foot.north - foot_before.north;
        const double way_km = std::hypot(east, north);
        foot_before = foot;
        if (low.seen && before.seen && way_km > 0.0) {
          const Sight beside = sights.at({foot.east - north / way_km, foot.north + east / way_km}, kLowKm);
          if (beside.seen) {
            scale.across_columns_px_km = std::max(scale.across_columns_px_km, std::abs(beside.x - low.x));
            scale.across_rows_px_km = std::max(scale.across_rows_px_km, std::abs(beside.y - low.y));
          }
        }
        if (low.seen && before.seen)
          scale.along_px_km =
              std::max(scale.along_px_km, std::hypot(low.x - before.x, low.y - before.y) / step_km);
        if (low.seen && high.seen)
          scale.down_px_km =
              std::max(scale.down_px_km, std::hypot(high.x - low.x, high.y - low.y) / (kHighKm - kLowKm));
        before = low;
      }
    }
  }
  const double near_px_km = pixels_per_degree(scene.camera) / (kNearKm * kRadiansPerDegree);
  if (scale.along_px_km == 0.0) scale.along_px_km = near_px_km;
  if (scale.down_px_km == 0.0) scale.down_px_km = near_px_km;
  if (scale.across_columns_px_km == 0.0) scale.across_columns_px_km = near_px_km;
  if (scale.across_rows_px_km == 0.0) scale.across_rows_px_km = near_px_km;
  return scale;
}

/// The distance at which beams along a sheet still tell its course.
double structure_km(const Sheet& sheet) {
  if (is_curve(sheet) || sheet.thickness_km == 0.0) return kFurthestBeamsKm;
  return std::min(kFurthestBeamsKm, sheet.wavelength_km / 16.0);
}

/// Not less than the standard deviation to either side at the lower end of a path (MeanPath in
/// sim/emit/aurora/fall-inl.h).
double tube_km(const Sheet& sheet) {
  const double cone = sheet.loss_cone_deg * kRadiansPerDegree, growth = std::abs(sheet.pitch_step_rad);
  const double pitch = sheet.pitch_law == PitchLaw::product     ? cone * growth
                       : sheet.pitch_law == PitchLaw::increment ? growth
                       : sheet.pitch_law == PitchLaw::constant  ? cone
                                                                : std::max(cone, std::abs(cone - growth));
  return (sheet.top_km - HeightProfile::kBottomKm) * pitch * std::sqrt(sheet.path_step / 3.0);
}

double widest_km(const Sheet& sheet) {
  return sheet.point_width_km.empty()
             ? sheet.width_km
             : *std::max_element(sheet.point_width_km.begin(), sheet.point_width_km.end());
}

}  // namespace

bool has_expected_picture(const Scene& scene) {
  return std::all_of(scene.sheets.begin(), scene.sheets.end(), [](const Sheet& sheet) {
    return sheet.fold_spacing_km == 0.0 && sheet.curl_spacing_km == 0.0 && sheet.border_amplitude_km == 0.0;
  });
}

std::vector<SheetNodes> sheet_nodes(const Scene& scene, const FilmGeometry& film, double smooth_px,
                                    double fineness) {
  const Sights sights(scene, film);
  double blur_px = 1e9;
  for (std::size_t l = 0; l < scene.emission.lines.size(); ++l)
    blur_px = std::min(blur_px, scene.blur.width_deg[l] * pixels_per_degree(scene.camera));
  // What is seen of a node: a hat of cells, the blur and the smoothing.
  const double rows_px = std::hypot(kHat * film.cell_height_px, blur_px, smooth_px);
  const double down_px =
      std::max(kLeastDownCells * film.cell_height_px, kDownPerBlur * std::hypot(blur_px, smooth_px));
  const double along_px = (film.ramp_px > 0.0 ? kAlongWideCells : kAlongCells) * film.cell_width_px +
                          kAlongPerSmoothing * std::min(smooth_px, 0.5 * film.cell_width_px);
  std::vector<SheetNodes> all;
  for (const Sheet& sheet : scene.sheets) {
    const Scale scale = scale_of(scene, sheet, sights);
    const double seen_across =  // of a kilometre across, in what is seen of a node
        fineness *
        std::hypot(scale.across_rows_px_km / rows_px, scale.across_columns_px_km / film.cell_width_px);
    const double width = widest_km(sheet) * seen_across;
    SheetNodes nodes;
    nodes.across = kAcrossTrapezium;
    for (int count = kMostGaussAcross; count > 0; --count)
      if (width < kWidthOfGauss[count - 1]) nodes.across = count;
    nodes.wide_tube = tube_km(sheet) * seen_across > kNarrowTube;
    const bool much_is_drawn = nodes.wide_tube || nodes.across == kAcrossTrapezium ||
                               sheet.ray_length_contrast > 0.0 || sheet.spacing_rule == SpacingRule::literal;
    const double along_km = std::min(along_px / scale.along_px_km, structure_km(sheet)) / fineness /
                            (much_is_drawn ? kMoreBeams : 1.0);
    nodes.beams =
        static_cast<int>(std::clamp(std::ceil(line_length_km(sheet) / along_km),
                                    static_cast<double>(kLeastBeams), static_cast<double>(kMostBeams)));
    const double down_km = std::min(down_px / scale.down_px_km, kFurthestNodesKm) / fineness;
    nodes.path.offset = kStretchKm / (sheet.top_km - HeightProfile::kBottomKm);
    nodes.path.shrink = std::exp(-down_km / kStretchKm);
    nodes.path.spread = sheet.path_spread;
    all.push_back(nodes);
  }
  return all;
}

}  // namespace vegard::sim
