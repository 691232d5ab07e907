#include "fit/report/table/run_tables.h"

#include <algorithm>
#include <limits>
#include <map>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "fit/photo/averaging.h"
#include "fit/report/table/report_bins.h"
#include "sim/base/file/csv_table.h"
#include "sim/base/number/constants.h"
#include "sim/base/version.h"
#include "sim/scene/lines/emission_lines.h"

namespace vegard::fit {
namespace {

/// A fit that found nothing may come without a model.
double at(const std::vector<double>& values, std::size_t i) {
  return i < values.size() ? values[i] : sim::kNaN;
}

std::string head(const FitResult& result, const FittedPhoto& fitted) {
  std::string text =
      sim::csv_comment(has_named_axes(fitted.data) ? "profiles: what the fit compared"
                                                   : "vertical profiles: what the fit compared");
  text += sim::csv_comment("vegard: " + sim::version());
  for (const InputFile& input : result.inputs)
    text += sim::csv_comment(input.role + ": " + input.name + " (sha256 " + input.sha256 + ")");
  if (!fitted.name.empty()) text += sim::csv_comment("of the photograph " + fitted.name);
  text += sim::csv_comment("decoding: " + fitted.decoding);
  text += sim::csv_comment(
      fmt::format("roi_px: [{}]", fmt::join(region_in_file(fitted.best.camera, fitted.data.region), ", ")));
  if (has_named_axes(fitted.data)) {
    text += sim::csv_comment("band_at: " + axis_label(fitted.data.grid->across) + ", the band's middle");
    text += sim::csv_comment("at: " + axis_label(fitted.data.grid->along) + ", the bin's middle");
  } else {
    text += sim::csv_comment(
        "row_px: row of the image, counted from 0 at the top; its centre is at row_px + 0.5; of averaged "
        "rows their middle");
    text += sim::csv_comment(
        "elevation_deg: above the horizon, of the row's centre at the centre column of the band");
  }
  text += sim::csv_comment(
      "data, model: mean linear light of the photograph and of the best model, sky included");
  text += sim::csv_comment(
      "sigma: standard deviation that the fit gave the data, noise and model error together");
  text += sim::csv_comment(
      "residual_over_sigma: (data - model) / sigma; empty where the fit did not use the value");
  text += sim::csv_comment("count: pixels used");
  return text;
}

std::string head(const FitResult& result) {
  std::string text = sim::csv_comment("height profiles as fitted, free of any electrons");
  text += sim::csv_comment("vegard: " + sim::version());
  for (const InputFile& input : result.inputs)
    text += sim::csv_comment(input.role + ": " + input.name + " (sha256 " + input.sha256 + ")");
  text += sim::csv_comment(
      "rate_*: volume emission rate by wavelength in angstrom, photons cm-3 s-1 per mW m-2 of");
  text += sim::csv_comment(
      "energy_flux_mw_m2; where gains were solved for, only its shape and the lines' ratios mean");
  text += sim::csv_comment("anything, and the column of 557.7 nm is that of the start");
  text +=
      sim::csv_comment("lower_*, upper_*: of the 68 % interval at each altitude, given what was not free");
  return text;
}

}  // namespace

std::string trace_csv(const FitResult& result) {
  std::string text =
      sim::csv_comment("the progress of the search: accepted evaluations, and the best of every stage");
  text += sim::csv_comment("evaluation: evaluations of the residuals so far");
  text += "stage,evaluation,chi2,chi2_per_dof";
  for (const FittedParameter& p : result.parameters) text += "," + sim::csv_cell(p.path);
  text += "\n";
  for (const TraceRow& row : result.trace) {
    text +=
        sim::csv_cell(row.stage) + "," + std::to_string(row.evaluation) + "," + sim::csv_number(row.chi2) +
        "," +
        sim::csv_number(result.dof > 0 ? row.chi2 / result.dof : std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i < result.parameters.size(); ++i)
      text += "," + (i < row.values.size() ? sim::csv_number(row.values[i]) : std::string());
    text += "\n";
  }
  return text;
}

std::string profiles_csv(const FitResult& result, const FittedPhoto& fitted,
                         const ElevationOfPixel& elevation_of_pixel) {
  static const char* const kChannels[3] = {"r", "g", "b"};
  const Profile& data = fitted.data;
  std::string text = head(result, fitted);
  const bool named = has_named_axes(data);
  const double row_px = fitted.best.camera.pixel_height_px;
  text += std::string(named ? "band,band_at,at" : "band,row_px,elevation_deg") +
          ",channel,data,sigma,model,residual_over_sigma,count\n";
  for (int band = 0; band < data.bands; ++band)
    for (int row = 0; row < data.rows; ++row) {
      const std::string place =
          std::to_string(band) + "," +
          (named ? sim::csv_number(data.grid->across.edge(band + 0.5)) + "," +
                       sim::csv_number(data.grid->along.edge(row + 0.5))
                 : sim::csv_number((data.region.y + row + 0.5) * row_px - 0.5) + "," +
                       sim::csv_number(row_elevation_deg(data, band, row, elevation_of_pixel))) +
          ",";
      for (int c = 0; c < 3; ++c) {
        const std::size_t i = data.index(band, row, c);
        const double sigma = at(fitted.sigma, i);
        const double residual = sigma > 0.0 ? (data.mean[i] - at(fitted.model, i)) / sigma : sim::kNaN;
        text += place + kChannels[c] + "," + sim::csv_number(data.mean[i]) + "," + sim::csv_number(sigma) +
                "," + sim::csv_number(at(fitted.model, i)) + "," + sim::csv_number(residual) + "," +
                std::to_string(data.count[i]) + "\n";
      }
    }
  return text;
}

std::string free_profiles_csv(const FitResult& result) {
  std::vector<double> lines;  // of all sheets, in the order of their first mention
  for (const FreeProfile& profile : result.profiles)
    if (std::find(lines.begin(), lines.end(), profile.wavelength_nm) == lines.end())
      lines.push_back(profile.wavelength_nm);
  std::string text = head(result) + "sheet,altitude_km";
  for (const double line_nm : lines) {
    const std::string line = sim::line_name(line_nm);
    text += ",rate_" + line + ",lower_" + line + ",upper_" + line;
  }
  text += "\n";
  for (std::size_t first = 0; first < result.profiles.size();) {
    std::size_t end = first;
    while (end < result.profiles.size() && result.profiles[end].sheet == result.profiles[first].sheet) ++end;
    // A line may not be free in this sheet, or be dark where another is not.
    std::map<double, std::vector<std::string>> rows;  // [altitude][line]
    for (std::size_t p = first; p < end; ++p) {
      const FreeProfile& profile = result.profiles[p];
      const auto column = std::find(lines.begin(), lines.end(), profile.wavelength_nm) - lines.begin();
      for (std::size_t i = 0; i < profile.altitude_km.size(); ++i) {
        std::vector<std::string>& cells =
            rows.try_emplace(profile.altitude_km[i], lines.size(), ",,,").first->second;
        cells[column] = "," + sim::csv_number(profile.rate[i]) + "," + sim::csv_number(profile.lower[i]) +
                        "," + sim::csv_number(profile.upper[i]);
      }
    }
    for (const auto& [altitude_km, cells] : rows) {
      text += sim::csv_cell(result.profiles[first].sheet) + "," + sim::csv_number(altitude_km);
      for (const std::string& cell : cells) text += cell;
      text += "\n";
    }
    first = end;
  }
  return text;
}

}  // namespace vegard::fit
