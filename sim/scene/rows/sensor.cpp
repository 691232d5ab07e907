// [sensor]: from light to numbers.
#include <algorithm>

#include "sim/scene/rows/complaint.h"
#include "sim/scene/rows/parameter_rules.h"
#include "sim/scene/rows/row.h"
#include "sim/scene/structs/sensor.h"

namespace vegard::sim {
namespace {

/// A value that is one of the names or a table's file.
std::optional<Complaint> name_complaint(const std::string& value, const std::vector<std::string>& names,
                                        const std::string& problem) {
  if (is_table_file(value) || std::find(names.begin(), names.end(), value) != names.end())
    return std::nullopt;
  std::string expected;
  for (const std::string& name : names) expected += "\"" + name + "\", ";
  const std::string nearest = nearest_name(value, names);
  return Complaint{"\"" + value + "\" is " + problem, expected + "or a table \"FILE.csv\"",
                   is_near(value, nearest) ? "did you mean \"" + nearest + "\"?" : ""};
}

std::optional<Complaint> response_complaint(const std::string& response) {
  std::vector<std::string> names = built_in_cameras();
  names.insert(names.begin(), {"cie", "filters", "grey"});
  return name_complaint(response, names, "no camera that is built in");
}

std::optional<Complaint> colour_table_complaint(const std::string& table) {
  return name_complaint(table, {"none", "171", "195", "284", "304"}, "no false colour that is built in");
}

}  // namespace

std::vector<Declaration> sensor_rows() {
  // clang-format off
  return {
      Row("sensor", "primaries", &Scene::sensor, &Sensor::primaries).one_of<Primaries>({{"srgb", Primaries::srgb}, {"smpte-c", Primaries::smpte_c}, {"rec2020", Primaries::rec2020}, {"acescg", Primaries::acescg}})
          .means("of the image"),
      Row("sensor", "gain_per_kilorayleigh", &Scene::sensor, &Sensor::gain_per_kilorayleigh).within(1e-12, 1e12)
          .means("of 557.7 nm (white = 1): luminance, or a camera's raw green"),
      Row("sensor", "response", &Scene::sensor, &Sensor::response).names_table().rule(response_complaint)
          .means("`cie` (1931 observer), `filters` (the first three emission.lines), `grey` (all photons alike), `canon_5d_mark_ii`, `nikon_d200`, `nikon_d700`, `sony_a7s_ii`, or `FILE.csv` of wavelength_nm, red, green, blue"),
      Row("sensor", "response_per", &Scene::sensor, &Sensor::response_per).one_of<ResponsePer>({{"energy", ResponsePer::energy}, {"photon", ResponsePer::photon}})
          .means("of the numbers of a `FILE.csv`"),
      Row("sensor", "white_balance_rule", &Scene::sensor, &Sensor::white_balance_rule).one_of<WhiteBalanceRule>({{"given", WhiteBalanceRule::given}, {"daylight", WhiteBalanceRule::daylight}})
          .means("as given, or D65 is neutral"),
      Row("sensor", "white_balance", &Scene::sensor, &Sensor::white_balance).of({"red", "green", "blue"}).within(1e-6, 1e6)
          .means("of a camera's raw channels"),
      Row("sensor", "matrix_rule", &Scene::sensor, &Sensor::matrix_rule).one_of<MatrixRule>({{"none", MatrixRule::none}, {"colorimetric", MatrixRule::colorimetric}, {"given", MatrixRule::given}})
          .means("camera channels to primaries: not, by least squares (docs/optics.md), or by matrix"),
      Row("sensor", "matrix", &Scene::sensor, &Sensor::matrix).of({"rr", "rg", "rb", "gr", "gg", "gb", "br", "bg", "bb"}).within(-1e6, 1e6)
          .means("from camera to picture channels, by rows"),
      Row("sensor", "exposure", &Scene::sensor, &Sensor::exposure).one_of<ExposureRule>({{"gain", ExposureRule::gain}, {"camera", ExposureRule::camera}})
          .means("by gain_per_kilorayleigh, or by lens, pixel, time.exposure_s and iso"),
      Row("sensor", "f_number", &Scene::sensor, &Sensor::f_number).within(0.5, 64)
          .means("for \"camera\""),
      Row("sensor", "lens_transmission", &Scene::sensor, &Sensor::lens_transmission).within(0.01, 1)
          .means("of lens and filters"),
      Row("sensor", "pixel_um", &Scene::sensor, &Sensor::pixel_um).in("µm").within(0.5, 100)
          .means("edge of a pixel of the picture"),
      Row("sensor", "quantum_efficiency", &Scene::sensor, &Sensor::quantum_efficiency).within(0.001, 1)
          .means("electrons per photon of 557.7 nm on a green pixel"),
      Row("sensor", "full_well_e", &Scene::sensor, &Sensor::full_well_e).in("electrons").within(10, 1e9)
          .means("of a pixel; white at base_iso"),
      Row("sensor", "iso", &Scene::sensor, &Sensor::iso).within(1, 1e7)
          .means("white is full_well_e·base_iso/iso electrons, for both exposures"),
      Row("sensor", "base_iso", &Scene::sensor, &Sensor::base_iso).within(1, 1e7)
          .means("the ISO at which white fills a pixel"),
      Row("sensor", "read_noise_e", &Scene::sensor, &Sensor::read_noise_e).in("electrons").within(0, 10000)
          .means("of a pixel, standard deviation"),
      Row("sensor", "dark_e_s", &Scene::sensor, &Sensor::dark_e_s).in("electrons s⁻¹").within(0, 1e6)
          .means("of a pixel, over time.exposure_s"),
      Row("sensor", "black_level", &Scene::sensor, &Sensor::black_level).within(0, 0.5)
          .means("number without light, as a fraction of the largest"),
      Row("sensor", "bits", &Scene::sensor, &Sensor::bits).within(8, 16)
          .means("of the analogue-digital converter"),
      Row("sensor", "mosaic", &Scene::sensor, &Sensor::mosaic).one_of<MosaicPattern>({{"rggb", MosaicPattern::rggb}, {"bggr", MosaicPattern::bggr}, {"grbg", MosaicPattern::grbg}, {"gbrg", MosaicPattern::gbrg}, {"none", MosaicPattern::none}})
          .means("of the upper left 2×2 pixels; none: all colours in every pixel"),
      Row("sensor", "vignetting_cos_power", &Scene::sensor, &Sensor::vignetting_cos_power).within(0, 16)
          .means("4: a simple lens; 0: none"),
      Row("sensor", "vignetting", &Scene::sensor, &Sensor::vignetting).of({"r2", "r4", "r6"}).within(-10, 10)
          .means("factor 1+r2·r²+r4·r⁴+r6·r⁶, r = 1 in the corners"),
      Row("sensor", "tone", &Scene::sensor, &Sensor::tone).one_of<ToneKind>({{"srgb", ToneKind::srgb}, {"linear", ToneKind::linear}, {"gamma", ToneKind::gamma}, {"file", ToneKind::file}, {"filmic", ToneKind::filmic}})
          .means("curve of display files; `filmic`: highlights roll off and keep their hue"),
      Row("sensor", "gamma", &Scene::sensor, &Sensor::gamma).within(0.2, 5)
          .means("for \"gamma\": light to the power 1/gamma"),
      Row("sensor", "tone_file", &Scene::sensor, &Sensor::tone_file).names_table()
          .means("for \"file\": CSV of linear and encoded values"),
      Row("sensor", "colour_table", &Scene::sensor, &Sensor::colour_table).names_table().rule(colour_table_complaint)
          .means("false colour of display files: none, 171, 195, 284, 304 (of the Sun, in ångström), or a CSV of grey, red, green, blue"),
      Row("sensor", "calibration_error", &Scene::sensor, &Sensor::calibration_error).within(0, 10)
          .means("relative standard uncertainty of the scale; 0: not calibrated"),
  };
  // clang-format on
}

}  // namespace vegard::sim
