// Uses a little of both libraries; exit code 0 if each answers as its header says.
#include <cstdio>
#include <string>

#include "fit/photo/photo.h"
#include "fit/ready_scene.h"
#include "sim/base/error.h"
#include "sim/base/picture/image_io.h"
#include "sim/base/version.h"
#include "sim/render/render.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/table/parameter_table.h"

namespace {

int failures = 0;

void expect(bool good, const char* what) {
  if (good) return;
  std::fprintf(stderr, "outside: %s\n", what);
  ++failures;
}

void use_sim() {
  using namespace vegard::sim;
  expect(!version().empty(), "there is no version");
  Scene scene = parse_scene(
      "camera = { width = 48, height = 32 }\nsheet = [{ name = \"main\", beams = 100 }]\n", "outside.toml");
  set_from_text(scene, "sheet.main.energy_kev", "4");
  vegard::fit::make_ready(scene);
  expect(scene.sheets.front().energy_kev == 4.0, "a parameter is not set");
  const Rendering picture = render(scene);  // by the emission tables in the library
  expect(picture.rgb.width == 48 && picture.deflection_points > 0, "nothing is rendered");
  const Image grey(2, 2, {"Y"});
  expect(!encode_display(ImageFormat::png, grey, 8, 0, {}).empty(), "no picture comes out");
  try {
    image_format("picture.bmp");
    expect(false, "an unknown format is accepted");
  } catch (const Error& error) {
    expect(error.kind() == ErrorKind::usage, "errors have changed their kind on the way");
  }
}

void use_fit() {
  using namespace vegard;
  const std::string bytes = sim::encode_display(sim::ImageFormat::png, sim::Image(4, 3, {"R", "G", "B"}), 8, 0, {});
  const fit::Photo photo = fit::read_photo_bytes(bytes, "photo.png", fit::Decoding::automatic);
  expect(photo.linear.width == 4 && photo.linear.height == 3, "a photograph is read otherwise");
}

}  // namespace

int main() {
  use_sim();
  use_fit();
  return failures == 0 ? 0 : 1;
}
