// Encodes a rendered picture as a file, for stills and for frames of an animation, with the layers of an EXR:
// that of volumes, and those that `vegard render --layers sheets` adds to the picture.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/options/command.h"
#include "sim/base/image.h"
#include "sim/base/picture/image_io.h"
#include "sim/render/render.h"
#include "sim/scene/structs/scene.h"

namespace vegard::apps {

/// Part of the attribute "units" by which an EXR written with --photograph is recognised.
inline constexpr const char* photograph_words = "R, G, B are a photograph's";

/// Options for a picture's file other than its name; empty: the default for its kind.
struct PictureOptions {
  std::optional<int> bits, quality;
  bool as_seen = false;         ///< as a dark-adapted eye sees it (sim/render/as_seen.h), not a camera
  double seen_half_mcd = 20.0;  ///< the luminance that is then shown as half of white
  bool photograph = false;      ///< with the sensor's noise (sim/view/sensor/sensor.h)
  std::uint32_t frame = 0;      ///< number in an animation: each frame has its own noise
  int threads = 0;              ///< for the noise, which does not depend on it
};

/// Adds --bits, --quality (with this help) and --photograph; `options` must outlive the parsing.
void add_picture_options(const Command& command, PictureOptions& options,
                         const std::string& quality = "Quality of a JPEG (default: 92)");

/// Throws Error(usage) if the kind of file given by the name does not support the options.
void check_picture_options(const std::string& path, const PictureOptions& options);

/// Bytes per pixel that it takes to encode such a file from a rendering.
double bytes_to_encode_px(const std::string& path, const PictureOptions& options, const sim::Scene& scene);

/// The lines' channels as the layer "rayleigh".
sim::Image line_layer(const sim::Rendering& rendering);

/// Returns the bytes of the picture's file, whose kind is given by the extension of `path`. `lines` is the
/// line_layer(). With `with_layers`, an EXR also gets the layers of apps/output/picture_file.h, which are
/// moved out of the rendering.
std::string encoded_picture(const std::string& path, const PictureOptions& options, const sim::Scene& scene,
                            sim::Rendering&& rendering, const sim::Image& lines, bool with_layers = false);

/// Returns the bytes of a 16-bit PNG or TIFF of the sensor's raw numbers, the same as for --photograph: one
/// channel if the sensor has a mosaic, else three.
std::string encoded_raw(const std::string& path, const PictureOptions& options, const sim::Scene& scene,
                        const sim::Rendering& rendering);

/// Returns the bytes of an EXR of the lines alone.
std::string encoded_lines(const std::string& path, const sim::Scene& scene, const sim::Image& lines);

/// Throws Error(scene) if a sheet has the name of another layer.
void check_layer_names(const sim::Scene& scene);

/// The layer of the volumes in the picture, "volume.R" to "volume.A"; empty if there are none. Every EXR has
/// it.
sim::Image volume_layer(const sim::Rendering& rendering);

/// Returns the layers as images with the channel names of the file: each sheet ("main.R",
/// "main.rayleigh.6300"), the aurora, the sky, and, as far as they exist, background, stars, the part of
/// these that volumes hide, nebulae of the literal march, foreground (times its mask) and mask.
std::vector<sim::Image> layers_of(const sim::Scene& scene, sim::Rendering&& rendering);

}  // namespace vegard::apps
