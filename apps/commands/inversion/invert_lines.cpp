#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/commands/inversion/invert_request.h"
#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/refusals.h"
#include "apps/options/standard_streams.h"
#include "apps/output/plot_file.h"
#include "fit/columns/column_inversion.h"
#include "fit/columns/line_measurement.h"
#include "fit/columns/spectrum_trials.h"
#include "fit/report/columns/inversion_texts.h"
#include "sim/base/file/whole_file.h"

namespace vegard::apps {
namespace {

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

}  // namespace

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
  spare_inputs(request, {});
  const Inversion inversion(request, lines_nm);
  if (format != PlotFormat::none && !(inversion.free()[fit::kLnEnergy] && inversion.free()[fit::kLnFlux]))
    throw usage_error("--plot", "energy and flux are not both free", "--free energy,flux");
  const std::string output = request.outputs.empty() ? std::string() : request.outputs.front();
  sim::WholeFiles files({output, request.plot}, request.overwrite);

  const fit::ColumnChi2 chi2 = inversion.chi2(1);
  fit::ColumnInversion answer = fit::invert_columns(chi2, data);
  fit::try_spectra(inversion.tables(), inversion.options(), chi2, request.threads, answer);
  const fit::InversionFacts facts = inversion.facts(request);
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
  const bool is_doubted = answer.verdict == fit::ColumnVerdict::contradiction ||
                          answer.verdict == fit::ColumnVerdict::other_spectrum;
  return is_doubted ? doubted : good;
}

}  // namespace vegard::apps
