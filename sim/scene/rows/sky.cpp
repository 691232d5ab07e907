// What else is in the picture: [sky], [stars], [moon], [ground], [composite], and the lights of the night
// sky: [air], [airglow], [twilight], [light_pollution].
#include "sim/scene/rows/row.h"

namespace vegard::sim {
namespace {

constexpr double kCatalogueEnds_mag = 6.0;  // data/stars/README.md

bool is_beyond_catalogue(const Stars& stars) {
  return stars.source == StarSource::catalogue && stars.faintest_magnitude > kCatalogueEnds_mag;
}

Row<LowerAir> air(const char* key, double LowerAir::*value) {
  return Row("air", key, &Scene::air, value)
      .inert_if([](const LowerAir& lower) { return lower.model == AirModel::none; }, "there is no air",
                "set air.model to \"standard\"");
}

}  // namespace

std::vector<Declaration> sky_rows() {
  // clang-format off
  return {
      Row("sky", "level", &Scene::sky, &Sky::level).of({"red", "green", "blue"}).within(-1e6, 1e6)
          .means("brightness, mean over the picture's height, linear"),
      Row("sky", "gradient", &Scene::sky, &Sky::gradient).of({"red", "green", "blue"}).within(-1e6, 1e6)
          .means("brightness at the bottom less that at the top"),
      Row("sky", "curvature", &Scene::sky, &Sky::curvature).of({"red", "green", "blue"}).within(-1e6, 1e6)
          .means("four times the excess of top and bottom over the middle"),
      Row("sky", "lights_gain", &Scene::sky, &Sky::lights_gain).within(0, 1e12)
          .means("factor on airglow, twilight and light pollution; in best.toml the gain's ratio"),

      Row("stars", "shown", &Scene::stars, &Stars::shown).means("stars behind the aurora"),
      Row("stars", "source", &Scene::stars, &Stars::source).one_of<StarSource>({{"random", StarSource::random}, {"catalogue", StarSource::catalogue}})
          .means("at random, or the catalogue's at the site and its time"),
      Row("stars", "planets", &Scene::stars, &Stars::planets).means("Mercury to Saturn at the site and its time"),
      Row("stars", "milky_way", &Scene::stars, &Stars::milky_way).means("the unresolved light of faint stars"),
      Row("stars", "faintest_magnitude", &Scene::stars, &Stars::faintest_magnitude).in("mag").within(-2, 12)
          .means("of the stars that are shown")
          .noted_if(is_beyond_catalogue, "the catalogue's stars end at V = 6, so none that is fainter is shown; stars.source = \"random\" has them"),
      Row("stars", "width_deg", &Scene::stars, &Stars::width_deg).in("deg").within(0.0001, 5)
          .means("standard deviation of an image"),
      Row("stars", "gain", &Scene::stars, &Stars::gain).within(0, 1e6).means("times photometric brightness"),
      Row("stars", "sphere_distance", &Scene::stars, &Stars::sphere_distance).within(0, 1000)
          .means("of the spheres that are a solar grid's stars, in the Sun's distances; 0: none"),

      Row("moon", "shown", &Scene::moon, &Moon::shown).means("disc with its phase, at the site and its time"),
      Row("moon", "skylight", &Scene::moon, &Moon::skylight).means("the light that the air scatters, and on the ground the Moon's own"),

      Row("ground", "shown", &Scene::ground, &Ground::shown)
          .means("snow, trees and hills, lit by the sky, and light that air scatters"),
      Row("ground", "albedo", &Scene::ground, &Ground::albedo).within(0, 1)
          .means("fresh snow 0.8–0.9, bare ground 0.2"),

      Row("composite", "background", &Scene::composite, &Composite::background).names_file()
          .means("picture behind the aurora"),
      Row("composite", "background_gain", &Scene::composite, &Composite::background_gain).within(0, 1e6)
          .means("in linear light"),
      Row("composite", "foreground", &Scene::composite, &Composite::foreground).names_file()
          .means("picture before the aurora"),
      Row("composite", "foreground_gain", &Scene::composite, &Composite::foreground_gain).within(0, 1e6)
          .means("in linear light"),
      Row("composite", "mask", &Scene::composite, &Composite::mask).names_file()
          .means("picture, white where the foreground hides the sky; empty: the foreground's alpha"),
  };
  // clang-format on
}

std::vector<Declaration> night_sky_rows() {
  // clang-format off
  return {
      Row("air", "model", &Scene::air, &LowerAir::model).one_of<AirModel>({{"none", AirModel::none}, {"standard", AirModel::standard}})
          .means("extinction: none, or by molecules, aerosol and ozone"),
      air("aerosol_optical_depth", &LowerAir::aerosol_optical_depth).as(ParameterRole::aerosol_depth).within(0, 5).may_be_free(ParameterScale::logarithmic)
          .means("at 550 nm at the zenith; 0.05 very clear, 0.3 hazy"),
      air("angstrom_exponent", &LowerAir::angstrom_exponent).as(ParameterRole::angstrom_exponent).within(-1, 4).may_be_free(ParameterScale::linear)
          .means("of the aerosol: 1.3 on average, near 0 for sea salt and dust"),
      air("aerosol_height_km", &LowerAir::aerosol_height_km).in("km").within(0.3, 10)
          .means("its scale height"),
      air("ozone_dobson", &LowerAir::ozone_dobson).in("DU").within(0, 1000)
          .means("Chappuis band, green to red"),

      Row("airglow", "green_rayleigh", &Scene::airglow, &Airglow::green_rayleigh).called("green light").as(ParameterRole::green_airglow).in("R").within(0, 1e5).may_be_free(ParameterScale::linear)
          .means("557.7 nm at the zenith, at 97 km (Paranal: 163)"),
      Row("airglow", "red_rayleigh", &Scene::airglow, &Airglow::red_rayleigh).called("red light").as(ParameterRole::red_airglow).in("R").within(0, 1e5).may_be_free(ParameterScale::linear)
          .means("630.0 nm at the zenith, at 250 km (Paranal: 120)"),
      Row("airglow", "sodium_rayleigh", &Scene::airglow, &Airglow::sodium_rayleigh).called("sodium light").as(ParameterRole::sodium_airglow).in("R").within(0, 1e5).may_be_free(ParameterScale::linear)
          .means("589.3 nm at the zenith, at 92 km (Paranal: 37)"),

      Row("twilight", "shown", &Scene::twilight, &Twilight::shown).means("light of a Sun below the horizon"),
      Row("twilight", "sun", &Scene::twilight, &Twilight::sun).one_of<TwilightSun>({{"given", TwilightSun::given}, {"time", TwilightSun::of_time}})
          .means("its position: as given below, or from site and time"),
      Row("twilight", "sun_elevation_deg", &Scene::twilight, &Twilight::sun_elevation_deg).in("deg").within(-15, -5)
          .means("within the range of the measurements"),
      Row("twilight", "sun_azimuth_deg", &Scene::twilight, &Twilight::sun_azimuth_deg).in("deg").within(-720, 720)
          .means("of the Sun"),
      Row("twilight", "contrast", &Scene::twilight, &Twilight::contrast).within(1, 1000)
          .means("brightness of the horizon under the Sun over the zenith's"),

      Row("light_pollution", "luminance_mcd_m2", &Scene::light_pollution, &LightPollution::luminance_mcd_m2).as(ParameterRole::town_light).in("mcd m⁻²")
          .within(0, 1e5).may_be_free(ParameterScale::linear)
          .means("at the horizon towards a town; natural night sky: 0.2"),
      Row("light_pollution", "azimuth_deg", &Scene::light_pollution, &LightPollution::azimuth_deg).in("deg").within(-720, 720)
          .means("of the town, from north to the east"),
      Row("light_pollution", "height_deg", &Scene::light_pollution, &LightPollution::height_deg).in("deg").within(0.5, 90)
          .means("elevation at which its glow is 1/e"),
      Row("light_pollution", "spread_deg", &Scene::light_pollution, &LightPollution::spread_deg).in("deg").within(1, 1000)
          .means("standard deviation of its glow in azimuth"),
      Row("light_pollution", "colour_temperature_k", &Scene::light_pollution, &LightPollution::colour_temperature_k).in("K")
          .within(1000, 20000)
          .means("of its lamps: sodium 2000, white 3000–5000"),
  };
  // clang-format on
}

}  // namespace vegard::sim
