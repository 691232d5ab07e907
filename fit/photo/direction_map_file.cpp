#include "fit/photo/direction_map_file.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <limits>
#include <string_view>

#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/picture/fits_io.h"
#include "sim/base/picture/image_io.h"

namespace vegard::fit {
namespace {

const char* const kAzimuth = "azimuth_deg";
const char* const kMapElevation = "elevation_deg";

sim::Image one_channel(const sim::Image& image, int channel) {
  sim::Image one(image.width, image.height, {image.channel_names[channel]});
  for (std::size_t i = 0; i < one.data.size(); ++i)
    one.data[i] = image.data[i * image.channel_names.size() + channel];
  return one;
}

bool is_fits(const std::string& file) {
  std::string extension = std::filesystem::path(file).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension == ".fits" || extension == ".fit" || extension == ".fts";
}

sim::Image read_fits_angles(const std::string& file) {
  const std::string bytes = sim::input_bytes(file, "a map of angles", sim::kMostPictureBytes);
  sim::FitsImage fits = sim::read_fits_image(bytes, file);
  for (std::size_t i = 0; i < fits.known.size(); ++i)
    if (!fits.known[i]) fits.image.data[i] = std::numeric_limits<float>::quiet_NaN();
  return one_channel(fits.image, 0);
}

sim::ImageFormat format_of(const std::string& file) {
  try {
    return sim::image_format(file);
  } catch (const sim::Error&) {
    sim::refuse_file(sim::ErrorKind::unreadable_input, file, "its name does not say that it holds angles",
                     "an EXR, FITS, or a TIFF of floats");
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

FitsMaps encode_fits_maps(const sim::DirectionMap& map) {
  const sim::Image image = image_of(map);
  const sim::FitsKeyword unit = {"BUNIT", std::string("deg"), "NaN: looks nowhere"};
  return {sim::encode_fits(one_channel(image, 0),
                           {{"IMAGTYP", std::string("AZIMUTH"), "from north to the east"}, unit}),
          sim::encode_fits(one_channel(image, 1),
                           {{"IMAGTYP", std::string("ELEVATION"), "above the horizon"}, unit})};
}

sim::Image read_angles(const std::string& file, const std::string& channel) {
  if (is_fits(file)) return read_fits_angles(file);
  const sim::ImageFormat format = format_of(file);
  if (format == sim::ImageFormat::exr) {
    const sim::ExrFile exr = sim::read_exr(file);
    const auto& names = exr.image.channel_names;
    const auto named = std::find(names.begin(), names.end(), channel);
    if (named != names.end()) return one_channel(exr.image, static_cast<int>(named - names.begin()));
    if (names.size() == 1) return exr.image;
    sim::refuse_file(sim::ErrorKind::unreadable_input, file, "which of its channels is meant is not known",
                     "one named " + channel + ", or only one");
  }
  const sim::PictureFile picture = sim::read_picture(file);
  if (!picture.floating)
    sim::refuse_file(sim::ErrorKind::unreadable_input, file, "it holds integers, no angles",
                     "an EXR, FITS, or a TIFF of floats");
  return one_channel(picture.image, 0);
}

sim::DirectionMap read_direction_map(const std::string& azimuth_file, const std::string& elevation_file) {
  return direction_map(read_angles(azimuth_file, kAzimuth), read_angles(elevation_file, kMapElevation),
                       azimuth_file, elevation_file);
}

}  // namespace vegard::fit
