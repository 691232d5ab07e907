#include "fit/report/run_directory.h"

#include <fmt/format.h>

#include <cassert>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>

#include "fit/report/foot_map.h"
#include "fit/report/model_picture.h"
#include "fit/report/netcdf/run_dataset.h"
#include "fit/report/report_html.h"
#include "fit/report/table/report_bins.h"
#include "fit/report/table/result_json.h"
#include "fit/report/table/run_tables.h"
#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/whole_directory.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/picture/image_io.h"
#include "sim/base/utc_time.h"
#include "sim/base/version.h"
#include "sim/scene/file/named_files.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/table/emission_folder.h"
#include "sim/scene/table/table_files.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit {
namespace {

/// `best` is the result's, with its tables beside it.
std::string best_scene(const FitResult& result, const sim::Scene& best) {
  std::string comment = "The best scene of a fit. vegard " + sim::version() +
                        "\nverdict: " + verdict_name(result.verdict) + "\n" + result.verdict_line + "\n";
  comment += fmt::format("chi2 {} with {} degrees of freedom", result.chi2, result.dof);
  for (const FittedPhoto& photo : result.photos)
    comment += "\ndecoding" + (photo.name.empty() ? "" : " of " + photo.name) + ": " + photo.decoding;
  if (!result.command.empty()) comment += "\n" + result.command;
  for (const PhotoFact& fact : result.from_photograph) comment += "\nfrom the photograph: " + fact_text(fact);
  return sim::write_scene(best, comment);
}

/// The files of each photograph.
constexpr std::pair<const char*, const char*> kProfiles = {"profiles", ".csv"}, kModel = {"model", ".exr"},
                                              kResidual = {"residual", ".exr"};
constexpr std::pair<const char*, const char*> kFilesOfPhoto[] = {kProfiles, kModel, kResidual};

/// "model-NAME.exr"; without a name "model.exr".
std::string file_of(const std::string& photo, const std::pair<const char*, const char*>& stem_and_ending) {
  return stem_and_ending.first + (photo.empty() ? "" : "-" + photo) + stem_and_ending.second;
}

/// Photographs, and the pictures and grids of volumes, stand beside the scene that was fitted: from the run's
/// directory they are called differently. Grids may be large, so none is copied.
void rename_files(const std::string& directory, sim::Scene& best) {
  namespace fs = std::filesystem;
  const fs::path from = best.file.empty() ? fs::current_path() : fs::absolute(best.file).parent_path();
  const fs::path to = fs::absolute(directory).lexically_normal();
  const auto renamed = [&](const std::string& file) -> std::string {
    if (file.empty() || fs::path(file).is_absolute()) return file;
    return (from / file).lexically_normal().lexically_relative(to).string();
  };
  sim::rename_files(best, renamed);
  sim::rename_emission_folder(best, renamed);
  for (sim::PhotoEntry& entry : best.fit.photos) {
    entry.file = renamed(entry.file);
    entry.mask = renamed(entry.mask);
  }
  for (sim::RadarEntry& entry : best.fit.radars) entry.file = renamed(entry.file);
}

sim::ImageAttributes attributes_of(const FitResult& result, const FittedPhoto& fitted,
                                   const std::string& units) {
  sim::Scene shown = fitted.best;
  shown.camera = sim::in_own_pixels(shown.camera);
  sim::ImageAttributes attributes = {
      {"scene", sim::write_scene(shown)},
      {"seed", std::to_string(result.seed)},
      {"version", sim::version()},
      {"verdict", verdict_name(result.verdict)},
      {"units", units},
      {"decoding", fitted.decoding},
      {"model",
       fitted.best.sheets.empty()
           ? "the best scene"
           : "the expectation that was fitted: the scene without its spacing_jitter and with more beams"}};
  if (!fitted.best.site.time_utc.empty()) attributes["DateTime"] = sim::in_utc(fitted.best.site.time_utc);
  return attributes;
}

void write_pictures(const sim::WholeDirectory& run, const FitResult& result, const FittedPhoto& fitted,
                    const ModelPicture& picture) {
  sim::Image lines = picture.rayleigh;
  for (std::string& name : lines.channel_names) name.insert(0, "rayleigh.");
  sim::ImageAttributes attributes = attributes_of(
      result, fitted,
      "R, G, B: linear light of the photograph, sky included; rayleigh.*: rayleighs before any gain, by "
      "wavelength in tenths of a nanometre");
  attributes["gain"] = has_named_axes(fitted.data)
                           ? "in the fit's bins their band's gain and sky, the mean "
                             "gain where a band's is unconstrained; elsewhere "
                             "the mean gain and sky"
                           : "of every column: the bands' gains at the bands' centres, linear between them, "
                             "level outside; the fit itself has one gain in all of a band";
  sim::write_exr(run.file(file_of(fitted.name, kModel)), {&picture.rgb, &lines}, attributes);
  sim::write_exr(
      run.file(file_of(fitted.name, kResidual)), picture.residual,
      attributes_of(result, fitted, "R, G, B: photograph - model, linear light of the photograph, signed"));
}

bool is_verdict(const nlohmann::json& word) {
  for (const Verdict verdict : kVerdicts)
    if (word == verdict_name(verdict)) return true;
  return false;
}

/// Photographs' names in a result.json of vegard's, of this version or an older one; none if it is not one.
/// Of a single photograph the name is empty.
std::optional<std::vector<std::string>> photos_of_result(const std::string& text) {
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  const auto has = [&](const char* key, nlohmann::json::value_t type) {
    return json.contains(key) && json[key].type() == type;
  };
  using Type = nlohmann::json::value_t;
  if (!json.is_object() || !has("verdict", Type::string) || !is_verdict(json["verdict"]) ||
      !has("verdict_line", Type::string) || !has("parameters", Type::array) ||
      !has("version", Type::string) || !has("libraries", Type::object) ||
      !json["libraries"].contains("ceres"))
    return {};
  if (!has("photos", Type::array)) return std::vector<std::string>{""};
  std::vector<std::string> names;
  for (const nlohmann::json& photo : json["photos"]) {
    if (!photo.is_object() || !photo.contains("name") || !photo["name"].is_string()) return {};
    names.push_back(photo["name"].get<std::string>());
  }
  return names;
}

/// What a run may hold: what write_run() writes, for the photographs of its result.json and with the tables
/// of its best.toml.
sim::KnownFolder look_at_run(const std::string& directory) {
  std::set<std::string> names = {"result.json", "best.toml",   "profile.csv", "trace.csv",
                                 "map.svg",     "report.html", kRunNetcdf};
  sim::KnownFolder known;
  const sim::InputFile result = sim::read_input(directory + "/result.json", kMaxResultBytes);
  const std::optional<std::vector<std::string>> photos = photos_of_result(result.bytes);
  if (!result.problem.empty())
    known.objection = "its result.json " + result.problem;
  else if (!photos)
    known.objection = "its result.json is none that vegard wrote";
  for (const std::string& photo : photos.value_or(std::vector<std::string>()))
    for (const auto& file : kFilesOfPhoto) names.insert(file_of(photo, file));
  try {
    const sim::InputFile best = sim::read_input(directory + "/best.toml");
    for (const sim::TableFile& table : sim::table_files(sim::parse_scene(best.bytes, "best.toml")))
      names.insert(table.name);
  } catch (const sim::Error&) {
    // A scene that cannot be read names no tables: if there are any, they are taken for the user's.
  }
  known.has = [names = std::move(names)](const std::string& name) { return names.count(name) != 0; };
  return known;
}

sim::DirectoryKind run_kind() { return {"a run", look_at_run, {"best.toml", "result.json"}}; }

}  // namespace

void check_run_directory(const std::string& directory, bool overwrite) {
  sim::WholeDirectory(directory, overwrite, run_kind());
}

void write_run(const std::string& directory, bool overwrite, const FitResult& result,
               const std::vector<Photo>& photos, const RunContext& context) {
  assert(photos.size() == result.photos.size());
  sim::WholeDirectory run(directory, overwrite, run_kind());
  std::vector<ModelPicture> pictures;
  std::vector<ShownPhoto> shown;
  for (std::size_t i = 0; i < photos.size(); ++i)
    pictures.push_back(model_picture(result.photos[i], photos[i], context.threads));
  for (std::size_t i = 0; i < photos.size(); ++i)
    shown.push_back({&result.photos[i], &photos[i], &pictures[i],
                     [&camera = result.photos[i].best.camera](double x_px, double y_px) {
                       return sim::direction_of_pixel(camera, x_px, y_px).elevation_deg;
                     }});
  run.fill([&] {
    sim::write_whole(run.file("result.json"), result_json(result));
    sim::Scene best = sim::with_tables_beside(result.best);
    rename_files(directory, best);
    sim::write_whole(run.file("best.toml"), best_scene(result, best));
    for (const sim::TableFile& table : sim::table_files(best))
      sim::write_whole(run.file(table.name), sim::table_text(best, table.path));
    for (std::size_t i = 0; i < photos.size(); ++i) {
      const FittedPhoto& fitted = result.photos[i];
      sim::write_whole(run.file(file_of(fitted.name, kProfiles)),
                       profiles_csv(result, fitted, shown[i].elevation_of_pixel));
      write_pictures(run, result, fitted, pictures[i]);
    }
    if (!result.profiles.empty()) sim::write_whole(run.file("profile.csv"), free_profiles_csv(result));
    sim::write_whole(run.file("trace.csv"), trace_csv(result));
    if (const std::string map = foot_map_svg(result); !map.empty())
      sim::write_whole(run.file("map.svg"), map);
    sim::write_whole(run.file("report.html"), report_html(result, shown));
    // Whatever is in it stands in the other files.
    if (context.netcdf) sim::write_netcdf(run_dataset(run.temporary()), run.file(kRunNetcdf), false);
  });
}

void write_run(const std::string& directory, bool overwrite, const FitResult& result, const Photo& photo,
               const RunContext& context) {
  write_run(directory, overwrite, result, std::vector<Photo>{photo}, context);
}

}  // namespace vegard::fit
