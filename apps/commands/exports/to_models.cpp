// `vegard to-gemini` and `vegard to-lompe`: maps of precipitation as models of the ionosphere read them.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/commands/commands.h"
#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/refusals.h"
#include "apps/options/standard_streams.h"
#include "apps/output/terminal.h"
#include "fit/report/netcdf/model_inputs.h"
#include "sim/base/utc_time.h"

namespace vegard::apps {
namespace {

struct ModelRequest {
  std::vector<std::string> maps;
  std::string output, time;
  double step_deg = 0.05, flux_factor = 0.0;
  bool overwrite = false;
};

fit::ModelInputs model_inputs_of(const ModelRequest& options, fit::EarthFrame frame) {
  std::optional<double> time_s;
  if (!options.time.empty()) {
    time_s = sim::utc_seconds(options.time);
    if (!time_s)
      throw usage_error("--time", "'" + options.time + "' is no time",
                        "ISO 8601 such as 2014-03-10T06:05:33Z");
  }
  return fit::model_inputs(options.maps, frame, options.step_deg, options.flux_factor, time_s);
}

void tell_grid(const fit::ModelInputs& inputs) {
  const fit::GeographicGrid& grid = inputs.grid;
  json_answer() = {{"longitude_cells", grid.longitude_deg.size()},
                   {"latitude_cells", grid.latitude_deg.size()},
                   {"longitude_deg", {grid.longitude_deg.front(), grid.longitude_deg.back()}},
                   {"latitude_deg", {grid.latitude_deg.front(), grid.latitude_deg.back()}},
                   {"outputs", Json::array()}};
  say("%zu x %zu cells, longitude %.3f to %.3f, latitude %.3f to %.3f\n", grid.longitude_deg.size(),
      grid.latitude_deg.size(), grid.longitude_deg.front(), grid.longitude_deg.back(),
      grid.latitude_deg.front(), grid.latitude_deg.back());
}

int run_to_gemini(const ModelRequest& options) {
  end_at_once_when_interrupted();
  std::vector<NamedInput> inside;
  for (const std::string& map : options.maps) inside.push_back({map, "a map"});
  protect_inputs_inside("--out", options.output, inside);
  fit::check_gemini_directory(options.output, options.overwrite);
  const fit::ModelInputs inputs = model_inputs_of(options, fit::EarthFrame::gemini_dipole);
  fit::write_gemini(options.output, options.overwrite, inputs);
  tell_grid(inputs);
  for (const double time_s : inputs.times_s) {
    const std::string name = options.output + "/" + fit::gemini_file_name(time_s);
    json_answer()["outputs"].push_back(name);
    say("%s\n", name.c_str());
  }
  return good;
}

int run_to_lompe(const ModelRequest& options) {
  end_at_once_when_interrupted();
  if (std::filesystem::path(options.output).extension() != ".nc")
    throw usage_error("--output", "'" + options.output + "' is no name of a netCDF file",
                      "a name that ends in .nc");
  for (const std::string& map : options.maps)
    if (same_file(options.output, map + "/precipitation.fits") || same_file(options.output, map))
      throw same_file_error("--output", options.output, "an input");
  const fit::ModelInputs inputs = model_inputs_of(options, fit::EarthFrame::geographic);
  sim::write_netcdf(fit::lompe_dataset(inputs), options.output, options.overwrite);
  tell_grid(inputs);
  json_answer()["outputs"].push_back(options.output);
  say("%s\n", options.output.c_str());
  return good;
}

void add_model_options(const Command& command, ModelRequest& options) {
  command.option("MAP", options.maps, "Directories that vegard map wrote, one for each time").required();
  command
      .option("--step-deg", options.step_deg,
              "Degrees of latitude between cells; longitude steps make the cells square")
      .range(0.001, 10.0)
      .shows_default();
  command.option("--time", options.time, "Time of the only map, in place of its own").type_name("TIME");
  command
      .option("--flux-factor", options.flux_factor,
              "Factor on energy fluxes, needed if the map's are relative")
      .type_name("F");
  command.flag("--overwrite", options.overwrite, "Replace an output that exists");
}

}  // namespace

void add_to_gemini_command(Program& program) {
  const auto options = std::make_shared<ModelRequest>();
  const Command command = program.add(
      "to-gemini",
      "Convert maps of precipitation to GEMINI's input: energy flux and energy by magnetic coordinates");
  add_model_options(command, *options);
  command.option("--out", options->output, "The directory to write: prec_dir of a config.nml")
      .required()
      .type_name("DIR");
  command.runs([options] { return run_to_gemini(*options); });
}

void add_to_lompe_command(Program& program) {
  const auto options = std::make_shared<ModelRequest>();
  const Command command = program.add(
      "to-lompe", "Convert maps of precipitation to Lompe's input: conductances by longitude and latitude");
  add_model_options(command, *options);
  command.option("-o,--output", options->output, "The file to write").required().type_name("OUT.nc");
  command.runs([options] { return run_to_lompe(*options); });
}

}  // namespace vegard::apps
