#include <filesystem>
#include <memory>
#include <string>

#include "apps/commands/commands.h"
#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/refusals.h"
#include "apps/options/standard_streams.h"
#include "apps/output/terminal.h"
#include "fit/report/netcdf/run_dataset.h"

namespace vegard::apps {
namespace {

struct NetcdfRequest {
  std::string input, output;
  bool overwrite = false;
};

int run_to_netcdf(const NetcdfRequest& options) {
  end_at_once_when_interrupted();
  if (std::filesystem::path(options.output).extension() != ".nc")
    throw usage_error("--output", "'" + options.output + "' is no name of a netCDF file",
                      "a name that ends in .nc");
  if (same_file(options.output, options.input))
    throw same_file_error("--output", options.output, "the input");
  const sim::NetcdfDataset dataset = fit::dataset_of(options.input);
  sim::write_netcdf(dataset, options.output, options.overwrite);
  json_answer() = {{"outputs", json_names({options.output})}, {"variables", dataset.variables().size()}};
  say("%s: %zu variables\n", options.output.c_str(), dataset.variables().size());
  return good;
}

}  // namespace

void add_to_netcdf_command(Program& program) {
  const auto options = std::make_shared<NetcdfRequest>();
  const Command command = program.add("to-netcdf", "Convert a run, a map, a sequence or a table to netCDF");
  command
      .option("INPUT", options->input,
              "The directory that fit, map or sequence wrote, or the CSV of profile or keogram")
      .required();
  command.option("-o,--output", options->output, "The file to write").required().type_name("OUT.nc");
  command.flag("--overwrite", options->overwrite, "Replace a file that exists");
  command.runs([options] { return run_to_netcdf(*options); });
}

}  // namespace vegard::apps
