#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/commands/atmosphere/atmosphere_plot.h"
#include "apps/commands/atmosphere/atmosphere_texts.h"
#include "apps/commands/commands.h"
#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/refusals.h"
#include "apps/options/standard_streams.h"
#include "apps/output/plot_file.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/utc_time.h"

namespace vegard::apps {
namespace {

constexpr std::size_t kHistory = 7;

struct AtmosphereRequest {
  std::string conditions, time, output, plot;
  std::optional<double> latitude_deg, longitude_deg, f107, f107a, ap;
  std::vector<double> ap_history;
  double bottom_km = sim::kAirBottomKm, top_km = sim::kAirTopKm;
  bool list = false, overwrite = false;
};

/// What was given, else what the named conditions have; there is nothing else to fall back on.
double number_of(const std::optional<double>& given, const char* option, const AtmosphereRequest& request,
                 double named, const char* expected) {
  if (given) return *given;
  if (request.conditions.empty())
    throw usage_error(option, "it is missing", expected, "--conditions NAME stands for all of them; --list");
  return named;
}

sim::AirConditions conditions_of(const AtmosphereRequest& request) {
  sim::AirConditions conditions;
  for (const sim::NamedConditions& named : sim::named_conditions())
    if (named.name == request.conditions) conditions = named.conditions;
  if (!request.time.empty()) {
    const std::optional<double> utc_s = sim::utc_seconds(request.time);
    if (!utc_s)
      throw usage_error("--time", "'" + request.time + "' is no time", "UTC such as 2014-03-10T06:05:33Z");
    conditions.utc_s = *utc_s;
  } else if (request.conditions.empty()) {
    throw usage_error("--time", "it is missing", "UTC such as 2014-03-10T06:05:33Z",
                      "--conditions NAME stands for all of them; --list");
  }
  conditions.latitude_deg = number_of(request.latitude_deg, "--latitude-deg", request,
                                      conditions.latitude_deg, "degrees, north positive");
  conditions.longitude_deg = number_of(request.longitude_deg, "--longitude-deg", request,
                                       conditions.longitude_deg, "degrees, east positive");
  const double named_mean = conditions.f107a;
  conditions.f107 = number_of(request.f107, "--f107", request, conditions.f107,
                              "the Sun's radio flux at 10.7 cm, 67 to some 300");
  conditions.f107a = request.f107a ? *request.f107a : request.f107 ? *request.f107 : named_mean;
  if (!request.ap_history.empty()) {
    if (request.ap) throw usage_error("--ap-history", "--ap is given as well", "one of the two");
    if (request.ap_history.size() != kHistory)
      throw usage_error(
          "--ap-history", std::to_string(request.ap_history.size()) + " numbers",
          "seven: of the day; of now, 3, 6, 9 hours before; means of 12-33, 36-57 hours before");
    for (const double ap : request.ap_history)
      if (!(ap >= 0.0 && ap <= 400.0))
        throw usage_error("--ap-history", "a number is out of range", "0 to 400");
    conditions.ap_history.emplace();
    std::copy(request.ap_history.begin(), request.ap_history.end(), conditions.ap_history->begin());
    return conditions;
  }
  conditions.ap = number_of(request.ap, "--ap", request, conditions.ap, "the day's magnetic index, 0 to 400");
  return conditions;
}

int run_atmosphere(const AtmosphereRequest& request) {
  if (request.list) {
    answer_with(named_conditions_json());
    say_result(named_conditions_text());
    return good;
  }
  const PlotFormat format = plot_format(request.plot, "--plot");
  if (same_file(request.plot, request.output)) refuse_same_file("--plot", request.plot, "another output");
  if (request.bottom_km >= request.top_km)
    throw usage_error("--bottom-km", "the bottom is not below the top", "less than --top-km");
  const AirColumn column = air_column(conditions_of(request), request.bottom_km, request.top_km);
  std::optional<sim::WholeFile> output, plot;
  if (!request.output.empty()) output.emplace(request.output, request.overwrite);
  if (format != PlotFormat::none) plot.emplace(request.plot, request.overwrite);
  if (output) output->write(air_csv(column));
  if (plot) plot->write(plot_bytes(air_plot(column), format));
  if (output) output->commit();
  if (plot) plot->commit();
  answer_with(air_json(column));
  json_answer()["outputs"] = json_names({request.output, request.plot});
  say_result(air_text(column));
  return good;
}

/// The names as a list of words in a message or a help text; empty for a good one.
std::string complaint_about(const std::string& name) {
  std::string names;
  for (const sim::NamedConditions& named : sim::named_conditions()) {
    if (named.name == name) return {};
    names += (names.empty() ? "" : ", ") + named.name;
  }
  return "'" + name + "' is not one of " + names;
}

}  // namespace

void add_atmosphere_command(Program& program) {
  const auto options = std::make_shared<AtmosphereRequest>();
  const Command command = program.add(
      "atmosphere",
      "Compute the neutral air for a place, a time and an activity (NRLMSISE-00), for vegard electrons");
  command.option("--time", options->time, "Time in UTC, such as 2014-03-10T06:05:33Z").type_name("TIME");
  command.option("--latitude-deg", options->latitude_deg, "Geographic latitude, north positive")
      .finite_range(-90.0, 90.0);
  command.option("--longitude-deg", options->longitude_deg, "Geographic longitude, east positive")
      .finite_range(-180.0, 360.0);
  command
      .option("--f107", options->f107,
              "The Sun's radio flux at 10.7 cm on the day before, in 10^-22 W m^-2 Hz^-1")
      .finite_range(50.0, 400.0);
  command
      .option("--f107a", options->f107a, "Mean of that flux over the 81 days about the day (default: --f107)")
      .finite_range(50.0, 400.0);
  command.option("--ap", options->ap, "Magnetic index of the day").finite_range(0.0, 400.0);
  command
      .option("--ap-history", options->ap_history,
              "After storms, in place of --ap: ap of the day, now, 3, 6 and 9 hours before, and means of 12 "
              "to 33 and 36 to 57 hours before")
      .delimiter(',')
      .one_an_occurrence()
      .type_name("AP,AP,AP,AP,AP,AP,AP");
  command
      .option("--conditions", options->conditions,
              "Set all of these by a name; other options take precedence")
      .check(complaint_about, "NAME");
  command.flag("--list", options->list, "List the names and their meanings");
  command.option("--bottom-km", options->bottom_km, "Altitude of the first row")
      .finite_range(sim::kMsisBottomKm, sim::kMsisTopKm)
      .shows_default();
  command.option("--top-km", options->top_km, "Altitude of the last row")
      .finite_range(sim::kMsisBottomKm, sim::kMsisTopKm)
      .shows_default();
  command.option("-o,--output", options->output, "Temperature and densities by altitude")
      .type_name("OUT.csv");
  command.option("--plot", options->plot, "Draw temperature and densities").type_name("OUT.svg|OUT.png");
  command.flag("--overwrite", options->overwrite, "Replace outputs that exist");
  command.runs([options] { return run_atmosphere(*options); });
}

}  // namespace vegard::apps
