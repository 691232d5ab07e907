// The physical blur for every lens, footprints and fits: against the blur beam by beam, against sums that
// are known, and its derivatives against differences.
#include "sim/render/slab_exposer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sim/base/number/constants.h"
#include "sim/render/physical_blur.h"
#include "sim/render/picture_model.h"
#include "sim/render/render.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/table/parameter_table.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::slab_exposer_test {
namespace {

/// Red light up to 400 km over a third of the picture's width, so that little of it is lost at the border.
Scene red_scene(BlurModel model) {
  Scene scene = tests::small_scene();
  scene.emission.tables = "glow";
  scene.emission.lag = EmissionLag::none;
  scene.blur.model = model;
  scene.blur.width_deg = {0.0, 0.0, 0.0};
  scene.camera.hfov_deg = 90.0;
  scene.camera.elevation_deg = 45.0;
  scene.camera.roll_deg = 0.0;
  Sheet& sheet = scene.sheets[0];
  sheet.center_km = {0.0, 250.0};
  sheet.length_km = 60.0;
  sheet.energy_kev = 0.6;
  sheet.top_km = 400.0;
  sheet.beams = 1500;
  return scene;
}

double total(const Image& image, int channel) {
  double sum = 0.0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) sum += image.at(x, y, channel);
  return sum;
}

/// Mean column of a row's light and its RMS distance from that, in pixels.
struct RowLight {
  double middle_px = 0.0, width_px = 0.0, light = 0.0;
};
RowLight row_light(const Image& image, int row, int channel) {
  double light = 0.0, moment = 0.0, square = 0.0;
  for (int x = 0; x < image.width; ++x) {
    const double value = image.at(x, row, channel);
    light += value;
    moment += value * (x + 0.5);
    square += value * (x + 0.5) * (x + 0.5);
  }
  const double middle = moment / light;
  return {middle, std::sqrt(square / light - middle * middle), light};
}

Image by_slabs(const Scene& scene) {
  const FilmGeometry film = film_for(scene, 0, 0, scene.camera.width, scene.camera.height, 1.0, 1.0);
  Exposure exposure;
  make_exposer(scene, film, 0)->expose(scene, exposure);
  return rayleigh_image(scene, exposure);
}

// Two shapes of one variance: slabs by altitude where beams have a spread for each point.
TEST(SlabExposer, AgreesWithTheBeamByBeamBlur) {
  for (const EastNorth& wind : {EastNorth{0.0, 0.0}, {150.0, -80.0}}) {
    Scene scene = red_scene(BlurModel::physical);
    scene.blur.wind_m_s = wind;
    ASSERT_TRUE(is_spread_by_beams(scene));
    const Image beams = render(scene).rayleigh, slabs = by_slabs(scene);
    for (int l = 0; l < 3; ++l) EXPECT_NEAR(total(slabs, l) / total(beams, l), 1.0, 4e-3) << l;
    for (int row = 20; row < 90; row += 10)
      for (int l = 0; l < 2; ++l) {
        const RowLight one = row_light(beams, row, l), other = row_light(slabs, row, l);
        if (one.light < 0.05 * total(beams, l) / beams.height) continue;
        EXPECT_NEAR(other.light / one.light, 1.0, 0.02) << row << " " << l;
        EXPECT_NEAR(other.middle_px, one.middle_px, 0.15) << row << " " << l;
        EXPECT_NEAR(other.width_px / one.width_px, 1.0, 0.02) << row << " " << l;
      }
    // Prompt light is none of its business; films of unlike margins round places otherwise.
    for (int y = 0; y < beams.height; ++y)
      for (int x = 0; x < beams.width; ++x)
        ASSERT_NEAR(slabs.at(x, y, 2), beams.at(x, y, 2), 1e-3 * beams.at(x, y, 2) + 0.1);
  }
}

TEST(SlabExposer, KnowsShiftedAndMirroredPinholes) {
  const Scene plain = red_scene(BlurModel::physical);
  const Image straight = by_slabs(plain);
  Scene shifted = plain;
  shifted.camera.principal_x_px = 8.0;
  ASSERT_FALSE(is_spread_by_beams(shifted));
  const Image moved = render(shifted).rayleigh;
  Scene turned = plain;
  turned.camera.mirrored = true;
  const Image mirrored = render(turned).rayleigh;
  const float brightest = *std::max_element(straight.data.begin(), straight.data.end());
  for (int y = 0; y < 120; ++y)
    for (int x = 20; x < 140; ++x)
      for (int l = 0; l < 3; ++l) {
        // Slabs and ladders are those of either picture, whose nearest corners differ.
        ASSERT_NEAR(moved.at(x + 8, y, l), straight.at(x, y, l), 0.02 * brightest)
            << x << " " << y << " " << l;
        ASSERT_NEAR(mirrored.at(159 - x, y, l), straight.at(x, y, l), 0.01 * brightest)
            << x << " " << y << " " << l;
      }
}

TEST(SlabExposer, KeepsTheLightOfAFisheyeAndWidensItUpwards) {
  Scene scene = red_scene(BlurModel::angle);
  scene.camera.model = LensModel::equidistant;
  scene.camera.width = scene.camera.height = 160;
  scene.camera.focal_px = 50.0;
  scene.camera.elevation_deg = 90.0;
  scene.sheets[0].center_km = {0.0, 120.0};
  scene.sheets[0].length_km = 10.0;
  const Image sharp = render(scene).rayleigh;
  scene.blur.model = BlurModel::physical;
  const Image spread = render(scene).rayleigh;
  // Pixels of such a lens are of unlike size, and what is counted is brightness.
  for (int l = 0; l < 3; ++l) EXPECT_NEAR(total(spread, l) / total(sharp, l), 1.0, 0.03) << l;
  int lit = 0, wider = 0;
  for (int row = 0; row < sharp.height; ++row) {
    if (row_light(sharp, row, 0).light < 5.0) continue;
    ++lit;
    wider += row_light(spread, row, 0).width_px > 1.2 * row_light(sharp, row, 0).width_px;
  }
  EXPECT_GT(lit, 5);
  EXPECT_GT(wider, lit / 2) << "its red light is high up";
}

const char* const kCurtain = R"(
[camera]
width = 120
height = 90
hfov_deg = 70
elevation_deg = 45
[sensor]
gain_per_kilorayleigh = 1
[emission]
tables = "glow"
[blur]
width_deg = [0, 0, 0]
[[footprint]]
center_km = [0, 200]
size_km = [200, 120]
cell_km = 2
east_km = [-40, 0, 40]
north_km = [0, 10, 0]
width_km = 6
energy_kev = 0.8
top_km = 400
)";

Scene curtain(BlurModel model) {
  Scene scene = parse_scene(kCurtain, "curtain.toml");
  scene.blur.model = model;
  return scene;
}

TEST(SlabExposer, SpreadsFootprintsToo) {
  const Image sharp = render(curtain(BlurModel::angle)).rayleigh;
  const Rendering spread = render(curtain(BlurModel::physical));
  // Light is spread over the border either way.
  EXPECT_NEAR(total(spread.rayleigh, 0) / total(sharp, 0), 1.0, 0.1);
  EXPECT_NEAR(total(spread.rayleigh, 1) / total(sharp, 1), 1.0, 5e-3);
  for (int y = 0; y < sharp.height; ++y)
    for (int x = 0; x < sharp.width; ++x)
      ASSERT_NEAR(spread.rayleigh.at(x, y, 2), sharp.at(x, y, 2), 1e-5 * sharp.at(x, y, 2) + 1e-4);
  double change = 0.0;
  for (int y = 0; y < sharp.height; ++y)
    for (int x = 0; x < sharp.width; ++x) change += std::abs(spread.rayleigh.at(x, y, 0) - sharp.at(x, y, 0));
  EXPECT_GT(change, 0.05 * total(sharp, 0)) << "its red light is spread";
  EXPECT_FALSE(spread.volume.empty());
}

TEST(SlabExposer, LeavesTwoColoursAndNebulaeAsTheyAre) {
  Scene scene = curtain(BlurModel::angle);
  scene.footprints[0].light = FootprintLight::colours;
  const Image sharp = render(scene).rayleigh;
  scene.blur.model = BlurModel::physical;
  const Image spread = render(scene).rayleigh;
  for (std::size_t i = 0; i < sharp.data.size(); ++i)
    ASSERT_NEAR(spread.data[i], sharp.data[i], 1e-5 * sharp.data[i] + 1e-5);
}

TEST(SlabExposer, IsTheSameForEveryNumberOfThreads) {
  Scene scene = curtain(BlurModel::physical);
  scene.sheets = red_scene(BlurModel::physical).sheets;
  RenderOptions options;
  options.threads = 1;
  const Image one = render(scene, options).rayleigh;
  options.threads = 2;
  EXPECT_EQ(render(scene, options).rayleigh.data, one.data);
}

TEST(SlabExposer, LooksAtTheLimbAlongTheLowestPoint) {
  // From 400 km over the Earth to light at 250 km: straight down, and past the limb.
  EXPECT_NEAR(range_to_altitude_km(400.0, -1.0, 250.0), 150.0, 1e-9);
  const double sine = -0.2, from_centre = kEarthRadiusKm + 400.0;
  EXPECT_NEAR(range_to_altitude_km(400.0, sine, 250.0), from_centre * 0.2, 1e-6);
  // And from the ground to it: the triangle's sides.
  const double range = range_to_altitude_km(0.0, 0.5, 250.0);
  EXPECT_NEAR(std::pow(kEarthRadiusKm + 250.0, 2),
              kEarthRadiusKm * kEarthRadiusKm + range * range + kEarthRadiusKm * range, 1e-3);
}

/// Means over strips of the picture's rows.
CellWeights strips(const FilmGeometry& film) {
  constexpr int kRows = 9;
  CellWeights weights;
  for (int row = 0; row + kRows <= film.rows; row += kRows) {
    weights.first_run.push_back(weights.runs.size());
    for (int r = row; r < row + kRows; ++r) {
      weights.runs.push_back({r, 0, film.columns, weights.pixels.size()});
      weights.pixels.insert(weights.pixels.end(), static_cast<std::size_t>(film.columns) * 3, 1.0f);
    }
    weights.inverse.insert(weights.inverse.end(), 3, 1.0f / static_cast<float>(kRows * film.columns));
  }
  weights.first_run.push_back(weights.runs.size());
  return weights;
}

/// Largest difference of the derivatives by a number from central differences of values, over the largest
/// derivative.
double worst(const Scene& scene, const std::string& path, double step) {
  const FilmGeometry film = film_for(scene, 0, 0, scene.camera.width, scene.camera.height, 2.0, 1.0);
  PictureModelOptions options;
  options.keeps_negative_light = true;
  PictureModel model(scene, film, strips(film), options);
  const ParameterId id = *parameter_at(scene, path);
  PictureMeans here, ahead, behind;
  model.evaluate_with_derivatives(scene, {id}, here);
  Scene moved = scene;
  *number_at(moved, id) += step;
  model.evaluate(moved, ahead);
  *number_at(moved, id) -= 2.0 * step;
  model.evaluate(moved, behind);
  double difference = 0.0, largest = 0.0;
  for (std::size_t i = 0; i < here.value.size(); ++i) {
    const double slope = (ahead.value[i] - behind.value[i]) / (2.0 * step);
    difference = std::max(difference, std::abs(here.derivative[i] - slope));
    largest = std::max(largest, std::abs(slope));
  }
  EXPECT_GT(largest, 0.0) << path;
  return difference / largest;
}

// Differences of steps this small are off by their third derivative and by the rounding of floats: 1 % holds
// both, where a forgotten share of the blur or of a slab would be tens of per cent.
TEST(SlabExposer, HasTheDerivativesOfItsPictures) {
  Scene scene = red_scene(BlurModel::physical);
  scene.camera.principal_x_px = 3.0;
  scene.blur.wind_m_s = {100.0, 50.0};
  scene.sensor.gain_per_kilorayleigh = 1.0;
  EXPECT_LT(worst(scene, "sheet.main.energy_kev", 0.005), 0.01);
  EXPECT_LT(worst(scene, "sheet.main.center_km.north", 0.3), 0.01);
  EXPECT_LT(worst(scene, "camera.elevation_deg", 0.05), 0.01);
  EXPECT_LT(worst(scene, "camera.hfov_deg", 0.1), 0.01);
  Scene fisheye = scene;
  fisheye.camera.model = LensModel::equisolid;
  fisheye.camera.focal_px = 90.0;
  EXPECT_LT(worst(fisheye, "camera.focal_px", 0.1), 0.01);
}

TEST(SlabExposer, HasTheDerivativesOfFootprintsAndFreeProfiles) {
  const Scene arc = curtain(BlurModel::physical);
  EXPECT_LT(worst(arc, "footprint.arc.energy_kev", 0.005), 0.01);
  EXPECT_LT(worst(arc, "footprint.arc.north_km.1", 0.2), 0.02);
  Scene scene = red_scene(BlurModel::physical);
  scene.sensor.gain_per_kilorayleigh = 1.0;
  Sheet& sheet = scene.sheets[0];
  sheet.profile = ProfileKind::form;
  sheet.peak_km = 200.0;
  sheet.lower_km = 40.0;
  sheet.upper_km = 100.0;
  EXPECT_LT(worst(scene, "sheet.main.peak_km", 0.5), 0.01);
}

}  // namespace
}  // namespace vegard::sim::slab_exposer_test
