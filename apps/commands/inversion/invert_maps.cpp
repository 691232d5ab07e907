#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/commands/inversion/invert_request.h"
#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/refusals.h"
#include "apps/options/standard_streams.h"
#include "fit/columns/column_inversion.h"
#include "fit/columns/column_maps.h"
#include "fit/columns/common_physics.h"
#include "fit/columns/line_measurement.h"
#include "fit/photo/direction_map_file.h"
#include "fit/report/columns/inversion_texts.h"
#include "sim/base/declared_unit.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/text.h"
#include "sim/scene/lines/emission_lines.h"

namespace vegard::apps {
namespace {

constexpr long long kMaxMapPixels = 1LL << 25;  // some 3 GB with all that is worked out
constexpr std::size_t kSampledPixels = 300;     // of which physics in common is learnt
constexpr const char* kMapForm = "NM=FILE, such as 427.8=blue.fits";

/// The same electrons with a soft component beside them, where that can be told from the lines.
class SoftTrial {
 public:
  SoftTrial(const Inversion& inversion, std::size_t stride, int threads) {
    const auto unknowns = std::count(inversion.free().begin(), inversion.free().end(), true);
    if (inversion.options().soft_kev || inversion.model().lines() <= static_cast<std::size_t>(unknowns))
      return;
    fit::ColumnModelOptions options = inversion.options();
    options.soft_kev = fit::kUsualSoftKev;
    fit::ColumnFreedom free = inversion.free();
    free[fit::kLnSoft] = true;
    model_.emplace(inversion.tables(), inversion.model().lines_nm(), options, threads);
    chi2_.emplace(*model_, free, inversion.fixed(), stride);
  }
  const fit::ColumnChi2* chi2() const { return chi2_ ? &*chi2_ : nullptr; }

 private:
  std::optional<fit::ColumnModel> model_;
  std::optional<fit::ColumnChi2> chi2_;
};

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
  return fit::read_plane(file, {"rayleigh." + name, name}, "brightnesses",
                         sim::Quantity::brightness_rayleigh);
}

enum class MapFormat { fits, netcdf };

MapFormat map_format(const std::string& file) {
  const std::string ending = sim::lowered_extension(file);
  if (ending == ".fits" || ending == ".fit" || ending == ".fts") return MapFormat::fits;
  if (ending == ".nc") return MapFormat::netcdf;
  throw usage_error("--output", "'" + file_name_of(file) + "' does not say what maps are to be written as",
                    "a name that ends in .fits or .nc");
}

}  // namespace

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
  spare_inputs(request, inputs);
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

  constexpr std::size_t kStride = 4;  // a fifth of ln(E0): ratios turn over whole factors
  const SoftTrial soft(inversion, kStride, request.threads);
  fit::ColumnChi2 chi2 = inversion.chi2(kStride);
  std::optional<fit::ColumnModel> learnt;
  if (request.common_physics && inversion.model().modes() > 0) {
    const std::vector<fit::ColumnData> sample = fit::lit_sample(lines, kSampledPixels);
    learnt.emplace(inversion.model(), fit::learn_physics(chi2, sample, request.threads).common);
    chi2 = fit::ColumnChi2(*learnt, inversion.free(), inversion.fixed(), kStride);
  }
  const fit::ColumnMaps maps = fit::invert_maps(chi2, soft.chi2(), lines, static_cast<std::size_t>(width),
                                                static_cast<std::size_t>(height), request.threads);
  const fit::InversionFacts facts = inversion.facts(request);
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

}  // namespace vegard::apps
