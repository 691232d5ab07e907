#include "apps/options/refusals.h"

#include "sim/scene/structs/line_of.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::apps {

sim::Error with_place(const sim::Error& error, const sim::Scene& scene) {
  sim::ErrorDetails details = error.details();
  if (error.kind() != sim::ErrorKind::scene || details.line != 0) return error;
  if (!details.file.empty() && details.file != scene.file) return error;
  details.file = scene.file;
  details.line = sim::line_of(scene, details.key);
  return sim::Error(error.kind(), details);
}

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
