#include "apps/live/live_page.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string_view>

#include <nlohmann/json.hpp>

#include "sim/base/file/byte_stream.h"
#include "sim/base/shown_text.h"
#include "sim/light/height_profile.h"

namespace vegard::apps {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kWhole = 65535.0;

/// Floats as they are, little-endian as all machines are that vegard runs on.
Json floats(const std::vector<float>& values) {
  if (values.empty()) return nullptr;
  return {{"packed", sim::base64(sim::gzipped(
                         {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)}))}};
}

/// Whole numbers of 16 bits between the least and the greatest: for maps, which are most of a page.
Json words(const std::vector<float>& values) {
  if (values.empty()) return nullptr;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double from = *low, range = std::max(1e-30, static_cast<double>(*high) - from);
  std::string bytes;
  bytes.reserve(2 * values.size());
  for (const float value : values) {
    const auto whole = static_cast<std::uint16_t>(std::lround((value - from) / range * kWhole));
    bytes.push_back(static_cast<char>(whole & 0xff));
    bytes.push_back(static_cast<char>(whole >> 8));
  }
  return {{"low", from}, {"high", from + range}, {"packed", sim::base64(sim::gzipped(bytes))}};
}

Json pair(const sim::EastNorth& vector) { return {vector.east, vector.north}; }

Json json_of(const sim::LiveLayer& layer) {
  Json maps = Json::array();
  for (const sim::LiveMap& map : layer.maps)
    maps.push_back({{"flux", words(map.flux)},
                    {"ln_energy", words(map.ln_energy)},
                    {"shift_km", words(map.shift_km)},
                    {"ln_stretch", words(map.ln_stretch)}});
  Json axes = Json::array();
  for (const auto& axis : layer.axes) axes.push_back({axis[0], axis[1], axis[2]});
  return {{"name", layer.name},
          {"is_shell", layer.is_shell},
          {"axes", axes},
          {"turn_deg_s", layer.turn_deg_s},
          {"first_column", layer.first_column},
          {"first_row", layer.first_row},
          {"along", pair(layer.along)},
          {"drift_km_s", pair(layer.drift_km_s)},
          {"cell_km", layer.cell_km},
          {"face_cells", layer.face_cells},
          {"columns", layer.columns},
          {"rows", layer.rows},
          {"faces", layer.faces},
          {"maps", maps},
          {"dark", floats(layer.dark)},
          {"dark_columns", layer.dark_columns},
          {"dark_rows", layer.dark_rows},
          {"dark_texels", layer.dark_texels},
          {"dark_first_column", layer.dark_first_column},
          {"dark_first_row", layer.dark_first_row},
          {"fall", floats(layer.fall)},
          {"bottom_km", layer.bottom_km},
          {"top_km", layer.top_km},
          {"peak_km", layer.peak_km},
          {"ln_first", layer.ln_first},
          {"ln_step", layer.ln_step},
          {"energies", layer.energies},
          {"rate", floats(layer.rate)}};
}

Json json_of(const sim::LiveCamera& camera) {
  return {{"width", camera.width},
          {"height", camera.height},
          {"azimuth_deg", camera.azimuth_deg},
          {"elevation_deg", camera.elevation_deg},
          {"roll_deg", camera.roll_deg},
          {"principal_x_px", camera.principal_x_px},
          {"principal_y_px", camera.principal_y_px},
          {"aspect", camera.aspect},
          {"side", camera.side},
          {"altitude_km", camera.altitude_km},
          {"radius_px", floats(camera.radius_px)},
          {"last_angle_rad", camera.last_angle_rad}};
}

std::string json_text(const sim::LiveView& view, const std::string& name) {
  Json layers = Json::array();
  for (const sim::LiveLayer& layer : view.layers) layers.push_back(json_of(layer));
  std::vector<float> stars;
  for (const sim::LiveStar& star : view.stars) {
    stars.insert(stars.end(), star.enu.begin(), star.enu.end());
    stars.insert(stars.end(), star.rgb_steradian.begin(), star.rgb_steradian.end());
  }
  const Json json = {{"name", name},
                     {"radius_km", view.radius_km},
                     {"foot_altitude_km", view.foot_altitude_km},
                     {"fall_nodes", sim::kFallNodes},
                     {"profile_bottom_km", sim::HeightProfile::kBottomKm},
                     {"profile_step_km", sim::kProfileStep_km},
                     {"lines_nm", view.lines_nm},
                     {"rgb_per_kilorayleigh", view.rgb_per_kilorayleigh},
                     {"blur_px", view.blur_px},
                     {"camera", json_of(view.camera)},
                     {"layers", layers},
                     {"start_s", view.start_s},
                     {"step_s", view.step_s},
                     {"instants", view.instants},
                     {"sky_rgb", view.sky_rgb},
                     {"night_rgb", floats(view.night_rgb)},
                     {"night_columns", view.night_columns},
                     {"night_rows", view.night_rows},
                     {"stars", floats(stars)},
                     {"star_sigma_px", view.star_sigma_px},
                     {"transmission", floats(view.transmission)},
                     {"tone", floats(view.tone)},
                     {"left_out", view.left_out}};
  std::string text = json.dump(-1, ' ', true, Json::error_handler_t::replace);
  // Nothing in it ends the element that holds it.
  for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;) text.replace(at, 1, "\\u003c");
  return text;
}

std::string_view page_file(std::string_view name) {
  for (const EmbeddedFile& file : live_pages())
    if (file.name == name) return file.bytes;
  return {};
}

/// All modules as one script, since a page from disk may not load others: their imports and exports fall
/// away, and the page's own module comes last.
std::string joined_modules() {
  std::string joined;
  const auto add = [&](std::string_view text) {
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size() - 1);
      std::string_view line = text.substr(0, end + 1);
      text.remove_prefix(end + 1);
      constexpr std::string_view kExport = "export ", kImport = "import ";
      if (line.substr(0, kImport.size()) == kImport) continue;
      if (line.substr(0, kExport.size()) == kExport) line.remove_prefix(kExport.size());
      joined += line;
    }
  };
  constexpr std::string_view kLast = "live.js", kEnd = ".js";
  // lens.js has what shaders of other modules are made of.
  add(page_file("lens.js"));
  for (const EmbeddedFile& file : live_pages())
    if (file.name != kLast && file.name != "lens.js" && file.name.size() > kEnd.size() &&
        file.name.substr(file.name.size() - kEnd.size()) == kEnd)
      add(file.bytes);
  add(page_file(kLast));
  return joined;
}

}  // namespace

std::string live_page(const sim::LiveView& view, const std::string& name) {
  std::string page;
  std::string_view rest = page_file("index.html");
  const auto put = [&](std::string_view mark, std::string_view text) {
    const std::size_t at = rest.find(mark);
    page += rest.substr(0, at);
    page += text;
    rest.remove_prefix(at + mark.size());
  };
  put("%style%", page_file("live.css"));
  put("%scene%", json_text(view, name));
  put("%program%", joined_modules());
  return page += rest;
}

}  // namespace vegard::apps
