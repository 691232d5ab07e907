#include "apps/options/refusals.h"

#include "sim/scene/table/parameter_table.h"

namespace vegard::apps {

void require_rayleighs(const sim::Scene& scene, const std::string& what) {
  if (scene.film.weight == sim::PointWeight::rayleigh) return;
  throw with_place(sim::Error(sim::ErrorKind::scene, "points of " + sim::word_of(scene.film.weight) +
                                                         " weight are no rayleighs, which " + what + " needs")
                       .key("film.weight")
                       .expected("\"rayleigh\""),
                   scene);
}

}  // namespace vegard::apps
