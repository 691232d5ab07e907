#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/commands/commands.h"
#include "apps/commands/electrons/electron_options.h"
#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/refusals.h"
#include "apps/options/standard_streams.h"
#include "apps/output/progress_bar.h"
#include "apps/output/terminal.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/whole_directory.h"
#include "sim/base/file/whole_file.h"
#include "sim/light/chemistry/light_mode_maker.h"
#include "sim/light/chemistry/table_maker.h"

namespace vegard::apps {
namespace {

constexpr const char* kAbout = "about.json";
constexpr const char* kModes = "modes.csv";
constexpr const char* kFiles[] = {"ver_maxwellian.csv",
                                  "ver_mono.csv",
                                  "column_brightness.csv",
                                  "linearity_Q.csv",
                                  "atmosphere.csv",
                                  kModes,
                                  kAbout};
constexpr int kMostDraws = 2000;

struct TablesRequest {
  std::string output, atmosphere = kDefaultAir, reactions;
  std::vector<double> oxygen = {0.5, 1.0, 2.0};
  double dip_deg = 78.0, refinement = 0.5, seconds = sim::kUsualSeconds;
  bool steady = false;
  int threads = 0;
  int ensemble = 0;
  std::uint64_t seed = 1;
  bool overwrite = false;
};

/// A folder of emission tables is known by its about.json.
sim::KnownFolder look_at_tables(const std::string& directory) {
  constexpr std::size_t kMaxBytes = 65536;
  sim::KnownFolder known;
  const sim::InputFile file = sim::read_input(directory + "/" + kAbout, kMaxBytes);
  if (!file.problem.empty())
    known.objection = std::string("its ") + kAbout + " " + file.problem;
  else if (file.bytes.find("\"vegard emission tables 1\"") == std::string::npos)
    known.objection = std::string("its ") + kAbout + " is none that vegard wrote";
  known.has = [](const std::string& name) {
    for (const char* file_of_tables : kFiles)
      if (name == file_of_tables) return true;
    return false;
  };
  return known;
}

void require_factors(const std::vector<double>& factors) {
  bool one = false, increasing = true;
  for (std::size_t i = 0; i < factors.size(); ++i) {
    one = one || factors[i] == 1.0;
    increasing = increasing && factors[i] >= sim::kMinOxygenFactor && factors[i] <= sim::kMaxOxygenFactor &&
                 (i == 0 || factors[i] > factors[i - 1]);
  }
  constexpr std::size_t kMax = 9;
  if (!one || !increasing || factors.size() > kMax)
    throw usage_error("--oxygen-factors", "the factors are not such as tables have",
                      "up to nine that increase, from 0.1 to 10, 1 among them, such as 0.5,1,2");
}

/// Makes the modes of the tables' uncertainty.
std::string modes_of(const TablesRequest& request, const sim::TableRequest& tables) {
  sim::ModeRequest modes;
  modes.draws = request.ensemble;
  modes.seed = request.seed;
  ProgressBar bar("drawing the numbers of physics");
  sim::ModeSummary summary;
  std::string text =
      sim::make_light_modes(tables, modes, request.threads, summary, [&](std::size_t done, std::size_t all) {
        bar.update(static_cast<double>(done) / static_cast<double>(all));
      });
  bar.finish();
  json_answer()["modes"] = {{"count", summary.modes}, {"carried_share", summary.carried_share}};
  say_text(fmt::format("{} modes of their uncertainty carry {:.1f} % of the variance of {} draws\n",
                       summary.modes, 100.0 * summary.carried_share, request.ensemble));
  return text;
}

int run_tables(const TablesRequest& request) {
  end_at_once_when_interrupted();
  require_factors(request.oxygen);
  sim::TableRequest tables;
  tables.dip_deg = request.dip_deg;
  tables.refinement = request.refinement;
  tables.draws = request.ensemble;
  tables.seed = request.seed;
  tables.seconds = request.steady ? std::numeric_limits<double>::infinity() : request.seconds;
  tables.oxygen_factors = request.oxygen;
  tables.air_file = air_file(request.atmosphere);
  tables.air_name = words_of_air(request.atmosphere);
  tables.air = air_of_choice(request.atmosphere);
  if (!request.reactions.empty()) {
    tables.reactions_name += ", changed by " + file_name_of(request.reactions);
    tables.reactions = sim::Reactions::changed(
        sim::input_bytes(request.reactions, "a table of the columns of data/electrons/reactions.csv"),
        request.reactions);
  }
  sim::WholeDirectory folder(request.output, request.overwrite,
                             {"a folder of emission tables", look_at_tables, {kAbout}});
  ProgressBar bar("making emission tables");
  sim::MadeTables made = sim::make_tables(tables, request.threads, [&](std::size_t done, std::size_t all) {
    bar.update(static_cast<double>(done) / static_cast<double>(all));
  });
  bar.finish();
  if (request.ensemble > 0) made[kModes] = modes_of(request, tables);
  for (const auto& [name, text] : made) {
    sim::WholeFile file(folder.file(name), false);
    file.write(text);
    file.commit();
  }
  folder.commit();
  json_answer()["outputs"] = json_names({request.output});
  json_answer()["maxwellian_energies"] = tables.maxwellian_kev.size();
  json_answer()["single_energies"] = tables.mono_kev.size();
  json_answer()["oxygen_factors"] = request.oxygen;
  say_text(fmt::format("emission tables of {} Maxwellian and {} single energies, {} oxygen factors: {}\n",
                       tables.maxwellian_kev.size(), tables.mono_kev.size(), request.oxygen.size(),
                       request.output));
  return good;
}

}  // namespace

void add_tables_command(Program& program) {
  const auto options = std::make_shared<TablesRequest>();
  const Command command = program.add(
      "tables",
      "Make emission tables for a neutral air and its chemistry: light by altitude and energy of electrons");
  command.option("-o,--output", options->output, "The folder of the tables").type_name("FOLDER").required();
  add_air_option(command, options->atmosphere, ", from 80 to 640 km");
  command
      .option("--reactions", options->reactions,
              "Rows that replace those of data/electrons/reactions.csv: number, value, exponent, "
              "activation_K, of")
      .type_name("FILE.csv");
  command
      .option("--oxygen-factors", options->oxygen,
              "Factors on the atomic oxygen, between which scenes and fits interpolate")
      .delimiter(',')
      .shows_default();
  command.option("--dip-deg", options->dip_deg, "Inclination of the field to the horizontal")
      .finite_range(10.0, 90.0)
      .shows_default();
  const Option seconds =
      command
          .option("--seconds", options->seconds,
                  "Time since the electrons have begun to fall, for ions, thermal electrons and metastable atoms")
          .finite_range(1.0, 1e6)
          .shows_default();
  command.flag("--steady", options->steady, "The steady state of hours in place of --seconds")
      .excludes(seconds);
  command
      .option("--refinement", options->refinement,
              "Fineness of the steps in energy and altitude; the work grows as its cube (columns at 0.5 "
              "agree with 1 within 0.3 %)")
      .finite_range(0.25, 2.0)
      .shows_default();
  const Option ensemble = command
                              .option("--ensemble", options->ensemble,
                                      "Draw the numbers of physics so often within their uncertainty, and "
                                      "write the modes of the light's "
                                      "(modes.csv)")
                              .range(2, kMostDraws)
                              .type_name("DRAWS");
  command.option("--seed", options->seed, "Of the draws").shows_default().needs(ensemble);
  add_threads_option(command, options->threads);
  command.flag("--overwrite", options->overwrite, "Replace a folder of emission tables");
  command.runs([options] { return run_tables(*options); });
}

}  // namespace vegard::apps
