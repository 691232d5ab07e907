#include "apps/commands/commands.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/photo_options.h"
#include "apps/options/refusals.h"
#include "apps/options/scene_options.h"
#include "apps/options/standard_streams.h"
#include "apps/output/picture_file.h"
#include "apps/output/terminal.h"
#include "fit/photo/photo.h"
#include "fit/photo/rayleigh/count_picture.h"
#include "fit/photo/rayleigh/rayleigh_camera.h"
#include "sim/base/error.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/picture/image_io.h"
#include "sim/base/version.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/view/sensor/sensor.h"

namespace vegard::apps {
namespace {

struct LineariseRequest {
  std::string photo, at, output;
  std::string rayleigh, filter;  ///< a camera's file of counts, and which of its filters
  std::optional<double> exposure_s;
  SceneOptions scene;
  bool overwrite = false;
};

/// An EXR of this program says whether it is a photograph or light already.
void check_is_photograph(const fit::Photo& photo, const std::string& file) {
  const auto units = photo.words.find("units");
  if (units == photo.words.end() || units->second.find(photograph_words) != std::string::npos) return;
  throw sim::Error(sim::ErrorKind::unreadable_input, "it is no photograph but linear light already")
      .file(file)
      .expected("a photograph, as render --photograph writes it");
}

void check_size(const sim::Scene& scene, const fit::Photo& photo) {
  if (scene.camera.width == photo.linear.width && scene.camera.height == photo.linear.height) return;
  throw usage_error(
      "camera.width",
      fmt::format("the scene's camera has {} x {} pixels, the photograph {} x {}", scene.camera.width,
                  scene.camera.height, photo.linear.width, photo.linear.height),
      "one size",
      fmt::format("--set camera.width={} --set camera.height={}", photo.linear.width, photo.linear.height));
}

int run_linearise(const LineariseRequest& options) {
  end_at_once_when_interrupted();
  const sim::Scene scene = scene_of(options.scene);
  if (sim::image_format(options.output) != sim::ImageFormat::exr)
    throw usage_error("--output", "'" + options.output + "' cannot hold linear light and its variance",
                      "a name that ends in .exr");
  protect_outputs({{"--output", options.output}},
                  {options.photo, options.scene.file, options.scene.camera_file});
  sim::WholeFile file(options.output, options.overwrite);
  const fit::Photo photo = fit::read_photo(options.photo, fit::Decoding::sensor, &scene);
  check_is_photograph(photo, options.photo);
  check_size(scene, photo);

  sim::Image variance = sim::light_variance(scene, photo.linear, fit::file_step(photo));
  sim::Image saturated = photo.linear;
  std::size_t lost = 0;
  for (std::size_t i = 0; i < photo.usable.size(); ++i) {
    saturated.data[i] = photo.usable[i] ? 0.0f : 1.0f;
    lost += photo.usable[i] ? 0 : 1;
  }
  for (std::string& name : variance.channel_names) name.insert(0, "variance.");
  for (std::string& name : saturated.channel_names) name.insert(0, "saturated.");
  const sim::ImageAttributes attributes = {
      {"scene", sim::write_scene(scene)},
      {"version", sim::version()},
      {"photograph", photo.file_name},
      {"decoding", photo.decoding},
      {"units",
       "R, G, B: linear sensor values, white = 1; variance.*: of these, without what JPEG does to them; "
       "saturated.*: 1 where a full pixel has had a part in the value"}};
  file.write(sim::encode_exr({&photo.linear, &variance, &saturated}, attributes, options.output));
  file.commit();
  json_answer() = {{"outputs", json_names({options.output})},
                   {"width_px", photo.linear.width},
                   {"height_px", photo.linear.height},
                   {"decoding", photo.decoding},
                   {"saturated_share", static_cast<double>(lost) / static_cast<double>(photo.usable.size())}};
  say("%s: %s\n", options.output.c_str(),
      fmt::format("{} x {} pixels, {}, {:.2f} % of the values saturated", photo.linear.width,
                  photo.linear.height, photo.decoding,
                  100.0 * static_cast<double>(lost) / static_cast<double>(photo.usable.size()))
          .c_str());
  return good;
}

/// To rayleighs, by what is known of a camera that counts.
int run_rayleigh(const LineariseRequest& options) {
  end_at_once_when_interrupted();
  if (!options.scene.file.empty() || !options.scene.camera_file.empty() || !options.scene.changes.empty() ||
      !options.scene.seed.empty())
    throw usage_error("--rayleigh", "a scene and a camera that counts", "no SCENE with --rayleigh");
  const std::string ending = std::filesystem::path(options.output).extension().string();
  const bool is_fits = ending == ".fits" || ending == ".fit" || ending == ".fts";
  if (!is_fits && ending != ".exr")
    throw usage_error("--output", "'" + options.output + "' cannot hold rayleighs and their error",
                      "a name that ends in .fits or .exr");
  const fit::RayleighCamera camera = fit::read_rayleigh_camera(options.rayleigh);
  const fit::RayleighFilter& filter = fit::filter_called(camera, options.filter);
  protect_outputs({{"--output", options.output}},
                  {options.photo, options.rayleigh, filter.dark_file, filter.flat_file});
  if (!filter.factor) {
    throw sim::Error(sim::ErrorKind::scene, "it is not known what a count of '" + filter.name + "' means")
        .file(options.rayleigh)
        .line(filter.line)
        .key("filter.rayleigh_per_count_s")
        .expected("rayleigh_per_count_s")
        .hint("vegard photometry finds it by stars");
  }
  sim::WholeFile file(options.output, options.overwrite);
  const fit::CountPicture counts = fit::count_picture(options.photo, filter, options.exposure_s);
  const fit::RayleighPicture picture = fit::rayleigh_picture(counts, filter);
  const std::string photo = file_name_of(options.photo);
  file.write(
      is_fits ? fit::encode_rayleigh_fits(picture, filter, camera, photo, counts.exposure_s, options.output)
              : fit::encode_rayleigh_exr(picture, filter, camera, photo, counts.exposure_s, options.output));
  file.commit();
  std::string text = fmt::format("{} x {} pixels of {:.1f} nm, {:g} s; {:.4g} to {:.4g} R, median {:.4g} R\n",
                                 picture.image.width, picture.image.height, filter.band.line_nm,
                                 counts.exposure_s, picture.least, picture.most, picture.median);
  text += picture.scale_error > 0.0
              ? fmt::format("the scale is known to {:.1f} %, the same for all pixels\n",
                            100.0 * picture.scale_error)
              : "note: the error of the scale is not known: no rayleigh_per_count_s_error\n";
  if (!counts.is_noise_known)
    text += "note: a pixel's error is without its photons' noise: no gain_e_per_count\n";
  if (picture.unknown > 0) text += fmt::format("{} pixels are full or blank, and are NaN\n", picture.unknown);
  json_answer() = {
      {"outputs", json_names({options.output})},
      {"width_px", picture.image.width},
      {"height_px", picture.image.height},
      {"wavelength_nm", filter.band.line_nm},
      {"exposure_s", json_number(counts.exposure_s)},
      {"min_rayleigh", json_number(picture.least)},
      {"median_rayleigh", json_number(picture.median)},
      {"max_rayleigh", json_number(picture.most)},
      {"scale_error_share", picture.scale_error > 0.0 ? Json(picture.scale_error) : Json(nullptr)},
      {"is_noise_known", counts.is_noise_known},
      {"unknown_pixels", picture.unknown}};
  say("%s: %s", options.output.c_str(), text.c_str());
  return good;
}

}  // namespace

void add_linearise_command(Program& program) {
  const auto options = std::make_shared<LineariseRequest>();
  const Command command = program.add(
      "linearise",
      "Convert a photograph to linear light with its variance, by a scene's sensor, or counts to rayleighs");
  command.option("PHOTO", options->photo, "A photograph of any format that is read")
      .required()
      .type_name("PHOTO");
  add_at_option(command, options->at);
  add_scene_options(command, options->scene, SceneWord::may_be_missing);
  const Option rayleigh =
      command
          .option(
              "--rayleigh", options->rayleigh,
              "Convert to rayleighs, without a scene, by this dark level, flat field and factors of a camera")
          .type_name("COUNTS.toml");
  command.option("--filter", options->filter, "Filter of COUNTS.toml through which the picture was taken")
      .type_name("NAME")
      .needs(rayleigh);
  command
      .option("--exposure", options->exposure_s, "Exposure time in seconds, if the picture does not give it")
      .finite_range(1e-6, 1e5)
      .type_name("S")
      .needs(rayleigh);
  command.option("-o,--output", options->output, "The linear light, or rayleighs, to write")
      .required()
      .type_name("OUT.exr|OUT.fits");
  command.flag("--overwrite", options->overwrite, "Replace an output that exists");
  command.runs([options] {
    if (options->rayleigh.empty() && options->scene.file.empty())
      throw usage_error("SCENE", "no scene is given",
                        "a scene with the photograph's sensor, or --rayleigh COUNTS.toml");
    options->photo = picture_at(options->photo, options->at);
    return options->rayleigh.empty() ? run_linearise(*options) : run_rayleigh(*options);
  });
}

}  // namespace vegard::apps
