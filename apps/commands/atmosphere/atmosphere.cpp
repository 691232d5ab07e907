#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
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
#include "fit/report/plot/plot.h"
#include "sim/base/file/csv_table.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/utc_time.h"
#include "sim/light/air/msis_air.h"

namespace vegard::apps {
namespace {

/// The model's air at altitudes, from the bottom up.
struct AirColumn {
  sim::AirConditions conditions;
  std::vector<double> altitude_km;
  std::vector<sim::MsisAir> air;
};

/// Computes the air. Throws Error(usage) where the model is not valid.
AirColumn air_column(const sim::AirConditions& conditions, double bottom_km, double top_km) {
  const sim::MsisModel model = sim::sound_msis_model(conditions);
  AirColumn column;
  column.conditions = conditions;
  column.altitude_km = sim::air_altitudes(bottom_km, top_km);
  for (const double altitude : column.altitude_km) column.air.push_back(model.at(altitude));
  return column;
}

/// CSV that sim::read_air_table() reads: conditions in comments; altitude_km, T_K, densities in cm^-3, mass.
std::string air_csv(const AirColumn& column) {
  std::string text = sim::csv_comment("air: NRLMSISE-00 (Picone et al. 2002)") +
                     sim::csv_comment("conditions: " + sim::condition_words(column.conditions)) +
                     sim::csv_comment("units: km, K, cm^-3; mass_g_cm3 without nO_anomalous");
  text += "altitude_km,T_K,nN2,nO2,nO,nHe,nAr,nH,nN4S,nO_anomalous,mass_g_cm3\n";
  for (std::size_t r = 0; r < column.altitude_km.size(); ++r) {
    const sim::MsisAir& air = column.air[r];
    text += fmt::format("{},{:.3f}", sim::csv_number(column.altitude_km[r]), air.temperature_k);
    for (const double density : air.density_cm3) text += fmt::format(",{:.6e}", density);
    text += fmt::format(",{:.6e},{:.6e}\n", air.hot_o_cm3, air.mass_g_cm3);
  }
  return text;
}

/// Lines of text: conditions, temperatures, the altitude above which O is more abundant than N2.
std::string air_text(const AirColumn& column) {
  const auto ratio = [&](std::size_t r) {
    return column.air[r].of(sim::MsisGas::o) / column.air[r].of(sim::MsisGas::n2);
  };
  std::size_t coldest = 0, last = column.air.size() - 1;
  for (std::size_t r = 0; r < column.air.size(); ++r)
    if (column.air[r].temperature_k < column.air[coldest].temperature_k) coldest = r;
  std::string text = fmt::format("air: NRLMSISE-00, {}\n", sim::condition_words(column.conditions));
  text += fmt::format("temperature: least {:.1f} K at {:g} km, {:.1f} K at {:g} km\n",
                      column.air[coldest].temperature_k, column.altitude_km[coldest],
                      column.air[last].temperature_k, column.altitude_km[last]);
  text +=
      fmt::format("mass density: {:.3e} g cm^-3 at {:g} km, {:.3e} at {:g} km\n", column.air[0].mass_g_cm3,
                  column.altitude_km[0], column.air[last].mass_g_cm3, column.altitude_km[last]);
  for (std::size_t r = 1; r < column.air.size(); ++r)
    if (ratio(r - 1) < 1.0 && ratio(r) >= 1.0)
      return text + fmt::format("O overtakes N2 between {:g} and {:g} km\n", column.altitude_km[r - 1],
                                column.altitude_km[r]);
  return text + fmt::format("O to N2: {:.3g} at {:g} km\n", ratio(last), column.altitude_km[last]);
}

/// The same as JSON, with the densities of the gases at the bottom and the top.
std::string air_json(const AirColumn& column) {
  const auto level = [&](std::size_t r) {
    const sim::MsisAir& air = column.air[r];
    return Json{{"altitude_km", column.altitude_km[r]}, {"temperature_k", air.temperature_k},
                {"n2_cm3", air.of(sim::MsisGas::n2)},   {"o2_cm3", air.of(sim::MsisGas::o2)},
                {"o_cm3", air.of(sim::MsisGas::o)},     {"mass_g_cm3", air.mass_g_cm3}};
  };
  std::size_t coldest = 0;
  for (std::size_t r = 0; r < column.air.size(); ++r)
    if (column.air[r].temperature_k < column.air[coldest].temperature_k) coldest = r;
  return Json{{"model", "NRLMSISE-00"},
              {"conditions", sim::condition_words(column.conditions)},
              {"bottom", level(0)},
              {"coldest", level(coldest)},
              {"top", level(column.air.size() - 1)}}
      .dump();
}

std::string named_conditions_json() {
  Json conditions = Json::object();
  for (const sim::NamedConditions& named : sim::named_conditions())
    conditions[named.name] = sim::condition_words(named.conditions);
  return Json{{"conditions", conditions}}.dump();
}

/// The named conditions, a line each, and as JSON.
std::string named_conditions_text() {
  std::string text;
  for (const sim::NamedConditions& named : sim::named_conditions())
    text += fmt::format("{:<14} {}\n", named.name, sim::condition_words(named.conditions));
  return text;
}

constexpr std::array<const char*, sim::kMsisGases> kGasNames = {"N2", "O2", "O", "He", "Ar", "H", "N"};
constexpr double kMinLog = 2.0;  // 100 cm^-3: below it nothing is of interest

fit::Panel altitude_panel(const char* title, const char* label) {
  fit::Panel panel;
  panel.title = title;
  panel.x.label = label;
  panel.y.label = "altitude (km)";
  return panel;
}

/// Two panels, altitude upwards: the densities of all gases, and the temperature.
fit::Plot air_plot(const AirColumn& column) {
  fit::Panel densities = altitude_panel("Densities", "log10(density in cm^-3)"),
             temperature = altitude_panel("Temperature", "temperature (K)");
  double most = kMinLog + 1.0;
  for (std::size_t g = 0; g < sim::kMsisGases; ++g) {
    fit::Series series;
    series.label = kGasNames[g];
    series.colour = fit::distinct_colour(static_cast<int>(g));
    series.y = column.altitude_km;
    for (const sim::MsisAir& air : column.air) series.x.push_back(std::log10(air.density_cm3[g]));
    most = std::max(most, *std::max_element(series.x.begin(), series.x.end()));
    densities.series.push_back(series);
  }
  densities.x.min = kMinLog;
  densities.x.max = most + 0.2;
  fit::Series kelvin;
  kelvin.y = column.altitude_km;
  for (const sim::MsisAir& air : column.air) kelvin.x.push_back(air.temperature_k);
  temperature.series.push_back(kelvin);
  temperature.x.min = 0.0;
  fit::Plot plot;
  plot.title = "Neutral air, NRLMSISE-00";
  plot.note = sim::condition_words(column.conditions);
  plot.panels = {densities, temperature};
  return plot;
}

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
  protect_outputs({{"--output", request.output}, {"--plot", request.plot}}, {});
  if (request.bottom_km >= request.top_km)
    throw usage_error("--bottom-km", "the bottom is not below the top", "less than --top-km");
  const AirColumn column = air_column(conditions_of(request), request.bottom_km, request.top_km);
  sim::WholeFiles outputs({request.output, request.plot}, request.overwrite);
  outputs.write(request.output, air_csv(column));
  if (format != PlotFormat::none) outputs.write(request.plot, plot_bytes(air_plot(column), format));
  outputs.commit();
  answer_with(air_json(column));
  json_answer()["outputs"] = json_names(outputs.written());
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
