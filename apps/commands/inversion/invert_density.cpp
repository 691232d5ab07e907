#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/commands/inversion/invert_request.h"
#include "apps/options/air_options.h"
#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/refusals.h"
#include "apps/options/standard_streams.h"
#include "apps/output/plot_file.h"
#include "apps/output/progress_bar.h"
#include "apps/output/terminal.h"
#include "fit/report/columns/density_texts.h"
#include "sim/base/file/whole_file.h"

namespace vegard::apps {
namespace {

constexpr const char* kAirOfTables = "tables";

void refuse_options_of_lines(const InvertRequest& request) {
  const auto refuse = [](bool is_given, const char* option) {
    if (is_given) throw usage_error(option, "it is of lines", "no --density with it");
  };
  refuse(!request.lines.empty(), "--line");
  refuse(!request.maps.empty(), "--map");
  refuse(!request.table.empty(), "--table");
  refuse(!request.errors.empty(), "--error");
  refuse(!request.relative_error.empty(), "--relative-error");
  refuse(!request.model_error.empty(), "--model-error");
  refuse(request.common_physics, "--common-physics");
  refuse(request.soft_kev.has_value(), "--soft-kev");
  refuse(request.spectrum.spectrum != "maxwellian", "--spectrum");
  refuse(request.spectrum.spread.has_value(), "--spread");
  refuse(request.spectrum.kappa.has_value(), "--kappa");
  refuse(request.free != InvertRequest{}.free, "--free");
  for (std::size_t k = 0; k < fit::kColumnUnknowns; ++k) refuse(request.held[k].has_value(), kHoldOptions[k]);
}

/// Two numbers of an option, the first below the second.
void require_range(const std::vector<double>& ends, const char* option) {
  if (ends.size() == 2 && !(ends[0] < ends[1]))
    throw usage_error(option, fmt::format("{:g} is not below {:g}", ends[0], ends[1]), "LOW HIGH");
}

std::string ending_of(const std::string& file) {
  const std::string ending = std::filesystem::path(file).extension().string();
  if (ending == ".json" || ending == ".csv" || ending == ".nc") return ending;
  throw usage_error("--output", "'" + file_name_of(file) + "' does not say what is to be written",
                    "a name that ends in .json, .csv or .nc");
}

}  // namespace

void add_density_options(const Command& command, DensityRequest& request) {
  const Option density =
      command
          .option(
              "--density", request.file,
              "In place of --line: profiles of electron density with errors, CSV or HDF5 of Madrigal, from "
              "which a spectrum is found")
          .type_name("FILE");
  command
      .option("--atmosphere", request.atmosphere,
              "With --density: the air, that of the tables, a name (vegard atmosphere --list) or a table")
      .type_name("tables|NAME|FILE.csv")
      .shows_default()
      .needs(density);
  command
      .option("--recombination", request.recombination,
              "With --density: that of ions in balance, or of Vickrey et al. 1982, taken as exact")
      .one_of({"chemistry", "vickrey"})
      .shows_default()
      .needs(density);
  command
      .option("--altitudes-km", request.altitudes_km,
              "With --density: the altitudes that are used (default: 85 150)")
      .expected(2)
      .finite_range(80.0, 300.0)
      .type_name("LOW HIGH")
      .needs(density);
  command
      .option(
          "--energies-kev", request.energies_kev,
          "With --density: energies of which flux and mean energy are told (default: all that the altitudes "
          "tell)")
      .expected(2)
      .finite_range(0.1, 100.0)
      .type_name("LOW HIGH")
      .needs(density);
  command.option("--beam", request.beam, "With --density: the beam of a Madrigal file")
      .type_name("ID")
      .needs(density);
  command.flag("--steady", request.is_steady, "With --density: each profile in a steady state, not in time")
      .needs(density);
}

int invert_density(const InvertRequest& request) {
  end_at_once_when_interrupted();
  const DensityRequest& of = request.density;
  refuse_options_of_lines(request);
  const PlotFormat format = plot_format(request.plot, "--plot");
  require_range(of.altitudes_km, "--altitudes-km");
  require_range(of.energies_kev, "--energies-kev");
  for (const std::string& output : request.outputs) ending_of(output);
  const bool has_own_air = of.atmosphere != kAirOfTables;
  spare_inputs(request, {of.file, has_own_air ? air_file(of.atmosphere) : std::string()});
  const fit::DensityTable table =
      fit::read_density_table(of.file, of.altitudes_km[0], of.altitudes_km[1], of.beam);
  if (format != PlotFormat::none && table.profiles.size() != 1)
    throw usage_error("--plot", "it draws one profile, and there are more", "-o OUT.nc for them");
  std::vector<std::string> outputs = request.outputs;
  outputs.push_back(request.plot);
  sim::WholeFiles files(outputs, request.overwrite);

  const bool is_chemistry = of.recombination == "chemistry";
  const fit::DensityPhysics physics(
      inversion_tables(request), has_own_air ? std::optional(air_of_choice(of.atmosphere)) : std::nullopt,
      is_chemistry ? sim::RecombinationLaw::chemistry : sim::RecombinationLaw::vickrey, table.altitude_km);
  fit::DensityInversionOptions options;
  options.is_steady = of.is_steady || table.profiles.size() == 1;
  options.has_uncertainty = request.uncertainty != "none";
  options.threads = request.threads;
  if (!of.energies_kev.empty()) options.least_kev = of.energies_kev[0], options.most_kev = of.energies_kev[1];
  const fit::EnergyRange energies = fit::known_energies(physics, options);
  ProgressBar bar("inverting densities");
  options.progress = [&](double share) { bar.update(share); };
  const std::vector<fit::DensitySpectrum> spectra = fit::invert_densities(physics, table, options);
  bar.finish();

  fit::DensityFacts facts;
  facts.tables = request.tables;
  facts.air = has_own_air ? words_of_air(of.atmosphere) : "that of the emission tables " + request.tables;
  facts.recombination = is_chemistry ? "of ions in balance" : "of Vickrey et al. 1982, taken as exact";
  facts.balance = options.is_steady ? "in a steady state" : "in time, each profile after the one before";
  facts.errors = options.has_uncertainty ? "those of the density, and draws of the numbers of physics"
                                         : "those of the density; physics is taken as exact";
  facts.energies = energies;
  const fit::InvertedDensities inverted{physics, table, spectra};
  for (const std::string& output : request.outputs) {
    if (ending_of(output) == ".json") files.write(output, fit::density_json(inverted, facts));
    if (ending_of(output) == ".csv") files.write(output, fit::density_csv(inverted, facts));
    if (ending_of(output) == ".nc")
      fit::density_dataset(inverted, facts).write(files.file(output).temporary(), output);
  }
  if (format != PlotFormat::none)
    files.write(request.plot, plot_bytes(fit::density_plot(inverted, facts), format));
  files.commit();
  answer_with(fit::density_json(inverted, facts));
  say_result(fit::density_text(inverted, facts));
  return fit::most_contradict(spectra) ? doubted : good;
}

}  // namespace vegard::apps
