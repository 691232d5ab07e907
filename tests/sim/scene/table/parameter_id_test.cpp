// One identity for a parameter: from a path and back, in whatever scene, whatever the order of its lines.
#include "sim/scene/table/parameter_id.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <unordered_set>

#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/lines/scene_lines.h"
#include "sim/scene/rows/value_words.h"
#include "sim/scene/table/parameter_table.h"
#include "tests/support/full_scene.h"

namespace vegard::sim::parameter_id_test {
namespace {

using tests::full_scene;

TEST(ParameterId, EveryPathOfEveryRowComesBack) {
  const Scene scene = full_scene();
  std::set<const ParameterRow*> rows;
  std::set<ParameterId> ordered;
  std::unordered_set<ParameterId, ParameterIdHash> hashed;
  const std::vector<ParameterPath> paths = all_paths(scene);
  for (const ParameterPath& path : paths) {
    const std::optional<ParameterId> id = parameter_at(scene, path.text);
    ASSERT_TRUE(id) << path.text;
    EXPECT_EQ(*id, path.id) << path.text;
    EXPECT_EQ(id->row, path.row) << path.text;
    EXPECT_EQ(path_of(scene, *id), path.text);
    EXPECT_EQ(index_in(scene, *id), path.component) << path.text;
    EXPECT_EQ(id->sheet() >= 0, path.row->table == "sheet") << path.text;
    rows.insert(id->row);
    ordered.insert(*id);
    hashed.insert(*id);
  }
  EXPECT_EQ(rows.size(), parameter_table().size()) << "every row has been asked for";
  EXPECT_EQ(ordered.size(), paths.size());
  EXPECT_EQ(hashed.size(), paths.size());
}

TEST(ParameterId, TheNumberItFindsIsTheOneThatTextSets) {
  const Scene before = full_scene();
  std::size_t count = 0;
  for (const ParameterPath& path : all_paths(before)) {
    if (path.row->kind != ParameterKind::real) continue;
    Scene scene = before, by_text = before;
    ASSERT_EQ(number_at(scene, path.id), real_value(scene, path)) << path.text;
    // Lines stand in an order, and angles of the field have a rule.
    if (path.row->table == "emission" || path.row->role == ParameterRole::inclination) continue;
    ++count;
    const double value = path.row->min + 0.4375 * (path.row->max - path.row->min);
    *number_at(scene, path.id) = value;
    set_from_text(by_text, path.text, real_text(value));
    for (const ParameterPath& each : all_paths(before))
      EXPECT_EQ(value_text(scene, each), value_text(by_text, each)) << path.text << ": " << each.text;
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(count, 300u);
}

TEST(ParameterId, OfALineIsTheSameWhereverTheLineStands) {
  Scene scene = full_scene();
  const ParameterId green = parameter_at(scene, "blur.width_deg.5577").value();
  EXPECT_EQ(green.line, line_in_angstrom(557.7));
  EXPECT_EQ(index_in(scene, green), 1);
  const ParameterId knot = parameter_at(scene, "sheet.second.spline_rate.5577_3").value();
  const double rate = *number_at(scene, knot);

  Scene turned = scene;
  change_lines(turned, {557.7, 630.0});
  Sheet& sheet = turned.sheets[1];
  std::rotate(sheet.spline_rate.begin(), sheet.spline_rate.begin() + sheet.spline_knots,
              sheet.spline_rate.begin() + 2 * sheet.spline_knots);
  sheet.spline_rate.resize(2 * sheet.spline_knots);
  EXPECT_EQ(parameter_at(turned, "blur.width_deg.5577"), green);
  EXPECT_EQ(index_in(turned, green), 0);
  EXPECT_EQ(number_at(turned, green), &turned.blur.width_deg[0]);
  EXPECT_EQ(number_at(turned, knot), &sheet.spline_rate[3]);
  EXPECT_EQ(*number_at(turned, knot), rate);
  EXPECT_EQ(path_of(turned, knot), "sheet.second.spline_rate.5577_3");
}

TEST(ParameterId, ASceneWithoutTheNumberHasNone) {
  const Scene scene = full_scene();
  Scene less = scene;
  less.sheets.pop_back();
  change_lines(less, {557.7, 630.0});
  less.footprints[0].north_km.resize(2);
  for (const char* path : {"sheet.second.energy_kev", "blur.width_deg.4278", "footprint.first.north_km.2"}) {
    const ParameterId id = parameter_at(scene, path).value();
    EXPECT_EQ(index_in(less, id), -1) << path;
    EXPECT_EQ(number_at(less, id), nullptr) << path;
  }
  EXPECT_FALSE(ParameterId().any());
  EXPECT_EQ(number_at(less, ParameterId()), nullptr);
  EXPECT_EQ(ParameterId().role(), ParameterRole::none);
}

TEST(ParameterId, APathMayLeaveOutTheOnlyNameButNotAComponent) {
  Scene scene;
  scene.sheets.emplace_back();
  EXPECT_EQ(parameter_at(scene, "sheet.energy_kev"), parameter_with(ParameterRole::energy, 0));
  EXPECT_FALSE(parameter_at(scene, "sheet.main.center_km"));
  EXPECT_FALSE(parameter_at(scene, "sheet.main.nothing"));
}

TEST(ParameterRole, EachIsThatOfOneKey) {
  std::map<ParameterRole, std::set<std::string>> keys;
  for (const ParameterRow& row : parameter_table())
    if (row.role != ParameterRole::none) keys[row.role].insert(row.table + "." + row.key);
  EXPECT_EQ(keys.size() + 1, static_cast<std::size_t>(ParameterRole::roles));
  for (const auto& [role, names] : keys) EXPECT_EQ(names.size(), 1u) << *names.begin();
}

// What the search, the priors and the renderer take the roles for.
TEST(ParameterRole, IsThatOfTheNumberItStandsFor) {
  Scene scene = full_scene();
  const auto at = [&](ParameterRole role, int element = -1, int component = 0) {
    return number_at(scene, parameter_with(role, element, component));
  };
  Sheet& sheet = scene.sheets[1];
  EXPECT_EQ(at(ParameterRole::centre, 1, 0), &sheet.center_km.east);
  EXPECT_EQ(at(ParameterRole::centre, 1, 1), &sheet.center_km.north);
  EXPECT_EQ(at(ParameterRole::bearing, 1), &sheet.bearing_deg);
  EXPECT_EQ(at(ParameterRole::length, 1), &sheet.length_km);
  EXPECT_EQ(at(ParameterRole::amplitude, 1), &sheet.thickness_km);
  EXPECT_EQ(at(ParameterRole::wavelength, 1), &sheet.wavelength_km);
  EXPECT_EQ(at(ParameterRole::phase, 1), &sheet.phase_rad);
  EXPECT_EQ(at(ParameterRole::drift, 1, 1), &sheet.drift_km_s.north);
  EXPECT_EQ(at(ParameterRole::energy, 1), &sheet.energy_kev);
  EXPECT_EQ(at(ParameterRole::energy_spread, 1), &sheet.energy_spread);
  EXPECT_EQ(at(ParameterRole::energy_flux, 1), &sheet.energy_flux_mw_m2);
  EXPECT_EQ(at(ParameterRole::loss_cone, 1), &sheet.loss_cone_deg);
  EXPECT_EQ(at(ParameterRole::pitch_step, 1), &sheet.pitch_step_rad);
  EXPECT_EQ(at(ParameterRole::form_peak, 1), &sheet.peak_km);
  EXPECT_EQ(at(ParameterRole::form_lower, 1), &sheet.lower_km);
  EXPECT_EQ(at(ParameterRole::form_upper, 1), &sheet.upper_km);
  EXPECT_EQ(at(ParameterRole::profile_coefficient, 1, 5), &sheet.spline_rate[5]);
  EXPECT_EQ(at(ParameterRole::inclination), &scene.field.inclination_deg);
  EXPECT_EQ(at(ParameterRole::declination), &scene.field.declination_deg);
  EXPECT_EQ(at(ParameterRole::field_of_view), &scene.camera.hfov_deg);
  EXPECT_EQ(at(ParameterRole::focal_length), &scene.camera.focal_px);
  EXPECT_EQ(at(ParameterRole::blur_width, -1, 2), &scene.blur.width_deg[2]);
  EXPECT_EQ(at(ParameterRole::town_light), &scene.light_pollution.luminance_mcd_m2);
  Footprint& footprint = scene.footprints[1];
  EXPECT_EQ(at(ParameterRole::footprint_centre, 1, 1), &footprint.center_km.north);
  EXPECT_EQ(at(ParameterRole::footprint_east, 1, 2), &footprint.east_km[2]);
  EXPECT_EQ(at(ParameterRole::footprint_north, 1, 2), &footprint.north_km[2]);
  EXPECT_EQ(at(ParameterRole::footprint_energy, 1), &footprint.energy_kev);
  EXPECT_EQ(at(ParameterRole::footprint_energy_flux, 1), &footprint.energy_flux_mw_m2);
  EXPECT_EQ(at(ParameterRole::sun_azimuth), &scene.sun.azimuth_deg);
  EXPECT_EQ(at(ParameterRole::sun_elevation), &scene.sun.elevation_deg);
  EXPECT_EQ(at(ParameterRole::granule_size, 1), &scene.chromospheres[1].scale);
  EXPECT_EQ(at(ParameterRole::granule_shift, 1, 2), &scene.chromospheres[1].shift[2]);
}

}  // namespace
}  // namespace vegard::sim::parameter_id_test
