#include "fit/report/run_directory.h"

#include <fmt/format.h>

#include <cassert>
#include <filesystem>

#include "fit/report/foot_map.h"
#include "fit/report/model_picture.h"
#include "fit/report/report_html.h"
#include "fit/report/table/report_bins.h"
#include "fit/report/table/result_json.h"
#include "fit/report/table/run_tables.h"
#include "sim/base/error.h"
#include "sim/base/file/whole_directory.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/picture/image_io.h"
#include "sim/base/version.h"
#include "sim/scene/file/named_files.h"
#include "sim/scene/file/scene_toml.h"
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

/// "model-NAME.exr"; without a name "model.exr".
std::string file_of(const FittedPhoto& fitted, const std::string& stem, const std::string& ending) {
  return stem + (fitted.name.empty() ? "" : "-" + fitted.name) + ending;
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
  for (sim::PhotoEntry& entry : best.fit.photos) {
    entry.file = renamed(entry.file);
    entry.mask = renamed(entry.mask);
  }
}

sim::ImageAttributes attributes_of(const FitResult& result, const FittedPhoto& fitted,
                                   const std::string& units) {
  sim::ImageAttributes attributes = {
      {"scene", sim::write_scene(fitted.best)},
      {"seed", std::to_string(result.seed)},
      {"version", sim::version()},
      {"verdict", verdict_name(result.verdict)},
      {"units", units},
      {"decoding", fitted.decoding},
      {"model",
       fitted.best.sheets.empty()
           ? "the best scene"
           : "the expectation that was fitted: the scene without its spacing_jitter and with more beams"}};
  if (!fitted.best.site.time_utc.empty()) attributes["DateTime"] = fitted.best.site.time_utc;
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
  attributes["gain"] = has_named_axes(fitted.data) ? "in the fit's bins their band's gain and sky, the mean "
                                                     "gain where a band's is not told; elsewhere "
                                                     "the mean gain and sky"
                                                   : "of every column: the bands' gains at the bands' "
                                                     "centres, linear between them, level outside; the fit "
                                                     "itself has "
                                                     "one gain in all of a band";
  sim::write_exr(run.file(file_of(fitted, "model", ".exr")), {&picture.rgb, &lines}, attributes);
  sim::write_exr(
      run.file(file_of(fitted, "residual", ".exr")), picture.residual,
      attributes_of(result, fitted, "R, G, B: photograph - model, linear light of the photograph, signed"));
}

/// An error inside of the temporary directory is one of the directory that the user named.
sim::Error about(const std::string& directory, const std::string& temporary, const sim::Error& error) {
  sim::ErrorDetails details = error.details();
  if (details.file.compare(0, temporary.size(), temporary) == 0)
    details.file.replace(0, temporary.size(), directory);
  return sim::Error(error.kind(), details);
}

}  // namespace

void check_run_directory(const std::string& directory, bool overwrite) {
  sim::WholeDirectory(directory, overwrite);
}

void write_run(const std::string& directory, bool overwrite, const FitResult& result,
               const std::vector<Photo>& photos, const RunContext& context) {
  assert(photos.size() == result.photos.size());
  sim::WholeDirectory run(directory, overwrite);
  std::vector<ModelPicture> pictures;
  std::vector<ShownPhoto> shown;
  for (std::size_t i = 0; i < photos.size(); ++i)
    pictures.push_back(model_picture(result.photos[i], photos[i], context.threads));
  for (std::size_t i = 0; i < photos.size(); ++i)
    shown.push_back({&result.photos[i], &photos[i], &pictures[i],
                     [&camera = result.photos[i].best.camera](double x_px, double y_px) {
                       return sim::direction_of_pixel(camera, x_px, y_px).elevation_deg;
                     }});
  try {
    sim::write_whole(run.file("result.json"), result_json(result));
    sim::Scene best = sim::with_tables_beside(result.best);
    for (const sim::TableFile& table : sim::table_files(best))
      sim::write_whole(run.file(table.name), sim::table_text(best, table.path));
    rename_files(directory, best);
    sim::write_whole(run.file("best.toml"), best_scene(result, best));
    for (std::size_t i = 0; i < photos.size(); ++i) {
      const FittedPhoto& fitted = result.photos[i];
      sim::write_whole(run.file(file_of(fitted, "profiles", ".csv")),
                       profiles_csv(result, fitted, shown[i].elevation_of_pixel));
      write_pictures(run, result, fitted, pictures[i]);
    }
    if (!result.profiles.empty()) sim::write_whole(run.file("profile.csv"), free_profiles_csv(result));
    sim::write_whole(run.file("trace.csv"), trace_csv(result));
    if (const std::string map = foot_map_svg(result); !map.empty())
      sim::write_whole(run.file("map.svg"), map);
    sim::write_whole(run.file("report.html"), report_html(result, shown));
    run.commit();
  } catch (const sim::Error& error) {
    throw about(directory, run.temporary(), error);
  }
}

void write_run(const std::string& directory, bool overwrite, const FitResult& result, const Photo& photo,
               const RunContext& context) {
  write_run(directory, overwrite, result, std::vector<Photo>{photo}, context);
}

}  // namespace vegard::fit
