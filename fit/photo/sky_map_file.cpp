#include "fit/photo/sky_map_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <string_view>
#include <vector>

#include "fit/photo/direction_map_file.h"
#include "sim/base/array/array_format.h"
#include "sim/base/declared_unit.h"
#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/picture/fits_io.h"
#include "sim/base/picture/pixel_limit.h"
#include "sim/base/text.h"

namespace vegard::fit {
namespace {

using sim::ErrorKind;
using sim::StoredArray;

using Names = std::array<std::string_view, 4>;
constexpr Names kAzimuthNames{"azimuth", "azim", "az", "azimuth_deg"};
constexpr Names kElevationNames{"elevation", "elev", "el", "elevation_deg"};

/// Returns the name without its groups, in small letters.
std::string last_name(const std::string& path) { return sim::lowered(path.substr(path.rfind('/') + 1)); }

bool is_called(const std::string& path, const Names& names) {
  const std::string own = last_name(path);
  return std::any_of(names.begin(), names.end(), [&](std::string_view name) {
    return sim::ends_with(own, name) &&
           (own.size() == name.size() || own[own.size() - name.size() - 1] == '_');
  });
}

/// Its two dimensions that are longer than 1, those of images: rows first.
std::optional<std::pair<std::uint64_t, std::uint64_t>> plane_of(const StoredArray& array) {
  std::vector<std::uint64_t> lengths;
  for (const std::uint64_t length : array.dims)
    if (length != 1) lengths.push_back(length);
  if (lengths.size() != 2 || array.kind == sim::ArrayKind::text) return std::nullopt;
  if (array.columns_first) std::swap(lengths[0], lengths[1]);
  return std::make_pair(lengths[0], lengths[1]);
}

const StoredArray& angles_of(const sim::ArrayFile& file, const Names& names) {
  const StoredArray* largest = nullptr;
  bool is_alone = true;
  for (const StoredArray& array : file.arrays()) {
    if (!is_called(array.name, names) || !plane_of(array)) continue;
    if (largest != nullptr && array.count() < largest->count()) continue;
    is_alone = largest == nullptr || array.count() > largest->count();
    largest = &array;
  }
  const std::string what(names.front());
  if (largest == nullptr)
    throw sim::unreadable(file.name(),
                          std::string("there is no map of ") + what + " in this " + file.format() + " file")
        .expected("an array of two dimensions called " + what + ", or with that behind an underscore");
  if (!is_alone)
    throw sim::unreadable(file.name(), "there are several maps of " + what + " of one size in it");
  return *largest;
}

/// From the array's unit, by its attribute units (unit, BUNIT), to degrees.
double factor_to_degrees(const sim::ArrayFile& file, const StoredArray& array) {
  for (const auto& [key, value] : array.words) {
    const std::string word = sim::lowered(key);
    if (word == "units" || word == "unit" || word == "bunit")
      return sim::declared_factor(value, sim::Quantity::angle_deg, file.name(), array.name + ":" + key);
  }
  return 1.0;
}

sim::Image image_of_angles(sim::ArrayFile& file, const StoredArray& array) {
  const auto [height, width] = *plane_of(array);
  if (height > static_cast<std::uint64_t>(sim::longest_side_px) ||
      width > static_cast<std::uint64_t>(sim::longest_side_px))
    throw sim::unreadable(file.name(), "'" + array.name + "' is too large");
  sim::check_pixel_limit(static_cast<long long>(width), static_cast<long long>(height), file.name());
  const std::vector<double> numbers = file.read_numbers(array);
  const double factor = factor_to_degrees(file, array);
  sim::Image image(static_cast<int>(width), static_cast<int>(height), {array.name});
  for (std::uint64_t y = 0; y < height; ++y)
    for (std::uint64_t x = 0; x < width; ++x) {
      image.data[y * width + x] =
          static_cast<float>(factor * numbers[array.columns_first ? x * height + y : y * width + x]);
    }
  return image;
}

const StoredArray* one_called(const sim::ArrayFile& file, std::initializer_list<std::string_view> names) {
  for (const StoredArray& array : file.arrays())
    for (const std::string_view name : names)
      if (array.count() == 1 && sim::size_of(array.kind) > 0 && last_name(array.name) == name) return &array;
  return nullptr;
}

std::optional<double> angle_called(sim::ArrayFile& file, std::initializer_list<std::string_view> names) {
  const StoredArray* const array = one_called(file, names);
  if (array == nullptr) return std::nullopt;
  return factor_to_degrees(file, *array) * file.read_numbers(*array).at(0);
}

/// In metres, or in the length of its attribute units.
std::optional<double> altitude_called(sim::ArrayFile& file, std::initializer_list<std::string_view> names) {
  const StoredArray* const array = one_called(file, names);
  if (array == nullptr) return std::nullopt;
  double factor = 1.0;
  for (const auto& [key, value] : array->words)
    if (sim::lowered(key) == "units" && !value.empty())
      factor =
          1e3 * sim::declared_factor(value, sim::Quantity::length_km, file.name(), array->name + ":" + key);
  return factor * file.read_numbers(*array).at(0);
}

std::optional<SkyMapPlace> place_of(sim::ArrayFile& file) {
  const auto latitude = angle_called(file, {"site_map_latitude", "site_latitude"});
  const auto longitude = angle_called(file, {"site_map_longitude", "site_longitude"});
  constexpr double kPole_deg = 90.0, kHalfTurn_deg = 180.0, kTurn_deg = 360.0;
  if (!latitude || !longitude || !(std::abs(*latitude) <= kPole_deg) || !(std::abs(*longitude) <= kTurn_deg))
    return std::nullopt;
  SkyMapPlace place{*latitude, *longitude, 0.0};
  if (place.longitude_deg > kHalfTurn_deg) place.longitude_deg -= kTurn_deg;
  if (place.longitude_deg < -kHalfTurn_deg) place.longitude_deg += kTurn_deg;
  const auto altitude = altitude_called(file, {"site_map_altitude", "site_altitude"});
  constexpr double kLowest_m = -500.0, kHighest_m = 9000.0;
  if (altitude && *altitude > kLowest_m && *altitude < kHighest_m) place.altitude_m = *altitude;
  return place;
}

SkyMapFile read_arrays(const std::string& file) {
  const std::unique_ptr<sim::ArrayFile> arrays = sim::open_array_file(file);
  const StoredArray& azimuth = angles_of(*arrays, kAzimuthNames);
  const StoredArray& elevation = angles_of(*arrays, kElevationNames);
  SkyMapFile read;
  read.map = sim::direction_map(image_of_angles(*arrays, azimuth), image_of_angles(*arrays, elevation),
                                file + ": " + azimuth.name, file + ": " + elevation.name);
  read.arrays = azimuth.name + ", " + elevation.name;
  read.place = place_of(*arrays);
  return read;
}

/// Two planes of one file.
SkyMapFile read_planes(const std::string& file) {
  const std::string bytes = sim::input_bytes(file, "a skymap", sim::kMaxPictureBytes);
  const sim::FitsImage fits = sim::read_fits_image(bytes, file);
  const std::size_t planes = fits.image.channel_names.size();
  if (planes != 2)
    throw sim::unreadable(
        file, "there " +
                  std::string(planes == 1 ? "is one plane" : "are " + std::to_string(planes) + " planes") +
                  " in this FITS file")
        .expected("two, azimuth and elevation")
        .hint("where each has a file of its own: --azimuth-map AZ.fits --elevation-map EL.fits");
  sim::Image angles[2];
  for (std::size_t plane = 0; plane < planes; ++plane) {
    angles[plane] = sim::Image(fits.image.width, fits.image.height, {plane == 0 ? "azimuth" : "elevation"});
    std::string key;
    const std::string unit = sim::unit_of_plane(fits.keywords, static_cast<int>(plane), true, key);
    const double factor = sim::declared_factor(unit, sim::Quantity::angle_deg, file, key);
    for (std::size_t i = 0; i < angles[plane].data.size(); ++i) {
      const std::size_t at = i * planes + plane;
      angles[plane].data[i] = fits.known.empty() || fits.known[at]
                                  ? static_cast<float>(factor * fits.image.data[at])
                                  : std::numeric_limits<float>::quiet_NaN();
    }
  }
  SkyMapFile read;
  read.map = sim::direction_map(angles[0], angles[1], file, file);
  return read;
}

SkyMapFile read_as_stored(const std::string& file) {
  if (sim::array_format_of(file) != nullptr) return read_arrays(file);
  constexpr std::string_view kFits = "SIMPLE  =";
  if (sim::read_beginning(file, kFits.size()).bytes == kFits) return read_planes(file);
  return {read_direction_map(file, file), {}, {}};
}

}  // namespace

void flip_map(const SkyMapFlip& flip, sim::DirectionMap& map) {
  for (std::vector<float>* angles : {&map.azimuth_deg, &map.elevation_deg}) {
    // Both at once are the order of all pixels turned round.
    if (flip.rows) std::reverse(angles->begin(), angles->end());
    if (flip.rows != flip.columns)
      for (auto row = angles->begin(); row != angles->end(); row += map.width)
        std::reverse(row, row + map.width);
  }
}

SkyMapFile read_sky_map(const std::string& file, const SkyMapFlip& flip) {
  SkyMapFile read = read_as_stored(file);
  flip_map(flip, read.map);
  return read;
}

bool has_sky_map(const std::string& file) {
  if (sim::array_format_of(file) == nullptr) return false;
  try {
    const std::unique_ptr<sim::ArrayFile> arrays = sim::open_array_file(file);
    return plane_of(angles_of(*arrays, kAzimuthNames)) == plane_of(angles_of(*arrays, kElevationNames));
  } catch (const sim::Error&) {
    return false;
  }
}

}  // namespace vegard::fit
