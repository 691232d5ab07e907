#include "sim/light/line_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "sim/light/height_profile.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::line_light_test {
namespace {

// Drawn at the very altitudes of a profile, a parabola is what it is made of: 10000 at its peak, nothing 30
// km from it.
TEST(LinePeak, OfAParabolaIsItsVertexWhereverThatLies) {
  for (const double peak_km : {120.0, 120.03, 120.1, 120.125, 120.2}) {
    std::string table = "altitude_km,557.7\n";
    for (double altitude = 80.0; altitude <= 160.0; altitude += HeightProfile::kStepKm) {
      const double off = (altitude - peak_km) / 30.0;
      table += std::to_string(altitude) + "," +
               std::to_string(off * off < 1.0 ? 1e4 * (1.0 - off * off) : 0.0) + "\n";
    }
    Sheet sheet;
    sheet.profile = ProfileKind::file;
    sheet.profile_file = "parabola.csv";
    Scene scene = tests::with_sheet(sheet);
    scene.tables["sheet.main.profile_file"] = table;
    const LineLight light = line_light(557.7, scene, 0);
    EXPECT_FALSE(light.peak_at_an_end);
    // Floats of 10000 are 5e-4 from the truth at most; the parabola bends by 1.4 from row to row.
    EXPECT_NEAR(light.peak_km, peak_km, 5e-4);
    EXPECT_NEAR(light.half_below_km, 30.0 * std::sqrt(0.5), 0.01);
    EXPECT_NEAR(light.half_above_km, 30.0 * std::sqrt(0.5), 0.01);
  }
}

}  // namespace
}  // namespace vegard::sim::line_light_test
