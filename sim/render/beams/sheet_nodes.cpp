#include "sim/render/beams/sheet_nodes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

#include "sim/base/number/constants.h"
#include "sim/emit/aurora/beam.h"
#include "sim/emit/aurora/foot_field.h"
#include "sim/emit/aurora/foot_line.h"
#include "sim/emit/aurora/motion.h"
#include "sim/emit/aurora/sheet_curve.h"
#include "sim/light/height_profile.h"

namespace vegard::sim {
namespace {

// The distances from beam to beam. A ramp is the integral of a parabola. With beams at this distance, in
// shares of the parabola's width, the light of a column has a ripple of at most 3 / (pi / 0.53)^2, a tenth;
// the beams of other layers and altitudes reduce it to a tenth of that.
constexpr double kAlongCells = 0.5, kAlongPerRamp = 0.53, kAlongPerSmoothing = 0.25;
// The distance from node to node in the lower part of a path. A Gaussian of the standard deviation d / 2 over
// a lattice of nodes at the distance d has a ripple of exp(-pi^2 / 2), 0.7 %; many beams with nodes at other
// places reduce it to a tenth of that.
constexpr double kDownPerBlur = 2.0, kMinDownCells = 1.0;
// Up to which standard deviation of the width, in what is seen of a node, how many of Gauss's nodes will do.
// One alone would not feel the width.
struct NodesAcross {
  double width;
  int nodes;
};
constexpr NodesAcross kAcross[] = {{1.0, 2}, {2.0, 4}, {3.0, 6}, {5.0, 10}};
constexpr int kMaxAcross = 14;
constexpr double kMoreBeams = 3.0;  // where more is drawn than the place in a path
constexpr double kHat = 0.41;       // standard deviation of a hat, in cells
constexpr double kFurthestNodesKm = 4.0;
constexpr double kFurthestBeamsKm = 8.0;
constexpr double kMinBeams = 64.0, kMaxBeams = 1e6;
constexpr double kStretchKm = 100.0;    // above the bottom nodes stand twice as far apart, and so on upwards
constexpr double kNearKm = 100.0;       // of a sheet that is not in view
constexpr int kParts = 96;              // of a line
constexpr double kMaxMoreBeams = 16.0;  // than are said
constexpr double kOutOfView = 0.25;     // of the beams where they stand most densely
constexpr double kLowKm = 105.0, kHighKm = 125.0;  // where most light is

/// The place on a picture at which a camera sees a point of the field line through a foot.
struct Sight {
  double x = 0.0, y = 0.0;
  bool seen = false;
};

class Sights {
 public:
  Sights(const Scene& scene, const FilmGeometry& film)
      : scene_(scene), film_(film), view_(camera_view(scene.camera)), field_(scene) {
    if (!field_.varies())
      fall_ = fall_frame(scene.field.inclination_deg * kRadiansPerDegree,
                         scene.field.declination_deg * kRadiansPerDegree);
  }

  Sight at(const EastNorth& foot, double altitude_km) const {
    Sight sight;
    const double up = scene_.site.altitude_m * 1e-3, sphere_km = scene_.body.radius_km;
    if (foot.east * foot.east + foot.north * foot.north > sphere_km * sphere_km) return sight;
    const FallFrame<double> fall = field_.varies() ? field_.at(foot.east, foot.north) : fall_;
    const Beam<double> beam =
        start_beam(foot.east, foot.north, fall, up, altitude_km, HeightProfile::kBottomKm, sphere_km);
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
  FootField field_;
  FallFrame<double> fall_{};
};

/// Pixels per kilometre along a sheet and along its field lines, where they are most; and across it, by
/// columns and rows.
struct Scale {
  std::vector<double> along_px_km = std::vector<double>(kParts, 0.0);  ///< by part of the line
  double down_px_km = 0.0, across_columns_px_km = 0.0, across_rows_px_km = 0.0;
};

Scale scale_of(const Scene& scene, const Sheet& sheet, const Sights& sights) {
  Scale scale;
  for (const double instant : instants_s(scene.time)) {
    for (int arc = 0; arc < sheet.arcs; ++arc) {
      const std::vector<EastNorth> feet = is_curve(sheet) ? curve_feet(sheet, instant, kParts + 1)
                                                          : sine_feet(scene, sheet, instant, arc, kParts + 1);
      const double step_km = line_length_km(sheet) / kParts;
      for (int k = 0; k < kParts; ++k) {
        const EastNorth &foot = feet[k], &next = feet[k + 1];
        const Sight low = sights.at(foot, kLowKm), high = sights.at(foot, kHighKm),
                    on = sights.at(next, kLowKm);
        if (low.seen && high.seen)
          scale.down_px_km =
              std::max(scale.down_px_km, std::hypot(high.x - low.x, high.y - low.y) / (kHighKm - kLowKm));
        const double east = next.east - foot.east, north = next.north - foot.north;
        const double way_km = std::hypot(east, north);
        if (!low.seen || !on.seen || way_km == 0.0) continue;
        scale.along_px_km[k] =
            std::max(scale.along_px_km[k], std::hypot(on.x - low.x, on.y - low.y) / step_km);
        const Sight beside = sights.at({foot.east - north / way_km, foot.north + east / way_km}, kLowKm);
        if (!beside.seen) continue;
        scale.across_columns_px_km = std::max(scale.across_columns_px_km, std::abs(beside.x - low.x));
        scale.across_rows_px_km = std::max(scale.across_rows_px_km, std::abs(beside.y - low.y));
      }
    }
  }
  const double near_px_km = pixels_per_degree(scene.camera) / (kNearKm * kRadiansPerDegree);
  const double most = *std::max_element(scale.along_px_km.begin(), scale.along_px_km.end());
  for (double& along : scale.along_px_km)
    along = most > 0.0 ? std::max(along, kOutOfView * most) : near_px_km;
  if (scale.down_px_km == 0.0) scale.down_px_km = near_px_km;
  if (scale.across_columns_px_km == 0.0) scale.across_columns_px_km = near_px_km;
  if (scale.across_rows_px_km == 0.0) scale.across_rows_px_km = near_px_km;
  return scale;
}

/// The distance at which beams along a sheet still resolve its course.
double structure_km(const Sheet& sheet) {
  if (is_curve(sheet) || sheet.thickness_km == 0.0) return kFurthestBeamsKm;
  return std::min(kFurthestBeamsKm, sheet.wavelength_km / 16.0);
}

/// Square pixels that a square kilometre of a sheet takes in the picture, where it takes most; 0 out of view.
double px2_per_km2(const Scene& scene, const Sheet& sheet, const Sights& sights) {
  const double step_km = line_length_km(sheet) / kParts;
  double most = 0.0;
  for (const double instant : instants_s(scene.time)) {
    for (int arc = 0; arc < sheet.arcs; ++arc) {
      const std::vector<EastNorth> feet = is_curve(sheet) ? curve_feet(sheet, instant, kParts + 1)
                                                          : sine_feet(scene, sheet, instant, arc, kParts + 1);
      for (int k = 0; k < kParts; ++k) {
        const Sight low = sights.at(feet[k], kLowKm), high = sights.at(feet[k], kHighKm),
                    on = sights.at(feet[k + 1], kLowKm);
        if (!low.seen || !high.seen || !on.seen) continue;
        const double area = (on.x - low.x) * (high.y - low.y) - (on.y - low.y) * (high.x - low.x);
        most = std::max(most, std::abs(area) / (step_km * (kHighKm - kLowKm)));
      }
    }
  }
  return most;
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
    return sheet.fold_spacing_km == 0.0 && sheet.curl_spacing_km == 0.0 && sheet.spiral_spacing_km == 0.0 &&
           sheet.border_amplitude_km == 0.0;
  });
}

Scene with_enough_beams(const Scene& scene, const FilmGeometry& film) {
  Scene enough = scene;
  const Sights sights(scene, film);
  for (Sheet& sheet : enough.sheets) {
    if (sheet.points_per_px <= 0.0) continue;
    const double points_per_km = 2.0 / path_step_of(sheet) / (sheet.top_km - HeightProfile::kBottomKm);
    const double beams =
        sheet.points_per_px * px2_per_km2(scene, sheet, sights) / points_per_km * line_length_km(sheet);
    const int said = beams_per_layer(sheet);
    const double most = std::min(kMaxMoreBeams * said, static_cast<double>(kSheetMaxBeams));
    // In steps of the square root of 2: with every other number all beams stand
    // elsewhere, and if it followed a moving sheet or camera, grain would
    // flicker from one picture to the next.
    const double steps = std::max(0.0, std::ceil(2.0 * std::log2(beams / said)));
    sheet.beams = static_cast<int>(std::min(std::ceil(said * std::exp2(0.5 * steps)), most));
    sheet.beams_per_km = 0.0;
  }
  return enough;
}

std::vector<SheetNodes> sheet_nodes(const Scene& scene, const FilmGeometry& film, double smooth_px,
                                    double fineness) {
  const Sights sights(scene, film);
  double blur_px = 1e9;
  for (std::size_t l = 0; l < scene.emission.lines.size(); ++l)
    blur_px = std::min(blur_px, scene.blur.width_deg[l] * pixels_per_degree(scene.camera));
  // A node is seen as a triangle function over cells, with the blur and the smoothing.
  const double rows_px = std::hypot(kHat * film.cell_height_px, blur_px, smooth_px);
  const double down_px =
      std::max(kMinDownCells * film.cell_height_px, kDownPerBlur * std::hypot(blur_px, smooth_px));
  const double along_px = film.ramp_px > 0.0
                              ? kAlongPerRamp * film.ramp_px
                              : kAlongCells * film.cell_width_px +
                                    kAlongPerSmoothing * std::min(smooth_px, 0.5 * film.cell_width_px);
  std::vector<SheetNodes> all;
  for (const Sheet& sheet : scene.sheets) {
    const Scale scale = scale_of(scene, sheet, sights);
    const double seen_across =  // of a kilometre across, in what is seen of a node
        fineness *
        std::hypot(scale.across_rows_px_km / rows_px, scale.across_columns_px_km / film.cell_width_px);
    const double width = std::hypot(widest_km(sheet), tube_km(sheet)) * seen_across;
    SheetNodes nodes;
    nodes.across = kMaxAcross;
    for (auto most = std::rbegin(kAcross); most != std::rend(kAcross); ++most)
      if (width < most->width) nodes.across = most->nodes;
    const bool much_is_drawn = sheet.ray_length_contrast > 0.0 || sheet.spacing_rule == SpacingRule::literal;
    const double part_km = line_length_km(sheet) / kParts;
    for (const double along_px_km : scale.along_px_km) {
      const double along_km = std::min(along_px / along_px_km, structure_km(sheet)) / fineness /
                              (much_is_drawn ? kMoreBeams : 1.0);
      nodes.beams.push_back(std::clamp(part_km / along_km, kMinBeams / kParts, kMaxBeams / kParts));
    }
    const double down_km = std::min(down_px / scale.down_px_km, kFurthestNodesKm) / fineness;
    nodes.path.offset = kStretchKm / (sheet.top_km - HeightProfile::kBottomKm);
    nodes.path.shrink = std::exp(-down_km / kStretchKm);
    nodes.path.spread = sheet.path_spread;
    all.push_back(nodes);
  }
  return all;
}

}  // namespace vegard::sim
