#include "fit/map/curtains/stored_map.h"

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/number_text.h"
#include "sim/base/file/sha256.h"
#include "sim/base/version.h"
#include "sim/scene/file/curve_table.h"
#include "sim/scene/table/photo_scene.h"

namespace vegard::fit {
namespace {

using RecordJson = nlohmann::json;

constexpr std::size_t kMaxMapJson = 64u << 20;
constexpr std::size_t kMaxCurtains = 10000;   // a map has some tens
constexpr std::size_t kMaxPoints = 1000;      // of a curtain, 5 km apart
constexpr double kFarthestPoint_km = 3000.0;  // of a point, as in a scene
constexpr double kSamePlace_deg = 1e-6;       // a tenth of a metre: what a scene's text may round

sim::Error bad_map(const std::string& file, const std::string& problem) {
  return sim::unreadable(file, problem).expected("a directory that vegard map wrote");
}

std::string bytes_of_map(const std::string& file) {
  const sim::InputFile text = sim::read_input(file, kMaxMapJson);
  if (!text.problem.empty()) throw bad_map(file, text.problem).hint("is that the directory of a map?");
  return text.bytes;
}

void check_written_by_us(const RecordJson& json, const std::string& file) {
  if (!json.is_object() || !json.contains("kind") || json["kind"] != "vegard map")
    throw bad_map(file, "is no map's").hint("is that the directory of a map?");
  const auto version = json.find("version");
  const std::string wrote = version != json.end() && version->is_string() ? version->get<std::string>() : "?";
  const std::string again = "map the photograph again";
  if (wrote != sim::version())
    throw bad_map(file, "was written by vegard " + wrote + ", and this is " + sim::version()).hint(again);
  if (!json.contains("format") || json["format"] != kMapFormat)
    throw bad_map(file, "has another format than this vegard reads").hint(again);
  if (json.contains("interrupted") && json["interrupted"] == true)
    throw bad_map(file, "is of a map that was interrupted").hint("finish it first, with --resume");
}

/// A whole number from 0 on. Throws RecordJson::exception for anything else.
int whole_number(const RecordJson& json, const char* key) {
  constexpr std::uint64_t kMax = 1u << 24;
  const RecordJson& value = json.at(key);
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > kMax)
    throw RecordJson::type_error::create(302, std::string(key) + " is no whole number", &value);
  return static_cast<int>(value.get<std::uint64_t>());
}

const RecordJson& list(const RecordJson& json, const char* key) {
  const RecordJson& value = json.at(key);
  if (!value.is_array()) throw RecordJson::type_error::create(302, std::string(key) + " is no list", &value);
  return value;
}

/// Throws RecordJson::exception.
void take_facts(const RecordJson& json, StoredMap& record) {
  for (const RecordJson& photo : list(json, "photos")) {
    StoredMap::Picture picture;
    picture.name = photo.at("name").get<std::string>();
    picture.width_px = whole_number(photo, "width_px");
    picture.height_px = whole_number(photo, "height_px");
    picture.latitude_deg = photo.at("latitude_deg").get<double>();
    picture.longitude_deg = photo.at("longitude_deg").get<double>();
    record.pictures.push_back(std::move(picture));
  }
  record.altitude_scale = json.at("altitude_scale").get<double>();
  record.spectrum = json.value("spectrum", record.spectrum);
  record.modes = json.value("modes", record.modes);
  for (const RecordJson& decoding : list(json, "decodings"))
    record.decodings.push_back(decoding.at("decoding").get<std::string>());
  for (const RecordJson& input : list(json, "inputs"))
    record.inputs.push_back({input.at("role").get<std::string>(), input.at("name").get<std::string>(),
                             input.at("sha256").get<std::string>()});
}

double ends_apart_km(const Ridge& ridge) {
  if (ridge.points.empty()) return 0.0;
  const sim::EastNorth first = ridge.points.front().foot_km, last = ridge.points.back().foot_km;
  return std::hypot(last.east - first.east, last.north - first.north);
}

std::vector<Ridge> ridges_of_table(const std::string& text, const std::string& file, const std::string& stem,
                                   std::size_t count, const std::vector<int>& points) {
  std::vector<Ridge> ridges;
  if (count > kMaxCurtains) throw bad_map(file, "cannot have " + std::to_string(count) + " curtains");
  for (std::size_t c = 1; c <= count; ++c) {
    sim::Sheet sheet;
    sim::take_curtain(text, file, static_cast<int>(c), false, sheet);
    Ridge ridge;
    ridge.name = stem + std::to_string(c);
    for (std::size_t i = 0; i < sheet.east_km.size(); ++i)
      ridge.points.push_back({{sheet.east_km[i], sheet.north_km[i]},
                              sheet.point_brightness[i] * sheet.energy_flux_mw_m2,
                              sheet.point_energy_kev[i],
                              sheet.point_width_km[i]});
    for (const RidgePoint& p : ridge.points)
      if (!std::isfinite(p.foot_km.east) || !std::isfinite(p.foot_km.north) || !std::isfinite(p.flux_mw_m2) ||
          !(p.energy_kev > 0.0) || !std::isfinite(p.energy_kev) || !(p.width_km > 0.0) ||
          !std::isfinite(p.width_km) || std::abs(p.foot_km.east) > kFarthestPoint_km ||
          std::abs(p.foot_km.north) > kFarthestPoint_km)
        throw bad_map(file, fmt::format("curtain {} has a point that is none", c))
            .hint("map the photograph again");
    if (c <= points.size() && ridge.points.size() != static_cast<std::size_t>(points[c - 1]))
      throw bad_map(file,
                    fmt::format("curtain {} has {} points of {}", c, ridge.points.size(), points[c - 1]))
          .hint("map the photograph again");
    if (ridge.points.size() > kMaxPoints)
      throw bad_map(
          file, fmt::format("curtain {} has {} points, of at most {}", c, ridge.points.size(), kMaxPoints))
          .hint("map the photograph again");
    // Too short for a curve, or closed to a ring.
    if (ends_apart_km(ridge) < kMinRidge_km) continue;
    ridges.push_back(std::move(ridge));
  }
  return ridges;
}

bool is_photograph(const InputFile& input) { return input.role.compare(0, 5, "photo") == 0; }

sim::Error other_subject(const StoredMap& record, const sim::Scene& scene, const std::string& problem) {
  return sim::Error(sim::ErrorKind::scene, "the map '" + record.directory + "' " + problem)
      .file(scene.file)
      .hint("map this photograph first: vegard map");
}

}  // namespace

StoredMap read_stored_map(const std::string& directory) {
  StoredMap record;
  record.directory = directory;
  const std::string file = directory + "/map.json";
  const std::string text = bytes_of_map(file);
  const RecordJson json = RecordJson::parse(text, nullptr, false);
  check_written_by_us(json, file);
  std::size_t faint = 0;
  std::vector<int> points;  // of each curtain
  try {
    take_facts(json, record);
    for (const RecordJson& curtain : list(json, "curtains"))
      points.push_back(whole_number(curtain, "points"));
    faint = static_cast<std::size_t>(whole_number(json, "faint_curtains"));
  } catch (const RecordJson::exception&) {
    throw bad_map(file, "lacks what a fit of its curtains needs").hint("map the photograph again");
  }
  const auto empty = [&] {
    return bad_map(file, "holds no curtain to refine")
        .hint("what shines is no curtain, or too faint: see the map's report.html");
  };
  if (points.empty()) throw empty();
  const std::string table = directory + "/" + kCurtainTable,
                    faint_table = directory + "/" + kFaintCurtainTable;
  const std::string rows = bytes_of_map(table), faint_rows = bytes_of_map(faint_table);
  record.curtains = ridges_of_table(rows, table, "curtain_", points.size(), points);
  if (record.curtains.empty()) throw empty();
  record.faint = ridges_of_table(faint_rows, faint_table, "faint_", faint, {});
  record.sha256 = sim::sha256(sim::sha256(text) + sim::sha256(rows) + sim::sha256(faint_rows));
  return record;
}

void check_same_subject(const StoredMap& record, const sim::Scene& scene,
                        const std::vector<InputFile>& inputs, const std::vector<std::string>& decodings) {
  const auto photographs = [](const std::vector<InputFile>& all) {
    std::vector<InputFile> some;
    for (const InputFile& input : all)
      if (is_photograph(input)) some.push_back(input);
    return some;
  };
  const std::vector<InputFile> mapped = photographs(record.inputs), asked = photographs(inputs);
  if (mapped.size() != asked.size())
    throw other_subject(record, scene,
                        fmt::format("is of {} photograph{}, and this fit of {}", mapped.size(),
                                    mapped.size() == 1 ? "" : "s", asked.size()))
        .key("fit.photo")
        .expected("the photographs that were mapped");
  for (std::size_t i = 0; i < mapped.size(); ++i)
    if (mapped[i].role != asked[i].role || mapped[i].sha256 != asked[i].sha256)
      throw other_subject(record, scene, "is of another photograph than " + asked[i].name)
          .expected("the photograph that was mapped, " + mapped[i].name + ", byte by byte");
  for (std::size_t i = 0; i < decodings.size() && i < record.decodings.size(); ++i)
    if (decodings[i] != record.decodings[i])
      throw other_subject(record, scene, "was made with the decoding \"" + record.decodings[i] + "\"")
          .key("fit.decoding")
          .expected("that decoding, and not \"" + decodings[i] + "\"");
  if (record.altitude_scale != 1.0)
    throw other_subject(record, scene, "was made with an --altitude-scale, which a fit does not have")
        .expected("a map with the altitudes of the tables");
  if (record.spectrum != "maxwellian")
    throw other_subject(record, scene,
                        "is of --spectrum " + record.spectrum + ", which a fit of its curtains does not have")
        .expected("a map of Maxwellian electrons");
  const std::vector<sim::PhotoEntry>& entries = scene.fit.photos;
  if (record.pictures.size() != std::max<std::size_t>(1, entries.size()))
    throw other_subject(record, scene, "is of another number of stations")
        .key("fit.photo")
        .expected("the photographs that were mapped");
  for (std::size_t i = 0; i < record.pictures.size(); ++i) {
    const StoredMap::Picture& picture = record.pictures[i];
    const sim::Scene own = entries.empty() ? scene : sim::scene_of_photo(scene, entries[i]);
    if (std::abs(own.site.latitude_deg - picture.latitude_deg) > kSamePlace_deg ||
        std::abs(own.site.longitude_deg - picture.longitude_deg) > kSamePlace_deg)
      throw other_subject(record, scene, "is of another site")
          .key("site.latitude_deg")
          .expected(sim::short_number(picture.latitude_deg, 8) +
                    ", and site.longitude_deg = " + sim::short_number(picture.longitude_deg, 8));
    if (own.camera.width != picture.width_px || own.camera.height != picture.height_px)
      throw other_subject(record, scene, "is of pictures of another size")
          .key("camera.width")
          .expected(fmt::format("{} x {} pixels", picture.width_px, picture.height_px));
  }
}

}  // namespace vegard::fit
