#include "apps/commands/commands.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/memory_limit.h"
#include "apps/options/refusals.h"
#include "apps/options/scene_options.h"
#include "apps/options/standard_streams.h"
#include "apps/output/camera_json.h"
#include "apps/output/light_outside.h"
#include "apps/output/picture_file.h"
#include "apps/output/progress_bar.h"
#include "apps/output/terminal.h"
#include "fit/photo/composite_pictures.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/picture/image_io.h"
#include "sim/render/auto_exposure.h"
#include "sim/render/grain.h"
#include "sim/render/render.h"
#include "sim/scene/freedom/keyframes.h"
#include "sim/view/colour/colour_table.h"
#include "sim/view/sensor/tone_curve.h"

namespace vegard::apps {
namespace {

constexpr double kBrightest = 0.95;  // of white, with --auto-exposure

struct RenderRequest {
  SceneOptions scene;
  std::string output, lines, raw, layers;
  PictureOptions picture;
  int threads = 0;
  bool overwrite = false, camera_json = false, grain = false, auto_exposure = false;
  std::string memory_limit;
};

/// Beside the picture, or where there is none beside its lines.
std::string camera_file(const RenderRequest& options) {
  if (!options.camera_json) return {};
  for (const std::string& name : {options.output, options.lines, options.raw})
    if (!name.empty()) return camera_json_name(name);
  return {};
}

/// With --overwrite a slip of the pen would cost what cannot be had again.
void spare_what_is_rendered(const RenderRequest& options, const sim::Scene& scene) {
  const auto spare = [&](const std::string& input, const std::string& what) {
    if (same_file(options.output, input)) throw same_file_error("--output", options.output, what);
    if (same_file(options.lines, input)) throw same_file_error("--lines", options.lines, what);
    if (same_file(options.raw, input)) throw same_file_error("--raw", options.raw, what);
    if (same_file(camera_file(options), input))
      throw same_file_error("--camera-json", camera_file(options), what);
  };
  spare(options.scene.file, "the scene");
  spare(options.scene.camera_file, "the camera's file");
  for (const std::string& file : fit::picture_files(scene)) spare(file, "a file that the scene reads");
}

/// Refuses what would be refused at the end, before the work.
void check_outputs(const RenderRequest& options, const sim::Scene& scene) {
  if (options.grain && scene.blur.model == sim::BlurModel::physical)
    throw usage_error("--grain", "with blur.model = \"physical\" it is not known", "leave it out");
  if (options.output.empty() && options.lines.empty() && options.raw.empty())
    throw usage_error("--output", "nothing to write", "-o OUT, --lines OUT.exr, --raw OUT.tif or several");
  if (same_file(options.output, options.lines))
    throw same_file_error("--lines", options.lines, "the picture's file");
  for (const std::string& other : {options.output, options.lines})
    if (same_file(options.raw, other)) throw same_file_error("--raw", options.raw, "another output");
  spare_what_is_rendered(options, scene);
  if (!options.output.empty()) {
    check_picture_options(options.output, options.picture);
    sim::WholeFile(options.output, options.overwrite);
  } else if (options.picture.bits || options.picture.quality || options.picture.photograph ||
             options.picture.as_seen) {
    throw usage_error(options.picture.bits         ? "--bits"
                      : options.picture.quality    ? "--quality"
                      : options.picture.photograph ? "--photograph"
                                                   : "--as-seen",
                      "without a picture it says nothing", "-o OUT with it");
  }
  if (options.picture.as_seen) require_rayleighs(scene, "--as-seen");
  if (options.picture.as_seen && options.picture.photograph)
    throw usage_error("--as-seen", "an eye takes no photographs", "--as-seen or --photograph");
  if (!options.raw.empty()) {
    const sim::ImageFormat format = sim::image_format(options.raw);
    if (format != sim::ImageFormat::png && format != sim::ImageFormat::tiff)
      throw usage_error("--raw", "'" + options.raw + "' cannot hold 16-bit numbers",
                        "a name that ends in .png or .tif");
    sim::WholeFile(options.raw, options.overwrite);
  }
  // A measured tone curve is read by whatever is encoded with it; here, before the work.
  sim::ToneCurve check_of_the_curve(scene);
  sim::ColourTable check_of_the_colours(scene);
  if (!options.layers.empty()) {
    if (options.output.empty() || sim::image_format(options.output) != sim::ImageFormat::exr)
      throw usage_error("--layers", "only an EXR has layers", "-o OUT.exr");
    check_layer_names(scene);
  }
  if (!options.lines.empty()) {
    if (sim::image_format(options.lines) != sim::ImageFormat::exr)
      throw usage_error("--lines", "'" + options.lines + "' cannot hold rayleighs",
                        "a name that ends in .exr");
    sim::WholeFile(options.lines, options.overwrite);
  }
  if (options.camera_json) {
    camera_json(sim::still_scene(scene));
    sim::WholeFile(camera_file(options), options.overwrite);
  }
}

/// All files are filled before any gets its name: a disk that fills up leaves none.
void write_outputs(const RenderRequest& options, const sim::Scene& scene, sim::Rendering&& rendering) {
  const sim::Image lines = line_layer(rendering);
  const std::string camera = options.camera_json ? camera_file(options) : std::string();
  sim::WholeFiles outputs({options.output, options.lines, options.raw, camera}, options.overwrite);
  if (!options.raw.empty())
    outputs.write(options.raw, encoded_raw(options.raw, options.picture, scene, rendering));
  if (!options.output.empty())
    outputs.write(options.output, encoded_picture(options.output, options.picture, scene,
                                                  std::move(rendering), lines, !options.layers.empty()));
  if (!options.lines.empty()) outputs.write(options.lines, encoded_lines(options.lines, scene, lines));
  if (!camera.empty()) outputs.write(camera, camera_json(sim::still_scene(scene)));
  outputs.commit();
}

/// Of beams: volumes have none.
std::string grain_text(const sim::Scene& scene, const std::vector<double>& grain) {
  std::string text = "grain";
  for (std::size_t l = 0; l < grain.size(); ++l)
    text += fmt::format("{} {:.1f} % of a pixel's light at {:.1f} nm", l > 0 ? "," : "", 100.0 * grain[l],
                        scene.emission.lines[l]);
  return text;
}

float peak_of(const sim::Image& image, int channel) {
  float peak = 0.0f;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) peak = std::max(peak, image.at(x, y, channel));
  return peak;
}

std::string facts(const sim::Scene& scene, const sim::Rendering& rendering) {
  const sim::Image& image = rendering.rayleigh;
  std::string text = fmt::format("{} x {} pixels, ", image.width, image.height);
  // Volumes have none.
  if (!scene.sheets.empty()) text += fmt::format("{} deflection points, ", rendering.deflection_points);
  text += "peak";
  for (int l = 0; l < image.channels(); ++l) {
    text +=
        fmt::format("{} {:.0f} R at {:.1f} nm", l > 0 ? "," : "", peak_of(image, l), scene.emission.lines[l]);
  }
  return text;
}

void answer_facts(const sim::Scene& scene, const sim::Rendering& rendering) {
  Json& answer = json_answer();
  answer["width_px"] = rendering.rayleigh.width;
  answer["height_px"] = rendering.rayleigh.height;
  if (!scene.sheets.empty()) answer["deflection_points"] = rendering.deflection_points;
  answer["lines"] = Json::array();
  for (int l = 0; l < rendering.rayleigh.channels(); ++l)
    answer["lines"].push_back({{"wavelength_nm", scene.emission.lines[static_cast<std::size_t>(l)]},
                               {"peak_rayleigh", json_number(peak_of(rendering.rayleigh, l))}});
  if (scene.sensor.exposure == sim::ExposureRule::gain)
    answer["gain_per_kilorayleigh"] = scene.sensor.gain_per_kilorayleigh;
  else
    answer["iso"] = scene.sensor.iso;
}

std::optional<sim::Scene> auto_exposed(const RenderRequest& options, const sim::Scene& scene) {
  sim::RenderOptions render_options;
  render_options.threads = options.threads;
  std::optional<sim::Scene> exposed = sim::auto_exposed(scene, kBrightest, render_options);
  if (!exposed)
    tell(
        "vegard: --auto-exposure found none: %s; the exposure is the scene's own\n",
        fmt::format("by no gain or ISO within its limits is one pixel in a thousand at {}, for want of light "
                    "or because sky.level is brighter",
                    kBrightest)
            .c_str());
  return exposed;
}

std::string exposure_text(const sim::Scene& scene) {
  return scene.sensor.exposure == sim::ExposureRule::gain
             ? fmt::format("sensor.gain_per_kilorayleigh = {:.4g}", scene.sensor.gain_per_kilorayleigh)
             : fmt::format("sensor.iso = {:.6g}", scene.sensor.iso);
}

int run_render(const RenderRequest& request) {
  end_at_once_when_interrupted();
  RenderRequest options = request;
  const sim::Scene as_given = moving_scene_of(options.scene);
  note_inert_keys(as_given);
  check_outputs(options, as_given);
  const std::optional<sim::Scene> exposed =
      options.auto_exposure ? auto_exposed(options, as_given) : std::nullopt;
  const sim::Scene& scene = exposed ? *exposed : as_given;
  sim::RenderingUse use;
  use.sheet_layers = !options.layers.empty();
  use.loads_codecs = !fit::picture_files(scene).empty();
  for (const std::string& name : {options.output, options.lines, options.raw}) {
    if (name.empty()) continue;
    use.bytes_per_px = std::max(use.bytes_per_px, bytes_to_encode_px(name, options.picture, scene));
    use.loads_codecs = use.loads_codecs || sim::image_format(name) == sim::ImageFormat::tiff;
  }
  options.threads = options.picture.threads =
      threads_to_render(scene, options.threads, use, options.memory_limit);
  const sim::CompositePictures pictures = fit::read_composite_pictures(scene);

  sim::Rendering rendering;
  std::vector<double> grain;
  ProgressBar bar("rendering");
  {
    sim::RenderOptions render_options;
    render_options.threads = options.threads;
    // What is left then is to make pictures of the light, and to write them.
    render_options.progress = [&bar](double share) { bar.update(0.8 * share); };
    render_options.pictures = &pictures;
    render_options.sheet_layers = !options.layers.empty();
    rendering = sim::render(scene, render_options);
    render_options.progress = {};
    if (options.grain) grain = sim::grain_per_px(scene, rendering, render_options);
  }
  const std::string warning = warning_if_out_of_view(sim::still_scene(scene), rendering.rayleigh);
  bar.finish();
  if (!warning.empty()) tell("vegard: %s\n", warning.c_str());

  const std::string summary = facts(scene, rendering);
  answer_facts(scene, rendering);
  bar.update(0.8, "writing");
  write_outputs(options, scene, std::move(rendering));
  bar.finish();
  std::string written;
  for (const std::string& name : {options.output, options.lines, options.raw, camera_file(options)})
    if (!name.empty()) written += (written.empty() ? "" : ", ") + name;
  json_answer()["outputs"] = json_names({options.output, options.lines, options.raw, camera_file(options)});
  say("%s: %s\n", written.c_str(), summary.c_str());
  if (exposed) say("exposed with %s\n", exposure_text(scene).c_str());
  if (options.grain) say("%s\n", grain_text(scene, grain).c_str());
  return good;
}

}  // namespace

void add_render_command(Program& program) {
  const auto options = std::make_shared<RenderRequest>();
  const Command command =
      program.add("render", "Render a scene: EXR for light, TIFF, PNG or JPEG for the eye");
  add_scene_options(command, options->scene);
  command.option("-o,--output", options->output, "The picture to write; its extension sets the format")
      .type_name("OUT.exr|tif|png|jpg");
  command.option("--lines", options->lines, "Write the emission lines alone, in rayleighs")
      .type_name("OUT.exr");
  command.option("--raw", options->raw, "Write the sensor's raw numbers of --photograph, 16 bits")
      .type_name("OUT.png|tif");
  command
      .option("--layers", options->layers,
              "Write each sheet and all other parts of the picture as layers of the EXR")
      .one_of({"sheets"});
  add_threads_option(command, options->threads);
  add_memory_option(command, options->memory_limit);
  add_picture_options(command, options->picture);
  const Option as_seen =
      command.flag("--as-seen", options->picture.as_seen,
                   "Show the picture as a dark-adapted eye sees it: faint light grey, bright light coloured");
  command
      .option("--seen-half", options->picture.seen_half_mcd,
              "Luminance that --as-seen shows as half of white, in mcd m^-2 (default: 20)")
      .range(1e-3, 1e6)
      .type_name("MCD_M2")
      .needs(as_seen);
  command.flag("--auto-exposure", options->auto_exposure,
               "Choose the sensor's gain (or ISO) so that only one pixel in a thousand is nearly white");
  command.flag("--grain", options->grain,
               "Render once more with other random paths of the beams, and report by how much pixels differ");
  command.flag("--camera-json", options->camera_json,
               "Write the camera's matrices next to the picture, OUT.camera.json");
  command.flag("--overwrite", options->overwrite, "Replace outputs that exist");
  command.runs([options] { return run_render(*options); });
}

}  // namespace vegard::apps
