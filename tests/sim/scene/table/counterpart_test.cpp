// Whatever number of a scene is free, its like is found in a copy of the scene.
#include "sim/scene/table/counterpart.h"

#include <gtest/gtest.h>

#include "sim/scene/table/parameter_table.h"

namespace {

using namespace vegard;

/// With two of every repeated table, and every list filled.
sim::Scene full_scene() {
  sim::Scene scene;
  for (const char* name : {"first", "second"}) {
    sim::Sheet sheet;
    sheet.name = name;
    sheet.spline_rate.assign(scene.emission.lines.size() * sheet.spline_knots, 1.0);
    scene.sheets.push_back(sheet);
    sim::Footprint footprint;
    footprint.name = name;
    footprint.east_km = footprint.north_km = footprint.latitude_deg = footprint.longitude_deg =
        footprint.point_energy = footprint.point_flux = {1.0, 2.0, 3.0};
    scene.footprints.push_back(footprint);
    sim::Nebula nebula;
    nebula.name = name;
    nebula.inner_rayleigh = nebula.outer_rayleigh = nebula.glow_rayleigh = {1.0, 2.0, 3.0};
    scene.nebulae.push_back(nebula);
    sim::Node node;
    node.name = name;
    scene.nodes.push_back(node);
    sim::Volume volume;
    volume.name = name;
    scene.volumes.push_back(volume);
  }
  return scene;
}

TEST(Counterpart, EveryRealNumberIsFoundInACopy) {
  const sim::Scene from = full_scene();
  sim::Scene copy = from;
  std::vector<const double*> addresses, expected;
  std::vector<std::string> names;
  for (const sim::ParameterPath& path : sim::all_paths(from)) {
    if (path.row->kind != sim::ParameterKind::real) continue;
    addresses.push_back(sim::real_value(from, path));
    expected.push_back(sim::real_value(copy, path));
    names.push_back(path.text);
  }
  ASSERT_GT(addresses.size(), 300u);
  const std::vector<const double*> found = sim::counterparts(from, addresses, copy);
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i], expected[i]) << names[i];
    EXPECT_NE(found[i], addresses[i]) << names[i];
  }
  EXPECT_EQ(sim::counterpart(from, addresses.back(), copy), expected.back());
}

TEST(Counterpart, OfOneNumberAskedForTwiceBothAreTheSame) {
  const sim::Scene from = full_scene();
  const sim::Scene copy = from;
  const double* number = &from.footprints[1].north_km[2];
  const auto found = sim::counterparts(from, {number, number}, copy);
  EXPECT_EQ(found[0], &copy.footprints[1].north_km[2]);
  EXPECT_EQ(found[1], found[0]);
}

TEST(Counterpart, WhatIsNoParameterHasNone) {
  const sim::Scene from = full_scene();
  sim::Scene copy = from;
  const double elsewhere = 1.0;
  EXPECT_EQ(sim::counterpart(from, &elsewhere, copy), nullptr);
}

}  // namespace
