// What else is in the picture: [sky], [stars], [composite].
#include "sim/scene/rows/row.h"
#include "sim/scene/rows/rows.h"

namespace vegard::sim {
std::vector<Declaration> sky_rows() {
  // clang-format off
  return {
      Row("sky", "level", &Scene::sky, &Sky::level).of({"red", "green", "blue"}).within(-1e6, 1e6)
          .means("light behind the aurora, mean over the image's height, linear sensor value"),
      Row("sky", "gradient", &Scene::sky, &Sky::gradient).of({"red", "green", "blue"}).within(-1e6, 1e6)
          .means("how much brighter the sky is at the image's bottom than at its top, linear sensor value"),
      Row("sky", "curvature", &Scene::sky, &Sky::curvature).of({"red", "green", "blue"}).within(-1e6, 1e6)
          .means("bend of the sky's brightness: four times what top and bottom exceed the middle by"),
      Row("sky", "lights_gain", &Scene::sky, &Sky::lights_gain).within(0, 1e12)
          .means("times airglow, twilight and light pollution; a fit writes here by how much its gain is not "
                 "gain_per_kilorayleigh"),

      Row("stars", "shown", &Scene::stars, &Stars::shown).means("whether there are stars behind the aurora"),
      Row("stars", "faintest_magnitude", &Scene::stars, &Stars::faintest_magnitude).in("mag").within(-2, 12)
          .means("of the stars that are shown"),
      Row("stars", "width_deg", &Scene::stars, &Stars::width_deg).in("deg").within(0.0001, 5)
          .means("standard deviation of a star's image"),
      Row("stars", "gain", &Scene::stars, &Stars::gain).within(0, 1e6).means("times the stars' photometric brightness"),

      Row("composite", "background", &Scene::composite, &Composite::background).names_file()
          .means("picture behind the aurora, beside the scene's file; empty: none"),
      Row("composite", "background_gain", &Scene::composite, &Composite::background_gain).within(0, 1e6)
          .means("of the background, in linear light"),
      Row("composite", "foreground", &Scene::composite, &Composite::foreground).names_file()
          .means("picture before the aurora, beside the scene's file; empty: none"),
      Row("composite", "foreground_gain", &Scene::composite, &Composite::foreground_gain).within(0, 1e6)
          .means("of the foreground, in linear light"),
      Row("composite", "mask", &Scene::composite, &Composite::mask).names_file()
          .means("picture that is white where the foreground hides the sky; empty: the foreground's alpha"),
  };
  // clang-format on
}

}  // namespace vegard::sim
