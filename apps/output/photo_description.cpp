#include "apps/output/photo_description.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "apps/options/json_answer.h"
#include "fit/photo/frames/frame_name.h"
#include "fit/photo/photo_metadata.h"
#include "sim/base/error.h"
#include "sim/base/shown_text.h"
#include "sim/base/version.h"
#include "sim/scene/file/closing_line.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::apps {
namespace {

struct Line {
  const char* key;
  const char* if_assumed;  ///< words behind a value that the picture does not say
};

struct Table {
  const char* head;
  std::string prefix;  ///< of a path
  std::vector<Line> lines;
};

constexpr const char* kDefault = "assumed: the default";
constexpr const char* kPointing = "assumed: no picture says where it points; see vegard horizon";
constexpr const char* kUnused =
    "assumed: the default; only counts with sensor.exposure = \"camera\" or noise";
constexpr const char* kField = "assumed: the default, whatever the place";
constexpr const char* kSheet = "assumed: a place to start from";

const std::vector<Table>& tables() {
  static const std::vector<Table> all = {
      {"[site]",
       "site.",
       {{"latitude_deg", kDefault},
        {"longitude_deg", kDefault},
        {"altitude_m", kDefault},
        {"time_utc", "unknown"}}},
      {"[field]", "field.", {{"model", kField}, {"inclination_deg", kField}, {"declination_deg", kField}}},
      {"[camera]",
       "camera.",
       {{"model", "assumed"},
        {"width", kDefault},
        {"height", kDefault},
        {"hfov_deg", "assumed: the picture does not say how wide it sees"},
        {"azimuth_deg", kPointing},
        {"elevation_deg", kPointing},
        {"roll_deg", kPointing}}},
      {"[sensor]", "sensor.", {{"f_number", kUnused}, {"iso", kUnused}}},
      {"[time]", "time.", {{"exposure_s", kUnused}}},
      {"[[sheet]]",
       "sheet.main.",
       {{"name", "assumed"},
        {"center_km", kSheet},
        {"bearing_deg", kSheet},
        {"length_km", kSheet},
        {"energy_kev", kSheet}}},
  };
  return all;
}

std::string value_of(const sim::Scene& scene, const std::string& path) {
  const std::vector<sim::ParameterPath> paths = sim::resolve(scene, path);
  if (paths.size() == 1) return sim::value_text(scene, paths.front());
  std::string text;
  for (const sim::ParameterPath& component : paths)
    text += (text.empty() ? "[" : ", ") + sim::value_text(scene, component);
  return text + "]";
}

const fit::PhotoFact* find(const fit::PhotoFacts& facts, const std::string& path) {
  const auto found = std::find_if(facts.facts.begin(), facts.facts.end(),
                                  [&](const fit::PhotoFact& fact) { return fact.path == path; });
  return found == facts.facts.end() ? nullptr : &*found;
}

class Listing {
 public:
  explicit Listing(const std::string& title) : text_(title + "\n") {}

  void add(const char* name, const std::optional<std::string>& words) {
    if (words) text_ += fmt::format("  {:<24} {}\n", name, sim::shortened_text(*words));
  }
  void add(const char* name, const std::optional<double>& value, const char* unit) {
    if (value) add(name, fmt::format("{:.8g}{}{}", *value, *unit == '\0' ? "" : " ", unit));
  }
  std::string text() const { return text_; }

 private:
  std::string text_;
};

template <class Value>
void put(Json& json, const char* key, const std::optional<Value>& value) {
  if (value) json[key] = *value;
}

Json description(const std::string& photo_name, const sim::PictureMetadata& metadata) {
  Json json = {{"file", photo_name}};
  put(json, "width_px", metadata.width_px);
  put(json, "height_px", metadata.height_px);
  json["orientation"] = metadata.orientation;
  put(json, "make", metadata.make);
  put(json, "model", metadata.model);
  put(json, "lens", metadata.lens);
  put(json, "imager", metadata.imager);
  put(json, "site", metadata.site);
  put(json, "mode", metadata.mode);
  put(json, "focal_length_mm", metadata.focal_length_mm);
  put(json, "focal_length_35mm_mm", metadata.focal_length_35mm_mm);
  put(json, "focal_plane_px_per_mm", metadata.focal_plane_px_per_mm);
  put(json, "exposure_s", metadata.exposure_s);
  put(json, "f_number", metadata.f_number);
  put(json, "iso", metadata.iso);
  put(json, "taken_local", metadata.taken_local);
  put(json, "utc_offset", metadata.utc_offset);
  put(json, "taken_utc", sim::taken_utc(metadata));
  put(json, "gps_time_utc", metadata.gps_time_utc);
  put(json, "latitude_deg", metadata.latitude_deg);
  put(json, "longitude_deg", metadata.longitude_deg);
  put(json, "altitude_m", metadata.altitude_m);
  const fit::PhotoFacts facts = fit::photo_facts(metadata);
  json["scene"] = Json::array();
  for (const fit::PhotoFact& fact : facts.facts)
    json["scene"].push_back({{"path", fact.path}, {"value", fact.value}, {"source", fact.source}});
  json["notes"] = facts.notes;
  return json;
}

std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

std::string time_words(const fit::FrameHead& frame) {
  if (frame.time) return frame.time->utc;
  return frame.stream.seconds ? fmt::format("{:.3f} s after the first", *frame.stream.seconds)
                              : "time unknown";
}

}  // namespace

std::string start_scene(const std::string& photo_name, const fit::PhotoFacts& facts) {
  sim::Scene scene;
  scene.sheets.emplace_back();
  std::string text =
      "# A scene to begin with, for the picture " + sim::comment_words(photo_name) +
      ". Behind each value stands where it comes\n# from; \"assumed\" is what the picture does not "
      "say. vegard " +
      sim::version() + "\n";
  for (const std::string& note : facts.notes) text += "# " + sim::comment_words(note) + "\n";
  for (const Table& table : tables()) {
    text += "\n" + std::string(table.head) + "\n";
    for (const Line& line : table.lines) {
      const std::string path = table.prefix + line.key;
      std::string from = line.if_assumed;
      if (const fit::PhotoFact* fact = find(facts, path)) {
        try {
          sim::set_from_text(scene, path, fact->value);
          from = fact->source;
        } catch (const sim::Error& error) {
          from += "; the picture says " + fact->value + " (" + fact->source + "): " + error.details().problem;
        }
      }
      text +=
          std::string(line.key) + " = " + value_of(scene, path) + "  # " + sim::comment_words(from) + "\n";
    }
  }
  return sim::with_closing_line(text);
}

std::string description_text(const std::string& photo_name, const sim::PictureMetadata& metadata,
                             const std::vector<std::string>& declared, const std::string& light) {
  Listing said(sim::shown_text(photo_name) + " says:");
  if (metadata.width_px && metadata.height_px)
    said.add("size", fmt::format("{} x {} pixels", *metadata.width_px, *metadata.height_px));
  if (metadata.orientation != 1)
    said.add("orientation", fmt::format("{}, undone here", metadata.orientation));
  said.add("make", metadata.make);
  said.add("model", metadata.model);
  said.add("lens", metadata.lens);
  said.add("imager", metadata.imager);
  said.add("site", metadata.site);
  said.add("mode", metadata.mode);
  said.add("focal length", metadata.focal_length_mm, "mm");
  said.add("35 mm equivalent", metadata.focal_length_35mm_mm, "mm");
  said.add("sensor", metadata.focal_plane_px_per_mm, "pixels per mm");
  said.add("exposure", metadata.exposure_s, "s");
  said.add("f-number", metadata.f_number, "");
  said.add("ISO", metadata.iso, "");
  if (metadata.taken_local)
    said.add(
        metadata.sources.clock == sim::PictureSources().clock ? "camera's clock" : "a clock, see the note",
        *metadata.taken_local + metadata.utc_offset.value_or(" (zone unknown)"));
  said.add("GPS time", metadata.gps_time_utc);
  said.add("latitude", metadata.latitude_deg, "deg");
  said.add("longitude", metadata.longitude_deg, "deg");
  said.add("altitude", metadata.altitude_m, "m");
  for (const std::string& word : declared) said.add("declares", word);

  const fit::PhotoFacts facts = fit::photo_facts(metadata);
  std::string text = said.text() + "in a scene's keys:\n";
  for (const fit::PhotoFact& fact : facts.facts)
    text += "  " + sim::shortened_quotes(fit::fact_text(fact)) + "\n";
  if (facts.facts.empty()) text += "  nothing\n";
  for (const std::string& note : facts.notes) text += "note: " + sim::shortened_quotes(note) + "\n";
  if (!light.empty()) text += "note: " + light + "\n";
  return text;
}

std::string frames_description_text(const std::string& file_name, const fit::FrameIndex& index,
                                    const std::vector<std::string>& declared) {
  sim::PictureMetadata metadata = fit::frame_metadata(index.frames.front(), index.words, file_name);
  metadata.header_time_utc.reset();
  std::string text = description_text(file_name, metadata, declared);
  text += fit::frames_text(index.frames) + (index.is_packed ? ", packed by gzip" : "") +
          "; one is chosen as " + sim::shown_text(fit::name_of_frame(file_name, 0)) + ", or by --at TIME:\n";
  for (const fit::FrameHead& frame : index.frames)
    text += fmt::format("  #{:<5} {}{}\n", frame.number, time_words(frame),
                        frame.exposure_s ? fmt::format("  {:.6g} s", *frame.exposure_s) : "");
  return text;
}

std::string sky_map_description_text(const std::string& file_name, const fit::SkyMapFile& map) {
  Listing said(sim::shown_text(file_name) + " is a skymap, azimuth and elevation of every pixel:");
  said.add("size", fmt::format("{} x {} pixels", map.map.width, map.map.height));
  if (!map.arrays.empty()) said.add("arrays", map.arrays);
  std::size_t looking = 0;
  double lowest = 90.0, highest = -90.0;
  for (const float elevation : map.map.elevation_deg) {
    if (!std::isfinite(elevation)) continue;
    ++looking;
    lowest = std::min<double>(lowest, elevation);
    highest = std::max<double>(highest, elevation);
  }
  said.add("directions",
           fmt::format("of {} pixels, elevations {:.1f} to {:.1f} deg", looking, lowest, highest));
  if (map.place) {
    said.add("latitude", map.place->latitude_deg, "deg");
    said.add("longitude", map.place->longitude_deg, "deg");
    said.add("altitude", map.place->altitude_m, "m");
  }
  return said.text() + "note: it holds no picture; calibrate, profile and keogram take it as --skymap\n";
}

std::string description_json(const std::string& photo_name, const sim::PictureMetadata& metadata,
                             const std::vector<std::string>& declared, const std::string& light) {
  Json json = description(photo_name, metadata);
  json["declares"] = declared;
  if (!light.empty()) json["notes"].push_back(light);
  return text_of(json);
}

std::string frames_description_json(const std::string& file_name, const fit::FrameIndex& index,
                                    const std::vector<std::string>& declared) {
  sim::PictureMetadata metadata = fit::frame_metadata(index.frames.front(), index.words, file_name);
  metadata.header_time_utc.reset();
  Json json = description(file_name, metadata);
  if (!declared.empty()) json["declares"] = declared;
  json["frames"] = Json::array();
  for (const fit::FrameHead& frame : index.frames) {
    json["frames"].push_back({{"number", frame.number},
                              {"time_utc", frame.time ? Json(frame.time->utc) : Json(nullptr)},
                              {"exposure_s", json_number(frame.exposure_s)}});
    if (frame.stream.seconds) json["frames"].back()["seconds"] = *frame.stream.seconds;
  }
  return text_of(json);
}

std::string sky_map_description_json(const std::string& file_name, const fit::SkyMapFile& map) {
  Json json = {
      {"file", file_name},
      {"width_px", map.map.width},
      {"height_px", map.map.height},
      {"arrays", map.arrays},
      {"pixels_with_a_direction", std::count_if(map.map.elevation_deg.begin(), map.map.elevation_deg.end(),
                                                [](float elevation) { return std::isfinite(elevation); })}};
  if (map.place) {
    json["latitude_deg"] = map.place->latitude_deg;
    json["longitude_deg"] = map.place->longitude_deg;
    json["altitude_m"] = map.place->altitude_m;
  }
  return text_of(json);
}

}  // namespace vegard::apps
