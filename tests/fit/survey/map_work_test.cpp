// What a survey keeps of a map, of a made picture whose precipitation is known.
#include "fit/survey/survey_frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <string>

#include "fit/map/map_fit.h"
#include "fit/photo/photo.h"
#include "sim/scene/file/scene_toml.h"
#include "tests/support/two_stations.h"

namespace vegard::fit::map_work_test {
namespace {

const char* const kCamera =
    "[site]\nlatitude_deg = 67.0\n[field]\ninclination_deg = 78.0\n[camera]\nwidth = 120\nheight = 80\n"
    "hfov_deg = 66\nelevation_deg = 33\n[emission]\nflux_law = \"linear\"\n[sensor]\n"
    "gain_per_kilorayleigh = 0.01\n[sky]\nlevel = [0.003, 0.006, 0.008]\n";

/// A straight band of 12 mW m^-2 in the middle of 3 km (standard deviation) across, 190 km to the north,
/// through all of the picture.
Photo photo_of_band() {
  return tests::photo_of(
      sim::parse_scene(std::string(kCamera) +
                           "[[footprint]]\nname = \"band\"\nsource = \"spline\"\ncenter_km = [0, 190]\n"
                           "size_km = [600, 60]\ncell_km = 1.0\nwidth_km = 3.0\nenergy_kev = 4.0\n"
                           "energy_flux_mw_m2 = 12.0\neast_km = [-290, -100, 100, 290]\n"
                           "north_km = [0, 0, 0, 0]\n",
                       "scene"),
      0.0015, 5);
}

MapOptions quick() {
  MapOptions options;
  options.replicates = 3;
  options.sparsity = 4.0;
  options.threads = 1;
  return options;
}

const SurveyQuantity* find(const WorkAnswer& answer, int item, const std::string& name) {
  const auto found = std::find_if(answer.quantities.begin(), answer.quantities.end(),
                                  [&](const auto& q) { return q.item == item && q.name == name; });
  return found == answer.quantities.end() ? nullptr : &*found;
}

TEST(MapWork, TellsWhereEnergyComesDownAndHowMuch) {
  const sim::Scene scene = sim::parse_scene(kCamera, "scene");
  const std::optional<WorkAnswer> answer = map_answer(photo_of_band(), scene, quick());
  ASSERT_TRUE(answer);
  const auto value = [&](int item, const char* name) {
    const SurveyQuantity* found = find(*answer, item, name);
    return found != nullptr && found->value ? *found->value : std::nan("");
  };
  EXPECT_GE(value(0, "curtains"), 1.0);
  // The tolerances are those of MapFit, whose map this is: 2 % of the distance, 15 % of the energy.
  EXPECT_NEAR(value(1, "distance of the nearest point"), 190.0, 4.0);
  EXPECT_NEAR(value(0, "mean characteristic energy E0"), 4.0, 0.6);
  // The foot 190 km to the north stands asin(190 / 6481) = 1.68 degrees from the site.
  EXPECT_NEAR(value(1, "latitude of the nearest point"), 68.68, 0.05);
  // 12 mW m^-2 times sqrt(2 pi) 3 km times the 247 km that 66 degrees see at 190 km: 22 MW, if the gain were
  // known; the picture's edges show more, since light high up is farther away. A factor of 1.5 either way.
  EXPECT_GT(value(0, "power"), 22.0 / 1.5);
  EXPECT_LT(value(0, "power"), 22.0 * 1.5);
  for (const char* name : {"power", "mean characteristic energy E0"}) {
    ASSERT_NE(find(*answer, 0, name), nullptr);
    EXPECT_GT(find(*answer, 0, name)->sigma.value_or(0.0), 0.0) << name;
    EXPECT_TRUE(find(*answer, 0, name)->trust) << name;
  }
  ASSERT_TRUE(answer->words);
  EXPECT_NE(answer->words->find("distance of the curtains"), std::string::npos) << *answer->words;
}

TEST(MapWork, IsGivenUpWhenStopped) {
  const std::atomic<bool> stop{true};
  MapOptions options = quick();
  options.stop = &stop;
  EXPECT_FALSE(map_answer(photo_of_band(), sim::parse_scene(kCamera, "scene"), options));
}

}  // namespace
}  // namespace vegard::fit::map_work_test
