#include "fit/photo/direction_map_file.h"

#include <algorithm>
#include <filesystem>
#include <limits>

#include "sim/base/declared_unit.h"
#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/picture/fits_io.h"
#include "sim/base/picture/image_io.h"
#include "sim/base/text.h"

namespace vegard::fit {
namespace {

const char* const kAzimuth = "azimuth_deg";
const char* const kMapElevation = "elevation_deg";

bool is_fits(const std::string& file) {
  const std::string extension = sim::lowered_extension(file);
  return extension == ".fits" || extension == ".fit" || extension == ".fts";
}

void multiply_by(double factor, sim::Image& image) {
  if (factor != 1.0)
    for (float& value : image.data) value = static_cast<float>(factor * value);
}

sim::Image read_fits_plane(const std::string& file, const std::string& what, sim::Quantity quantity) {
  const std::string bytes = sim::input_bytes(file, "a map of " + what, sim::kMaxPictureBytes);
  sim::FitsImage fits = sim::read_fits_image(bytes, file);
  for (std::size_t i = 0; i < fits.known.size(); ++i)
    if (!fits.known[i]) fits.image.data[i] = std::numeric_limits<float>::quiet_NaN();
  sim::Image plane = one_channel(fits.image, 0);
  std::string key;
  const std::string unit = sim::unit_of_plane(fits.keywords, 0, true, key);
  multiply_by(sim::declared_factor(unit, quantity, file, key), plane);
  return plane;
}

sim::ImageFormat format_of(const std::string& file, const std::string& what) {
  try {
    return sim::image_format(file);
  } catch (const sim::Error&) {
    throw sim::unreadable(file, "its name does not say that it holds " + what)
        .expected("an EXR, FITS, or a TIFF of floats");
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
  return read_plane(file, {channel}, "angles", sim::Quantity::angle_deg);
}

sim::DirectionMap read_direction_map(const std::string& azimuth_file, const std::string& elevation_file) {
  return direction_map(read_angles(azimuth_file, kAzimuth), read_angles(elevation_file, kMapElevation),
                       azimuth_file, elevation_file);
}

sim::Image one_channel(const sim::Image& image, int channel) {
  sim::Image one(image.width, image.height, {image.channel_names[channel]});
  for (std::size_t i = 0; i < one.data.size(); ++i)
    one.data[i] = image.data[i * image.channel_names.size() + channel];
  return one;
}

sim::Image read_plane(const std::string& file, const std::vector<std::string>& channels,
                      const std::string& what, sim::Quantity quantity) {
  if (is_fits(file)) return read_fits_plane(file, what, quantity);
  const sim::ImageFormat format = format_of(file, what);
  if (format == sim::ImageFormat::exr) {
    sim::ExrFile exr = sim::read_exr(file);
    const auto unit = exr.attributes.find("declared unit");
    if (unit != exr.attributes.end())
      multiply_by(sim::declared_factor(unit->second, quantity, file, "units"), exr.image);
    const auto& names = exr.image.channel_names;
    for (const std::string& channel : channels) {
      const auto named = std::find(names.begin(), names.end(), channel);
      if (named != names.end()) return one_channel(exr.image, static_cast<int>(named - names.begin()));
    }
    if (names.size() == 1) return exr.image;
    throw sim::unreadable(file, "which of its channels is meant is not known")
        .expected("one named " + channels.front() + ", or only one");
  }
  const sim::PictureFile picture = sim::read_picture(file);
  if (!picture.floating)
    throw sim::unreadable(file, "it holds integers, no " + what)
        .expected("an EXR, FITS, or a TIFF of floats");
  return one_channel(picture.image, 0);
}

}  // namespace vegard::fit
