// [sensor]: from light to numbers.
#include <algorithm>

#include "sim/scene/camera_responses.h"
#include "sim/scene/nearest_name.h"
#include "sim/scene/rows/row.h"
#include "sim/scene/rows/rows.h"
#include "sim/scene/table_files.h"

namespace vegard::sim {
namespace {

std::optional<Complaint> response_complaint(const std::string& response) {
  std::vector<std::string> names = built_in_cameras();
  names.insert(names.begin(), "cie");
  if (is_table_file(response) || std::find(names.begin(), names.end(), response) != names.end())
    return std::nullopt;
  std::string expected;
  for (const std::string& name : names) expected += "\"" + name + "\", ";
  const std::string nearest = nearest_name(response, names);
  return Complaint{"\"" + response + "\" is no camera that is built in", expected + "or a table \"FILE.csv\"",
                   is_near(response, nearest) ? "did you mean \"" + nearest + "\"?" : ""};
}

}  // namespace

std::vector<Declaration> sensor_rows() {
  // clang-format off
  return {
      Row("sensor", "primaries", &Scene::sensor, &Sensor::primaries).one_of({"srgb", "smpte-c", "rec2020", "acescg"})
          .means("colour primaries of the image"),
      Row("sensor", "gain_per_kilorayleigh", &Scene::sensor, &Sensor::gain_per_kilorayleigh).within(1e-12, 1e12)
          .means("linear sensor value (white = 1) of the luminance of 1 kR of 557.7 nm; with a camera's response, of its raw green"),
      Row("sensor", "response", &Scene::sensor, &Sensor::response).names_table().rule(response_complaint)
          .means("what makes colours of light: `cie` (the 1931 observer), a built-in camera (`canon_5d_mark_ii`, `nikon_d200`, `nikon_d700`, `sony_a7s_ii`) or a table `FILE.csv` of wavelength_nm, red, green, blue beside the scene's file"),
      Row("sensor", "response_per", &Scene::sensor, &Sensor::response_per).one_of({"energy", "photon"})
          .means("what the numbers of a table `FILE.csv` are relative to"),
      Row("sensor", "white_balance_rule", &Scene::sensor, &Sensor::white_balance_rule).one_of({"given", "daylight"})
          .means("of a camera: `given` (white_balance) or `daylight` (gains that make D65 light neutral)"),
      Row("sensor", "white_balance", &Scene::sensor, &Sensor::white_balance).of({"red", "green", "blue"}).within(1e-6, 1e6)
          .means("given gains of a camera's raw channels"),
      Row("sensor", "matrix_rule", &Scene::sensor, &Sensor::matrix_rule).one_of({"none", "colorimetric", "given"})
          .means("from a camera's balanced channels to the primaries: `none` (they stay as they are), `colorimetric` (least squares, see physics.md) or `given` (matrix)"),
      Row("sensor", "matrix", &Scene::sensor, &Sensor::matrix).of({"rr", "rg", "rb", "gr", "gg", "gb", "br", "bg", "bb"}).within(-1e6, 1e6)
          .means("the given matrix, by rows: red, green, blue of the picture from red, green, blue of the camera"),
  };
  // clang-format on
}

}  // namespace vegard::sim
