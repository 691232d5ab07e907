#include "fit/photo/pointing/scene_camera.h"

#include <charconv>
#include <cmath>
#include <system_error>

#include "fit/photo/pointing/direction_error.h"
#include "fit/photo/pointing/held_out.h"
#include "sim/base/file/csv_table.h"
#include "sim/base/file/number_text.h"
#include "sim/base/number/constants.h"
#include "sim/base/version.h"
#include "sim/scene/file/closing_line.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::fit {
namespace {

std::string line(const std::string& key, const std::string& value, const std::string& comment = {}) {
  return key + " = " + value + (comment.empty() ? "" : "  # " + comment) + "\n";
}

/// TOML's numbers: a real has a point or an exponent.
std::string real(double value) {
  std::string text = sim::csv_number(value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

std::string quoted(const std::string& words) {
  std::string out = "\"";
  for (const char c : words)
    if (c != '"' && c != '\\' && static_cast<unsigned char>(c) >= 0x20) out += c;
  return out + '"';
}

/// True if a number has its default value.
bool is_default(const CameraEstimate& estimate) {
  return estimate.id.role() == sim::ParameterRole::lens_aspect ? estimate.value == 1.0
                                                               : estimate.value == 0.0;
}

std::string in_one_line(const std::string& words) {
  std::string out = words;
  for (char& c : out)
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  return out;
}

}  // namespace

SkyCamera sky_camera_of(const sim::Camera& camera, const Frame& frame) {
  SkyCamera sky;
  sky.model = camera.model;
  sky.mirrored = camera.mirrored;
  sky.camera_from_enu = rotation_of(camera.azimuth_deg, camera.elevation_deg, camera.roll_deg);
  auto& n = sky.numbers;
  n[focal_px_number] = sky.model == sim::LensModel::pinhole
                           ? 0.5 * camera.width / std::tan(0.5 * camera.hfov_deg * sim::kRadiansPerDegree)
                           : camera.focal_px;
  n[centre_x_number] = 0.5 * frame.width_px + camera.principal_x_px;
  n[centre_y_number] = 0.5 * frame.height_px + camera.principal_y_px;
  n[aspect_ratio_number] = camera.aspect;
  n[radial_1_number] = camera.k1;
  n[radial_2_number] = camera.k2;
  n[radial_3_number] = camera.k3;
  n[decentring_1_number] = camera.p1;
  n[decentring_2_number] = camera.p2;
  return sky;
}

sim::Camera scene_camera_of(const Calibration& calibration) {
  const SkyCamera& sky = calibration.camera;
  const auto& n = sky.numbers;
  const Frame& frame = calibration.frame;
  sim::Camera camera;
  camera.model = sky.model;
  camera.mirrored = sky.mirrored;
  camera.width = frame.width_px;
  camera.height = frame.height_px;
  camera.azimuth_deg = calibration.pointing.azimuth_deg;
  camera.elevation_deg = calibration.pointing.elevation_deg;
  camera.roll_deg = calibration.pointing.roll_deg;
  if (sky.model == sim::LensModel::pinhole)
    camera.hfov_deg = 2.0 * std::atan(0.5 * frame.width_px / n[focal_px_number]) / sim::kRadiansPerDegree;
  else
    camera.focal_px = n[focal_px_number];
  camera.principal_x_px = n[centre_x_number] - 0.5 * frame.width_px;
  camera.principal_y_px = n[centre_y_number] - 0.5 * frame.height_px;
  camera.aspect = n[aspect_ratio_number];
  camera.k1 = n[radial_1_number];
  camera.k2 = n[radial_2_number];
  camera.k3 = n[radial_3_number];
  camera.p1 = n[decentring_1_number];
  camera.p2 = n[decentring_2_number];
  return camera;
}

std::optional<double> direction_error_deg_in(std::string_view camera_toml) {
  const std::string_view before = kDirectionsKnown, unit = " deg";
  // Maps have errors of their own, which their points do not tell.
  if (camera_toml.find("# A camera found from its stars") == std::string_view::npos) return std::nullopt;
  const std::size_t at = camera_toml.find(std::string("# ") + kDirectionsKnown);
  if (at == std::string_view::npos) return std::nullopt;
  const char* const begin = camera_toml.data() + at + 2 + before.size();
  double error_deg = 0.0;
  const auto [end, problem] = std::from_chars(begin, camera_toml.data() + camera_toml.size(), error_deg);
  const bool has_unit =
      camera_toml.substr(static_cast<std::size_t>(end - camera_toml.data()), unit.size()) == unit;
  if (problem != std::errc() || !has_unit || !(error_deg > 0.0)) return std::nullopt;
  return error_deg;
}

std::string camera_toml(const Calibration& calibration, const CalibrationOrigin& origin) {
  const bool stars = calibration.evidence == CalibrationEvidence::stars;
  std::string text = std::string("# A camera found from ") + (stars ? "its stars" : "maps of directions") +
                     " by vegard " + sim::version() + ".\n";
  text += (stars ? "# stars: " : "# maps: ") + in_one_line(origin.stars) + ", " +
          std::to_string(calibration.used()) + " of " + std::to_string(calibration.stars.size()) +
          (stars ? " used\n" : " points used\n");
  if (!origin.image.empty()) text += "# picture: " + in_one_line(origin.image) + "\n";
  if (origin.same_lens > 1)
    text += "# its lens is that of " + std::to_string(origin.same_lens) + " pictures together\n";
  for (const std::string& words : origin.from_photograph)
    text += "# from the photograph: " + in_one_line(words) + "\n";
  if (origin.instant) text += "# " + in_one_line(words_of(*origin.instant)) + "\n";
  text += "# lens: " + words_of(calibration.form) +
          (calibration.candidates.size() > 1
               ? ", by BIC from " + std::to_string(calibration.candidates.size()) + " lenses\n"
               : "\n");
  text +=
      "# rms " + sim::short_number(calibration.rms_px, 4) + " px (sqrt of the mean of dx^2 + dy^2)" +
      (stars ? ", each star by a fit without it " + sim::short_number(calibration.without_rms_px, 4) + " px\n"
             : "\n");
  if (stars) text += "# " + held_out_line(calibration) + "\n";
  if (const std::string points = explained_line(calibration); !points.empty()) text += "# " + points + "\n";
  if (calibration.maps) text += "# " + words_of(*calibration.maps) + "\n";
  text += "# the axis is known to " + sim::short_number(calibration.line_of_sight_sigma_deg, 2) +
          " deg, the turn about it to " + sim::short_number(calibration.twist_sigma_deg, 2) + " deg\n";
  text += "# " + words_of(direction_errors(calibration)) + "\n";
  for (const std::string& warning : calibration.warnings) text += "# " + in_one_line(warning) + "\n";
  text += "# Behind each number that was fitted: its standard deviation.\n\n";
  if (origin.site_known) {
    text += "[site]\n";
    text += line("latitude_deg", real(origin.site.latitude_deg));
    text += line("longitude_deg", real(origin.site.longitude_deg));
    text += line("altitude_m", real(origin.site.altitude_m));
    if (!origin.site.time_utc.empty()) text += line("time_utc", quoted(origin.site.time_utc));
    text += "\n";
  }
  text += "[camera]\n";
  text += line("model", quoted(sim::word_of(calibration.camera.model)));
  text += line("width", std::to_string(calibration.frame.width_px),
               calibration.frame.known ? "" : "guessed from where the stars are");
  text +=
      line("height", std::to_string(calibration.frame.height_px), calibration.frame.known ? "" : "likewise");
  for (const CameraEstimate& estimate : calibration.estimates) {
    if (!estimate.free && is_default(estimate)) continue;
    text += line(estimate.key(), real(estimate.value),
                 estimate.free ? "± " + sim::short_number(estimate.sigma, 2) : "held");
  }
  if (calibration.camera.mirrored) text += line("mirrored", "true");
  return sim::with_closing_line(text);
}

}  // namespace vegard::fit
