// Electrons at a foot against the beams that the renderer lays out, and their derivatives against
// differences.
#include "sim/emit/aurora/foot_electrons.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sim/base/number/constants.h"
#include "sim/emit/aurora/curve_foot.h"
#include "sim/emit/aurora/foot_line.h"
#include "sim/emit/aurora/sheet.h"
#include "sim/emit/aurora/sheet_curve.h"
#include "sim/render/beams/kernel_scene.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim::foot_electrons_test {
namespace {

Scene two_arcs() {
  Scene scene;
  scene.field.declination_deg = 12.0;
  Sheet sheet;
  sheet.center_km = {10.0, 190.0};
  sheet.bearing_deg = 84.0;
  sheet.length_km = 200.0;
  sheet.layers = 2;
  sheet.arcs = 2;
  sheet.arc_spacing_km = 9.0;
  sheet.width_km = 2.0;
  sheet.spacing_jitter = 0.0;
  scene.sheets = {sheet};
  return scene;
}

Scene bent() {
  Scene scene = two_arcs();
  Sheet& sheet = scene.sheets[0];
  sheet.course = SheetCourse::curve;
  sheet.arcs = 1;
  sheet.east_km = {-120.0, -60.0, 10.0, 70.0, 140.0};
  sheet.north_km = {180.0, 205.0, 195.0, 215.0, 190.0};
  sheet.point_brightness = {0.5, 1.0, 0.7, 1.2, 0.4};
  sheet.point_energy_kev = {2.0, 3.0, 5.0, 4.0, 2.5};
  sheet.point_width_km = {2.0, 2.5, 2.0, 1.5, 2.0};
  return scene;
}

double flux_at(const Scene& scene, double east_km, double north_km) {
  double sum = 0.0;
  for (const FootElectrons<double>& one : foot_electrons<double>(scene, east_km, north_km, plain_number))
    sum += one.energy_flux_mw_m2;
  return sum;
}

/// The energy flux through a box, mW m^-2 km^2: of all beams of the scene's sheet that stand in it.
double flux_of_beams(Scene scene, const double low[2], const double high[2]) {
  Sheet& sheet = scene.sheets[0];
  const int beams = 40000;
  sheet.beams = beams;
  double sum = 0.0;
  for (int arc = 0; arc < sheet.arcs; ++arc)
    for (int layer = 0; layer < sheet.layers; ++layer) {
      const LayerPlaces places(sheet, layer_address(0, arc, layer), 7, 0.0);
      const SheetShape<double> shape = shape_of(scene, 0, arc, 0.0, NoSeeds{});
      const CurveLayout layout = is_curve(sheet) ? curve_layout(sheet) : CurveLayout{};
      std::vector<BeamPlace> some(LayerPlaces::kSumEvery);
      for (int first = 0; first < places.size(); first += LayerPlaces::kSumEvery) {
        const int count = std::min(LayerPlaces::kSumEvery, places.size() - first);
        places.fill(first, count, some.data());
        std::optional<SheetCurve<double>> curve;
        if (is_curve(sheet))
          curve.emplace(curve_nodes<double>(sheet, 0.0, [](const double& x) { return x; }), 0,
                        static_cast<int>(sheet.east_km.size()) - 2);
        for (int i = 0; i < count; ++i) {
          const BeamFoot<double> foot =
              curve ? curve_foot(*curve, shape, layout, some[static_cast<std::size_t>(i)]).foot
                    : beam_foot(shape, stretch_of(sheet, 0.0), some[static_cast<std::size_t>(i)], layer,
                                sheet.layers, false);
          if (foot.east_km >= low[0] && foot.east_km < high[0] && foot.north_km >= low[1] &&
              foot.north_km < high[1])
            sum += foot.flux_km2_mw_m2;
        }
      }
    }
  return sum;
}

// Boxes of 8 km on the arc: 40000 beams stand in a layer of 200 km, some 1600 in a box, in van der Corput's
// even order; a curve's flux is that of its length, whichever way it bends, which is left out (2 %).
TEST(FootElectrons, AreThoseOfTheBeams) {
  for (const bool is_curved : {false, true}) {
    const Scene scene = is_curved ? bent() : two_arcs();
    for (const double east : {-62.0, 4.0, 66.0}) {
      const double middle = is_curved ? (east < 0.0    ? 204.5
                                         : east < 50.0 ? 195.5
                                                       : 214.5)
                                      : 190.0 + (east - 10.0) * std::tan(6.0 * kRadiansPerDegree);
      const double low[2] = {east - 4.0, middle - 4.0}, high[2] = {east + 4.0, middle + 4.0};
      constexpr int kCells = 32;
      double sum = 0.0;
      for (int i = 0; i < kCells; ++i)
        for (int k = 0; k < kCells; ++k)
          sum += flux_at(scene, low[0] + (i + 0.5) * 8.0 / kCells, low[1] + (k + 0.5) * 8.0 / kCells) * 64.0 /
                 (kCells * kCells);
      const double beams = flux_of_beams(scene, low, high);
      EXPECT_GT(beams, 50.0);
      EXPECT_NEAR(sum / beams, 1.0, is_curved ? 0.02 : 0.005) << is_curved << " at " << east;
    }
    EXPECT_TRUE(foot_electrons<double>(scene, 0.0, 260.0, plain_number).empty());
    EXPECT_TRUE(foot_electrons<double>(scene, 200.0, 200.0, plain_number).empty()) << "beyond the end";
  }
}

TEST(FootElectrons, HaveExactDerivatives) {
  for (const bool is_curved : {false, true}) {
    Scene scene = is_curved ? bent() : two_arcs();
    const std::vector<std::string> paths =
        is_curved ? std::vector<std::string>{"north_km.2",         "north_km.3",         "east_km.3",
                                             "point_brightness.3", "point_energy_kev.3", "point_width_km.3",
                                             "energy_flux_mw_m2"}
                  : std::vector<std::string>{"center_km.east",    "center_km.north", "bearing_deg",
                                             "thickness_km",      "wavelength_km",   "phase_rad",
                                             "phase_shift_rad",   "width_km",        "energy_kev",
                                             "energy_flux_mw_m2", "arc_spacing_km"};
    std::vector<ParameterId> ids;
    for (const std::string& path : paths) {
      const auto id = parameter_at(scene, "sheet.main." + path);
      ASSERT_TRUE(id) << path;
      ids.push_back(*id);
    }
    const double east = 25.0, north = is_curved ? 199.0 : 189.0;
    const Seeds seeds(scene, ids, 0, ids.size());
    const std::vector<FootElectrons<FreeDual>> dual = foot_electrons<FreeDual>(
        scene, FreeDual(east), FreeDual(north), [&](const double& number) { return seeds(number); });
    ASSERT_EQ(dual.size(), 1u);
    int moved = 0;
    for (std::size_t k = 0; k < ids.size(); ++k) {
      double& number = *number_at(scene, ids[k]);
      const double was = number, step = 1e-5 * std::max(1.0, std::abs(was));
      double flux[2], ln_energy[2];
      for (const int side : {0, 1}) {
        number = was + (side == 0 ? -step : step);
        const auto there = foot_electrons<double>(scene, east, north, plain_number);
        ASSERT_EQ(there.size(), 1u);
        flux[side] = there[0].energy_flux_mw_m2;
        ln_energy[side] = there[0].ln_energy_kev;
      }
      number = was;
      const double by_flux = (flux[1] - flux[0]) / (2.0 * step),
                   by_energy = (ln_energy[1] - ln_energy[0]) / (2.0 * step);
      EXPECT_NEAR(dual[0].energy_flux_mw_m2.d.t[k], by_flux, 1e-4 * (std::abs(by_flux) + 0.01)) << paths[k];
      EXPECT_NEAR(dual[0].ln_energy_kev.d.t[k], by_energy, 1e-4 * (std::abs(by_energy) + 0.01)) << paths[k];
      moved += by_flux != 0.0;
    }
    EXPECT_GT(moved, 5);
  }
}

/// The field line through a point has its foot where a beam through that foot passes the point.
TEST(FootElectrons, ABeamFromTheFootPassesThePoint) {
  for (const FieldModel model : {FieldModel::uniform, FieldModel::dipole}) {
    Scene scene = two_arcs();
    scene.field.model = model;
    scene.site.latitude_deg = 66.0;
    scene.site.longitude_deg = 20.0;
    scene.site.altitude_m = 400.0;
    for (const double altitude : {90.0, 110.0, 150.0}) {
      const PointInSpace point = point_above(scene, 67.3, 21.0, altitude);
      const FootPlace<double> foot = foot_below<double>(scene, point.enu_km, plain_number);
      const FootField field(scene);
      const FallFrame<double> fall =
          field.varies() ? field.at(foot.east_km, foot.north_km)
                         : fall_frame<double>(scene.field.inclination_deg * kRadiansPerDegree,
                                              scene.field.declination_deg * kRadiansPerDegree);
      const Beam<double> beam =
          start_beam(foot.east_km, foot.north_km, fall, 0.4, altitude, 80.0, scene.body.radius_km);
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(beam.start_in_enu_km[i], point.enu_km[i], 1e-6) << altitude;
      const PlaceOnEarth place = place_of_foot(scene, {foot.east_km, foot.north_km});
      if (altitude == 110.0) {
        EXPECT_NEAR(place.latitude_deg, 67.3, 1e-9);
        EXPECT_NEAR(place.longitude_deg, 21.0, 1e-9);
      } else {
        EXPECT_GT(std::abs(place.latitude_deg - 67.3), 0.01);
      }
    }
  }
}

}  // namespace
}  // namespace vegard::sim::foot_electrons_test
