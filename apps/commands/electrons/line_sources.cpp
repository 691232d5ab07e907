#include "apps/commands/electrons/line_sources.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/refusals.h"
#include "apps/options/standard_streams.h"
#include "apps/output/plot_file.h"
#include "fit/report/plot/plot.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/whole_file.h"
#include "sim/light/chemistry/line_sources.h"
#include "sim/scene/structs/scene.h"

namespace vegard::apps {
namespace {

constexpr double kMinShare = 0.005;  // of a line, that is listed and drawn

double peak_km(const sim::FieldAir& column, const std::vector<double>& rate) {
  return column
      .altitude_km[static_cast<std::size_t>(std::max_element(rate.begin(), rate.end()) - rate.begin())];
}

std::string sources_text(const sim::AuroralRun& run, const std::vector<sim::SourcedLine>& lines) {
  std::string text;
  for (const sim::SourcedLine& line : lines) {
    const std::vector<double> all = line.photons_cm3_s();
    const double rayleigh = sim::column_rayleigh(run.column, all);
    text += fmt::format("{:.1f} nm {:10.1f} R, brightest at {:.1f} km", line.wavelength_nm, rayleigh,
                        peak_km(run.column, all));
    std::string separator = ": ";
    for (const sim::LineSource& source : line.sources) {
      const double share = sim::column_rayleigh(run.column, source.photons_cm3_s) / rayleigh;
      if (!(share >= kMinShare)) continue;
      text += fmt::format("{}{} {:.0f} %", separator, source.name, 100.0 * share);
      separator = ", ";
    }
    text += "\n";
  }
  return text;
}

void answer_sources(const sim::AuroralRun& run, const std::vector<sim::SourcedLine>& lines) {
  json_answer()["lines"] = Json::array();
  for (const sim::SourcedLine& line : lines) {
    const std::vector<double> all = line.photons_cm3_s();
    Json one = {{"wavelength_nm", line.wavelength_nm},
                {"rayleigh", json_number(sim::column_rayleigh(run.column, all))},
                {"peak_km", json_number(peak_km(run.column, all))},
                {"sources", Json::array()}};
    for (const sim::LineSource& source : line.sources)
      one["sources"].push_back(
          {{"name", source.name},
           {"rayleigh", json_number(sim::column_rayleigh(run.column, source.photons_cm3_s))}});
    json_answer()["lines"].push_back(one);
  }
}

/// Photons cm^-3 s^-1 of every source, a row a place, with the ions.
std::string sources_csv(const sim::AuroralRun& run, const std::vector<sim::SourcedLine>& lines) {
  std::string text = "altitude_km,electrons_cm3,O+_cm3,O2+_cm3,NO+_cm3,N2+_cm3";
  for (const sim::SourcedLine& line : lines) {
    text += fmt::format(",{}", line.column);
    if (!line.lifetime_s.empty()) text += fmt::format(",lifetime_s_{}", line.column.substr(4));
    for (const sim::LineSource& source : line.sources) {
      std::string name = source.name;
      std::replace(name.begin(), name.end(), ',', ';');
      text += fmt::format(",{}: {}", line.column, name);
    }
  }
  text += "\n";
  for (std::size_t m = 0; m < run.column.size(); ++m) {
    const sim::IonDensities& ions = run.light.ions[m];
    text += fmt::format("{:.3f},{:.4e},{:.4e},{:.4e},{:.4e},{:.4e}", run.column.altitude_km[m],
                        ions.electrons, ions.op + ions.op2d + ions.op2p, ions.o2p, ions.nop, ions.n2p);
    for (const sim::SourcedLine& line : lines) {
      double all = 0.0;
      for (const sim::LineSource& source : line.sources) all += source.photons_cm3_s[m];
      text += fmt::format(",{:.4e}", all);
      if (!line.lifetime_s.empty()) text += fmt::format(",{:.4e}", line.lifetime_s[m]);
      for (const sim::LineSource& source : line.sources)
        text += fmt::format(",{:.4e}", source.photons_cm3_s[m]);
    }
    text += "\n";
  }
  return text;
}

fit::Series curve(const std::string& label, fit::Colour colour, const sim::FieldAir& column,
                  const std::vector<double>& rate) {
  constexpr double kHighestKm = 400.0;
  fit::Series series;
  series.label = label;
  series.colour = colour;
  for (std::size_t m = 0; m < rate.size() && column.altitude_km[m] <= kHighestKm; ++m) {
    series.x.push_back(rate[m] > 0.0 ? std::log10(rate[m]) : std::numeric_limits<double>::quiet_NaN());
    series.y.push_back(column.altitude_km[m]);
  }
  return series;
}

/// A panel a line of atoms: the bands of N2 come from impact alone. A source looks the same in all panels.
fit::Plot sources_plot(const sim::AuroralRun& run, const std::vector<sim::SourcedLine>& lines,
                       const std::string& note) {
  constexpr double kDecades = 4.0, kBandsNm = 670.5;
  constexpr int kColours = 6;
  std::vector<std::string> names;
  fit::Plot plot;
  plot.title = "Where the lines come from";
  plot.note = note;
  for (const sim::SourcedLine& line : lines) {
    if (line.sources.size() < 2 || line.wavelength_nm == kBandsNm) continue;
    const std::vector<double> all = line.photons_cm3_s();
    const double most = *std::max_element(all.begin(), all.end()),
                 rayleigh = sim::column_rayleigh(run.column, all);
    fit::Panel panel;
    panel.title = fmt::format("{:.1f} nm, {:.0f} R", line.wavelength_nm, rayleigh);
    panel.x.label = "log10(photons cm^-3 s^-1)";
    panel.y.label = "altitude (km)";
    if (most > 0.0) {
      panel.x.max = std::log10(most) + 0.2;
      panel.x.min = std::log10(most) - kDecades;
    }
    panel.series.push_back(curve("all", fit::distinct_colour(0), run.column, all));
    for (const sim::LineSource& source : line.sources) {
      if (sim::column_rayleigh(run.column, source.photons_cm3_s) < kMinShare * rayleigh) continue;
      auto found = std::find(names.begin(), names.end(), source.name);
      if (found == names.end()) found = names.insert(names.end(), source.name);
      const int look = static_cast<int>(found - names.begin());
      panel.series.push_back(
          curve(source.name, fit::distinct_colour(1 + look % kColours), run.column, source.photons_cm3_s));
      if (look >= kColours) panel.series.back().mark = fit::Mark::dashed_line;
    }
    plot.panels.push_back(panel);
  }
  return plot;
}

}  // namespace

void add_line_source_options(const Command& command, const Option& sources, LineSourcesRequest& request) {
  for (const Option& option : add_electron_options(command, request.electrons)) option.needs(sources);
  command
      .option("--reactions", request.reactions,
              "Rows that replace those of data/electrons/reactions.csv (needs --sources)")
      .type_name("FILE.csv")
      .needs(sources);
  command.option("--oxygen-factor", request.oxygen_factor, "Multiple of the atomic oxygen")
      .finite_range(sim::kMinOxygenFactor, sim::kMaxOxygenFactor)
      .needs(sources);
  command
      .option("--seconds", request.seconds,
              "Duration of the precipitation in seconds (default: a steady state)")
      .finite_range(0.001, 1e6)
      .needs(sources);
  command.option("-o,--output", request.output, "Write light by altitude and source, ions and lifetimes")
      .type_name("OUT.csv")
      .needs(sources);
  command.option("--plot", request.plot, "Draw the sources by altitude")
      .type_name("OUT.svg|OUT.png")
      .needs(sources);
}

ExitCode run_line_sources(const LineSourcesRequest& request, bool overwrite) {
  const PlotFormat format = plot_format(request.plot, "--plot");
  for (const auto& [key, file] : {std::pair{"--output", request.output}, std::pair{"--plot", request.plot}})
    for (const std::string& input :
         {request.electrons.table, air_file(request.electrons.atmosphere), request.reactions})
      if (same_file(file, input)) refuse_same_file(key, file, "an input");
  if (same_file(request.plot, request.output)) refuse_same_file("--plot", request.plot, "another output");
  const ElectronOptions& electrons = request.electrons;
  const sim::IncidentSpectrum spectrum = spectrum_of(electrons);
  const sim::AirTable air = sim::with_oxygen_factor(air_of(electrons), request.oxygen_factor);
  const sim::Reactions reactions =
      request.reactions.empty()
          ? sim::Reactions::standard()
          : sim::Reactions::changed(
                sim::input_bytes(request.reactions, "a table of the columns of data/electrons/reactions.csv"),
                request.reactions);
  std::optional<sim::WholeFile> output, plot;
  if (!request.output.empty()) output.emplace(request.output, overwrite);
  if (format != PlotFormat::none) plot.emplace(request.plot, overwrite);

  const sim::Degradation all = sim::degradation(sim::energy_grid(1e3 * sim::highest_energy_kev(spectrum)));
  const sim::AuroralRun run = sim::auroral_run(all, sim::field_air(air, electrons.dip_deg),
                                               sim::incident_flux(spectrum, all.grid, electrons.flux_mw_m2),
                                               pitch_angles_of(electrons), reactions);
  require_balance(electrons, run.rates.budget.missing_share());
  std::vector<sim::SourcedLine> lines = run.light.lines;
  if (request.seconds)
    for (sim::SourcedLine& line : lines) line = sim::after_seconds(line, *request.seconds);
  const std::string words = electron_words(electrons, spectrum) + "; " + air_words(electrons);
  if (output) output->write(sources_csv(run, lines));
  if (plot) plot->write(plot_bytes(sources_plot(run, lines, words), format));
  if (output) output->commit();
  if (plot) plot->commit();
  answer_sources(run, lines);
  json_answer()["electrons"] = words;
  json_answer()["outputs"] = json_names({request.output, request.plot});
  say_result(words + "\n" + sources_text(run, lines));
  return good;
}

}  // namespace vegard::apps
