// What the air takes from the light and what the night sky adds: [air], [airglow], [twilight],
// [light_pollution].
#include "sim/scene/table/rows/row.h"
#include "sim/scene/table/rows/rows.h"

namespace vegard::sim {
std::vector<Declaration> night_sky_rows() {
  // clang-format off
  return {
      Row("air", "model", &Scene::air, &LowerAir::model).one_of({"none", "standard"})
          .means("what light loses in the air: nothing, or by molecules, aerosol and ozone as far as it passes them"),
      Row("air", "aerosol_optical_depth", &Scene::air, &LowerAir::aerosol_optical_depth).within(0, 5).may_be_free(ParameterScale::logarithmic)
          .means("of the aerosol from sea level to the zenith at 550 nm; 0.05 is very clear, 0.3 hazy"),
      Row("air", "angstrom_exponent", &Scene::air, &LowerAir::angstrom_exponent).within(-1, 4).may_be_free(ParameterScale::linear)
          .means("of the aerosol's optical depth against wavelength: 1.3 on average, near 0 for sea salt and dust"),
      Row("air", "aerosol_height_km", &Scene::air, &LowerAir::aerosol_height_km).in("km").within(0.3, 10)
          .means("scale height of the aerosol"),
      Row("air", "ozone_dobson", &Scene::air, &LowerAir::ozone_dobson).in("DU").within(0, 1000)
          .means("column of ozone, whose Chappuis band takes from green to red"),

      Row("airglow", "green_rayleigh", &Scene::airglow, &Airglow::green_rayleigh).in("R").within(0, 1e5).may_be_free(ParameterScale::linear)
          .means("zenith airglow of 557.7 nm, at 97 km; 0: none; 163 at Paranal in the mean"),
      Row("airglow", "red_rayleigh", &Scene::airglow, &Airglow::red_rayleigh).in("R").within(0, 1e5).may_be_free(ParameterScale::linear)
          .means("zenith airglow of 630.0 nm, at 250 km; 0: none; some 120 at Paranal in the mean, fewer at high latitudes"),
      Row("airglow", "sodium_rayleigh", &Scene::airglow, &Airglow::sodium_rayleigh).in("R").within(0, 1e5).may_be_free(ParameterScale::linear)
          .means("zenith airglow of both sodium lines, 589.3 nm, at 92 km; 0: none; 37 at Paranal in the mean"),

      Row("twilight", "shown", &Scene::twilight, &Twilight::shown).means("whether there is the light of a sun below the horizon"),
      Row("twilight", "sun_elevation_deg", &Scene::twilight, &Twilight::sun_elevation_deg).in("deg").within(-15, -5)
          .means("of the sun, between which elevations the twilight sky was measured"),
      Row("twilight", "sun_azimuth_deg", &Scene::twilight, &Twilight::sun_azimuth_deg).in("deg").within(-720, 720)
          .means("of the sun, from north to the east"),
      Row("twilight", "contrast", &Scene::twilight, &Twilight::contrast).within(1, 1000)
          .means("how much brighter the horizon under the sun is than the zenith"),

      Row("light_pollution", "luminance_mcd_m2", &Scene::light_pollution, &LightPollution::luminance_mcd_m2).in("mcd m⁻²")
          .within(0, 1e5).may_be_free(ParameterScale::linear)
          .means("of the sky at the horizon towards a town; 0: none; 0.2 is the natural night sky"),
      Row("light_pollution", "azimuth_deg", &Scene::light_pollution, &LightPollution::azimuth_deg).in("deg").within(-720, 720)
          .means("of the town, from north to the east"),
      Row("light_pollution", "height_deg", &Scene::light_pollution, &LightPollution::height_deg).in("deg").within(0.5, 90)
          .means("elevation at which its glow has fallen to 1 / e"),
      Row("light_pollution", "spread_deg", &Scene::light_pollution, &LightPollution::spread_deg).in("deg").within(1, 1000)
          .means("standard deviation of its glow in azimuth"),
      Row("light_pollution", "colour_temperature_k", &Scene::light_pollution, &LightPollution::colour_temperature_k).in("K")
          .within(1000, 20000)
          .means("of its lamps: 2000 for sodium, 3000 to 5000 for white ones"),
  };
  // clang-format on
}

}  // namespace vegard::sim
