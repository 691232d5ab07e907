#include "sim/scene/structs/error_place.h"

#include "sim/scene/structs/line_of.h"

namespace vegard::sim {

Error with_place(const Error& error, const Scene& scene) {
  ErrorDetails details = error.details();
  if (error.kind() != ErrorKind::scene || details.line != 0) return error;
  if (!details.file.empty() && details.file != scene.file) return error;
  details.file = scene.file;
  details.line = line_of(scene, details.key);
  return Error(error.kind(), details);
}

}  // namespace vegard::sim
