#include "fit/photo/direction_map_file.h"

#include "fit/photo/plane_file.h"
#include "sim/base/picture/fits_io.h"
#include "sim/base/picture/image_io.h"

namespace vegard::fit {
namespace {

const char* const kAzimuth = "azimuth_deg";
const char* const kMapElevation = "elevation_deg";

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
  return read_plane(file, {channel}, "angles");
}

sim::DirectionMap read_direction_map(const std::string& azimuth_file, const std::string& elevation_file) {
  return direction_map(read_angles(azimuth_file, kAzimuth), read_angles(elevation_file, kMapElevation),
                       azimuth_file, elevation_file);
}

}  // namespace vegard::fit
