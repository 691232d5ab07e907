#include "apps/commands/commands.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/refusals.h"
#include "apps/options/standard_streams.h"
#include "apps/output/plot_file.h"
#include "fit/columns/column_inversion.h"
#include "fit/columns/column_maps.h"
#include "fit/columns/line_measurement.h"
#include "fit/photo/direction_map_file.h"
#include "fit/report/columns/inversion_texts.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/text.h"
#include "sim/light/tables/emission_tables.h"
#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/table/emission_folder.h"

namespace vegard::apps {
namespace {

constexpr const char* kFreeWords[fit::kColumnUnknowns] = {"energy", "flux", "oxygen"};
constexpr const char* kHoldOptions[fit::kColumnUnknowns] = {"--energy-kev", "--flux-mw-m2",
                                                            "--oxygen-factor"};
constexpr long long kMaxMapPixels = 1LL << 25;  // some 3 GB with all that is worked out
constexpr const char* kMapForm = "NM=FILE, such as 427.8=blue.fits";

struct InvertRequest {
  std::vector<std::string> lines, maps, errors, outputs, free = {"energy", "flux"};
  std::string relative_error, model_error, spectrum = "maxwellian", tables = sim::kDefaultEmissionTables,
                                           uncertainty = "modes", plot, command;
  std::optional<double> spread;
  std::array<std::optional<double>, fit::kColumnUnknowns> held;
  int threads = 0;
  bool json = false, overwrite = false;
};

/// "5" or "5%" of an option in per cent.
double share_of(const std::string& text, const char* option) {
  if (text.empty()) return 0.0;
  const bool has_sign = text.back() == '%';
  return fit::brightness_error(has_sign ? text : text + "%", option).relative;
}

fit::ColumnFreedom freedom_of(const InvertRequest& request) {
  fit::ColumnFreedom free{};
  for (const std::string& word : request.free)
    for (std::size_t k = 0; k < fit::kColumnUnknowns; ++k) free[k] = free[k] || word == kFreeWords[k];
  for (std::size_t k = 0; k < fit::kColumnUnknowns; ++k) {
    if (free[k] && request.held[k])
      throw usage_error(kHoldOptions[k], std::string("the ") + kFreeWords[k] + " is to be found",
                        "no " + std::string(kFreeWords[k]) + " in --free with it");
    if (!free[k] && !request.held[k] && k != fit::kLnOxygen)
      throw usage_error("--free", std::string("the ") + kFreeWords[k] + " is neither free nor given",
                        std::string(kHoldOptions[k]) + " beside it");
  }
  return free;
}

/// The model of the lines, once they are known to determine what is asked of them.
class Inversion {
 public:
  Inversion(const InvertRequest& request, const std::vector<double>& lines_nm)
      : free_(freedom_of(request)),
        model_(tables_of(request), lines_nm, options_of(request), request.threads) {
    for (std::size_t k = 0; k < fit::kColumnUnknowns; ++k) {
      if (request.held[k]) fixed_[k] = std::log(*request.held[k]);
      require_inside(k, request);
    }
    require_enough_lines(request);
  }

  const fit::ColumnModel& model() const { return model_; }
  const fit::ColumnFreedom& free() const { return free_; }
  fit::ColumnChi2 chi2(std::size_t stride) const { return {model_, free_, fixed_, stride}; }

 private:
  static fit::ColumnModelOptions options_of(const InvertRequest& request) {
    fit::ColumnModelOptions options;
    if (request.spectrum == "gaussian") options.spectrum = fit::ColumnSpectrum::gaussian;
    if (request.spectrum == "mono") options.spectrum = fit::ColumnSpectrum::mono;
    if (request.spread && request.spectrum != "gaussian")
      throw usage_error("--spread", "a spectrum of the kind '" + request.spectrum + "' has no such number",
                        "--spectrum gaussian beside it");
    options.spread = request.spread.value_or(options.spread);
    options.has_modes = request.uncertainty != "none";
    return options;
  }

  static const sim::EmissionTables& tables_of(const InvertRequest& request) {
    sim::Scene scene;
    scene.emission.tables = request.tables;
    try {
      sim::read_emission_folder(scene, request.tables);
      return sim::emission_tables(scene);
    } catch (const sim::Error& error) {
      if (error.details().key != "emission.tables") throw;
      throw sim::Error(error).key("--tables");
    }
  }

  void require_inside(std::size_t k, const InvertRequest& request) const {
    if (free_[k] && !model_.knows(k))
      throw usage_error("--free", "the tables '" + request.tables + "' are for one amount of atomic oxygen",
                        "no oxygen in --free, or tables of several");
    const double least = std::exp(model_.least(k)), most = std::exp(model_.most(k));
    if (request.held[k] && !(fixed_[k] >= model_.least(k) - 1e-9 && fixed_[k] <= model_.most(k) + 1e-9))
      throw usage_error(kHoldOptions[k], fmt::format("{:g} is outside of the tables", *request.held[k]),
                        fmt::format("from {:.4g} to {:.4g}", least, most));
  }

  /// Lines of one upper state count once.
  void require_enough_lines(const InvertRequest& request) const {
    const char* const key = request.lines.empty() ? "--map" : "--line";
    std::size_t different = 0;
    std::string same;
    for (std::size_t l = 0; l < model_.lines(); ++l) {
      bool is_new = true;
      for (std::size_t other = 0; other < l && is_new; ++other)
        if (model_.is_multiple(l, other)) {
          is_new = false;
          same = fmt::format("; {:.1f} and {:.1f} nm have one upper state, and a fixed ratio",
                             model_.lines_nm()[other], model_.lines_nm()[l]);
        }
      different += is_new ? 1 : 0;
    }
    const auto unknowns = static_cast<std::size_t>(std::count(free_.begin(), free_.end(), true));
    if (unknowns == 0)
      throw usage_error("--free", "nothing is free", "energy, flux, oxygen or several of them");
    if (different >= unknowns) return;
    std::string hint = "--free flux --energy-kev E0 needs one line only";
    if (free_[fit::kLnOxygen])
      hint = "844.6 or 777.4 nm with 427.8 and 630.0 nm determine atomic oxygen; --free energy,flux holds it";
    else if (unknowns == 2)
      hint = "a line whose ratio to this one depends on the energy, such as 630.0 with 427.8 nm; " + hint;
    throw usage_error(key,
                      fmt::format("{} {} not enough for {} unknowns{}", different,
                                  different == 1 ? "line is" : "lines are", unknowns, same),
                      fmt::format("{} different lines or more", unknowns), hint);
  }

  fit::ColumnFreedom free_;
  fit::ColumnPoint fixed_{};
  fit::ColumnModel model_;
};

fit::InversionFacts facts_of(const InvertRequest& request, const fit::ColumnModel& model) {
  fit::InversionFacts facts;
  facts.spectrum = request.spectrum;
  facts.tables = request.tables;
  facts.uncertainty = model.modes() > 0 ? "modes" : "none";  // tables without modes are exact
  facts.model_error = share_of(request.model_error, "--model-error");
  return facts;
}

/// The errors of maps by their lines: words of --error, NM=50, NM=5% or NM=FILE.
void take_errors(const InvertRequest& request, const std::vector<double>& lines_nm,
                 std::vector<fit::LineMap>& lines, std::vector<std::string>& files) {
  const double relative = share_of(request.relative_error, "--relative-error");
  const std::string form = "NM=50 (rayleighs), NM=5% or NM=FILE";
  files.resize(lines_nm.size());
  for (const std::string& text : request.errors) {
    const fit::LineWord word = fit::line_word(text, "--error", form);
    const auto found = std::find(lines_nm.begin(), lines_nm.end(), word.wavelength_nm);
    if (found == lines_nm.end())
      throw usage_error("--error", fmt::format("there is no map of {:.1f} nm", word.wavelength_nm),
                        "a line of --map");
    const auto l = static_cast<std::size_t>(found - lines_nm.begin());
    const bool is_number = word.rest.find_first_not_of("0123456789.eE+-%") == std::string::npos;
    if (is_number) {
      const fit::BrightnessError error = fit::brightness_error(word.rest, "--error");
      lines[l].error.rayleigh = std::hypot(lines[l].error.rayleigh, error.rayleigh);
      lines[l].error.relative = std::hypot(lines[l].error.relative, error.relative);
    } else if (files[l].empty()) {
      files[l] = word.rest;
    } else {
      throw usage_error("--error", fmt::format("two files are given for {:.1f} nm", *found), "one");
    }
  }
  const double model = share_of(request.model_error, "--model-error");
  for (std::size_t l = 0; l < lines_nm.size(); ++l) {
    if (!lines[l].error.given() && files[l].empty()) lines[l].error.relative = relative;
    if (!lines[l].error.given() && files[l].empty())
      throw usage_error("--map", fmt::format("the error of {:.1f} nm is not known", lines_nm[l]),
                        fmt::format("--error {:.1f}=50, {:.1f}=5% or a file, or --relative-error 5",
                                    lines_nm[l], lines_nm[l]));
    lines[l].error.relative = std::hypot(lines[l].error.relative, model);
  }
}

sim::Image brightness_plane(const std::string& file, double line_nm) {
  const std::string name = sim::line_name(line_nm);
  return fit::read_plane(file, {"rayleigh." + name, name}, "brightnesses");
}

enum class MapFormat { fits, netcdf };

MapFormat map_format(const std::string& file) {
  const std::string ending = sim::lowered_extension(file);
  if (ending == ".fits" || ending == ".fit" || ending == ".fts") return MapFormat::fits;
  if (ending == ".nc") return MapFormat::netcdf;
  throw usage_error("--output", "'" + file_name_of(file) + "' does not say what maps are to be written as",
                    "a name that ends in .fits or .nc");
}

void spare(const InvertRequest& request, const std::vector<std::string>& inputs) {
  std::vector<std::pair<std::string, std::string>> outputs;
  for (const std::string& output : request.outputs) outputs.emplace_back("--output", output);
  outputs.emplace_back("--plot", request.plot);
  protect_outputs(outputs, inputs);
}

int invert_line_maps(const InvertRequest& request) {
  if (!request.plot.empty()) throw usage_error("--plot", "it is of one set of lines", "no --map with it");
  if (request.outputs.empty())
    throw usage_error("--output", "maps have no text output", "-o OUT.fits or -o OUT.nc");
  std::vector<double> lines_nm;
  std::vector<std::string> map_files, error_files;
  for (const std::string& text : request.maps) {
    const fit::LineWord word = fit::line_word(text, "--map", kMapForm);
    lines_nm.push_back(word.wavelength_nm);
    map_files.push_back(word.rest);
  }
  fit::require_different_lines(lines_nm, "--map");
  std::vector<fit::LineMap> lines(lines_nm.size());
  take_errors(request, lines_nm, lines, error_files);
  for (const std::string& output : request.outputs) map_format(output);  // refuses what it does not know
  std::vector<std::string> inputs = map_files;
  inputs.insert(inputs.end(), error_files.begin(), error_files.end());
  spare(request, inputs);
  const Inversion inversion(request, lines_nm);

  int width = 0, height = 0;
  const auto take = [&](const std::string& file, double line_nm, std::vector<float>& values) {
    sim::Image plane = brightness_plane(file, line_nm);
    if (static_cast<long long>(plane.width) * plane.height > kMaxMapPixels)
      throw sim::unreadable(file, "it has " + sim::size_text(plane.width, plane.height) + " pixels")
          .expected(fmt::format("{} at most in all", kMaxMapPixels));
    if (width == 0) {
      width = plane.width;
      height = plane.height;
    }
    if (plane.width != width || plane.height != height)
      throw sim::unreadable(file, "it has " + sim::size_text(plane.width, plane.height) + " pixels")
          .expected(sim::size_text(width, height) + ", as " + map_files.front());
    values = std::move(plane.data);
  };
  for (std::size_t l = 0; l < lines_nm.size(); ++l) {
    take(map_files[l], lines_nm[l], lines[l].rayleigh);
    if (!error_files[l].empty()) take(error_files[l], lines_nm[l], lines[l].known_error);
  }
  sim::WholeFiles files(request.outputs, request.overwrite);

  constexpr std::size_t kStride = 2;  // a tenth of ln(E0): ratios turn over whole factors
  const fit::ColumnMaps maps =
      fit::invert_maps(inversion.chi2(kStride), lines, static_cast<std::size_t>(width),
                       static_cast<std::size_t>(height), request.threads);
  const fit::InversionFacts facts = facts_of(request, inversion.model());
  for (const std::string& output : request.outputs) {
    if (map_format(output) == MapFormat::fits)
      files.write(output, fit::encode_column_maps(maps, facts, output));
    else
      fit::write_column_maps_netcdf(maps, facts, files.file(output).temporary(), output);
  }
  files.commit();
  json_answer() = {{"outputs", json_names(request.outputs)},
                   {"width_px", width},
                   {"height_px", height},
                   {"words", fit::column_maps_text(maps)}};
  say_text(fit::column_maps_text(maps));
  return fit::most_contradict(maps) ? doubted : good;
}

/// The model's own error goes with the brightness that is measured, as the model's is not known yet.
fit::ColumnData data_of(const InvertRequest& request, const std::vector<fit::LineMeasurement>& lines) {
  const double relative = share_of(request.relative_error, "--relative-error");
  const double model = share_of(request.model_error, "--model-error");
  fit::ColumnData data;
  for (std::size_t l = 0; l < lines.size(); ++l) {
    const fit::LineMeasurement& line = lines[l];
    const fit::BrightnessError error = line.error.value_or(fit::BrightnessError{0.0, relative});
    data.rayleigh[l] = line.rayleigh;
    data.sigma[l] = std::hypot(error.of(line.rayleigh), model * line.rayleigh);
    if (error.of(line.rayleigh) > 0.0) continue;
    throw usage_error(
        "--line", fmt::format("the error of {:.1f} nm is not known", line.wavelength_nm),
        fmt::format("{:.1f}={:g}±ERROR, in rayleighs or with a %", line.wavelength_nm, line.rayleigh),
        "--relative-error 5 gives 5 % to all lines without one");
  }
  return data;
}

int invert_lines(const InvertRequest& request) {
  const PlotFormat format = plot_format(request.plot, "--plot");
  if (!request.errors.empty()) throw usage_error("--error", "it is of maps", "NM=RAYLEIGHS±ERROR in --line");
  if (request.outputs.size() > 1)
    throw usage_error("--output", "there is one file to write, of JSON", "-o OUT.json once");
  std::vector<fit::LineMeasurement> lines;
  std::vector<double> lines_nm;
  for (const std::string& text : request.lines) {
    lines.push_back(fit::line_measurement(text));
    lines_nm.push_back(lines.back().wavelength_nm);
  }
  fit::require_different_lines(lines_nm, "--line");
  const fit::ColumnData data = data_of(request, lines);
  spare(request, {});
  const Inversion inversion(request, lines_nm);
  if (format != PlotFormat::none && !(inversion.free()[fit::kLnEnergy] && inversion.free()[fit::kLnFlux]))
    throw usage_error("--plot", "energy and flux are not both free", "--free energy,flux");
  const std::string output = request.outputs.empty() ? std::string() : request.outputs.front();
  sim::WholeFiles files({output, request.plot}, request.overwrite);

  const fit::ColumnChi2 chi2 = inversion.chi2(1);
  const fit::ColumnInversion answer = fit::invert_columns(chi2, data);
  const fit::InversionFacts facts = facts_of(request, inversion.model());
  const std::string json = fit::inversion_json(answer, facts);
  files.write(output, json);
  if (format != PlotFormat::none)
    files.write(
        request.plot,
        plot_bytes(fit::inversion_plot(chi2, answer, facts.spectrum + " electrons, tables " + facts.tables),
                   format));
  files.commit();
  answer_with(json);
  say_result(fit::inversion_text(answer, facts));
  return answer.verdict == fit::ColumnVerdict::contradiction ? doubted : good;
}

}  // namespace

void add_invert_command(Program& program) {
  const auto options = std::make_shared<InvertRequest>();
  const Command command = program.add(
      "invert", "Compute electrons' energy flux and energy from the brightness of lines, or from maps of it");
  const Option line = command
                          .option("--line", options->lines,
                                  "A line's brightness in rayleighs of the vertical column, 427.8=2300±50 or "
                                  "427.8=2300+-2%; at least as many as are free, at most eight")
                          .type_name("NM=R±ERROR")
                          .repeated();
  command
      .option(
          "--map", options->maps,
          "In place of --line: an image of the brightness (FITS, EXR, TIFF of floats); of an EXR the channel "
          "of the line, as vegard render --lines writes it")
      .type_name("NM=FILE")
      .repeated()
      .excludes(line);
  command
      .option("--error", options->errors,
              "Error of a map: in rayleighs, in per cent or an image; several of one line are added in "
              "quadrature")
      .type_name("NM=R|%|FILE")
      .repeated();
  command
      .option("--relative-error", options->relative_error,
              "Error in per cent of lines without one of their own")
      .type_name("PERCENT");
  command
      .option("--model-error", options->model_error,
              "Error of the tables, in per cent of each line, added in quadrature to its own error")
      .type_name("PERCENT");
  command
      .option("--uncertainty", options->uncertainty,
              "Errors contain the tables' own uncertainty (modes), or take the tables as exact (none)")
      .one_of({"modes", "none"})
      .shows_default();
  command.option("--spectrum", options->spectrum, "Spectrum of the electrons")
      .one_of({"maxwellian", "gaussian", "mono"})
      .shows_default();
  command.option("--spread", options->spread, "Standard deviation of a Gaussian over E0 (default: 0.25)")
      .finite_range(0.01, 1.0);
  command
      .option("--tables", options->tables,
              "Emission tables: those of the program by name, or a folder such as vegard tables writes")
      .type_name("NAME|FOLDER")
      .shows_default();
  command.option("--free", options->free, "What to find (default: energy,flux)")
      .delimiter(',')
      .one_an_occurrence()
      .one_of({"energy", "flux", "oxygen"})
      .type_name("WORDS");
  command.option("--energy-kev", options->held[fit::kLnEnergy], "E0 in keV, where it is not free")
      .finite_range(1e-3, 1e3);
  command.option("--flux-mw-m2", options->held[fit::kLnFlux], "Energy flux in mW m^-2, where it is not free")
      .finite_range(fit::ColumnModel::kMinFlux, fit::ColumnModel::kMaxFlux);
  command
      .option("--oxygen-factor", options->held[fit::kLnOxygen],
              "Atomic oxygen over that of the tables (default: 1)")
      .finite_range(1e-2, 1e2);
  command
      .option("-o,--output", options->outputs,
              "The result to write: JSON of lines; FITS or netCDF-4 of maps, or one of each")
      .type_name("OUT.json|.fits|.nc")
      .repeated();
  command.option("--plot", options->plot, "Draw chi2 over energy and flux").type_name("OUT.svg|OUT.png");
  add_threads_option(command, options->threads);
  command.flag("--overwrite", options->overwrite, "Replace outputs that exist");
  command.runs([options] {
    if (options->lines.empty() && options->maps.empty())
      throw usage_error("--line", "no line is given",
                        "--line NM=RAYLEIGHS±ERROR or --map NM=FILE, two or more");
    return options->maps.empty() ? invert_lines(*options) : invert_line_maps(*options);
  });
}

}  // namespace vegard::apps
