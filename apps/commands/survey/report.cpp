#include <filesystem>
#include <memory>
#include <string>

#include "apps/commands/survey/steps.h"
#include "apps/options/exit_code.h"
#include "apps/options/json_answer.h"
#include "apps/options/standard_streams.h"
#include "apps/options/survey_eyes.h"
#include "apps/output/progress_bar.h"
#include "apps/output/terminal.h"
#include "fit/survey/report/survey_report.h"
#include "fit/survey/survey_plan.h"

namespace vegard::apps {
namespace {

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
  say("%d night%s, %d keogram%s: %s/index.html\n", made.nights, made.nights == 1 ? "" : "s", made.keograms,
      made.keograms == 1 ? "" : "s", options.out.c_str());
  if (report.keograms && !made.why_no_keogram.empty())
    say("there are nights without a keogram: %s\n", made.why_no_keogram.c_str());
  return good;
}

}  // namespace

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
