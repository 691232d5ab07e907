#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "apps/commands/survey/shard_folder.h"
#include "apps/commands/survey/steps.h"
#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/refusals.h"
#include "apps/options/standard_streams.h"
#include "apps/options/survey_eyes.h"
#include "apps/output/progress_bar.h"
#include "apps/output/terminal.h"
#include "fit/survey/survey_plan.h"
#include "fit/survey/report/survey_report.h"
#include "fit/survey/survey_export.h"
#include "fit/survey/survey_merge.h"
#include "fit/survey/survey_motion.h"

namespace vegard::apps {
namespace {

/// The ending of a noun after this number.
const char* plural(int count) { return count == 1 ? "" : "s"; }

struct MergeRequest {
  std::vector<std::string> inputs;
  std::string out;
  bool mixed = false, overwrite = false;
};

/// Folders as the shards in them.
std::vector<std::string> databases_of(const MergeRequest& options) {
  std::vector<std::string> found;
  for (const std::string& input : options.inputs) {
    std::error_code error;
    if (!std::filesystem::is_directory(input, error)) {
      found.push_back(input);
      continue;
    }
    const std::vector<ShardFile> shards = shard_files(input);
    if (shards.empty())
      throw usage_error("DATABASE", "there is no shard in the folder '" + input + "'",
                        "the folder of vegard survey run, or databases");
    for (const ShardFile& shard : shards) found.push_back(shard.path);
  }
  return found;
}

int run_merge(const MergeRequest& options) {
  const std::vector<std::string> databases = databases_of(options);
  for (const std::string& database : databases)
    protect_inputs("--output", options.out, {{database, "a database to merge"}});
  const fit::SurveyMerge merge = fit::merge_surveys(databases, options.out, options.mixed, options.overwrite);
  json_answer() = {{"outputs", json_names({options.out})}, {"frames", merge.frames},
                   {"databases", merge.databases},         {"plans", merge.plans},
                   {"versions", merge.versions},           {"lacking", merge.lacking}};
  say("%d frame%s of %d database%s\n", merge.frames, plural(merge.frames), merge.databases,
      plural(merge.databases));
  if (merge.plans > 1 || merge.versions > 1)
    say("of %d plan%s and %d version%s\n", merge.plans, plural(merge.plans), merge.versions,
        plural(merge.versions));
  if (merge.lacking == 0) return good;
  say("%d frame%s of the plan %s not there yet\n", merge.lacking, plural(merge.lacking),
      merge.lacking == 1 ? "is" : "are");
  return doubted;
}

struct ExportRequest {
  std::string database, out, table;  // no table: wide
  bool overwrite = false;
};

int run_export(const ExportRequest& options) {
  protect_inputs("--output", options.out, {{options.database, "the database"}});
  const fit::SqliteFile file(options.database, fit::SqliteFile::Opening::read);
  if (std::filesystem::path(options.out).extension() == ".nc") {
    if (!options.table.empty())
      throw usage_error("--table", "a netCDF file has all of a frame in one", "a name that ends in .csv");
    fit::write_survey_netcdf(file, options.out, options.overwrite);
    json_answer()["outputs"] = json_names({options.out});
    return good;
  }
  fit::write_survey_csv(file, *fit::survey_table_kind(options.table.empty() ? "wide" : options.table),
                        options.out, options.overwrite);
  json_answer()["outputs"] = json_names({options.out});
  return good;
}

struct SmoothRequest {
  std::string database, out;
  fit::SurveyMotionOptions motion;
  bool overwrite = false;
};

int run_smooth(const SmoothRequest& options) {
  end_at_once_when_interrupted();
  protect_inputs("--output", options.out, {{options.database, "the database"}});
  const fit::SurveyMotion made =
      fit::smooth_survey(options.database, options.out, options.motion, options.overwrite);
  json_answer() = {{"outputs", json_names({options.out})},
                   {"tracks", made.tracks},
                   {"numbers", made.used},
                   {"outliers", made.outliers},
                   {"breaks", made.breaks}};
  say("%d track%s of %d numbers; %d jumped and %s left out, %d track%s broken\n", made.tracks,
      plural(made.tracks), made.used, made.outliers, made.outliers == 1 ? "was" : "were", made.breaks,
      made.breaks == 1 ? " is" : "s are");
  return good;
}

struct ReportRequest {
  std::string database, out, plan;
  bool no_keograms = false, overwrite = false;
};

int run_report(const ReportRequest& options) {
  end_at_once_when_interrupted();
  const fit::SqliteFile database(options.database, fit::SqliteFile::Opening::read);
  fit::SurveyReportOptions report;
  report.overwrite = options.overwrite;
  report.keograms = !options.no_keograms;
  fit::SurveyPlan plan;
  if (!options.plan.empty()) {
    plan = fit::read_plan(options.plan);
    report.frames.plan = &plan;
    report.frames.eye = [&](int camera, int calibration) { return planned_eye(plan, camera, calibration); };
  }
  ProgressBar bar("survey report");
  report.progress = [&](double share) { bar.update(share); };
  const fit::SurveyReport made = fit::write_survey_report(database, options.out, report);
  bar.finish();
  json_answer() = {{"report", options.out + "/index.html"},
                   {"nights", made.nights},
                   {"keograms", made.keograms},
                   {"why_no_keogram", made.why_no_keogram}};
  say("%d night%s, %d keogram%s: %s/index.html\n", made.nights, plural(made.nights), made.keograms,
      plural(made.keograms), options.out.c_str());
  if (report.keograms && !made.why_no_keogram.empty())
    say("there are nights without a keogram: %s\n", made.why_no_keogram.c_str());
  return good;
}

}  // namespace

void add_survey_merge(const Command& survey) {
  const auto options = std::make_shared<MergeRequest>();
  const Command command = survey.add("merge", "Merge the databases of all shards");
  command.option("DATABASE", options->inputs, "Databases, or the folder of vegard survey run").required();
  command.option("-o,--output", options->out, "The database to write").required().type_name("OUT.sqlite");
  command.flag("--mixed", options->mixed, "Also merge databases of different plans or versions of vegard");
  command.flag("--overwrite", options->overwrite, "Replace a file that exists");
  command.runs([options] { return run_merge(*options); });
}

void add_survey_export(const Command& survey) {
  const auto options = std::make_shared<ExportRequest>();
  const Command command = survey.add("export", "Write a survey's database as a table (CSV) or as netCDF");
  command.option("DATABASE", options->database, "The database, merged or of one shard").required();
  command.option("-o,--output", options->out, "The file to write: netCDF if it ends in .nc, else CSV")
      .required()
      .type_name("OUT.csv");
  command
      .option("--table", options->table,
              "wide (default): a row a frame with all its numbers; frames; results: a row for each frame and "
              "work; quantities: a row for each number; velocities and flags, of vegard survey smooth")
      .one_of({"wide", "frames", "results", "quantities", "velocities", "flags"});
  command.flag("--overwrite", options->overwrite, "Replace a file that exists");
  command.runs([options] { return run_export(*options); });
}

void add_survey_smooth(const Command& survey) {
  const auto options = std::make_shared<SmoothRequest>();
  const Command command =
      survey.add("smooth", "Compute how curtains move: velocities with errors, and outliers");
  command.option("DATABASE", options->database, "The database, merged or of one shard").required();
  command.option("-o,--output", options->out, "The database to write, a copy with three more tables")
      .required()
      .type_name("OUT.sqlite");
  command
      .option("--quantity", options->motion.quantities,
              "Follow this number as well, by its name in the table quantity (repeatable)")
      .type_name("NAME")
      .one_an_occurrence();
  command.option("--gap-s", options->motion.gap_s, "Gap in seconds after which a track ends").shows_default();
  command
      .option("--false-alarms", options->motion.false_alarms,
              "Probability of a false alarm for each of the two outlier tests")
      .shows_default();
  command.flag("--overwrite", options->overwrite, "Replace a file that exists");
  command.runs([options] { return run_smooth(*options); });
}

void add_survey_report(const Command& survey) {
  const auto options = std::make_shared<ReportRequest>();
  const Command command =
      survey.add("report", "Write web pages (HTML): one for each night, one for the survey");
  command.option("DATABASE", options->database, "The database, merged or of one shard").required();
  command.option("-o,--output", options->out, "The folder to write").required().type_name("FOLDER");
  command
      .option("--plan", options->plan,
              "The survey's plan, which names the frames: for keograms, latitudes and links")
      .type_name("PLAN.json");
  command.flag("--no-keograms", options->no_keograms, "Do not read any frame");
  command.flag("--overwrite", options->overwrite, "Replace a report that exists");
  command.runs([options] { return run_report(*options); });
}

}  // namespace vegard::apps
