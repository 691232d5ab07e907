// What is given about one site and seen from another: the same light at the same point of space, and along
// the rays of a camera there.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "sim/base/error.h"
#include "sim/base/grid/vdb_io.h"
#include "sim/base/number/constants.h"
#include "sim/base/picture/fits_io.h"
#include "sim/light/sheet_profile.h"
#include "sim/render/emitters/emitter_makers.h"
#include "sim/scene/structs/site_axes.h"
#include "sim/scene/table/photo_scene.h"
#include "tests/support/temporary_folder.h"

namespace vegard::sim::carried_emitters_test {
namespace {

Site some_site(double latitude_deg, double longitude_deg, double altitude_m) {
  Site site;
  site.latitude_deg = latitude_deg;
  site.longitude_deg = longitude_deg;
  site.altitude_m = altitude_m;
  return site;
}

const Site kHome = some_site(67.0, 20.0, 300.0), kThere = some_site(68.2, 23.5, 1200.0);

/// East, north, up of a foot at 110 km altitude, seen from kHome.
std::array<double, 3> above(double east, double north, double more_km) {
  const double radius = kEarthRadiusKm + kFootAltitudeKm;
  const double up = std::sqrt(radius * radius - east * east - north * north);
  const double scale = 1.0 + more_km / radius;
  return {east * scale, north * scale, up * scale - kEarthRadiusKm - 1e-3 * kHome.altitude_m};
}

std::array<double, 3> moved(const SiteTurn& turn, const std::array<double, 3>& p) {
  std::array<double, 3> out;
  for (int i = 0; i < 3; ++i)
    out[i] = turn.turn[i][0] * p[0] + turn.turn[i][1] * p[1] + turn.turn[i][2] * p[2] + turn.shift_km[i];
  return out;
}

/// [line] photons cm^-3 s^-1
std::vector<float> light_at(const LightField& field, const std::array<double, 3>& p, int lines) {
  const double* points[3] = {&p[0], &p[1], &p[2]};
  std::vector<float> light(static_cast<std::size_t>(lines), 0.0f);
  std::vector<float*> out;
  for (float& line : light) out.push_back(&line);
  float density = 0.0f;
  field.sample(1, points, out.data(), &density);
  return light;
}

/// Rayleighs of a line along a ray, from samples of the field 0.2 km apart.
double along(const LightField& field, const double direction[3], int lines, int line) {
  double sum = 0.0;
  for (int i = 0; i < 4000; ++i) {
    const double t = 0.2 * (i + 0.5);
    sum += 0.2 * kRayleighsPerKm *
           light_at(field, {t * direction[0], t * direction[1], t * direction[2]}, lines)[line];
  }
  return sum;
}

/// The only element of a scene of kHome against that of the same seen from kThere: along upright lines over
/// `feet`, and along a ray from there through the first of them.
void expect_same_light(const Scene& at_home, const Scene& there,
                       const std::vector<std::array<double, 2>>& feet) {
  const VolumeFiles home_files = read_volume_files(at_home), there_files = read_volume_files(there);
  const auto home = light_fields(at_home, home_files, 1), seen = light_fields(there, there_files, 1);
  ASSERT_EQ(home.size(), 1u);
  const int lines = static_cast<int>(at_home.emission.lines.size());
  const SiteTurn turn = turn_between(kHome, kThere);
  int lit = 0;
  for (const auto& [east, north] : feet)
    for (const double more : {-5.0, 0.0, 10.0, 40.0}) {
      const std::array<double, 3> place = above(east, north, more);
      const auto wanted = light_at(*home[0].field, place, lines),
                 light = light_at(*seen[0].field, moved(turn, place), lines);
      for (int l = 0; l < lines; ++l) {
        EXPECT_NEAR(light[l], wanted[l], 1e-5 * wanted[l] + 1e-6) << east << " " << north << " +" << more;
        lit += wanted[l] > 1.0f;
      }
    }
  EXPECT_GT(lit, 6);

  const std::array<double, 3> target = moved(turn, above(feet[0][0], feet[0][1], 5.0));
  const double far = std::sqrt(target[0] * target[0] + target[1] * target[1] + target[2] * target[2]);
  const double direction[3] = {target[0] / far, target[1] / far, target[2] / far};
  RayBundle<double> ray;
  ray.count = 1;
  for (int a = 0; a < 3; ++a) ray.direction[a] = &direction[a];
  const double end = std::numeric_limits<double>::infinity();
  ray.end_km = &end;
  std::vector<double> rayleigh(static_cast<std::size_t>(lines), 0.0),
      kept(static_cast<std::size_t>(lines), 1.0);
  double entry = end, depth = end;
  BundleLight<double> out;
  out.lines = lines;
  out.rayleigh = rayleigh.data();
  out.kept = kept.data();
  out.entry_km = &entry;
  out.depth_km = &depth;
  make_emitters<double>(there, there_files, plain_number, 1)[0]->march(ray, out);
  for (int l = 0; l < lines; ++l) {
    const double wanted = along(*seen[0].field, direction, lines, l);
    EXPECT_GT(wanted, 1.0);
    EXPECT_NEAR(rayleigh[l], wanted, 0.01 * wanted);
  }
}

/// The scene as a photograph from kThere has it.
Scene seen_from_there(Scene scene) {
  PhotoEntry entry;
  entry.name = "there";
  entry.file = "there.png";
  entry.set = {{"site.latitude_deg", "68.2"}, {"site.longitude_deg", "23.5"}, {"site.altitude_m", "1200.0"}};
  scene.fit.photos = {entry};
  check_photos(scene);
  return scene_of_photo(scene, entry);
}

Scene scene_at_home(FieldModel field) {
  Scene scene;
  scene.site = kHome;
  scene.field.model = field;
  scene.march.step_km = 0.2;
  return scene;
}

TEST(CarriedEmitters, AFootprintStandsWhereItStood) {
  for (const FieldModel field : {FieldModel::uniform, FieldModel::dipole}) {
    Scene scene = scene_at_home(field);
    scene.footprints.emplace_back();
    Footprint& f = scene.footprints[0];
    f.center_km = {20.0, 150.0};
    f.east_km = {-80.0, 0.0, 90.0};
    f.north_km = {10.0, -15.0, 20.0};
    f.point_energy = {0.5, 1.0, 2.0};
    f.width_km = 6.0;
    expect_same_light(scene, seen_from_there(scene), {{20.0, 135.0}, {-20.0, 141.0}, {60.0, 141.0}});
  }
}

TEST(CarriedEmitters, AMapOfPrecipitationStandsWhereItsHeaderSays) {
  const tests::TemporaryFolder folder;
  Image image(60, 50, {"1", "2"});
  for (int y = 0; y < 50; ++y)
    for (int x = 0; x < 60; ++x) {
      const double east = -60.0 + 2.0 * x, north = 200.0 - 2.0 * y;  // of the cell's middle
      const double off = (north - 150.0 - 0.2 * east) / 8.0;
      image.at(x, y, 0) = static_cast<float>(10.0 * std::exp(-0.5 * off * off));
      image.at(x, y, 1) = static_cast<float>(3.0 + 0.02 * east);
    }
  const auto encoded = [&](bool with_site) {
    std::vector<FitsKeyword> keywords = {
        {"CTYPE1", "EAST", ""}, {"CUNIT1", "km", ""},    {"CRPIX1", 1.0, ""},  {"CRVAL1", -60.0, ""},
        {"CDELT1", 2.0, ""},    {"CTYPE2", "NORTH", ""}, {"CUNIT2", "km", ""}, {"CRPIX2", 1.0, ""},
        {"CRVAL2", 102.0, ""},  {"CDELT2", 2.0, ""}};
    if (with_site) {
      keywords.push_back({"SITELAT", kHome.latitude_deg, ""});
      keywords.push_back({"SITELONG", kHome.longitude_deg, ""});
    }
    return encode_fits(image, keywords);
  };
  tests::put(folder / "of_home.fits", encoded(true));
  tests::put(folder / "plain.fits", encoded(false));
  Scene scene = scene_at_home(FieldModel::dipole);
  scene.file = folder / "scene.toml";
  scene.footprints.emplace_back();
  scene.footprints[0].source = FootprintSource::precipitation;
  const std::vector<std::array<double, 2>> feet = {{0.0, 150.0}, {-40.0, 142.0}, {30.0, 156.0}};
  // By the header alone, in a scene of the other site.
  scene.footprints[0].file = "of_home.fits";
  Scene there = scene;
  there.site = kThere;
  expect_same_light(scene, there, feet);
  // As one of several photographs, by either file.
  expect_same_light(scene, seen_from_there(scene), feet);
  scene.footprints[0].file = "plain.fits";
  expect_same_light(scene, seen_from_there(scene), feet);
  // A file that does not say is about the scene's own site.
  there.footprints[0].file = "plain.fits";
  const VolumeFiles files = read_volume_files(there);
  const auto field = light_fields(there, files, 1);
  const SiteTurn turn = turn_between(kHome, kThere);
  EXPECT_EQ(light_at(*field[0].field, moved(turn, above(0.0, 150.0, 0.0)), 3)[1], 0.0f);

  // The map's light over a foot is its flux times the height profile of its energy.
  const VolumeFiles home_files = read_volume_files(scene);
  const auto home = light_fields(scene, home_files, 1);
  Scene one = scene;
  one.footprints.clear();
  one.sheets.emplace_back();
  one.sheets[0].energy_kev = 3.0;
  one.sheets[0].energy_flux_mw_m2 = 7.07;  // what the flux law goes by: the mean of a Gaussian ridge
  const HeightProfile profile = sheet_profile(one.emission.lines, one, 0);
  const auto light = light_at(*home[0].field, above(0.0, 150.0, 0.0), 3);
  const std::size_t row = static_cast<std::size_t>((110.0 - 80.0) / HeightProfile::kStepKm) *
                          static_cast<std::size_t>(profile.stride);
  for (int l = 0; l < 3; ++l)
    EXPECT_NEAR(light[l], 10.0 * profile.rate[row + l], 0.02 * 10.0 * profile.rate[row + l]);
}

TEST(CarriedEmitters, AVolumeStandsWhereItStood) {
  const tests::TemporaryFolder folder;
  // A blob about 20, 150, 130 km, on voxels of 4 km.
  SparseGrid grid;
  grid.voxel = 4.0;
  for (const char* name : {"emission_6300", "emission_5577", "emission_4278"})
    grid.channels.push_back({name, "photons cm^-3 s^-1"});
  grid.origin = {-44.0, 86.0, 66.0};
  for (int bx = 0; bx < 4; ++bx)
    for (int by = 0; by < 4; ++by)
      for (int bz = 0; bz < 4; ++bz) {
        std::vector<float>& numbers = grid.brick({bx, by, bz});
        for (int i = 0; i < SparseGrid::kEdge; ++i)
          for (int j = 0; j < SparseGrid::kEdge; ++j)
            for (int k = 0; k < SparseGrid::kEdge; ++k) {
              const double x = bx * 8 + i - 16.0, y = by * 8 + j - 16.0, z = bz * 8 + k - 16.0;
              for (int c = 0; c < 3; ++c)
                numbers[c * SparseGrid::kVoxels + SparseGrid::within(i, j, k)] =
                    static_cast<float>((c + 1) * 1000.0 * std::exp(-0.5 * (x * x + y * y + z * z) / 25.0));
            }
      }
  write_vdb(folder / "blob.vdb", std::move(grid), {}, {});
  Scene scene = scene_at_home(FieldModel::uniform);
  scene.file = folder / "scene.toml";
  scene.volumes.emplace_back();
  scene.volumes[0].file = "blob.vdb";
  scene.volumes[0].shift_km = {8.0, -12.0, 3.0};
  scene.volumes[0].step_voxels = 0.05;
  expect_same_light(scene, seen_from_there(scene), {{28.0, 138.0}, {10.0, 140.0}, {35.0, 150.0}});
}

TEST(CarriedEmitters, WhatStandsInTheSkyIsRefused) {
  Scene scene = scene_at_home(FieldModel::uniform);
  scene.nebulae.emplace_back();
  scene.nebulae[0].gas = "node";
  scene.nebulae[0].inner_rayleigh = scene.nebulae[0].outer_rayleigh = {1.0, 1.0, 1.0};
  scene.nodes.emplace_back();
  EXPECT_THROW(seen_from_there(scene), Error);
  scene = scene_at_home(FieldModel::uniform);
  scene.sheets.emplace_back();
  scene.footprints.emplace_back();
  scene.footprints[0].source = FootprintSource::sheets;
  EXPECT_THROW(seen_from_there(scene), Error);
  scene.footprints.clear();
  EXPECT_NO_THROW(seen_from_there(scene));
}

}  // namespace
}  // namespace vegard::sim::carried_emitters_test
