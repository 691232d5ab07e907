// Which way each form turns, seen along the field B, in both hemispheres. B points into the Earth in the
// north and out of it in the south: who looks along it looks down from above there, up from the ground here.
//
// Spirals: J. S. Murphree, L. L. Cogger, R. D. Elphinstone, IEEE Trans. Plasma Sci. 17, 109 (1989), abstract:
// always counter-clockwise viewed in the direction of B in the northern hemisphere. Curls and folds: the
// other way, by E x B about an excess of electrons (docs/physics.md has the derivation and what was read).
#include <gtest/gtest.h>

#include <cmath>

#include "sim/emit/aurora/sheet.h"

namespace vegard::sim::sense_test {
namespace {

struct Turning {
  double seen_along_b_rad = 0.0;  ///< of a short piece of the layer, counter-clockwise
};

/// How far the layer's tangent is turned in the middle of a structure, against the straight sheet.
Turning turning(Scene scene, const LayerStructure& structure, double along_km) {
  const Sheet& sheet = scene.sheets[0];
  const auto number = [](double n, double scale = 1.0) { return n * scale; };
  const SheetShape<double> shape = sheet_shape<double>(scene, 0, 0, 0.0, number);
  const StretchOfSheet stretch = stretch_of(sheet, 0.0);
  const auto foot = [&](double at_km) {
    BeamPlace place;
    place.s = place.s_of_phase = (at_km - stretch.center_km) / sheet.length_km + 0.5;
    place.to = 1.0;
    const BeamFoot<double> on = beam_foot(shape, stretch, place, 0, 1, false, &structure);
    return EastNorth{on.east_km, on.north_km};
  };
  constexpr double h = 1e-4;
  const EastNorth a = foot(along_km - h), b = foot(along_km + h);
  const double east = b.east - a.east, north = b.north - a.north;
  // Against the sheet's own direction, counter-clockwise as seen from above.
  const double from_above = std::atan2(shape.along_east * north - shape.along_north * east,
                                       shape.along_east * east + shape.along_north * north);
  return {scene.field.inclination_deg > 0.0 ? from_above : -from_above};
}

Scene flat_scene(double inclination_deg) {
  Scene scene;
  scene.field.inclination_deg = inclination_deg;
  scene.sheets.resize(1);
  Sheet& sheet = scene.sheets[0];
  sheet.bearing_deg = 70.0;
  sheet.thickness_km = 0.01;
  sheet.layers = 1;
  sheet.length_km = 2000.0;
  return scene;
}

Curl nearest(const Curls& curls, double along_km) {
  Curl found;
  found.center_km = 1e9;
  for (double a = along_km - 300.0; a < along_km + 300.0; a += 1.0)
    curls.near(a, [&](const Curl& curl) {
      if (std::abs(curl.center_km - along_km) < std::abs(found.center_km - along_km)) found = curl;
    });
  return found;
}

TEST(Sense, SpiralsWindCounterClockwiseSeenAlongTheFieldInBothHemispheres) {
  for (const double inclination : {75.0, -75.0}) {
    Scene scene = flat_scene(inclination);
    Sheet& sheet = scene.sheets[0];
    sheet.spiral_spacing_km = 150.0;
    sheet.spiral_turn_rad = 1.2;  // less than half a turn, so that the angle is not ambiguous
    const LayerStructure structure(sheet, 0, 0, 7, 0.0, 0.0);
    const double center = nearest(structure.spirals, 0.0).center_km;
    EXPECT_NEAR(turning(scene, structure, center).seen_along_b_rad, 1.2, 0.01) << inclination;
  }
}

TEST(Sense, CurlsWindClockwiseSeenAlongTheFieldInBothHemispheres) {
  for (const double inclination : {75.0, -75.0}) {
    Scene scene = flat_scene(inclination);
    Sheet& sheet = scene.sheets[0];
    sheet.curl_spacing_km = 8.0;
    sheet.curl_turn_rad = 1.2;
    sheet.curl_gather = 0.0;
    const LayerStructure structure(sheet, 0, 0, 7, 0.0, 0.0);
    const double center = nearest(structure.curls, 0.0).center_km;
    EXPECT_NEAR(turning(scene, structure, center).seen_along_b_rad, -1.2, 0.05) << inclination;
  }
}

TEST(Sense, FoldsTurnClockwiseSeenAlongTheFieldInBothHemispheres) {
  for (const double inclination : {75.0, -75.0}) {
    Scene scene = flat_scene(inclination);
    Sheet& sheet = scene.sheets[0];
    sheet.fold_spacing_km = 30.0;
    sheet.fold_length_km = 20.0;
    sheet.fold_stage = 0.5;
    sheet.fold_stage_spread = 0.0;
    const LayerStructure structure(sheet, 0, 0, 7, 0.0, 0.0);
    double center = 1e9;
    for (double a = 0.0; a < 60.0; a += 0.25) {
      const Fold fold = structure.folds.at(a);
      if (fold.here) {
        center = a - fold.from_center_km;
        break;
      }
    }
    // 155 degrees times 1/2 (3 - 1/2) / 2.
    EXPECT_NEAR(turning(scene, structure, center).seen_along_b_rad, -155.0 * 0.625 * kRadiansPerDegree, 0.05)
        << inclination;
  }
}

}  // namespace
}  // namespace vegard::sim::sense_test
