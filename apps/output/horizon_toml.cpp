#include "apps/output/horizon_toml.h"

#include <cmath>
#include <tuple>

#include <fmt/format.h>

#include "apps/output/photo_description.h"
#include "sim/base/error.h"
#include "sim/base/version.h"
#include "sim/scene/rows/value_words.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::apps {
namespace {

std::string line(const std::string& key, const std::string& value, const std::string& from) {
  return key + " = " + value + "  # " + comment_words(from) + "\n";
}

/// With a point, as TOML wants its real numbers, and no "-0".
std::string real(double value) { return fmt::format("{:.6f}", std::abs(value) < 5e-7 ? 0.0 : value); }

std::string with_error(const fit::ErrorBar& bar, const std::string& from) {
  return bar.sigma > 0.0 ? fmt::format("{}, +- {:.2g} deg", from, bar.sigma) : from;
}

bool is_allowed(const std::string& path, const std::string& value) {
  sim::Scene scene;
  try {
    sim::set_from_text(scene, path, value);
  } catch (const sim::Error&) {
    return false;
  }
  return true;
}

std::string site_lines(const HorizonCamera& camera) {
  const std::string table = "site.";
  std::string text;
  bool has_altitude = false;
  for (const fit::PhotoFact& fact : camera.facts.facts) {
    if (fact.path.compare(0, table.size(), table) != 0 || !is_allowed(fact.path, fact.value)) continue;
    text += line(fact.path.substr(table.size()), fact.value, fact.source);
    has_altitude = has_altitude || fact.path == "site.altitude_m";
  }
  if (camera.altitude_m && !has_altitude) {
    const std::string value = fmt::format("{:.1f}", *camera.altitude_m);
    const bool allowed = is_allowed("site.altitude_m", value);
    text += (allowed ? "" : "# higher than a scene's site may be: ") + line("altitude_m", value, "given");
  }
  return text.empty() ? text : "[site]\n" + text + "\n";
}

std::string lens_lines(const HorizonCamera& camera) {
  if (!camera.lens)
    return "model = \"pinhole\"  # assumed, its axis in the middle\n" +
           line("width", std::to_string(camera.problem.width_px), "the picture's size") +
           line("height", std::to_string(camera.problem.height_px), "the picture's size") +
           line("hfov_deg", real(camera.found.hfov_deg.value),
                with_error(camera.found.hfov_deg, camera.hfov_source));
  const sim::Camera& lens = *camera.lens;
  std::string text =
      fmt::format("model = \"{}\"  # {}\n", sim::word_of(lens.model), comment_words(camera.hfov_source));
  text += fmt::format("width = {}\nheight = {}\n", lens.width, lens.height);
  if (lens.model == sim::LensModel::pinhole)
    text += "hfov_deg = " + sim::real_text(lens.hfov_deg) + "\n";
  else
    text += "focal_px = " + sim::real_text(lens.focal_px) + "\n";
  for (const auto& [key, value, usual] : {std::tuple{"principal_x_px", lens.principal_x_px, 0.0},
                                          {"principal_y_px", lens.principal_y_px, 0.0},
                                          {"aspect", lens.aspect, 1.0},
                                          {"k1", lens.k1, 0.0},
                                          {"k2", lens.k2, 0.0},
                                          {"k3", lens.k3, 0.0},
                                          {"p1", lens.p1, 0.0},
                                          {"p2", lens.p2, 0.0}})
    if (value != usual) text += std::string(key) + " = " + sim::real_text(value) + "\n";
  if (lens.mirrored) text += "mirrored = true\n";
  return text;
}

}  // namespace

std::string horizon_toml(const HorizonCamera& camera) {
  const fit::HorizonCalibration& found = camera.found;
  std::string text =
      "# A camera from " + std::to_string(camera.problem.points.size()) + " points on the horizon" +
      (camera.name.empty() ? "" : " of " + comment_words(camera.name)) + ". vegard " + sim::version() + "\n";
  text += fmt::format("# dip {:.4f} deg; rms {:.2f} px; error bars from {:.2f} px a point; no refraction\n\n",
                      found.dip_deg.value, found.rms_px, found.used_error_px);
  text += site_lines(camera);
  text += "[camera]\n" + lens_lines(camera);
  text += line("azimuth_deg", real(camera.azimuth_deg.value_or(0.0)),
               camera.azimuth_deg ? "given" : "assumed: a horizon does not determine it");
  std::string elevation_from = with_error(found.elevation_deg, "from the horizon");
  if (camera.hfov_rounding_deg)
    elevation_from += fmt::format(", and within {:.2f} deg by the rounding of the focal length",
                                  camera.elevation_rounding_deg);
  text += line("elevation_deg", real(found.elevation_deg.value), elevation_from);
  text += line("roll_deg", real(found.roll_deg.value), with_error(found.roll_deg, "from the horizon"));
  return text;
}

}  // namespace vegard::apps
