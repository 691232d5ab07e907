// A rendered picture as the bytes of its file: the same for a still and for a frame of an animation.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "apps/options/command.h"

#include "sim/base/image.h"
#include "sim/base/picture/image_io.h"
#include "sim/render/render.h"
#include "sim/scene/structs/scene.h"

namespace vegard::apps {

/// In the units of an EXR that --photograph has written.
inline constexpr const char* photograph_words = "R, G, B are a photograph's";

/// What the command line says of a picture's file beside its name; empty: the default of its kind.
struct PictureOptions {
  std::optional<int> bits, quality;
  bool as_seen = false;         ///< as a dark-adapted eye sees it (sim/render/as_seen.h), not a camera
  double seen_half_mcd = 20.0;  ///< the luminance that it then shows as half of white
  bool photograph = false;      ///< with the sensor's noise (sim/view/sensor/sensor.h)
  std::uint32_t frame = 0;      ///< of an animation: each has its own noise
  int threads = 0;              ///< for the noise; it does not depend on them
};

/// Adds --bits, --quality and --photograph; `options` must outlive the parsing.
void add_picture_options(const Command& command, PictureOptions& options);

/// Throws Error(usage) if a file of that name cannot be what the options want.
void check_picture_options(const std::string& path, const PictureOptions& options);

/// The lines' channels as the layer "rayleigh".
/// Bytes for each pixel that it takes to make such a file of a rendering.
double bytes_to_encode_px(const std::string& path, const PictureOptions& options, const sim::Scene& scene);

sim::Image line_layer(const sim::Rendering& rendering);

/// The bytes of the picture's file, its kind by the extension of `path`. `lines` is the line_layer().
/// with_layers: an EXR gets those of apps/layers.h too, taken out of the rendering.
std::string encoded_picture(const std::string& path, const PictureOptions& options, const sim::Scene& scene,
                            sim::Rendering&& rendering, const sim::Image& lines, bool with_layers = false);

/// The bytes of a 16-bit PNG or TIFF of the sensor's raw numbers, those of the photograph: one channel behind
/// a mosaic, else three.
std::string encoded_raw(const std::string& path, const PictureOptions& options, const sim::Scene& scene,
                        const sim::Rendering& rendering);

/// The bytes of an EXR of the lines alone.
std::string encoded_lines(const std::string& path, const sim::Scene& scene, const sim::Image& lines);

}  // namespace vegard::apps
