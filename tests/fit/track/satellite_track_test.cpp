#include "fit/track/satellite_track.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/base/error.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/distributions.h"
#include "sim/base/number/random.h"
#include "sim/base/utc_time.h"

namespace vegard::fit::satellite_track_test {
namespace {

constexpr double kMapTime_s = 1394431533.0;  // 2014-03-10T06:05:33Z

template <class Call>
std::string refusal(const Call& call) {
  try {
    call();
  } catch (const sim::Error& error) {
    return error.what();
  }
  return "none";
}

// Places of round numbers: the equator, a pole, and Bowring's formula back and forth.
TEST(SatelliteTrack, GoesToTheEllipsoidAndBack) {
  EXPECT_NEAR(earth_place_km(EarthShape::wgs84, GeodeticPlace{0.0, 90.0, 100.0})[1], 6478.137, 1e-9);
  EXPECT_NEAR(earth_place_km(EarthShape::wgs84, GeodeticPlace{90.0, 0.0, 0.0})[2], 6356.752314, 1e-6);
  for (const GeodeticPlace& place :
       {GeodeticPlace{65.1, -147.4, 450.0}, {-33.0, 170.0, 0.0}, {89.9, 10.0, 35786.0}}) {
    const GeodeticPlace back = geodetic_place(EarthShape::wgs84, earth_place_km(EarthShape::wgs84, place));
    EXPECT_NEAR(back.latitude_deg, place.latitude_deg, 1e-9);
    EXPECT_NEAR(back.longitude_deg, place.longitude_deg, 1e-9);
    EXPECT_NEAR(back.height_km, place.height_km, 1e-6);
  }
}

// In a field line the radius over the square of the cosine of the magnetic latitude stays, for a dipole; IGRF
// is none, but far from it the way there and back is one line: the foot of a foot's conjugate is itself.
TEST(SatelliteTrack, FootIsOnTheLine) {
  const sim::Igrf igrf(2014.2);
  for (const GeodeticPlace& from :
       {GeodeticPlace{65.0, -147.0, 480.0}, {68.0, 20.0, 850.0}, {-70.0, 40.0, 1200.0}}) {
    const auto foot = field_foot(igrf, from, 110.0);
    ASSERT_TRUE(foot);
    EXPECT_NEAR(foot->height_km, 110.0, 2e-3);
    // Half the way down and then on: the same foot.
    const auto half = field_foot(igrf, from, 300.0);
    const auto again = field_foot(igrf, *half, 110.0);
    EXPECT_NEAR(again->latitude_deg, foot->latitude_deg, 1e-4);
    EXPECT_NEAR(again->longitude_deg, foot->longitude_deg, 1e-4);
    // The field leans towards the equator going up: the foot is poleward, by about the height over tan(dip).
    EXPECT_GT(std::abs(foot->latitude_deg), std::abs(from.latitude_deg));
  }
  EXPECT_FALSE(field_foot(igrf, {65.0, -147.0, 90.0}, 110.0));
}

// A vertical fall at the pole of the field, where the foot is below.
TEST(SatelliteTrack, FootIsBelowWhereTheFieldIsVertical) {
  const sim::Igrf igrf(2020.0);
  // The dip pole of 2020: 86.50 N, 162.87 E (Alken et al. 2021, table 3), within half a degree of 90 over
  // some hundred km.
  const auto foot = field_foot(igrf, {86.5, 162.87, 400.0}, 110.0);
  ASSERT_TRUE(foot);
  EXPECT_NEAR(foot->latitude_deg, 86.5, 0.1);
}

/// A map of Gaussian arc along east with E0 and flux that change to the north.
PrecipitationPlanes map_at(double time_s) {
  PrecipitationPlanes map;
  map.columns = 60;
  map.rows = 80;
  map.step_km = 5.0;
  map.west_km = -150.0;
  map.south_km = -200.0;
  map.site = {65.1, -147.4, 0.0, ""};
  map.time_s = time_s;
  for (int row = 0; row < map.rows; ++row)
    for (int column = 0; column < map.columns; ++column) {
      const double north = map.south_km + row * map.step_km;
      map.energy_flux_mw_m2.push_back(1.0 + 20.0 * std::exp(-0.5 * north * north / 900.0));
      map.energy_kev.push_back(2.0 * std::exp(0.002 * north));
      map.relative_flux_error.push_back(0.15);
      map.ln_energy_error.push_back(0.1);
      map.sensitivity.push_back(5.0);
    }
  return map;
}

/// Northwards over the site at 7 km/s; the foot of 65 N lies some degrees poleward.
std::vector<SatellitePoint> pass(double over_site_s, double longitude_deg = -147.4) {
  std::vector<SatellitePoint> track;
  for (double t = -30.0; t <= 30.0; t += 1.0)
    track.push_back({over_site_s + t, {64.4 + t * 7.0 / 111.0, longitude_deg, 480.0}});
  return track;
}

TEST(SatelliteTrack, MeetsWhatTheMapHas) {
  const std::vector<MetElectrons> met =
      electrons_along({map_at(kMapTime_s)}, pass(kMapTime_s + 5.0), {}, "a.csv");
  std::size_t known = 0;
  for (const MetElectrons& here : met) {
    if (!std::isfinite(here.energy_flux_mw_m2)) continue;
    ++known;
    // Bilinear between cells of 5 km: the arc's curvature, 1/8 25/900 of it.
    EXPECT_NEAR(here.energy_flux_mw_m2, 1.0 + 20.0 * std::exp(-0.5 * here.north_km * here.north_km / 900.0),
                0.08);
    // Weighted with the flux, E0 is that of the brighter cell by a cell's 1 % at most.
    EXPECT_NEAR(here.energy_kev / (2.0 * std::exp(0.002 * here.north_km)), 1.0, 0.01);
    EXPECT_NEAR(here.seconds_after_map, here.point.time_s - kMapTime_s, 1e-9);
  }
  EXPECT_GT(known, 40u);
  EXPECT_LT(known, met.size());  // the track leaves the map
}

// A made conjunction: maps with errors as they say, drawn about a true aurora; what is found along the track
// is within one standard deviation of the truth as often as a normal number is. 300 maps of seed 5: 2.7 %
// of 68.
TEST(SatelliteTrack, HasErrorsThatHold) {
  const PrecipitationPlanes truth = map_at(kMapTime_s);
  constexpr std::uint32_t kMaps = 300;
  int flux = 0, energy = 0;
  const std::vector<SatellitePoint> over = {pass(kMapTime_s)[30]};
  const MetElectrons real = electrons_along({truth}, over, {}, "a.csv").front();
  for (std::uint32_t m = 0; m < kMaps; ++m) {
    // Errors of cells side by side are those of one calibration and one physics.
    const sim::Words words = sim::random_words(5, sim::Stream::physics, m, 0, 0);
    PrecipitationPlanes map = truth;
    const double flux_factor = 1.0 + 0.15 * sim::normal_quantile(sim::uniform(words[0])),
                 energy_factor = std::exp(0.1 * sim::normal_quantile(sim::uniform(words[1])));
    for (double& q : map.energy_flux_mw_m2) q *= flux_factor;
    for (double& e : map.energy_kev) e *= energy_factor;
    const MetElectrons met = electrons_along({map}, over, {}, "a.csv").front();
    flux += std::abs(met.energy_flux_mw_m2 - real.energy_flux_mw_m2) <
            met.relative_flux_sigma * met.energy_flux_mw_m2;
    energy += std::abs(std::log(met.energy_kev / real.energy_kev)) < met.ln_energy_sigma;
  }
  EXPECT_GT(flux, 0.60 * kMaps);
  EXPECT_LT(flux, 0.76 * kMaps);
  EXPECT_GT(energy, 0.60 * kMaps);
  EXPECT_LT(energy, 0.76 * kMaps);
}

// A dim cell beside a bright one, whose flux is known to a factor of twenty and whose E0 is unknown, adds
// little.
TEST(SatelliteTrack, DimNeighboursDoNotSpoilErrors) {
  PrecipitationPlanes map = map_at(kMapTime_s);
  for (std::size_t i = 0; i < map.cells(); ++i) {
    const bool is_bright = (i / 60) % 2 == 0;
    map.energy_flux_mw_m2[i] = is_bright ? 10.0 : 1e-3;
    map.relative_flux_error[i] = is_bright ? 0.1 : 20.0;
    if (!is_bright) map.energy_kev[i] = sim::kNaN;
  }
  for (const MetElectrons& here : electrons_along({map}, pass(kMapTime_s), {}, "a.csv"))
    if (here.energy_flux_mw_m2 > 1.0) {
      EXPECT_LT(here.relative_flux_sigma, 0.15);
      EXPECT_TRUE(std::isfinite(here.energy_kev));
    }
}

TEST(SatelliteTrack, TakesTheNearestMapWithinTheTolerance) {
  PrecipitationPlanes later = map_at(kMapTime_s + 40.0);
  for (double& e : later.energy_kev) e = 7.0;
  TrackRequest request;
  request.time_tolerance_s = 5.0;
  const std::vector<MetElectrons> met =
      electrons_along({map_at(kMapTime_s), later}, pass(kMapTime_s + 30.0), request, "a.csv");
  for (const MetElectrons& here : met)
    if (std::isfinite(here.energy_kev)) {
      EXPECT_LE(std::abs(here.seconds_after_map), 5.0);
      EXPECT_EQ(here.energy_kev > 6.9, here.point.time_s > kMapTime_s + 20.0);
    }
}

TEST(SatelliteTrack, RefusesATrackOutOfView) {
  const PrecipitationPlanes map = map_at(kMapTime_s);
  const auto along = [&](double time_s, double longitude_deg) {
    return refusal([&] { electrons_along({map}, pass(time_s, longitude_deg), {}, "a.csv"); });
  };
  EXPECT_NE(along(kMapTime_s, -130.0).find("outside"), std::string::npos);
  EXPECT_NE(along(kMapTime_s, 40.0).find("a.csv"), std::string::npos);
  EXPECT_NE(along(kMapTime_s + 3600.0, -147.4).find("the map's time"), std::string::npos);
}

TEST(SatelliteTrack, ReadsTables) {
  const std::vector<SatellitePoint> own = read_track(
      "# comment\ntime_utc,latitude_deg,longitude_deg,altitude_km\n2014-03-10T06:05:33Z,65.1,-147.4,480\n",
      "a.csv");
  ASSERT_EQ(own.size(), 1u);
  EXPECT_EQ(own[0].time_s, kMapTime_s);
  EXPECT_EQ(own[0].place.height_km, 480.0);
  // Swarm: a geocentric latitude and the radius in metres; DMSP by Madrigal: seconds since 1970.
  const std::vector<SatellitePoint> swarm =
      read_track("Timestamp;Latitude;Longitude;Radius\n2014-03-10 06:05:33;45;10;6838137\n", "b.csv");
  const Eigen::Vector3d km = earth_place_km(EarthShape::wgs84, swarm[0].place);
  EXPECT_NEAR(km[2], 6838.137 * std::sqrt(0.5), 1e-6);
  EXPECT_GT(swarm[0].place.latitude_deg, 45.17);  // geodetic
  EXPECT_EQ(read_track("ut1_unix,gdlat,glon,gdalt\n1394431533,65,213,850\n", "c.csv")[0].time_s, kMapTime_s);

  const auto refused = [](const std::string& text) { return refusal([&] { read_track(text, "d.csv"); }); };
  EXPECT_NE(refused("time,lat,lon\n2014-03-10T06:05:33Z,1,2\n").find("an altitude"), std::string::npos);
  EXPECT_NE(refused("time,lat,lon,alt\nyesterday,1,2,3\n").find("d.csv:2"), std::string::npos);
  EXPECT_NE(refused("time,lat,lon,alt\n2014-03-10T06:05:33Z,91,2,3\n").find("91"), std::string::npos);
  EXPECT_NE(refused("time,lat,lon,alt\n2014-03-10T06:05:33Z,1,2\n").find("3 cells"), std::string::npos);
  EXPECT_NE(refused("time,lat,lon,alt\n").find("no rows"), std::string::npos);
}

TEST(SatelliteTrack, ReadsTimes) {
  EXPECT_EQ(instants_of("2014-03-10T06:00:00Z/0.5/2014-03-10T06:00:02Z").size(), 5u);
  for (const char* words :
       {"now", "2014-03-10T06:00:00Z/0/2014-03-10T06:00:02Z", "2014-03-10T06:00:00Z/1/tomorrow",
        "2014-03-10T06:00:00Z/inf/2014-03-10T06:00:02Z", "2014-03-10T06:00:02Z/1/2014-03-10T06:00:00Z",
        "2014-03-10T06:00:00Z/1e-9/2014-03-11T06:00:00Z"})
    EXPECT_NE(refusal([&] { instants_of(words); }).find("--times"), std::string::npos) << words;
}

// The state of Vallado et al. 2006, AIAA 2006-6753, appendix C, and the same turned to the Earth. UT1 was
// 0.44 s behind UTC; the rest is that of the sidereal time, which is given to a metre.
TEST(SatelliteTrack, TurnsAStateToTheEarth) {
  const double ut1_s = *sim::utc_seconds("2004-04-06T07:51:28.386Z") - 0.4399619;
  OrbitState state;
  state.km = {5094.18016210, 6127.64465950, 6380.34453270};
  const Eigen::Vector3d km = earth_place_km(EarthShape::wgs84, place_of_state(state, ut1_s));
  EXPECT_NEAR(km[0], -1033.47503130, 0.02);
  EXPECT_NEAR(km[1], 7901.30558560, 0.02);
  EXPECT_NEAR(km[2], 6380.34453270, 0.02);
}

// Elements of 2006 at their own day, and years later. The place is that of Vallado's published state, turned.
TEST(SatelliteTrack, FollowsElements) {
  const std::string text =
      "1 06251U 62025E   06176.82412014  .00008885  00000-0  12808-3 0  3985\n"
      "2 06251  58.0579  54.0425 0030035 139.1568 221.1854 15.56387291  6774\n";
  double oldest = 0.0;
  const double epoch_s = *sim::utc_seconds("2006-06-25T19:46:43.980Z");
  const std::vector<SatellitePoint> track =
      track_of_elements(text, "a.tle", "", {epoch_s, epoch_s + 7200.0}, oldest);
  EXPECT_NEAR(oldest, 7200.0 / 86400.0, 1e-6);
  const Eigen::Vector3d km = earth_place_km(EarthShape::wgs84, track[1].place);
  EXPECT_NEAR(km[2], 5471.33577327, 0.01);
  EXPECT_NEAR(std::hypot(km[0], km[1]), std::hypot(-3935.69800083, 409.10980837), 0.01);
  const auto refused = [&](const std::string& satellite, double time_s) {
    return refusal([&] { track_of_elements(text, "a.tle", satellite, {time_s}, oldest); });
  };
  EXPECT_NE(refused("", epoch_s + 3.0e8).find("days older"), std::string::npos);
  EXPECT_NE(refused("", epoch_s - 1.0e8).find("days younger"), std::string::npos);
  EXPECT_NE(refused("00005", epoch_s).find("06251"), std::string::npos);
}

}  // namespace
}  // namespace vegard::fit::satellite_track_test
