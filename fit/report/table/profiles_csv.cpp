#include "fit/report/table/profiles_csv.h"

#include <cmath>
#include <limits>

#include "fit/report/table/report_bins.h"
#include "sim/base/file/csv_text.h"
#include "sim/base/number/constants.h"
#include "sim/base/version.h"

namespace vegard::fit {
namespace {

/// A fit that found nothing may come without a model.
double at(const std::vector<double>& values, std::size_t i) {
  return i < values.size() ? values[i] : sim::kNaN;
}

std::string head(const FitResult& result, const FittedPhoto& fitted) {
  std::string text = csv_comment(has_named_axes(fitted.data) ? "profiles: what the fit compared"
                                                             : "vertical profiles: what the fit compared");
  text += csv_comment("vegard: " + sim::version());
  for (const InputFile& input : result.inputs)
    text += csv_comment(input.role + ": " + input.name + " (sha256 " + input.sha256 + ")");
  if (!fitted.name.empty()) text += csv_comment("of the photograph " + fitted.name);
  text += csv_comment("decoding: " + fitted.decoding);
  const Region& region = fitted.data.region;
  text += csv_comment("roi_px: [" + std::to_string(region.x) + ", " + std::to_string(region.y) + ", " +
                      std::to_string(region.width) + ", " + std::to_string(region.height) + "]");
  if (has_named_axes(fitted.data)) {
    text += csv_comment("band_at: " + axis_label(fitted.data.grid->across) + ", the band's middle");
    text += csv_comment("at: " + axis_label(fitted.data.grid->along) + ", the bin's middle");
  } else {
    text += csv_comment("row_px: row of the image, counted from 0 at the top; its centre is at row_px + 0.5");
    text +=
        csv_comment("elevation_deg: above the horizon, of the row's centre at the centre column of the band");
  }
  text += csv_comment("data, model: mean linear light of the photograph and of the best model, sky included");
  text += csv_comment("sigma: standard deviation that the fit gave the data, noise and model error together");
  text +=
      csv_comment("residual_over_sigma: (data - model) / sigma; empty where the fit did not use the value");
  text += csv_comment("count: pixels used");
  return text;
}

}  // namespace

std::string profiles_csv(const FitResult& result, const FittedPhoto& fitted,
                         const ElevationOfPixel& elevation_of_pixel) {
  static const char* const kChannels[3] = {"r", "g", "b"};
  const Profile& data = fitted.data;
  std::string text = head(result, fitted);
  const bool named = has_named_axes(data);
  text += std::string(named ? "band,band_at,at" : "band,row_px,elevation_deg") +
          ",channel,data,sigma,model,residual_over_sigma,count\n";
  for (int band = 0; band < data.bands; ++band)
    for (int row = 0; row < data.rows; ++row) {
      const std::string place =
          std::to_string(band) + "," +
          (named ? csv_number(data.grid->across.edge(band + 0.5)) + "," +
                       csv_number(data.grid->along.edge(row + 0.5))
                 : std::to_string(data.region.y + row) + "," +
                       csv_number(row_elevation_deg(data, band, row, elevation_of_pixel))) +
          ",";
      for (int c = 0; c < 3; ++c) {
        const std::size_t i = data.index(band, row, c);
        const double sigma = at(fitted.sigma, i);
        const double residual = sigma > 0.0 ? (data.mean[i] - at(fitted.model, i)) / sigma : sim::kNaN;
        text += place + kChannels[c] + "," + csv_number(data.mean[i]) + "," + csv_number(sigma) + "," +
                csv_number(at(fitted.model, i)) + "," + csv_number(residual) + "," +
                std::to_string(data.count[i]) + "\n";
      }
    }
  return text;
}

}  // namespace vegard::fit
