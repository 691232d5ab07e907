#include "sim/scene/file/camera_file.h"

#include "sim/base/error.h"
#include "sim/base/text.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::sim {

void take_camera(Scene& scene, const std::string& camera_file) {
  const Scene given = read_scene(camera_file);
  if (given.lines.empty()) {
    ErrorDetails details;
    details.file = camera_file;
    details.problem = "there is no camera in it";
    details.expected = "[camera] and [site]";
    details.hint = "vegard calibrate and vegard horizon write such files";
    throw Error(ErrorKind::scene, details);
  }
  bool has_camera = false;
  for (const auto& [path, line] : given.lines) {
    has_camera = has_camera || starts_with(path, "camera.");
    if (starts_with(path, "camera.") || starts_with(path, "site.")) continue;
    ErrorDetails details;
    details.file = camera_file;
    details.line = line;
    details.key = path;
    details.problem = "a camera's file says more than its camera";
    details.expected = "[camera] and [site]";
    throw Error(ErrorKind::scene, details);
  }
  // A lens is one thing: what the file does not say is at its default, not the scene's.
  if (has_camera) scene.camera = given.camera;
  for (const auto& [path, line] : given.lines) {
    if (starts_with(path, "site."))
      set_from_text(scene, path, value_text(given, resolve(given, path).front()));
    scene.lines[path] = 0;  // it was given, but in no line of the scene's own file
  }
}

}  // namespace vegard::sim
