#include "apps/render.h"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/composite_pictures.h"
#include "apps/exit_code.h"
#include "apps/interrupt.h"
#include "apps/layers.h"
#include "apps/light_outside.h"
#include "apps/output_files.h"
#include "apps/progress_bar.h"
#include "apps/scene_options.h"
#include "sim/base/error.h"
#include "sim/base/image_io.h"
#include "sim/base/version.h"
#include "sim/base/whole_file.h"
#include "sim/render/render.h"
#include "sim/scene/scene_toml.h"

namespace vegard::apps {
namespace {

struct Options {
  SceneOptions scene;
  std::string output, lines, layers;
  int threads = 0;
  std::optional<int> bits, quality;
  bool overwrite = false;
};

sim::Error usage(const std::string& key, const std::string& problem, const std::string& expected) {
  sim::ErrorDetails details;
  details.key = key;
  details.problem = problem;
  details.expected = expected;
  return sim::Error(sim::ErrorKind::usage, details);
}

int bits_of(const Options& options, sim::ImageFormat format) {
  if (!options.bits) return format == sim::ImageFormat::tiff ? 16 : 8;
  if (format == sim::ImageFormat::exr)
    throw usage("--bits", "an EXR always holds 32-bit floats", "no --bits");
  if (format == sim::ImageFormat::jpeg && *options.bits != 8)
    throw usage("--bits", "a JPEG holds 8 bits", "8, or a .png or .tif");
  return *options.bits;
}

/// With --overwrite a slip of the pen would cost what cannot be had again.
void spare_inputs(const Options& options, const sim::Scene& scene) {
  const auto spare = [&](const std::string& input, const std::string& what) {
    if (same_file(options.output, input)) refuse_same_file("--output", options.output, what);
    if (same_file(options.lines, input)) refuse_same_file("--lines", options.lines, what);
  };
  spare(options.scene.file, "the scene");
  for (const std::string& file : composite_files(scene)) spare(file, "a picture of the scene");
}

/// Refuses what would be refused at the end, before the work.
void check_outputs(const Options& options, const sim::Scene& scene) {
  if (options.output.empty() && options.lines.empty())
    throw usage("--output", "nothing to write", "-o OUT, --lines OUT.exr or both");
  if (same_file(options.output, options.lines))
    refuse_same_file("--lines", options.lines, "the picture's file");
  spare_inputs(options, scene);
  if (!options.output.empty()) {
    const sim::ImageFormat format = sim::image_format(options.output);
    bits_of(options, format);
    if (options.quality && format != sim::ImageFormat::jpeg)
      throw usage("--quality", "only a JPEG has a quality", "-o OUT.jpg");
    sim::WholeFile(options.output, options.overwrite);
  } else if (options.bits || options.quality) {
    throw usage(options.bits ? "--bits" : "--quality", "an EXR of lines always holds 32-bit floats",
                "-o OUT beside it");
  }
  if (!options.layers.empty()) {
    if (options.output.empty() || sim::image_format(options.output) != sim::ImageFormat::exr)
      throw usage("--layers", "only an EXR has layers", "-o OUT.exr");
    check_layer_names(scene);
  }
  if (!options.lines.empty()) {
    if (sim::image_format(options.lines) != sim::ImageFormat::exr)
      throw usage("--lines", "'" + options.lines + "' cannot hold rayleighs", "a name that ends in .exr");
    sim::WholeFile(options.lines, options.overwrite);
  }
}

sim::ImageAttributes attributes_of(const sim::Scene& scene) {
  sim::ImageAttributes attributes = {
      {"scene", sim::write_scene(scene)}, {"seed", std::to_string(scene.seed)}, {"version", sim::version()}};
  if (!scene.site.time_utc.empty()) attributes["DateTime"] = scene.site.time_utc;
  return attributes;
}

/// The lines' channels as the layer "rayleigh".
sim::Image line_layer(const sim::Rendering& rendering) {
  sim::Image layer = rendering.rayleigh;
  for (std::string& name : layer.channel_names) name.insert(0, "rayleigh.");
  return layer;
}

/// The bytes of the picture's file. Takes the layers out of the rendering.
std::string encoded_picture(const Options& options, const sim::Scene& scene, sim::Rendering&& rendering,
                            const sim::Image& lines) {
  sim::ImageAttributes attributes = attributes_of(scene);
  const sim::ImageFormat format = sim::image_format(options.output);
  if (format == sim::ImageFormat::exr) {
    attributes["units"] =
        "R, G, B: linear sensor values, white = 1, negative where a line is out of gamut; rayleigh.*: "
        "rayleighs, "
        "by wavelength in tenths of a nanometre";
    std::vector<const sim::Image*> images = {&rendering.rgb, &lines};
    std::vector<sim::Image> layers;
    if (!options.layers.empty()) {
      layers = layers_of(scene, std::move(rendering));
      attributes["units"] += "; other layers' R, G, B: the same; mask: 1 where the foreground hides the sky";
    }
    for (const sim::Image& layer : layers) images.push_back(&layer);
    return sim::encode_exr(images, attributes, options.output);
  }
  constexpr int kDefaultQuality = 92;
  attributes["units"] = "sRGB-encoded";
  return sim::encode_display(format, sim::display_picture(scene, rendering), bits_of(options, format),
                             options.quality.value_or(kDefaultQuality), attributes, options.output);
}

std::string encoded_lines(const Options& options, const sim::Scene& scene, const sim::Image& lines) {
  sim::ImageAttributes attributes = attributes_of(scene);
  attributes["units"] = "rayleighs, by wavelength in tenths of a nanometre";
  return sim::encode_exr({&lines}, attributes, options.lines);
}

/// Both files are filled before either gets its name: a disk that fills up leaves neither.
void write_outputs(const Options& options, const sim::Scene& scene, sim::Rendering&& rendering) {
  const sim::Image lines = line_layer(rendering);
  std::optional<sim::WholeFile> picture_file, lines_file;
  if (!options.output.empty()) picture_file.emplace(options.output, options.overwrite);
  if (!options.lines.empty()) lines_file.emplace(options.lines, options.overwrite);
  if (picture_file) picture_file->write(encoded_picture(options, scene, std::move(rendering), lines));
  if (lines_file) lines_file->write(encoded_lines(options, scene, lines));
  if (picture_file) picture_file->commit();
  if (lines_file) lines_file->commit();
}

std::string facts(const sim::Scene& scene, const sim::Rendering& rendering) {
  const sim::Image& image = rendering.rayleigh;
  std::string text = fmt::format("{} x {} pixels, {} deflection points, peak", image.width, image.height,
                                 rendering.deflection_points);
  for (int l = 0; l < image.channels(); ++l) {
    float peak = 0.0f;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) peak = std::max(peak, image.at(x, y, l));
    text += fmt::format("{} {:.0f} R at {:.1f} nm", l > 0 ? "," : "", peak, scene.emission.lines[l]);
  }
  return text;
}

int run(const Options& options) {
  const sim::Scene scene = scene_of(options.scene);
  check_outputs(options, scene);
  const sim::CompositePictures pictures = read_composite_pictures(scene);

  const std::atomic<bool>& stop = watch_for_interrupt();
  sim::Rendering rendering;
  {
    ProgressBar bar("rendering");
    sim::RenderOptions render_options;
    render_options.threads = options.threads;
    render_options.progress = [&bar](double share) { bar.update(share); };
    render_options.stop = &stop;
    render_options.pictures = &pictures;
    render_options.sheet_layers = !options.layers.empty();
    rendering = sim::render(scene, render_options);
  }
  if (stop.load()) {
    std::fputs("vegard: interrupted, nothing is written\n", stderr);
    return interrupted;
  }
  const std::string warning = warning_if_out_of_view(scene, rendering.rayleigh);
  if (!warning.empty()) std::fprintf(stderr, "vegard: %s\n", warning.c_str());

  const std::string summary = facts(scene, rendering);
  write_outputs(options, scene, std::move(rendering));
  std::string written = options.output;
  if (!options.lines.empty()) written += (written.empty() ? "" : ", ") + options.lines;
  std::printf("%s: %s\n", written.c_str(), summary.c_str());
  return good;
}

}  // namespace

void add_render_command(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("render", "Render a scene: EXR for light, TIFF, PNG or JPEG for the eye");
  add_scene_options(*command, options->scene);
  command->add_option("-o,--output", options->output, "The picture to write, its kind by its extension")
      ->type_name("OUT.exr|tif|png|jpg");
  command->add_option("--lines", options->lines, "Write the emission lines alone, in rayleighs")
      ->type_name("OUT.exr");
  command
      ->add_option("--layers", options->layers,
                   "sheets: in an EXR, each sheet and whatever else the picture is made of, as layers")
      ->check(CLI::IsMember({"sheets"}));
  command->add_option("--threads", options->threads, "Threads to use (0: all cores); the result is the same")
      ->check(CLI::Range(0, 1024));
  command->add_option("--bits", options->bits, "Bits per channel (default: 8 for PNG, 16 for TIFF)")
      ->check(CLI::IsMember({8, 16}));
  command->add_option("--quality", options->quality, "Quality of a JPEG, 1 to 100 (default 92)")
      ->check(CLI::Range(1, 100));
  command->add_flag("--overwrite", options->overwrite, "Replace outputs that exist");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace vegard::apps
