#include "fit/measure/direction_profile.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "sim/base/file/csv_table.h"
#include "sim/base/file/number_text.h"
#include "sim/base/number/constants.h"

namespace vegard::fit {
namespace {

std::string comments(const Photo& photo, const DirectionProfile& directions) {
  const Region& region = directions.profile.region;
  const DirectionSectors& sectors = directions.sectors;
  std::string text =
      sim::csv_comment("profiles by direction: mean linear light per azimuth sector and elevation step");
  text += sim::csv_comment("photograph: " + photo.file_name);
  text += sim::csv_comment("sha256: " + photo.sha256);
  text += sim::csv_comment(fmt::format("size_px: {} x {}", photo.linear.width, photo.linear.height));
  text += sim::csv_comment("decoding: " + photo.decoding);
  if (!photo.mask_name.empty()) {
    text += sim::csv_comment("mask: " + photo.mask_name);
    text += sim::csv_comment("mask_sha256: " + photo.mask_sha256);
  }
  text += sim::csv_comment(
      fmt::format("roi_px: [{}, {}, {}, {}]", region.x, region.y, region.width, region.height));
  text += sim::csv_comment("directions: " + directions.camera);
  text += sim::csv_comment(fmt::format("azimuth_width_deg: {}", sectors.width_deg));
  text += sim::csv_comment(sectors.tangent ? fmt::format("tangent_step_km: {}", sectors.tangent->step_km)
                                           : fmt::format("elevation_step_deg: {}", sectors.step_deg));
  text += sim::csv_comment(fmt::format("dark: [{}, {}, {}], taken off r, g, b", directions.dark[0],
                                       directions.dark[1], directions.dark[2]));
  text += sim::csv_comment("azimuth_deg: middle of the sector, from north to the east");
  text += sim::csv_comment("elevation_deg: middle of the step, above the horizon");
  if (sectors.observer_km)
    text += sim::csv_comment(fmt::format(
        "tangent_altitude_km: least height of that line of sight above the sphere, seen from {} km "
        "up, no refraction; negative where it strikes the Earth",
        *sectors.observer_km));
  text += sim::csv_comment(
      photo.floating ? "r, g, b: linear light in the file's own units"
                     : "r, g, b: linear light, the file's largest value = 1; clipped pixels are left out");
  text +=
      sim::csv_comment("sigma_*: standard error of the mean, from the differences of neighbouring pixels");
  text += sim::csv_comment("n_*: pixels used");
  text += sim::csv_comment("r_over_g, b_over_g: ratios of the channels, errors to first order");
  return text;
}

std::string sector_name(double azimuth_deg) { return sim::short_number(azimuth_deg, 4) + "\u00b0"; }

}  // namespace

Ratio channel_ratio(const Profile& profile, int band, int row, int numerator, int denominator) {
  const std::size_t i = profile.index(band, row, 0);
  const double a = profile.mean[i + numerator], b = profile.mean[i + denominator];
  const double sigma_a = profile.standard_error[i + numerator],
               sigma_b = profile.standard_error[i + denominator];
  if (!std::isfinite(a) || !(b > 0.0)) return {sim::kNaN, sim::kNaN};
  return {a / b, std::hypot(sigma_a, a / b * sigma_b) / b};
}

DirectionProfile direction_profile(const Photo& photo, const sim::DirectionMap& map, const Region& region,
                                   const DirectionSectors& sectors, const std::array<double, 3>& dark,
                                   const std::string& camera) {
  DirectionProfile directions;
  directions.profile =
      extract_profile(photo, std::make_shared<const BinGrid>(direction_bins(map, region, sectors)));
  directions.sectors = sectors;
  directions.dark = dark;
  directions.camera = camera;
  for (std::size_t i = 0; i < directions.profile.mean.size(); ++i) directions.profile.mean[i] -= dark[i % 3];
  return directions;
}

std::vector<std::optional<LimbLayer>> green_limb_layers(const DirectionProfile& directions) {
  const Profile& profile = directions.profile;
  std::vector<std::optional<LimbLayer>> layers;
  for (int sector = 0; sector < profile.bands; ++sector) {
    std::vector<double> tangent_km, light;
    for (int position = 0; position < profile.rows; ++position) {
      tangent_km.push_back(tangent_of_position_km(directions.sectors, position));
      light.push_back(profile.mean[profile.index(sector, position, 1)]);
    }
    layers.push_back(find_limb_layer(tangent_km, light, *directions.sectors.observer_km));
  }
  return layers;
}

std::string limb_layer_words(double azimuth_deg, const std::optional<LimbLayer>& layer) {
  const std::string name = "azimuth " + sector_name(azimuth_deg) + ": ";
  if (!layer) return name + "no layer";
  return name + fmt::format(
                    "emission {:.1f} \u00b1 {:.1f} km (half of it at {:.1f} and {:.1f} km), most light at "
                    "{:.1f} km, rms {:.1f} % of it",
                    layer->peak_km, layer->sigma_peak_km, layer->lower_km, layer->upper_km,
                    layer->apparent_peak_km, 100.0 * layer->rms_over_light);
}

std::string direction_profile_csv(const Photo& photo, const DirectionProfile& directions) {
  const Profile& profile = directions.profile;
  std::string text = comments(photo, directions);
  if (directions.sectors.tangent) {
    const std::vector<std::optional<LimbLayer>> layers = green_limb_layers(directions);
    for (std::size_t k = 0; k < layers.size(); ++k)
      text +=
          sim::csv_comment("green_layer: " + limb_layer_words(directions.sectors.azimuths_deg[k], layers[k]));
  }
  const bool limb = directions.sectors.observer_km.has_value();
  text += "azimuth_deg,elevation_deg,";
  if (limb) text += "tangent_altitude_km,";
  text +=
      "r,g,b,sigma_r,sigma_g,sigma_b,n_r,n_g,n_b,r_over_g,sigma_r_over_g,b_over_g,"
      "sigma_b_over_g\n";
  for (int sector = 0; sector < profile.bands; ++sector)
    for (int position = 0; position < profile.rows; ++position) {
      const std::size_t i = profile.index(sector, position, 0);
      if (profile.count[i] == 0 && profile.count[i + 1] == 0 && profile.count[i + 2] == 0) continue;
      text += sim::csv_number(directions.sectors.azimuths_deg[sector]) + "," +
              sim::csv_number(elevation_of_position_deg(directions.sectors, position));
      if (limb) text += "," + sim::csv_number(tangent_of_position_km(directions.sectors, position));
      for (int c = 0; c < 3; ++c) text += "," + sim::csv_number(profile.mean[i + c]);
      for (int c = 0; c < 3; ++c) text += "," + sim::csv_number(profile.standard_error[i + c]);
      for (int c = 0; c < 3; ++c) text += "," + std::to_string(profile.count[i + c]);
      for (const int channel : {0, 2}) {
        const Ratio ratio = channel_ratio(profile, sector, position, channel, 1);
        text += "," + sim::csv_number(ratio.value) + "," + sim::csv_number(ratio.sigma);
      }
      text += '\n';
    }
  return text;
}

}  // namespace vegard::fit
