#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/commands/commands.h"
#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/refusals.h"
#include "apps/options/standard_streams.h"
#include "apps/output/plot_file.h"
#include "fit/report/track/track_report.h"
#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/utc_time.h"

namespace vegard::apps {
namespace {

struct TrackOptions {
  std::vector<std::string> maps;
  std::string along, tle, times, satellite, time, output, plot;
  double time_tolerance_s = 60.0, flux_factor = 0.0;
  bool overwrite = false;
};

/// The maps, each with a time and absolute fluxes.
std::vector<fit::PrecipitationPlanes> maps_of(const TrackOptions& options) {
  std::optional<double> time_s;
  if (!options.time.empty()) {
    time_s = sim::utc_seconds(options.time);
    if (!time_s)
      throw usage_error("--time", "'" + options.time + "' is no time", "UTC such as 2014-03-10T06:05:33Z");
    if (options.maps.size() != 1) throw usage_error("--time", "several maps have a time each", "one map");
  }
  std::vector<fit::PrecipitationPlanes> maps;
  for (const std::string& directory : options.maps) {
    fit::PrecipitationPlanes map = fit::read_precipitation_planes(directory);
    if (time_s) map.time_s = time_s;
    if (!map.time_s)
      throw sim::unreadable(directory, "this map says no time")
          .expected("a map of a scene with site.time_utc")
          .hint("--time says it of a single map");
    if (!map.flux_is_absolute && options.flux_factor == 0.0)
      throw sim::unreadable(
          directory, "its energy flux is right up to a factor only, since the sensor is not calibrated")
          .expected("a map with FLUXCAL = 'absolute'")
          .hint("--flux-factor F says that factor, if it is known from elsewhere");
    if (options.flux_factor > 0.0)
      for (double& flux : map.energy_flux_mw_m2) flux *= options.flux_factor;
    maps.push_back(std::move(map));
  }
  return maps;
}

std::vector<fit::SatellitePoint> track_of(const TrackOptions& options, std::string& words) {
  if (options.along.empty() == options.tle.empty())
    throw usage_error("--along", options.along.empty() ? "there is no track" : "--tle is given as well",
                      "--along TRACK.csv, or --tle FILE with --times START/STEP/STOP");
  if (!options.along.empty()) {
    if (!options.times.empty()) throw usage_error("--times", "TRACK.csv has its times", "--tle with it");
    if (!options.satellite.empty())
      throw usage_error("--satellite", "TRACK.csv is of one satellite", "--tle with it");
    words = file_name_of(options.along);
    return fit::read_track(sim::input_bytes(options.along, "a table of a track"), options.along);
  }
  if (options.times.empty())
    throw usage_error("--times", "it is missing", "START/STEP/STOP with --tle, the step in seconds");
  double oldest_days = 0.0;
  const std::vector<fit::SatellitePoint> track =
      fit::track_of_elements(sim::input_bytes(options.tle, "two-line elements"), options.tle,
                             options.satellite, fit::instants_of(options.times), oldest_days);
  words = fmt::format("{}, SGP4, elements within {:.1f} days", file_name_of(options.tle), oldest_days);
  return track;
}

int run_track(const TrackOptions& options) {
  const PlotFormat format = plot_format(options.plot, "--plot");
  const std::string ending = std::filesystem::path(options.output).extension().string();
  if (!options.output.empty() && ending != ".nc" && ending != ".csv")
    throw usage_error("--output", "'" + options.output + "' is no name of a netCDF or CSV file",
                      "a name that ends in .nc or .csv");
  std::vector<std::string> inputs = {options.along, options.tle};
  for (const std::string& map : options.maps) inputs.push_back(map + "/precipitation.fits");
  protect_outputs({{"--output", options.output}, {"--plot", options.plot}}, inputs);
  fit::TrackFacts facts;
  const std::vector<fit::SatellitePoint> track = track_of(options, facts.track);
  const std::vector<fit::PrecipitationPlanes> maps = maps_of(options);
  fit::TrackRequest request;
  request.time_tolerance_s = options.time_tolerance_s;
  sim::WholeFiles files({options.output, options.plot}, options.overwrite);

  const std::vector<fit::MetElectrons> met =
      fit::electrons_along(maps, track, request, options.along.empty() ? options.tle : options.along);
  bool are_maxwellian = true;
  for (const fit::PrecipitationPlanes& map : maps)
    are_maxwellian = are_maxwellian && map.spectrum == "maxwellian";
  std::vector<fit::TrackLine> lines;
  if (are_maxwellian)
    lines = fit::track_lines(met, sim::emission_tables(sim::kDefaultEmissionTables), {427.8, 557.7, 630.0});
  for (const std::string& map : options.maps) facts.maps.push_back(map);
  facts.field = fmt::format("IGRF-14, down to {:g} km", maps.front().height_km);
  if (ending == ".csv")
    files.write(options.output, fit::track_csv(met, lines, facts));
  else if (!options.output.empty())
    fit::track_dataset(met, lines, facts).write(files.file(options.output).temporary(), options.output);
  if (format != PlotFormat::none) files.write(options.plot, plot_bytes(fit::track_plot(met, facts), format));
  files.commit();
  std::size_t known = 0;
  for (const fit::MetElectrons& here : met) known += std::isfinite(here.energy_flux_mw_m2) ? 1 : 0;
  json_answer()["points"] = met.size();
  json_answer()["known_points"] = known;
  json_answer()["outputs"] = json_names(files.written());
  say_result(fit::track_text(met, facts));
  return good;
}

}  // namespace

void add_track_command(Program& program) {
  const auto options = std::make_shared<TrackOptions>();
  const Command command = program.add(
      "track", "Follow a satellite over maps of precipitation: what it met at its feet along the field");
  command.option("MAP", options->maps, "Directories that vegard map wrote, one for each time").required();
  command
      .option("--along", options->along,
              "A table of its places: time, latitude, longitude, altitude in km or radius in m (Swarm, DMSP)")
      .type_name("TRACK.csv");
  command.option("--tle", options->tle, "Its two-line elements, for SGP4 (needs --times)").type_name("FILE");
  command.option("--satellite", options->satellite, "Its number among several in the elements")
      .type_name("NUMBER");
  command.option("--times", options->times, "First time, seconds between, last time")
      .type_name("START/STEP/STOP");
  command
      .option("--time-tolerance", options->time_tolerance_s,
              "Longest time between a point and the map, which holds for one instant")
      .finite_range(0.0, 1e6)
      .type_name("SECONDS")
      .shows_default();
  command.option("--time", options->time, "Time of the only map, in place of its own").type_name("TIME");
  command
      .option("--flux-factor", options->flux_factor,
              "Factor on energy fluxes, needed if the map's are relative")
      .finite_range(1e-9, 1e9)
      .type_name("F");
  command.option("-o,--output", options->output, "Place, feet, electrons and light by time")
      .type_name("OUT.csv|OUT.nc");
  command.option("--plot", options->plot, "Draw energy flux and energy by time").type_name("OUT.svg|OUT.png");
  command.flag("--overwrite", options->overwrite, "Replace outputs that exist");
  command.runs([options] { return run_track(*options); });
}

}  // namespace vegard::apps
