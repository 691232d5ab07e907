#include "sim/scene/table/parameter_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <variant>

#include "sim/scene/table/parameter_declarations.h"

namespace vegard::sim::same_values_test {
namespace {

/// One element of every repeated table.
Scene scene_of_everything() {
  Scene scene;
  for (const RepeatedTable& repeated : repeated_tables()) repeated.append(scene);
  return scene;
}

struct Another {
  void operator()(double* value) const {
    *value = std::nextafter(*value, std::numeric_limits<double>::infinity());
  }
  void operator()(std::string* value) const { *value += "x"; }
  void operator()(bool* value) const { *value = !*value; }
  void operator()(KindRef value) const { value.set(value.number() + 1); }
  template <class T>
  void operator()(T* value) const {
    *value = static_cast<T>(static_cast<long long>(*value) + 1);
  }
};

TEST(SameValues, SeesTheSmallestChangeOfEveryRow) {
  const Scene scene = scene_of_everything();
  EXPECT_TRUE(same_values(scene, scene));
  int rows = 0;
  for (const Declaration& d : declarations()) {
    for (int c = 0; c < component_count(d, scene, 0); ++c, ++rows) {
      Scene other = scene;
      std::visit(Another(), d.at(other, 0, c));
      EXPECT_FALSE(same_values(scene, other)) << d.table << "." << d.key << " " << c;
      EXPECT_TRUE(same_values(scene, other, {d.table})) << d.table << "." << d.key << " " << c;
    }
  }
  EXPECT_GT(rows, 300);
}

TEST(SameValues, SeesMoreElementsLongerListsAndOtherFiles) {
  const Scene scene = scene_of_everything();
  Scene other = scene;
  other.sheets.push_back(other.sheets[0]);
  EXPECT_FALSE(same_values(scene, other));
  EXPECT_TRUE(same_values(scene, other, {"sheet"}));
  other = scene;
  other.blur.width_deg.push_back(0.0);
  EXPECT_FALSE(same_values(scene, other));
  other = scene;
  other.tables["sensor.response"] = "wavelength_nm";
  EXPECT_FALSE(same_values(scene, other));
  other = scene;
  other.file = "elsewhere/scene.toml";
  EXPECT_FALSE(same_values(scene, other));
}

TEST(SameValues, TellsTheZerosApart) {
  Scene scene, other;
  scene.field.declination_deg = 0.0;
  other.field.declination_deg = -0.0;
  EXPECT_FALSE(same_values(scene, other));
}

}  // namespace
}  // namespace vegard::sim::same_values_test
