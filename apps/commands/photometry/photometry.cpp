#include "apps/commands/commands.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/refusals.h"
#include "apps/options/site_words.h"
#include "apps/options/standard_streams.h"
#include "apps/output/terminal.h"
#include "fit/photo/frames/picture_bytes.h"
#include "fit/photo/photo_metadata.h"
#include "fit/photo/rayleigh/star_photometry.h"
#include "fit/photo/taken_time.h"
#include "sim/base/error.h"
#include "sim/base/file/number_text.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/picture/picture_metadata.h"
#include "sim/scene/file/camera_file.h"
#include "sim/view/sky/star_place.h"

namespace vegard::apps {
namespace {

struct PhotometryRequest {
  std::string counts, filter, camera, time, extinction, output, stars_out;
  std::vector<std::string> pictures, site;
  std::optional<double> exposure_s;
  fit::StarPhotometrySettings settings;
  bool vacuum = false, overwrite = false;
};

void read_extinction(PhotometryRequest& options) {
  if (options.extinction.empty()) return;
  if (options.extinction == "stars") {
    options.settings.extinction = fit::ExtinctionBy::stars;
  } else if (options.extinction == "air") {
    options.settings.extinction = fit::ExtinctionBy::air;
  } else {
    char* end = nullptr;
    options.settings.magnitudes_per_airmass = std::strtod(options.extinction.c_str(), &end);
    options.settings.extinction = fit::ExtinctionBy::number;
    if (end != options.extinction.c_str() + options.extinction.size() ||
        !(options.settings.magnitudes_per_airmass >= 0.0 && options.settings.magnitudes_per_airmass <= 5.0))
      throw usage_error("--extinction", "'" + options.extinction + "' is no extinction",
                        "stars, air, or magnitudes per airmass from 0 to 5");
  }
}

/// The camera's scene, with the site of the command line or of the first picture where its file has none.
sim::Scene scene_of_camera(const PhotometryRequest& options) {
  sim::Scene scene;
  sim::take_camera(scene, options.camera);
  if (!options.site.empty()) {
    const sim::Observer place = site_place(options.site);
    scene.site.latitude_deg = place.latitude_deg;
    scene.site.longitude_deg = place.longitude_deg;
    scene.site.altitude_m = place.height_m;
  } else if (scene.lines.count("site.latitude_deg") == 0) {
    const sim::PictureMetadata says = fit::photo_metadata(options.pictures.front());
    if (!says.latitude_deg || !says.longitude_deg)
      throw usage_error("--site", "the directions of stars depend on the site, and none is given",
                        "--site LAT,LON,HEIGHT, or [site] in the camera's file");
    scene.site.latitude_deg = *says.latitude_deg;
    scene.site.longitude_deg = *says.longitude_deg;
    scene.site.altitude_m = says.altitude_m.value_or(0.0);
  }
  return scene;
}

/// The middle of its exposure.
double julian_date_of(const std::string& picture, const std::string& time, double exposure_s) {
  constexpr double kDay_s = 86400.0;
  const std::string utc = time.empty() ? fit::taken_time(fit::photo_metadata(picture)).utc : time;
  const std::optional<double> date = sim::julian_date(utc);
  if (!date)
    throw usage_error(
        "--time", !utc.empty() ? "'" + utc + "' is no time" : picture + " has no time at which it was taken",
        "when its exposure began, in UTC: 2015-10-07T08:23:51Z");
  return *date + 0.5 * exposure_s / kDay_s;
}

std::string extinction_text(const fit::StarFactor& found) {
  const std::string value = sim::number_with_error(found.magnitudes_per_airmass, found.extinction_error);
  switch (found.extinction) {
    case fit::ExtinctionBy::stars:
      return value + " magnitudes per airmass, by the stars";
    case fit::ExtinctionBy::number:
      return value + " magnitudes per airmass, as given";
    default:
      return value + " magnitudes per airmass, of the standard air";
  }
}

std::string factor_text(const fit::StarFactor& found, const fit::RayleighFilter& filter,
                        std::size_t pictures) {
  std::size_t used = 0;
  for (const fit::MeasuredStar& star : found.stars) used += star.used ? 1 : 0;
  std::string text =
      fmt::format("{} ({:.1f} nm): {} picture{}, {} of {} stars used\n", filter.name, filter.band.line_nm,
                  pictures, pictures == 1 ? "" : "s", used, found.stars.size());
  text += fmt::format("R per count per second: {}\n",
                      sim::number_with_error(found.factor.value, found.factor.error));
  text += fmt::format("  of its error: the stars {:.1f} % ({} degrees of freedom), their spectra {:.1f} %",
                      1e2 * found.star_error, found.degrees_of_freedom, 1e2 * found.spectrum_error);
  text += found.width_error > 0.0 ? fmt::format(", the filter's width {:.1f} %\n", 1e2 * found.width_error)
                                  : ", the error of the filter's width unknown (width_error)\n";
  text += fmt::format("  single stars scatter by {:.1f} % beyond their noise\n", 1e2 * found.scatter);
  text += "extinction: " + extinction_text(found) + "\n";
  for (const fit::MeasuredStar& star : found.stars)
    if (!star.used)
      text += fmt::format("left out: {} at ({:.1f}, {:.1f}), which alone would give {:.4g}\n", star.name,
                          star.x_px, star.y_px, star.factor);
  for (const std::string& note : found.notes) text += "note: " + note + "\n";
  return text;
}

void answer_factor(const fit::StarFactor& found, const fit::RayleighFilter& filter, std::size_t pictures) {
  Json& answer = json_answer();
  answer = {{"filter", filter.name},
            {"wavelength_nm", filter.band.line_nm},
            {"pictures", pictures},
            {"rayleigh_per_count_s", json_number(found.factor.value)},
            {"rayleigh_per_count_s_error", json_number(found.factor.error)},
            {"star_error_share", json_number(found.star_error)},
            {"degrees_of_freedom", found.degrees_of_freedom},
            {"spectrum_error_share", json_number(found.spectrum_error)},
            {"width_error_share", found.width_error > 0.0 ? Json(found.width_error) : Json(nullptr)},
            {"scatter_share", json_number(found.scatter)},
            {"extinction", extinction_text(found)},
            {"stars", Json::array()},
            {"notes", found.notes}};
  for (const fit::MeasuredStar& star : found.stars)
    answer["stars"].push_back({{"name", star.name},
                               {"x_px", star.x_px},
                               {"y_px", star.y_px},
                               {"rayleigh_per_count_s", json_number(star.factor)},
                               {"used", star.used}});
}

std::string star_table(const fit::StarFactor& found) {
  std::string text =
      "star,magnitude,b_v,x_px,y_px,elevation_deg,airmass,pictures,counts_per_s,counts_per_s_error,rayleigh,"
      "rayleigh_per_count_s,used\n";
  for (const fit::MeasuredStar& star : found.stars)
    text += fmt::format("{},{:.2f},{:.3f},{:.2f},{:.2f},{:.2f},{:.3f},{},{:.6g},{:.4g},{:.6g},{:.6g},{}\n",
                        star.name, star.magnitude, star.colour_index, star.x_px, star.y_px,
                        star.elevation_deg, star.airmass, star.pictures, star.rate, star.rate_error,
                        star.rayleighs, star.factor, star.used ? 1 : 0);
  return text;
}

void check_outputs(const PhotometryRequest& options, const fit::RayleighFilter& filter) {
  for (const auto& [key, file] : {std::pair<const char*, const std::string&>{"--output", options.output},
                                  {"--stars-out", options.stars_out}}) {
    for (const std::string& input : {options.camera, filter.dark_file, filter.flat_file})
      if (same_file(file, input)) throw same_file_error(key, file, "an input");
    for (const std::string& input : options.pictures)
      if (same_file(file, input)) throw same_file_error(key, file, "an input");
  }
  if (same_file(options.stars_out, options.counts))
    throw same_file_error("--stars-out", options.stars_out, "an input");
  if (same_file(options.stars_out, options.output))
    throw same_file_error("--stars-out", options.stars_out, "--output");
  if (options.output.empty()) return;
  const auto folder = [](const std::string& file) {
    std::error_code ignored;
    return std::filesystem::weakly_canonical(std::filesystem::absolute(file).parent_path(), ignored);
  };
  if (folder(options.output) != folder(options.counts))
    throw usage_error("--output",
                      "its dark level and flat field are named from the folder of " + options.counts,
                      "a name in that folder");
}

int run_photometry(PhotometryRequest& options) {
  end_at_once_when_interrupted();
  read_extinction(options);
  options.settings.refracting_air = !options.vacuum;
  if (!options.time.empty() && options.pictures.size() > 1)
    throw usage_error("--time", "there are several pictures", "pictures with their own time, or one picture");
  const std::string text = fit::rayleigh_camera_text(options.counts);
  const fit::RayleighCamera camera = fit::parse_rayleigh_camera(text, options.counts);
  const fit::RayleighFilter& filter = fit::filter_called(camera, options.filter);
  if (filter.band.width_nm == 0.0 && filter.band.table_nm.empty()) {
    throw sim::Error(sim::ErrorKind::scene, "it is not known how broad the filter '" + filter.name + "' is")
        .file(options.counts)
        .line(filter.line)
        .key("filter.width_nm")
        .expected("'width_nm', or 'transmission'");
  }
  check_outputs(options, filter);
  sim::WholeFiles outputs({options.output, options.stars_out}, options.overwrite);

  std::vector<std::string> names;
  for (const std::string& picture : options.pictures)
    for (const fit::NamedPicture& one : fit::pictures_in(picture)) names.push_back(one.name);
  const sim::Scene scene = scene_of_camera(options);
  fit::StarPhotometer photometer(scene, filter.band, options.settings);
  for (const std::string& name : names) {
    const fit::CountPicture picture = fit::count_picture(name, filter, options.exposure_s);
    if (picture.rate.width != scene.camera.width || picture.rate.height != scene.camera.height)
      throw usage_error("--camera",
                        fmt::format("the camera has {} x {} pixels, {} {} x {}", scene.camera.width,
                                    scene.camera.height, name, picture.rate.width, picture.rate.height),
                        "a camera that was calibrated on such a picture");
    photometer.add(picture, julian_date_of(name, options.time, picture.exposure_s));
  }
  const fit::StarFactor found = photometer.answer(options.pictures.front());
  // What is known to less than a factor of two or so is no calibration.
  constexpr double kMaxError = 0.3;
  answer_factor(found, filter, names.size());
  if (found.star_error > kMaxError) {
    say_text(factor_text(found, filter, names.size()));
    tell("vegard: the stars do not determine the factor: its error is %.0f %%\n", 100.0 * found.star_error);
    return doubted;
  }
  if (!options.output.empty())
    outputs.write(options.output, fit::with_factor(text, options.counts, filter.name, found.factor));
  outputs.write(options.stars_out, star_table(found));
  outputs.commit();
  say_text(factor_text(found, filter, names.size()));
  json_answer()["outputs"] = json_names(outputs.written());
  for (const std::string& name : outputs.written()) say("%s\n", name.c_str());
  return good;
}

}  // namespace

void add_photometry_command(Program& program) {
  const auto options = std::make_shared<PhotometryRequest>();
  const Command command =
      program.add("photometry", "Calibrate a camera's counts in rayleighs by stars, with errors");
  command
      .option("COUNTS", options->counts,
              "The camera's dark level, flat field and filters (docs/rayleighs.md)")
      .required()
      .type_name("COUNTS.toml");
  command
      .option("PICTURES", options->pictures,
              "Pictures through one of its filters; all frames of files that hold many")
      .required()
      .type_name("PICTURE");
  command.option("--filter", options->filter, "The filter of these pictures").type_name("NAME");
  command.option("--camera", options->camera, "Lens, pointing and site, as vegard calibrate writes them")
      .required()
      .type_name("CAMERA.toml");
  command.option("--time", options->time, "Beginning of the exposure (UTC), if the picture does not give it")
      .type_name("TIME");
  add_site_option(command, options->site);
  command
      .option("--exposure", options->exposure_s, "Exposure time in seconds, if the pictures do not give it")
      .finite_range(1e-6, 1e5)
      .type_name("S");
  command
      .option("--extinction", options->extinction,
              "Extinction of the air: fitted with the factor (stars), of the standard air (air), or in "
              "magnitudes per airmass (default: stars if their elevations differ enough, else air)")
      .type_name("stars|air|MAG");
  command.option("--catalogue-magnitude", options->settings.faintest, "Faintest star that is measured")
      .finite_range(-2.0, 6.0)
      .shows_default();
  command
      .option("--min-elevation", options->settings.min_elevation_deg,
              "Elevation of the lowest star used, in degrees")
      .finite_range(5.0, 85.0)
      .shows_default();
  command
      .option("--aperture", options->settings.aperture.radius_px,
              "Radius of the circle about a star, in pixels")
      .finite_range(1.0, 50.0)
      .shows_default();
  command.flag("--no-refraction", options->vacuum, "Compute the stars' places without refraction by the air");
  command
      .option("-o,--output", options->output,
              "The copy of COUNTS.toml with the factor to write, in the same folder")
      .type_name("OUT.toml");
  command.option("--stars-out", options->stars_out, "Write a table of the stars").type_name("STARS.csv");
  command.flag("--overwrite", options->overwrite, "Replace outputs that exist");
  command.runs([options] { return run_photometry(*options); });
}

}  // namespace vegard::apps
