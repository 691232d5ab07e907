#include <memory>
#include <string>

#include "apps/commands/survey/steps.h"
#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/standard_streams.h"
#include "apps/output/terminal.h"
#include "fit/survey/survey_motion.h"

namespace vegard::apps {
namespace {

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
      made.tracks == 1 ? "" : "s", made.used, made.outliers, made.outliers == 1 ? "was" : "were", made.breaks,
      made.breaks == 1 ? " is" : "s are");
  return good;
}

}  // namespace

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

}  // namespace vegard::apps
