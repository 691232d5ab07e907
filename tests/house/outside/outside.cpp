// Uses a little of both libraries; exit code 0 if each answers as its header says.
#include <cmath>
#include <cstdio>
#include <string>

#include "fit/measure/profile.h"
#include "sim/base/embedded_table.h"
#include "sim/base/error.h"
#include "sim/base/picture/image_io.h"
#include "sim/render/render.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/view/sensor/transfer_curve.h"

namespace {

int failures = 0;

void expect(bool good, const char* what) {
  if (good) return;
  std::fprintf(stderr, "outside: %s\n", what);
  ++failures;
}

void use_sim() {
  using namespace vegard::sim;
  expect(!embedded_table("emission/ver_maxwellian.csv").empty(), "the emission tables are not in the library");
  expect(std::abs(srgb_encode(0.18) - 0.461356) < 1e-6, "the transfer curve is wrong");
  const Scene scene = parse_scene(
      "camera = { width = 48, height = 32 }\nsheet = [{ name = \"main\", beams = 100 }]\n", "outside.toml");
  const Rendering picture = render(scene);
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
  using namespace vegard::fit;
  Profile profile;
  profile.bands = 2;
  profile.rows = 5;
  expect(band_begin({10, 0, 60, 5}, 2, 1) == 40, "bands begin elsewhere");
  expect(profile.index(1, 4, 2) == 29, "profiles are indexed otherwise");
}

}  // namespace

int main() {
  use_sim();
  use_fit();
  return failures == 0 ? 0 : 1;
}
