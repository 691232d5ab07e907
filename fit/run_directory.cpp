#include "fit/run_directory.h"

#include <fmt/format.h>

#include "fit/free_profiles_csv.h"
#include "fit/model_picture.h"
#include "fit/profiles_csv.h"
#include "fit/report_html.h"
#include "fit/result_json.h"
#include "fit/trace_csv.h"
#include "sim/base/error.h"
#include "sim/base/image_io.h"
#include "sim/base/version.h"
#include "sim/base/whole_directory.h"
#include "sim/base/whole_file.h"
#include "sim/scene/scene_toml.h"
#include "sim/scene/table_files.h"
#include "sim/view/camera.h"

namespace vegard::fit {
namespace {

/// `best` is the result's, with its tables beside it.
std::string best_scene(const FitResult& result, const sim::Scene& best) {
  std::string comment = "The best scene of a fit. vegard " + sim::version() +
                        "\nverdict: " + verdict_name(result.verdict) + "\n" + result.verdict_line + "\n";
  comment += fmt::format("chi2 {} with {} degrees of freedom", result.chi2, result.dof);
  if (!result.command.empty()) comment += "\n" + result.command;
  return sim::write_scene(best, comment);
}

sim::ImageAttributes attributes_of(const FitResult& result, const std::string& units) {
  sim::ImageAttributes attributes = {
      {"scene", sim::write_scene(result.best)},
      {"seed", std::to_string(result.seed)},
      {"version", sim::version()},
      {"verdict", verdict_name(result.verdict)},
      {"units", units},
      {"model",
       "the expectation that was fitted: the scene without its spacing_jitter and "
       "with more beams"}};
  if (!result.best.site.time_utc.empty()) attributes["DateTime"] = result.best.site.time_utc;
  return attributes;
}

void write_pictures(const sim::WholeDirectory& run, const FitResult& result, const ModelPicture& picture) {
  sim::Image lines = picture.rayleigh;
  for (std::string& name : lines.channel_names) name.insert(0, "rayleigh.");
  sim::ImageAttributes attributes = attributes_of(
      result,
      "R, G, B: linear light of the photograph, sky included; rayleigh.*: rayleighs before any gain, by "
      "wavelength in tenths of a nanometre");
  attributes["gain"] =
      "of every column: the bands' gains at the bands' centres, linear between them, level outside; the fit "
      "itself has "
      "one gain in all of a band";
  sim::write_exr(run.file("model.exr"), {&picture.rgb, &lines}, attributes);
  sim::write_exr(
      run.file("residual.exr"), picture.residual,
      attributes_of(result, "R, G, B: photograph - model, linear light of the photograph, signed"));
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

void write_run(const std::string& directory, bool overwrite, const FitResult& result, const Photo& photo,
               const RunContext& context) {
  sim::WholeDirectory run(directory, overwrite);
  const ElevationOfPixel elevation_of_pixel = [&](double x_px, double y_px) {
    return sim::direction_of_pixel(result.best.camera, x_px, y_px).elevation_deg;
  };
  const ModelPicture picture = model_picture(result, photo, context.threads);
  try {
    sim::write_whole(run.file("result.json"), result_json(result));
    const sim::Scene best = sim::with_tables_beside(result.best);
    sim::write_whole(run.file("best.toml"), best_scene(result, best));
    for (const sim::TableFile& table : sim::table_files(best))
      sim::write_whole(run.file(table.name), sim::table_text(best, table.path));
    sim::write_whole(run.file("profiles.csv"), profiles_csv(result, elevation_of_pixel));
    if (!result.profiles.empty()) sim::write_whole(run.file("profile.csv"), free_profiles_csv(result));
    sim::write_whole(run.file("trace.csv"), trace_csv(result));
    write_pictures(run, result, picture);
    sim::write_whole(run.file("report.html"), report_html(result, photo, picture, elevation_of_pixel));
    run.commit();
  } catch (const sim::Error& error) {
    throw about(directory, run.temporary(), error);
  }
}

}  // namespace vegard::fit
