#include "fit/radar/radar_refusal.h"

#include "sim/base/error.h"

namespace vegard::fit {

void refuse_radars(const sim::Scene& scene, const std::string& what) {
  if (scene.fit.radars.empty()) return;
  throw sim::Error(sim::ErrorKind::scene, what + " does not compare a radar's densities")
      .file(scene.file)
      .line(scene.fit.radars.front().line)
      .key("fit.radar")
      .expected("a scene without [[fit.radar]]")
      .hint("vegard fit compares them");
}

}  // namespace vegard::fit
