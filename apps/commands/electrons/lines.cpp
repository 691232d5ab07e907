#include "apps/commands/commands.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/commands/electrons/electron_options.h"
#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/standard_streams.h"
#include "apps/output/plot_file.h"
#include "fit/report/plot/plot.h"
#include "fit/report/quenching_plot.h"
#include "sim/base/error.h"
#include "sim/base/file/csv_table.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/whole_file.h"
#include "sim/light/chemistry/line_sources.h"
#include "sim/scene/lines/emission_lines.h"

namespace vegard::apps {
namespace {

struct LineSourcesRequest {
  ElectronOptions electrons;
  std::string reactions, output, plot;
  double oxygen_factor = 1.0;
  std::optional<double> seconds;
};

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

/// Adds the options that require the flag `sources`.
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
  protect_outputs({{"--output", request.output}, {"--plot", request.plot}},
                  {request.electrons.table, air_file(request.electrons.atmosphere), request.reactions});
  const ElectronOptions& electrons = request.electrons;
  const sim::IncidentSpectrum spectrum = spectrum_of(electrons);
  const sim::AirTable air =
      sim::with_oxygen_factor(air_of_choice(electrons.atmosphere), request.oxygen_factor);
  const sim::Reactions reactions =
      request.reactions.empty()
          ? sim::Reactions::standard()
          : sim::Reactions::changed(
                sim::input_bytes(request.reactions, "a table of the columns of data/electrons/reactions.csv"),
                request.reactions);
  sim::WholeFiles outputs({request.output, request.plot}, overwrite);

  const sim::Degradation all = sim::degradation(sim::energy_grid(1e3 * sim::highest_energy_kev(spectrum)));
  const sim::AuroralRun run = sim::auroral_run(
      all, sim::field_air(air, electrons.dip_deg),
      sim::incident_flux(spectrum, all.grid, electrons.flux_mw_m2), pitch_angles_of(electrons), reactions,
      request.seconds.value_or(std::numeric_limits<double>::infinity()));
  require_balance(electrons, run.rates.budget.missing_share());
  const std::vector<sim::SourcedLine>& lines = run.light.lines;
  const std::string words = electron_words(electrons, spectrum) + "; " + words_of_air(electrons.atmosphere);
  if (!request.output.empty()) outputs.write(request.output, sources_csv(run, lines));
  if (format != PlotFormat::none)
    outputs.write(request.plot, plot_bytes(sources_plot(run, lines, words), format));
  outputs.commit();
  answer_sources(run, lines);
  json_answer()["electrons"] = words;
  json_answer()["outputs"] = json_names(outputs.written());
  say_result(words + "\n" + sources_text(run, lines));
  return good;
}

std::string lifetime_text(double seconds) {
  if (seconds == 0.0) return "–";
  if (seconds >= 3600.0) return fmt::format("{:.0f} h", seconds / 3600.0);
  if (seconds >= 1e-3) return fmt::format("{:.4g} s", seconds);
  return seconds >= 1e-6 ? fmt::format("{:g} µs", seconds * 1e6) : fmt::format("{:.0f} ns", seconds * 1e9);
}

double megakelvin(const sim::TemperatureResponse& response) {
  return std::pow(10.0, response.peak_log_k - 6.0);
}

std::string column_text(const sim::EmissionLine& line) {
  if (const auto response = sim::temperature_response(line.wavelength_nm))
    return fmt::format("of the Sun, of {:.2g} MK", megakelvin(*response));
  if (sim::is_solar(line)) return "of the Sun";
  if (sim::is_subauroral(line)) return "of STEVE";
  if (!sim::is_auroral(line)) return "of nebulae";
  if (line.ratio_source[0] == '\0') return line.table_column;
  return fmt::format("{:.4g} × {}", line.ratio, line.table_column);
}

std::string line_listing() {
  std::string text;
  for (const sim::EmissionLine& line : sim::emission_lines()) {
    text += fmt::format("{:5.1f} nm  {:3}  {}; lives {}; light: {}\n", line.wavelength_nm, line.species,
                        line.transition, lifetime_text(line.lifetime_s), column_text(line));
    if (line.ratio_source[0] != '\0') text += fmt::format("          ratio: {}\n", line.ratio_source);
    if (const auto response = sim::temperature_response(line.wavelength_nm))
      text += fmt::format("          by temperature: exp(-1/2 ((log10 T - {:.2f}) / {:.2f})^2), {}\n",
                          response->peak_log_k, response->width_log_k, response->source);
    if (line.blended_with[0] != '\0') text += fmt::format("          blended with {}\n", line.blended_with);
  }
  return text;
}

/// The rows of --csv, and what they rest on.
void answer_lines() {
  Json lines = Json::array();
  for (const sim::EmissionLine& line : sim::emission_lines()) {
    Json one = {{"wavelength_nm", line.wavelength_nm}, {"species", line.species},
                {"transition", line.transition},       {"lifetime_s", json_number(line.lifetime_s)},
                {"table_column", line.table_column},   {"ratio", json_number(line.ratio)},
                {"ratio_source", line.ratio_source},   {"blended_with", line.blended_with},
                {"components", Json::array()}};
    for (const sim::LineComponent& component : line.components)
      one["components"].push_back({{"wavelength_nm", component.wavelength_nm}, {"share", component.share}});
    if (const auto response = sim::temperature_response(line.wavelength_nm)) {
      one["peak_log_k"] = response->peak_log_k;
      one["width_log_k"] = response->width_log_k;
    }
    lines.push_back(one);
  }
  json_answer()["lines"] = lines;
}

std::string line_page() {
  std::string text =
      "# Emission lines\n\n"
      "The lines that `emission.lines` can have (up to eight), by `vegard lines --markdown`: species, "
      "transition, lifetime, and light: a column of the [emission tables](file_formats.md#emission-tables), "
      "or a ratio of photons to one; of [nebulae](nebulae.md), the Sun or [STEVE](steve.md) without "
      "electrons. A filter of some nm also passes what a line is *blended with*.\n\n";
  for (const sim::EmissionLine& line : sim::emission_lines()) {
    text += fmt::format("- {:.1f} nm:", line.wavelength_nm);
    if (line.species != std::string("*")) text += fmt::format(" {}", line.species);
    text += fmt::format(" {}", line.transition);
    if (line.lifetime_s != 0.0) text += ", " + lifetime_text(line.lifetime_s);
    if (const auto response = sim::temperature_response(line.wavelength_nm))
      text += fmt::format("; of the Sun, p {:.2f} ({:.2g} MK), w {:.2f}", response->peak_log_k,
                          megakelvin(*response), response->width_log_k);
    else
      text += "; " + column_text(line);
    if (line.blended_with[0] != '\0') text += fmt::format("; blended with {}", line.blended_with);
    text += "\n";
  }
  text += "\n## Where the ratios come from\n\n";
  for (const sim::EmissionLine& line : sim::emission_lines())
    if (line.ratio_source[0] != '\0')
      text += fmt::format("- **{:.1f} nm**: {}.\n", line.wavelength_nm, line.ratio_source);
  text +=
      "\nA line with a ratio has the heights of its column: 670.5 nm, which needs less energy and is "
      "quenched "
      "below 90 km, only nearly.\n";
  text +=
      "\n## Lines and bands under one wavelength\n\n"
      "`vegard lines --csv` has every share.\n\n";
  for (const sim::EmissionLine& line : sim::emission_lines()) {
    if (line.components.size() < 2) continue;
    text += fmt::format("- **{:.1f} nm**: {}.\n", line.wavelength_nm, line.components_source);
  }
  text +=
      "\n## Bands of the Sun\n\n"
      "At the temperature T (K) of `temperature_mk` such a line has exp(-1/2 ((log10 T - p) / w)²) of its "
      "peak. `sensor.response = \"grey\"` shows what eyes do not see. Sources of the peaks:\n\n";
  std::vector<std::pair<std::string, std::string>> lines_of_source;  // in the order of their first lines
  for (const sim::EmissionLine& line : sim::emission_lines()) {
    const auto response = sim::temperature_response(line.wavelength_nm);
    if (!response) continue;
    const auto known = std::find_if(lines_of_source.begin(), lines_of_source.end(),
                                    [&](const auto& entry) { return entry.second == response->source; });
    const std::string nm = fmt::format("{:.1f}", line.wavelength_nm);
    if (known == lines_of_source.end())
      lines_of_source.emplace_back(nm, response->source);
    else
      known->first += ", " + nm;
  }
  for (const auto& [nm, source] : lines_of_source) text += fmt::format("- {} nm: {}\n", nm, source);
  text +=
      "\n## Quenching\n\n"
      "The share of the slow lines' light that collisions leave, and their lifetimes (`vegard lines "
      "--quenching quenching.svg`; [sources](physics.md#the-physical-blur)).\n\n"
      "![Quenching of the slow lines](pictures/quenching.svg)\n";
  return text;
}

std::string line_csv() {
  std::string text =
      "wavelength_nm,species,transition,lifetime_s,table_column,ratio,ratio_source,blended_with,components,"
      "peak_log_k,width_log_k\n";
  for (const sim::EmissionLine& line : sim::emission_lines()) {
    std::string components;
    for (const sim::LineComponent& c : line.components)
      components += fmt::format("{}{:.1f}:{:g}", components.empty() ? "" : " ", c.wavelength_nm, c.share);
    const auto response = sim::temperature_response(line.wavelength_nm);
    text +=
        fmt::format("{:.1f},{},{},{:g},{},{:.6g},{},{},{},{}\n", line.wavelength_nm, line.species,
                    sim::csv_cell(line.transition), line.lifetime_s, line.table_column, line.ratio,
                    sim::csv_cell(line.ratio_source), sim::csv_cell(line.blended_with), components,
                    response ? fmt::format("{:g},{:g}", response->peak_log_k, response->width_log_k) : ",");
  }
  return text;
}

}  // namespace

void add_lines_command(Program& program) {
  struct LinesRequest {
    bool markdown = false, csv = false, overwrite = false, sources = false;
    std::string quenching;
    LineSourcesRequest of_electrons;
  };
  const auto options = std::make_shared<LinesRequest>();
  const Command command = program.add("lines",
                                      "List the emission lines: wavelength, species, lifetime, source; plot "
                                      "their quenching; compute their sources");
  const Option page = command.flag("--markdown", options->markdown, "Print the documentation page instead");
  const Option csv = command.flag("--csv", options->csv, "Print a table (CSV) instead").excludes(page);
  const Option plot = command
                          .option("--quenching", options->quenching,
                                  "Plot how collisions quench the slow lines, as .svg or .png")
                          .excludes(page)
                          .excludes(csv);
  command.flag("--overwrite", options->overwrite, "Replace an existing output");
  const Option sources =
      command
          .flag("--sources", options->sources,
                "Compute each line's brightness under electrons, and the share of each source")
          .excludes(page)
          .excludes(csv)
          .excludes(plot);
  add_line_source_options(command, sources, options->of_electrons);
  command.runs([options] {
    if (options->sources) return run_line_sources(options->of_electrons, options->overwrite);
    if (!options->quenching.empty()) {
      const PlotFormat format = plot_format(options->quenching, "--quenching");
      sim::write_whole(options->quenching, plot_bytes(fit::quenching_plot(), format), options->overwrite);
      json_answer()["outputs"] = json_names({options->quenching});
    } else {
      answer_lines();
      say_result(options->markdown ? line_page() : options->csv ? line_csv() : line_listing());
    }
    return good;
  });
}

}  // namespace vegard::apps
