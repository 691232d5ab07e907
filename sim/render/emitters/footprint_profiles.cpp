#include "sim/render/emitters/footprint_profiles.h"

#include "sim/view/colour/line_colours.h"

namespace vegard::sim {

ColourLadder colour_ladder(const Scene& scene, const Footprint& f) {
  std::vector<std::array<double, 3>> of_line;
  for (const Vector3& colour : line_colours_at_unit_gain(scene))
    of_line.push_back({colour[0], colour[1], colour[2]});
  return {line_amounts(of_line, f.low_colour), line_amounts(of_line, f.high_colour), f.low_km, f.high_km};
}

ProfileTable footprint_profiles(const Scene& scene, const Footprint& f, double ln_least, double ln_most) {
  const ProfileTable usual = profile_table(scene.emission.lines, scene, f, ln_least, ln_most);
  return f.light == FootprintLight::colours ? colours_table(usual, colour_ladder(scene, f)) : usual;
}

}  // namespace vegard::sim
