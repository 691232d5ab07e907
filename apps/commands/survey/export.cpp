#include <filesystem>
#include <memory>
#include <string>

#include "apps/commands/survey/steps.h"
#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/refusals.h"
#include "fit/survey/survey_export.h"

namespace vegard::apps {
namespace {

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

}  // namespace

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

}  // namespace vegard::apps
