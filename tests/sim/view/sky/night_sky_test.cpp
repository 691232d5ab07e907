#include "sim/view/sky/night_sky.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/scene/table/parameter_id.h"
#include "sim/view/colour/line_colours.h"
#include "sim/view/colour/radiometry.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::night_sky_test {
namespace {

SightLine<double> towards(double azimuth_deg, double elevation_deg) {
  const double a = azimuth_deg * kRadiansPerDegree, e = elevation_deg * kRadiansPerDegree;
  return {std::sin(a) * std::cos(e), std::cos(a) * std::cos(e), std::sin(e)};
}

/// Y of linear sRGB, IEC 61966-2-1, in cd m^-2.
double luminance(const Scene& scene, const std::array<double, 3>& rgb) {
  const double value = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
  return value / scene.sensor.gain_per_kilorayleigh * 1e3 * luminance_cd_m2_per_rayleigh(557.7);
}

Scene sky_scene() {
  Scene scene = tests::small_scene();
  scene.camera.elevation_deg = 15.0;
  scene.air.model = AirModel::standard;
  scene.airglow = {163.0, 123.0, 37.0};
  scene.twilight.shown = true;
  scene.twilight.sun_azimuth_deg = 20.0;
  scene.light_pollution.luminance_mcd_m2 = 2.0;
  scene.light_pollution.azimuth_deg = -10.0;
  return scene;
}

TEST(Airglow, GrowsAsTheSecantAndEndsAtTheHorizon) {
  for (double elevation : {20.0, 40.0, 90.0}) {
    const double sine = std::sin(elevation * kRadiansPerDegree);
    EXPECT_NEAR(van_rhijn(sine, 1e-6, 0.0), 1.0 / sine, 1e-6) << "a low shell is a plane";
  }
  // At the horizon 1 / sqrt(1 - (R / (R + h))^2) = (R + h) / sqrt(h (2 R + h)), Pythagoras' chord.
  for (const AirglowLayer& layer : kAirglowLayers) {
    const double h = layer.altitude_km;
    EXPECT_NEAR(van_rhijn(0.0, h, 0.0), (kEarthRadiusKm + h) / std::sqrt(h * (2.0 * kEarthRadiusKm + h)),
                1e-9);
  }
  EXPECT_NEAR(van_rhijn(0.0, 97.0, 0.0), 5.80, 0.01);
  EXPECT_EQ(van_rhijn(0.5, 97.0, 100.0), 0.0) << "from above the shell";
}

TEST(Airglow, AtTheZenithIsItsRayleighs) {
  Scene scene;
  scene.airglow.green_rayleigh = 163.0;
  const auto rgb = NightSky<double>(scene).light(towards(0.0, 90.0));
  const Vector3 line = line_colour(scene, 557.7);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(rgb[c], 0.163 * line[c], 1e-12);
  scene.air.model = AirModel::standard;
  const auto dimmed = NightSky<double>(scene).light(towards(0.0, 25.0));
  EXPECT_NEAR(dimmed[1],
              0.163 * line[1] * air_transmission(scene, 557.7, 25.0) *
                  van_rhijn(std::sin(25.0 * kRadiansPerDegree), 97.0, 0.0),
              1e-9);
}

TEST(Twilight, HasPatatsMagnitudes) {
  const TwilightBand& v = kTwilightBands[2];
  EXPECT_DOUBLE_EQ(twilight_mag_arcsec2(v, -5.0), 11.84);
  EXPECT_NEAR(twilight_mag_arcsec2(v, -12.0), 19.67, 0.005);
  EXPECT_NEAR(twilight_mag_arcsec2(v, -15.0), 21.32, 0.005);
  // Their abstract's slope: between 95 and 100 deg of zenith distance, 1.14 mag per degree in V (table 1).
  double sum_xy = 0.0, sum_xx = 0.0;
  for (int i = 0; i <= 100; ++i) {
    const double x = 0.05 * i - 2.5;
    sum_xy += x * twilight_mag_arcsec2(v, -7.5 - x);
    sum_xx += x * x;
  }
  EXPECT_NEAR(sum_xy / sum_xx, 1.14, 0.12) << "the fit's mean slope there is 1.23";
}

TEST(Twilight, IsAsBrightAsItsMagnitudeSays) {
  // 1.08e5 cd m^-2 for magnitude 0 per square arcsecond in V (Garstang 1986: 34.08 exp(20.7233 - 0.92104 V)
  // nanolambert), for a spectrum of about the sun's colour.
  Scene scene;
  scene.twilight.shown = true;
  scene.twilight.sun_elevation_deg = -7.0;
  const double magnitude = twilight_mag_arcsec2(kTwilightBands[2], -7.0);
  const auto rgb = NightSky<double>(scene).light(towards(0.0, 90.0));
  const double garstang = 34.08 * std::exp(20.7233 - 0.92104 * magnitude) * 1e-5 / 3.14159265358979;
  EXPECT_NEAR(luminance(scene, rgb) / garstang, 1.0, 0.1);
}

// The magnitudes are of the whole sky: twilight and the night behind it.
TEST(Twilight, WithTheNightIsTheWholeSky) {
  for (const double elevation_deg : {-6.0, -12.0, -15.0}) {
    const Spectrum twilight = twilight_spectrum(elevation_deg);
    for (const TwilightBand& band : kTwilightBands) {
      const double whole = radiance_of_mag_arcsec2(band, twilight_mag_arcsec2(band, elevation_deg));
      const double night = radiance_of_mag_arcsec2(band, band.night_mag);
      EXPECT_NEAR((twilight(band.wavelength_nm) + night) / whole, 1.0, 1e-9)
          << band.wavelength_nm << " nm, " << elevation_deg << " degrees";
    }
  }
}

TEST(Twilight, DimsAsTheSunSinksAndIsBrightestTowardsIt) {
  double before = 1e9;
  for (double sun = -5.0; sun >= -15.0; sun -= 0.5) {
    const double now = luminance_of_continuum(twilight_spectrum(sun));
    EXPECT_GT(now, 0.0);
    EXPECT_LT(now, before);
    before = now;
  }
  Twilight twilight;
  twilight.sun_azimuth_deg = 70.0;
  EXPECT_NEAR(twilight_gradient(towards(70.0, 0.0), twilight), 10.0, 1e-9);
  EXPECT_NEAR(twilight_gradient(towards(70.0, 90.0), twilight), 1.0, 1e-9);
  EXPECT_EQ(twilight_gradient(towards(250.0, 10.0), twilight), 1.0);
}

TEST(LightPollution, HasTheLuminanceItStates) {
  Scene scene;
  scene.light_pollution.luminance_mcd_m2 = 2.0;
  scene.light_pollution.azimuth_deg = 130.0;
  const NightSky<double> sky(scene);
  EXPECT_NEAR(luminance(scene, sky.light(towards(130.0, 0.0))), 2e-3, 1e-6);
  EXPECT_NEAR(luminance(scene, sky.light(towards(130.0, 12.0))), 2e-3 / std::exp(1.0), 1e-6);
  EXPECT_NEAR(sky.light(towards(130.0, 90.0))[1], sky.light(towards(10.0, 90.0))[1], 1e-7);
  EXPECT_LT(sky.light(towards(310.0, 5.0))[1], 0.05 * sky.light(towards(130.0, 5.0))[1]);
}

TEST(LightPollution, IsRedderForCoolerLamps) {
  Scene scene;
  scene.light_pollution.luminance_mcd_m2 = 2.0;
  scene.light_pollution.colour_temperature_k = 2000.0;
  const auto warm = NightSky<double>(scene).light(towards(180.0, 3.0));
  scene.light_pollution.colour_temperature_k = 6500.0;
  const auto white = NightSky<double>(scene).light(towards(180.0, 3.0));
  EXPECT_GT(warm[0] / warm[2], 3.0);
  EXPECT_NEAR(white[0] / white[2], 1.0, 0.1) << "a black body near D65";
}

TEST(NightSky, IsDarkBelowTheHorizonAndAddsUp) {
  Scene scene = sky_scene();
  const auto below = NightSky<double>(scene).light(towards(0.0, -5.0));
  EXPECT_EQ(below[0] + below[1] + below[2], 0.0);
  std::array<double, 3> sum{};
  for (int part = 0; part < 3; ++part) {
    Scene one = scene;
    if (part != 0) one.airglow = {};
    if (part != 1) one.twilight.shown = false;
    if (part != 2) one.light_pollution.luminance_mcd_m2 = 0.0;
    const auto light = NightSky<double>(one).light(towards(5.0, 12.0));
    for (int c = 0; c < 3; ++c) sum[c] += light[c];
  }
  const auto all = NightSky<double>(scene).light(towards(5.0, 12.0));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(all[c], sum[c], 1e-12);
  EXPECT_TRUE(has_night_sky(scene));
  EXPECT_FALSE(has_night_sky(Scene()));
}

TEST(NightSky, DerivativesAgreeWithDifferences) {
  const Scene scene = sky_scene();
  const NightSky<SkyDual> sky(scene);
  const SkyView<SkyDual> view(scene);
  for (int k = 0; k < sky_numbers; ++k) {
    const auto which = static_cast<SkyNumber>(k);
    Scene more = scene, less = scene;
    const double step = 1e-4 * std::max(1.0, std::abs(sky_number<double>(scene, which)));
    *number_at(more, sky_number_id(more, which)) += step;
    *number_at(less, sky_number_id(less, which)) -= step;
    double error = 0.0, size = 0.0;
    for (double x : {3.0, 41.0, 90.0, 155.0})
      for (double y : {4.0, 33.0, 61.0}) {
        const auto exact = sky.light(view.at(x, y));
        const auto up = NightSky<double>(more).light(SkyView<double>(more).at(x, y));
        const auto down = NightSky<double>(less).light(SkyView<double>(less).at(x, y));
        for (int c = 0; c < 3; ++c) {
          const double difference = (up[c] - down[c]) / (2.0 * step);
          error += std::pow(exact[c].d.t[k] - difference, 2);
          size += difference * difference;
        }
      }
    EXPECT_GT(size, 0.0) << k;
    EXPECT_LT(std::sqrt(error / size), 1e-6) << k;
  }
}

TEST(NightSky, PictureIsTheLightAtThePixelsCentres) {
  const Scene scene = sky_scene();
  const Image one = night_sky_light(scene, 1), two = night_sky_light(scene, 2);
  EXPECT_EQ(one.data, two.data);
  const auto light = NightSky<double>(scene).light(SkyView<double>(scene).at(12.5, 40.5));
  for (int c = 0; c < 3; ++c) EXPECT_EQ(one.at(12, 40, c), static_cast<float>(light[c]));
}

}  // namespace
}  // namespace vegard::sim::night_sky_test
