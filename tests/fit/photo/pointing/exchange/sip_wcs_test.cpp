// Astrometry.net's solutions.
#include "fit/photo/pointing/exchange/sip_wcs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/base/picture/fits_io.h"
#include "sim/view/camera/camera.h"
#include "sim/view/sky/star_place.h"
#include "tests/support/expect_error.h"

namespace vegard::fit::sip_wcs_test {
namespace {

const sim::Observer kObserver{65.1, -147.4, 200.0, true};
const double kTime = *sim::julian_date("2014-03-10T06:05:33Z");

sim::Camera made_camera(sim::LensModel lens) {
  sim::Camera camera;
  camera.model = lens;
  camera.width = 360;
  camera.height = 240;
  camera.azimuth_deg = 20.0;
  camera.elevation_deg = 50.0;
  camera.roll_deg = 5.0;
  camera.focal_px = 260.0;
  camera.hfov_deg = 60.0;
  return camera;
}

TEST(SipWcs, FindsCataloguedPlacesOfDirections) {
  for (const double elevation : {2.0, 20.0, 60.0, 89.0})
    for (const double azimuth : {0.0, 77.0, 200.0, 310.0}) {
      Eigen::Vector3d enu;
      sim::enu_of_direction({azimuth, elevation}, enu.data());
      const Eigen::Vector3d sky = j2000_of_direction(enu, kObserver, kTime);
      sim::CataloguePlace place;
      place.j2000 = {std::atan2(sky.y(), sky.x()) / sim::kRadiansPerDegree + (sky.y() < 0.0 ? 360.0 : 0.0),
                     std::asin(sky.z()) / sim::kRadiansPerDegree};
      const std::array<double, 3> seen = sim::direction_of_star(place, kObserver, kTime);
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(seen[i], enu[i], 1e-10) << azimuth << " " << elevation;
    }
}

// A plain tangent plane by the definitions of FITS, at the reference and 3 degrees beside it.
TEST(SipWcs, ReadsATangentPlane) {
  const std::string bytes = sim::encode_fits_header({{"CTYPE1", "RA---TAN", ""},
                                                     {"CTYPE2", "DEC--TAN", ""},
                                                     {"CRVAL1", 45.0, ""},
                                                     {"CRVAL2", 0.0, ""},
                                                     {"CRPIX1", 100.5, ""},
                                                     {"CRPIX2", 50.5, ""},
                                                     {"CD1_1", -0.1, ""},
                                                     {"CD1_2", 0.0, ""},
                                                     {"CD2_1", 0.0, ""},
                                                     {"CD2_2", -0.1, ""},
                                                     {"IMAGEW", 200.0, ""},
                                                     {"IMAGEH", 100.0, ""}});
  const SipWcs wcs = read_sip_wcs(bytes, "a.wcs");
  EXPECT_EQ(wcs.width_px, 200);
  EXPECT_EQ(wcs.height_px, 100);
  const Eigen::Vector3d middle = sky_of_pixel(wcs, 100.0, 50.0);
  EXPECT_NEAR(std::atan2(middle.y(), middle.x()) / sim::kRadiansPerDegree, 45.0, 1e-12);
  // 30 pixels to the right are 3 degrees of the plane to smaller right ascensions: the angle's tangent.
  const Eigen::Vector3d right = sky_of_pixel(wcs, 130.0, 50.0);
  EXPECT_NEAR(std::atan2(right.y(), right.x()) / sim::kRadiansPerDegree,
              45.0 - std::atan(3.0 * sim::kRadiansPerDegree) / sim::kRadiansPerDegree, 1e-12);
  const Eigen::Vector3d up = sky_of_pixel(wcs, 100.0, 20.0);
  EXPECT_NEAR(std::asin(up.z()), std::atan(3.0 * sim::kRadiansPerDegree), 1e-12);
}

TEST(SipWcs, IsReadAsItWasWritten) {
  const SipFit fit = sip_of_camera(made_camera(sim::LensModel::equisolid), kObserver, kTime, 60.0);
  const SipWcs again = read_sip_wcs(encode_sip_wcs(fit.wcs, "words"), "a.wcs");
  EXPECT_EQ(again.reference_px, fit.wcs.reference_px);
  EXPECT_EQ(again.degrees_per_px, fit.wcs.degrees_per_px);
  EXPECT_EQ(again.a.terms, fit.wcs.a.terms);
  EXPECT_EQ(again.bp.terms, fit.wcs.bp.terms);
  EXPECT_EQ(again.width_px, 360);
}

TEST(SipWcs, StandsForACamera) {
  for (const auto lens : {sim::LensModel::pinhole, sim::LensModel::equidistant, sim::LensModel::equisolid}) {
    const sim::Camera camera = made_camera(lens);
    const SipFit fit = sip_of_camera(camera, kObserver, kTime, 60.0);
    EXPECT_LT(fit.rms_px, 0.05) << static_cast<int>(lens);
    // A grid of 7.5 pixels saw more than the corners: all of the picture.
    EXPECT_GT(fit.share, 0.99);
    // The way out and in again, by the map of directions: what the fit says is what is found.
    const sim::DirectionMap map = directions_of_wcs(fit.wcs, kObserver, kTime);
    for (int y = 10; y < 240; y += 40)
      for (int x = 10; x < 360; x += 40) {
        double enu[3], wanted[3];
        sim::enu_of_direction({map.azimuth_deg[map.index(x, y)], map.elevation_deg[map.index(x, y)]}, enu);
        sim::enu_of_direction(sim::direction_of_pixel(camera, x + 0.5, y + 0.5), wanted);
        const double off = std::hypot(enu[0] - wanted[0], enu[1] - wanted[1], enu[2] - wanted[2]);
        EXPECT_LT(off * 260.0, fit.largest_px + 0.01) << x << " " << y;
      }
    // AP and BP lead back: from a place's plane coordinates to the place.
    const double u = 100.0 - fit.wcs.reference_px.x(), v = 60.0 - fit.wcs.reference_px.y();
    const double U = u + fit.wcs.a.at(u, v), V = v + fit.wcs.b.at(u, v);
    EXPECT_NEAR(U + fit.wcs.ap.at(U, V), u, 0.1);
    EXPECT_NEAR(V + fit.wcs.bp.at(U, V), v, 0.1);
  }
}

TEST(SipWcs, RefusesWhatIsNoSolution) {
  const auto refused = [](const std::vector<sim::FitsKeyword>& changes) {
    std::map<std::string, sim::FitsKeyword> all;
    for (const sim::FitsKeyword& k : std::vector<sim::FitsKeyword>{{"CTYPE1", "RA---TAN-SIP", ""},
                                                                   {"CTYPE2", "DEC--TAN-SIP", ""},
                                                                   {"CRVAL1", 45.0, ""},
                                                                   {"CRVAL2", 0.0, ""},
                                                                   {"CRPIX1", 100.5, ""},
                                                                   {"CRPIX2", 50.5, ""},
                                                                   {"CD1_1", -0.1, ""},
                                                                   {"CD1_2", 0.0, ""},
                                                                   {"CD2_1", 0.0, ""},
                                                                   {"CD2_2", -0.1, ""}})
      all[k.name] = k;
    for (const sim::FitsKeyword& k : changes) all[k.name] = k;
    std::vector<sim::FitsKeyword> list;
    for (const auto& [name, k] : all) list.push_back(k);
    const std::string bytes = sim::encode_fits_header(list);
    return tests::expect_error(sim::ErrorKind::unreadable_input, [&] { read_sip_wcs(bytes, "a.wcs"); });
  };
  EXPECT_NE(refused({{"CTYPE1", "RA---TPV", ""}}).find("RA---TPV"), std::string::npos);
  EXPECT_NE(refused({{"CRVAL1", "soon", ""}}).find("CRVAL1"), std::string::npos);
  EXPECT_NE(refused({{"CRVAL2", 91.0, ""}}).find("CRVAL2"), std::string::npos);
  EXPECT_NE(refused({{"CD1_1", 0.0, ""}}).find("CD"), std::string::npos);
  EXPECT_NE(refused({{"A_ORDER", 10.0, ""}}).find("A_ORDER"), std::string::npos);
  EXPECT_NE(refused({{"EQUINOX", 1950.0, ""}}).find("1950"), std::string::npos);
  EXPECT_NE(refused({{"IMAGEW", -3.0, ""}}).find("IMAGEW"), std::string::npos);
  tests::expect_error(sim::ErrorKind::unreadable_input, [] { read_sip_wcs("no FITS", "a.wcs"); });
}

TEST(SipWcs, RefusesACameraOfTheGround) {
  sim::Camera camera = made_camera(sim::LensModel::pinhole);
  camera.elevation_deg = -60.0;
  tests::expect_error(sim::ErrorKind::scene, [&] { sip_of_camera(camera, kObserver, kTime, 60.0); });
}

}  // namespace
}  // namespace vegard::fit::sip_wcs_test
