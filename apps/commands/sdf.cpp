#include "apps/commands/commands.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/refusals.h"
#include "apps/options/standard_streams.h"
#include "apps/output/terminal.h"
#include "sim/base/error.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/number/distance_transform.h"
#include "sim/base/picture/image_io.h"

namespace vegard::apps {
namespace {

struct SdfRequest {
  std::string image, output;
  double threshold = 0.5;
  std::optional<double> spread_px;
  bool is_signed = false, wraps = false, overwrite = false;
};

/// Pixels whose mean of red, green and blue, as the numbers stand, is above the threshold.
std::vector<std::uint8_t> marks(const sim::PictureFile& picture, double threshold) {
  const sim::Image& image = picture.image;
  const int colours = image.channels() >= 3 ? 3 : 1;
  std::vector<std::uint8_t> marked(static_cast<std::size_t>(image.width) * image.height);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      double sum = 0.0;
      for (int c = 0; c < colours; ++c) sum += image.at(x, y, c);
      marked[static_cast<std::size_t>(y) * image.width + x] = sum > threshold * colours ? 1 : 0;
    }
  return marked;
}

/// Pixels from the middle of each to that of the nearest marked one; 0 where none is.
std::vector<double> distances(const std::vector<std::uint8_t>& marked, const sim::Image& image, bool wraps) {
  std::vector<double> away;
  away.reserve(marked.size());
  for (const std::uint32_t square : sim::squared_distance(marked, image.width, image.height, wraps, 0))
    away.push_back(square == sim::kNoMark ? 0.0 : std::sqrt(static_cast<double>(square)));
  return away;
}

void run_sdf(const SdfRequest& options) {
  end_at_once_when_interrupted();
  if (same_file(options.output, options.image)) throw same_file_error("--output", options.output, "an input");
  if (!(options.threshold >= 0.0 && options.threshold < 1.0))
    throw usage_error("--threshold", "a share of white must lie between 0 and 1", "0 <= threshold < 1");
  const sim::ImageFormat format = sim::image_format(options.output);
  const bool is_exr = format == sim::ImageFormat::exr;
  // range() lets nan through.
  if (options.spread_px && !(*options.spread_px >= 0.01 && *options.spread_px <= 1e6))
    throw usage_error("--spread", fmt::format("{} px is no distance to be white", *options.spread_px),
                      "0.01 to 1000000");
  if (is_exr && options.spread_px)
    throw usage_error("--spread", "an EXR holds pixels as they are", "leave it out, or a PNG or TIFF");
  if (!is_exr && !options.spread_px)
    throw usage_error("--spread", "a " + options.output + " holds values from black to white only",
                      "--spread PX, the distance that is white", "an EXR holds pixels as they are");
  // Refused now, not after the work.
  sim::WholeFile(options.output, options.overwrite);  // NOLINT(bugprone-unused-raii)
  const sim::PictureFile picture = sim::read_picture(options.image);
  constexpr int kMax = 32767;
  if (picture.image.width > kMax || picture.image.height > kMax)
    throw usage_error("IMAGE", options.image + " is wider or higher than " + std::to_string(kMax) + " pixels",
                      "a smaller picture");
  std::vector<std::uint8_t> marked = marks(picture, options.threshold);
  const auto lit = static_cast<std::size_t>(std::count(marked.begin(), marked.end(), 1));
  if (lit == 0 || (options.is_signed && lit == marked.size()))
    throw usage_error(
        "--threshold",
        options.image + " has " + (lit == 0 ? "nothing" : "everything") + " above the threshold",
        "a threshold that parts the picture");
  std::vector<double> away = distances(marked, picture.image, options.wraps);
  if (options.is_signed) {
    // Half-way between the last pixel within and the first one without the distance is 0.
    for (std::uint8_t& mark : marked) mark = mark != 0 ? 0 : 1;
    const std::vector<double> within = distances(marked, picture.image, options.wraps);
    for (std::size_t i = 0; i < away.size(); ++i) away[i] = away[i] > 0.0 ? away[i] - 0.5 : 0.5 - within[i];
  }
  sim::Image field(picture.image.width, picture.image.height, {"Y"});
  const double scale = is_exr ? 1.0 : (options.is_signed ? 0.5 : 1.0) / *options.spread_px;
  const double zero = is_exr || !options.is_signed ? 0.0 : 0.5;
  for (std::size_t i = 0; i < away.size(); ++i) field.data[i] = static_cast<float>(zero + scale * away[i]);
  if (is_exr)
    sim::write_exr(options.output, field, {{"unit", "px"}}, options.overwrite);
  else
    sim::write_display(options.output, field, format == sim::ImageFormat::jpeg ? 8 : 16, 95, {},
                       options.overwrite);
  const auto range = std::minmax_element(away.begin(), away.end());
  json_answer() = {{"outputs", json_names({options.output})},
                   {"width_px", field.width},
                   {"height_px", field.height},
                   {"pixels_above_threshold", lit},
                   {"min_distance_px", *range.first},
                   {"max_distance_px", *range.second}};
  say("%s: %d x %d pixels, %.3f %% of them above the threshold; distances from %.2f to %.2f px\n",
      options.output.c_str(), field.width, field.height,
      100.0 * static_cast<double>(lit) / static_cast<double>(away.size()), *range.first, *range.second);
}

}  // namespace

void add_sdf_command(Program& program) {
  const auto options = std::make_shared<SdfRequest>();
  const Command command =
      program.add("sdf", "Compute the exact distance of every pixel to the nearest bright one");
  command.option("IMAGE", options->image, "A picture, such as an aurora's footprint").required();
  command.option("-o,--output", options->output, "The distance field to write")
      .required()
      .type_name("OUT.exr|png|tif");
  command.option("--threshold", options->threshold,
                 "Share of white above which a pixel is bright (default: 0.5)");
  command.flag("--signed,!--unsigned", options->is_signed,
               "Make the distance negative inside bright regions (default: --unsigned, 0 there)");
  command.flag("--wrap", options->wraps, "Join the left edge to the right one, as around the Earth");
  command.option("--spread", options->spread_px, "Distance shown as white in a PNG, TIFF or JPEG")
      .type_name("PX");
  command.flag("--overwrite", options->overwrite, "Replace an output that exists");
  command.runs([options] {
    run_sdf(*options);
    return good;
  });
}

}  // namespace vegard::apps
