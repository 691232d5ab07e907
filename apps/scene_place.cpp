#include "apps/scene_place.h"

#include "sim/scene/structs/line_of.h"

namespace vegard::apps {

sim::Error with_place(const sim::Error& error, const sim::Scene& scene) {
  sim::ErrorDetails details = error.details();
  if (error.kind() != sim::ErrorKind::scene || details.line != 0) return error;
  if (!details.file.empty() && details.file != scene.file) return error;
  details.file = scene.file;
  details.line = sim::line_of(scene, details.key);
  return sim::Error(error.kind(), details);
}

}  // namespace vegard::apps
