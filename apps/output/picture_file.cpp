#include "apps/output/picture_file.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/options/refusals.h"
#include "sim/base/error.h"
#include "sim/base/utc_time.h"
#include "sim/base/version.h"
#include "sim/render/as_seen.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/freedom/keyframes.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/view/colour/line_colours.h"
#include "sim/view/sensor/sensor.h"
#include "sim/view/sensor/tone_curve.h"

namespace vegard::apps {

namespace {

int bits_of(const PictureOptions& options, sim::ImageFormat format) {
  if (!options.bits) return format == sim::ImageFormat::tiff ? 16 : 8;
  if (format == sim::ImageFormat::exr)
    throw usage_error("--bits", "an EXR always holds 32-bit floats", "no --bits");
  if (format == sim::ImageFormat::jpeg && *options.bits != 8)
    throw usage_error("--bits", "a JPEG holds 8 bits", "8, or a .png or .tif");
  return *options.bits;
}

sim::ImageAttributes attributes_of(const sim::Scene& scene) {
  sim::ImageAttributes attributes = {
      {"scene", sim::write_scene(scene)}, {"seed", std::to_string(scene.seed)}, {"version", sim::version()}};
  if (!scene.site.time_utc.empty()) attributes["DateTime"] = sim::in_utc(scene.site.time_utc);
  return attributes;
}

sim::Image raw_of(const PictureOptions& options, const sim::Scene& scene, const sim::Rendering& rendering) {
  return sim::raw_numbers(scene, sim::light_on_sensor(scene, rendering), options.frame, options.threads);
}

/// True for a picture whose channels the tone has mixed, and no table of false colours.
bool is_filmic(const sim::Scene& scene, const PictureOptions& options) {
  return scene.sensor.tone == sim::ToneKind::filmic && !options.as_seen &&
         scene.sensor.colour_table == "none";
}

std::string noise_words(const PictureOptions& options) {
  return "; noise of frame " + std::to_string(options.frame) + " of the seed";
}

std::string encoding_words(const sim::Scene& scene, const PictureOptions& options) {
  const std::string colour = scene.sensor.colour_table == "none"
                                 ? ""
                                 : "; false colour by sensor.colour_table = " + scene.sensor.colour_table;
  if (options.as_seen) return "sRGB-encoded" + colour;  // for the eye, whatever the sensor's tone
  return sim::ToneCurve(scene).name() + (scene.sensor.tone == sim::ToneKind::linear ? "" : "-encoded") +
         (options.photograph ? noise_words(options) : "") + colour;
}

sim::Image shown_picture(const PictureOptions& options, const sim::Scene& scene,
                         const sim::Rendering& rendering) {
  if (options.as_seen) return sim::picture_as_seen(scene, rendering, 1e-3 * options.seen_half_mcd);
  if (options.photograph)
    return sim::encoded(scene, sim::developed(scene, raw_of(options, scene, rendering)));
  return sim::display_picture(scene, rendering);
}

constexpr std::array<const char*, 12> kOwnNames = {"aurora", "sky",    "night_sky",  "background",
                                                   "stars",  "mask",   "foreground", "rayleigh",
                                                   "volume", "hidden", "literal",    "ground"};

sim::Image named(const std::string& layer, sim::Image image) {
  for (std::string& name : image.channel_names) name.insert(0, layer + ".");
  return image;
}

/// The channels from `first` on.
sim::Image channels_of(const sim::Image& image, int first, std::vector<std::string> names) {
  sim::Image part(image.width, image.height, std::move(names));
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < part.channels(); ++c) part.at(x, y, c) = image.at(x, y, first + c);
  return part;
}

}  // namespace

void add_picture_options(const Command& command, PictureOptions& options, const std::string& quality) {
  command.option("--bits", options.bits, "Bits per channel (default: 8 for PNG, 16 for TIFF)")
      .one_of({8, 16});
  command.option("--quality", options.quality, quality).range(1, 100);
  command.flag("--photograph", options.photograph,
               "Simulate the scene's sensor: photon and read noise, saturation, mosaic");
}

void check_picture_options(const std::string& path, const PictureOptions& options) {
  const sim::ImageFormat format = sim::image_format(path);
  bits_of(options, format);
  if (options.quality && format != sim::ImageFormat::jpeg)
    throw usage_error("--quality", "only a JPEG has a quality", "-o OUT.jpg");
  if (options.as_seen && format == sim::ImageFormat::exr)
    throw usage_error("--as-seen", "an EXR holds the camera's linear values", "-o OUT.png, .tif or .jpg");
}

double bytes_to_encode_px(const std::string& path, const PictureOptions& options, const sim::Scene& scene) {
  constexpr double kFloat = sizeof(float), kRgb = 3.0 * kFloat;
  const double noisy = options.photograph ? 3.0 * kRgb : 0.0;
  // All channels side by side, and the packed bytes, which may be as many.
  if (sim::image_format(path) == sim::ImageFormat::exr)
    return 2.0 * (kRgb + kFloat * static_cast<double>(scene.emission.lines.size())) + 16.0 + noisy;
  // What is shown, its numbers of 8 or 16 bits, and the packed bytes.
  const double of_numbers = bits_of(options, sim::image_format(path)) == 16 ? 6.0 : 3.0;
  return kRgb + 2.0 * of_numbers + 8.0 + noisy;
}

sim::Image line_layer(const sim::Rendering& rendering) {
  sim::Image layer = rendering.rayleigh;
  for (std::string& name : layer.channel_names) name.insert(0, "rayleigh.");
  return layer;
}

std::string encoded_raw(const std::string& path, const PictureOptions& options, const sim::Scene& moving,
                        const sim::Rendering& rendering) {
  const sim::Scene scene = sim::still_scene(moving);
  sim::Image raw = raw_of(options, scene, rendering);
  constexpr float kLargest = 65535.0f;
  for (float& value : raw.data) value /= kLargest;
  sim::ImageAttributes attributes = attributes_of(moving);
  attributes["units"] = "raw numbers of " + std::to_string(scene.sensor.bits) + " bits, mosaic " +
                        sim::word_of(scene.sensor.mosaic) + noise_words(options);
  constexpr int kBits = 16, kNoQuality = 100;
  return sim::encode_display(sim::image_format(path), raw, kBits, kNoQuality, attributes, path);
}

std::string encoded_picture(const std::string& path, const PictureOptions& options, const sim::Scene& moving,
                            sim::Rendering&& rendering, const sim::Image& lines, bool with_layers) {
  const sim::Scene scene = sim::still_scene(moving);
  sim::ImageAttributes attributes = attributes_of(moving);
  const sim::ImageFormat format = sim::image_format(path);
  if (format == sim::ImageFormat::exr) {
    // Light for other scenes, on a scale that its readers know.
    if (scene.camera.model == sim::LensModel::equirectangular)
      attributes["whiteLuminance"] = fmt::format("{:.9g}", sim::white_luminance_cd_m2(scene));
    attributes["units"] =
        "R, G, B: linear sensor values, white = 1, negative where a line is out of gamut; rayleigh.*: "
        "rayleighs, by wavelength in tenths of a nanometre";
    if (options.photograph) {
      rendering.rgb = sim::developed(scene, raw_of(options, scene, rendering));
      attributes["units"] += std::string("; ") + photograph_words +
                             ", dark in the corners as its lens has it" + noise_words(options);
    }
    std::vector<const sim::Image*> images = {&rendering.rgb, &lines};
    const sim::Image volume = volume_layer(rendering);
    if (!volume.empty()) {
      images.push_back(&volume);
      attributes["units"] += "; volume.*: R, G, B of volumes, the same, multiplied by A, their coverage";
    }
    std::vector<sim::Image> layers;
    if (with_layers) {
      layers = layers_of(scene, std::move(rendering));
      attributes["units"] +=
          "; other layers' R, G, B: the same; mask: 1 where the foreground hides the sky; hidden.*: "
          "share of what is behind volumes that they hide";
    }
    for (const sim::Image& layer : layers) images.push_back(&layer);
    return sim::encode_exr(images, attributes, path);
  }
  constexpr int kDefaultQuality = 92;
  attributes["units"] = encoding_words(scene, options);
  // By it a photograph's reader finds the light again (fit/photo/codec/filmic_light.h).
  if (is_filmic(scene, options))
    attributes["encoding"] = "filmic, primaries " + sim::word_of(scene.sensor.primaries);
  const sim::Image shown = shown_picture(options, scene, rendering);
  return sim::encode_display(format, shown, bits_of(options, format),
                             options.quality.value_or(kDefaultQuality), attributes, path);
}

std::string encoded_lines(const std::string& path, const sim::Scene& scene, const sim::Image& lines) {
  sim::ImageAttributes attributes = attributes_of(scene);
  attributes["units"] = "rayleighs, by wavelength in tenths of a nanometre";
  return sim::encode_exr({&lines}, attributes, path);
}

void check_layer_names(const sim::Scene& scene) {
  for (const sim::Sheet& sheet : scene.sheets) {
    if (std::find(kOwnNames.begin(), kOwnNames.end(), sheet.name) == kOwnNames.end()) continue;
    throw with_place(
        sim::Error(sim::ErrorKind::scene, "--layers has a layer '" + sheet.name + "' that is no sheet")
            .key("sheet." + sheet.name + ".name")
            .expected("another name for the sheet"),
        scene);
  }
}

sim::Image volume_layer(const sim::Rendering& rendering) {
  return rendering.volume.empty() ? sim::Image() : named("volume", rendering.volume);
}

std::vector<sim::Image> layers_of(const sim::Scene& scene, sim::Rendering&& rendering) {
  std::vector<sim::Image> layers;
  for (sim::SheetLayer& sheet : rendering.sheets) {
    layers.push_back(named(sheet.name, std::move(sheet.aurora)));
    layers.push_back(named(sheet.name + ".rayleigh", std::move(sheet.rayleigh)));
  }
  layers.push_back(named("aurora", std::move(rendering.aurora)));
  layers.push_back(named("sky", sim::sky_light(scene)));
  if (!rendering.night_sky.empty()) layers.push_back(named("night_sky", std::move(rendering.night_sky)));
  if (!rendering.background.empty()) layers.push_back(named("background", std::move(rendering.background)));
  if (!rendering.stars.empty()) layers.push_back(named("stars", std::move(rendering.stars)));
  if (!rendering.hidden.empty()) layers.push_back(named("hidden", std::move(rendering.hidden)));
  if (!rendering.literal.empty()) layers.push_back(named("literal", std::move(rendering.literal)));
  if (!rendering.ground.empty()) layers.push_back(named("ground", std::move(rendering.ground)));
  if (!rendering.foreground.empty()) {
    layers.push_back(channels_of(rendering.foreground, 0, {"foreground.R", "foreground.G", "foreground.B"}));
    layers.push_back(channels_of(rendering.foreground, 3, {"mask"}));
  }
  return layers;
}

}  // namespace vegard::apps
