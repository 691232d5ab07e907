#include "fit/direction_map_file.h"

#include <algorithm>

#include "sim/base/error.h"
#include "sim/base/image_io.h"

namespace vegard::fit {
namespace {

const char* const kAzimuth = "azimuth_deg";
const char* const kElevation = "elevation_deg";

[[noreturn]] void refuse(const std::string& file, const std::string& problem, const std::string& expected) {
  sim::ErrorDetails details;
  details.file = file;
  details.problem = problem;
  details.expected = expected;
  throw sim::Error(sim::ErrorKind::unreadable_input, details);
}

sim::Image one_channel(const sim::Image& image, int channel) {
  sim::Image one(image.width, image.height, {image.channel_names[channel]});
  for (std::size_t i = 0; i < one.data.size(); ++i)
    one.data[i] = image.data[i * image.channel_names.size() + channel];
  return one;
}

sim::ImageFormat format_of(const std::string& file) {
  try {
    return sim::image_format(file);
  } catch (const sim::Error&) {
    refuse(file, "its name does not say that it holds angles", "an EXR, or a TIFF of floats");
  }
}

}  // namespace

std::string encode_direction_map(const sim::DirectionMap& map, const std::string& name) {
  const sim::Image image = image_of(map);
  return sim::encode_exr({&image},
                         {{"units",
                           "azimuth_deg: degrees from north to the east; elevation_deg: degrees above the "
                           "horizon; of the pixels' centres, NaN where a pixel looks nowhere"}},
                         name);
}

sim::Image read_angles(const std::string& file, const std::string& channel) {
  const sim::ImageFormat format = format_of(file);
  // Another kind of file that holds floats gets its branch here.
  if (format == sim::ImageFormat::exr) {
    const sim::ExrFile exr = sim::read_exr(file);
    const auto& names = exr.image.channel_names;
    const auto named = std::find(names.begin(), names.end(), channel);
    if (named != names.end()) return one_channel(exr.image, static_cast<int>(named - names.begin()));
    if (names.size() == 1) return exr.image;
    refuse(file, "which of its channels is meant is not known", "one named " + channel + ", or only one");
  }
  const sim::PictureFile picture = sim::read_picture(file);
  if (!picture.floating) refuse(file, "it holds integers, no angles", "an EXR, or a TIFF of floats");
  return one_channel(picture.image, 0);
}

sim::DirectionMap read_direction_map(const std::string& azimuth_file, const std::string& elevation_file) {
  return direction_map(read_angles(azimuth_file, kAzimuth), read_angles(elevation_file, kElevation),
                       azimuth_file, elevation_file);
}

}  // namespace vegard::fit
