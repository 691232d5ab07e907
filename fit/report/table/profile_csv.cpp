#include "fit/report/table/profile_csv.h"

#include <fmt/format.h>

#include <limits>

#include "fit/report/table/report_bins.h"
#include "sim/base/file/csv_table.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit {
namespace {

std::string comments(const Photo& photo, const Profile& profile) {
  const Region& region = profile.region;
  const bool named = has_named_axes(profile);
  std::string text = named ? "# profiles: mean linear light per bin, band and channel\n"
                           : "# vertical profiles: mean linear light per row, band and channel\n";
  text += sim::csv_comment("photograph: " + photo.file_name);
  text += "# sha256: " + photo.sha256 + "\n";
  for (std::size_t c = 0; c < photo.filters.size(); ++c) {
    const PhotoPart& part = photo.filters[c];
    const char* const names[3] = {"r", "g", "b"};
    if (part.wavelength_nm > 0.0)
      text += sim::csv_comment(
          fmt::format("{}: {} nm, {}, sha256 {}", names[c], part.wavelength_nm, part.file_name, part.sha256));
    else
      text += fmt::format("# {}: no file\n", names[c]);
  }
  text += fmt::format("# size_px: {} x {}\n", photo.linear.width, photo.linear.height);
  text += "# decoding: " + photo.decoding + "\n";
  if (!photo.mask_name.empty()) {
    text += sim::csv_comment("mask: " + photo.mask_name);
    text += "# mask_sha256: " + photo.mask_sha256 + "\n";
  }
  text += fmt::format("# roi_px: [{}, {}, {}, {}]\n", region.x, region.y, region.width, region.height);
  if (named) {
    text += fmt::format("# bands: {}\n", profile.bands);
    text += "# band_at: " + axis_label(profile.grid->across) + ", the band's middle\n";
    text += "# at: " + axis_label(profile.grid->along) + ", the bin's middle\n";
  } else {
    text += fmt::format("# bands: {}\n# band_edges_px: [", profile.bands);
    for (int band = 0; band <= profile.bands; ++band)
      text += (band > 0 ? ", " : "") + std::to_string(band_begin(region, profile.bands, band));
    text += "]\n";
    text += "# row_px: row of the image, counted from 0 at the top; its centre is at row_px + 0.5\n";
    text += "# elevation_deg: above the horizon, of the row's centre at the centre column of the band\n";
  }
  text += photo.floating
              ? "# r, g, b: linear light in the file's own units\n"
              : "# r, g, b: linear light, the file's largest value = 1; clipped pixels are left out\n";
  text +=
      "# sigma_*: standard error of the mean, from the differences of neighbouring pixels, or by the "
      "sensor (fit.photo_noise)\n";
  text += "# n_*: pixels used\n";
  text += "# chroma_r, chroma_g: r / (r + g + b), g / (r + g + b)\n";
  return text;
}

}  // namespace

double row_elevation_deg(const Profile& profile, int band, int row,
                         const ElevationOfPixel& elevation_of_pixel) {
  if (!elevation_of_pixel) return std::numeric_limits<double>::quiet_NaN();
  const int begin = band_begin(profile.region, profile.bands, band);
  const int end = band_begin(profile.region, profile.bands, band + 1);
  return elevation_of_pixel(0.5 * (begin + end), profile.region.y + row + 0.5);
}

std::string profile_csv(const Photo& photo, const Profile& profile,
                        const ElevationOfPixel& elevation_of_pixel, const LineBrightness* lines,
                        std::optional<double> observer_km) {
  std::string text = comments(photo, profile);
  if (lines != nullptr)
    text +=
        "# rayleigh_*: of the line at so many tenths of a nanometre, with its standard error, by the scene's "
        "sensor and sky\n";
  if (observer_km)
    text += fmt::format(
        "# tangent_altitude_km: least height of that line of sight above the sphere, seen from {} km up, no "
        "refraction; negative where it strikes the Earth\n",
        *observer_km);
  const bool named = has_named_axes(profile);
  text += named ? "band,band_at,at," : "band,row_px,elevation_deg,";
  if (observer_km) text += "tangent_altitude_km,";
  text +=
      "r,g,b,sigma_r,sigma_g,sigma_b,n_r,n_g,n_b,chroma_r,chroma_g,"
      "sigma_chroma_r,sigma_chroma_g";
  const std::size_t line_count = lines != nullptr ? lines->names.size() : 0;
  for (std::size_t l = 0; l < line_count; ++l)
    text += ",rayleigh_" + lines->names[l] + ",sigma_rayleigh_" + lines->names[l];
  text += '\n';
  for (int band = 0; band < profile.bands; ++band)
    for (int row = 0; row < profile.rows; ++row) {
      text += std::to_string(band);
      double elevation_deg = std::numeric_limits<double>::quiet_NaN();
      if (named) {
        text += "," + sim::csv_number(profile.grid->across.edge(band + 0.5));
        text += "," + sim::csv_number(profile.grid->along.edge(row + 0.5));
      } else {
        text += "," + std::to_string(profile.region.y + row);
        elevation_deg = row_elevation_deg(profile, band, row, elevation_of_pixel);
        text += "," + sim::csv_number(elevation_deg);
      }
      if (observer_km) text += "," + sim::csv_number(sim::tangent_altitude_km(*observer_km, elevation_deg));
      const std::size_t i = profile.index(band, row, 0);
      for (int c = 0; c < 3; ++c) text += "," + sim::csv_number(profile.mean[i + c]);
      for (int c = 0; c < 3; ++c) text += "," + sim::csv_number(profile.standard_error[i + c]);
      for (int c = 0; c < 3; ++c) text += "," + std::to_string(profile.count[i + c]);
      const Chromaticity colour = chromaticity(profile, band, row);
      for (const double value : {colour.r, colour.g, colour.sigma_r, colour.sigma_g})
        text += "," + sim::csv_number(value);
      for (std::size_t l = 0; l < line_count; ++l) {
        const std::size_t at = i / 3 * line_count + l;
        text += "," + sim::csv_number(lines->rayleigh[at]);
        text += "," + sim::csv_number(lines->sigma[at]);
      }
      text += '\n';
    }
  return text;
}

}  // namespace vegard::fit
