#include "apps/options/refusals.h"

#include "sim/scene/table/parameter_table.h"

namespace vegard::apps {

void require_rayleighs(const sim::Scene& scene, const std::string& what) {
  if (scene.film.weight == sim::PointWeight::rayleigh) return;
  sim::ErrorDetails details;
  details.key = "film.weight";
  details.problem =
      "points of " + sim::word_of(scene.film.weight) + " weight are no rayleighs, which " + what + " needs";
  details.expected = "\"rayleigh\"";
  throw with_place(sim::Error(sim::ErrorKind::scene, details), scene);
}

}  // namespace vegard::apps
