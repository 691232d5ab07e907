#include "sim/scene/file/camera_file.h"

#include "sim/base/error.h"
#include "sim/base/text.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::sim {

void take_camera(Scene& scene, const std::string& camera_file) {
  const Scene given = read_scene(camera_file);
  if (given.lines.empty()) {
    throw Error(ErrorKind::scene, "there is no camera in it")
        .file(camera_file)
        .expected("[camera] and [site]")
        .hint("vegard calibrate and vegard horizon write such files");
  }
  if (!given.keys.empty())
    throw Error(ErrorKind::scene, "a camera's file has [[key]], and its camera would move")
        .file(camera_file)
        .line(given.keys.front().line)
        .expected("[camera] and [site]");
  bool has_camera = false;
  for (const auto& [path, line] : given.lines) {
    has_camera = has_camera || starts_with(path, "camera.");
    if (starts_with(path, "camera.") || starts_with(path, "site.")) continue;
    throw Error(ErrorKind::scene, "a camera's file says more than its camera")
        .file(camera_file)
        .line(line)
        .key(path)
        .expected("[camera] and [site]");
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
