#include "sim/base/picture/picture_metadata.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>
#include <vector>

#include "sim/base/error.h"
#include "sim/base/picture/exif_block.h"
#include "sim/base/picture/fits_time.h"
#include "sim/base/picture/tiff_directory.h"
#include "sim/base/utc_time.h"

namespace vegard::sim {
namespace {

// Tags of EXIF 2.32, tables 3 to 16.
constexpr int kMake = 271, kModel = 272, kExifDirectory = 34665, kGpsDirectory = 34853;
constexpr int kTimeOfFile = 306, kExposureTime = 33434, kFNumber = 33437, kSensitivity = 34855,
              kTimeOriginal = 36867, kTimeDigitized = 36868, kOffsetOfFile = 36880, kOffsetOriginal = 36881,
              kOffsetDigitized = 36882, kFocalLength = 37386, kSubsecondOriginal = 37521, kExifWidth = 40962,
              kExifHeight = 40963, kFocalPlaneX = 41486, kFocalPlaneUnit = 41488, kFocal35mm = 41989,
              kLensModel = 42036;
constexpr int kLatitudeRef = 1, kLatitude = 2, kLongitudeRef = 3, kLongitude = 4, kAltitudeRef = 5,
              kGpsAltitude = 6, kGpsTime = 7, kGpsDate = 29;

std::optional<double> between(std::optional<double> value, double least, double most) {
  return value && *value >= least && *value <= most ? value : std::nullopt;
}

/// Above 0, and no number that only a damaged file holds.
std::optional<double> positive(const TiffDirectory& directory, int tag) {
  return between(directory.number(tag), 1e-9, 1e9);
}

std::optional<int> pixels(const TiffDirectory& directory, int tag) {
  const auto value = between(directory.number(tag), 1.0, 1 << 30);
  return value ? std::optional<int>(static_cast<int>(*value)) : std::nullopt;
}

/// Degrees, minutes and seconds with N or S, E or W.
std::optional<double> coordinate(const TiffDirectory& gps, int tag, int ref_tag, const char* letters,
                                 double most) {
  const std::vector<double> parts = gps.numbers(tag, 3);
  const auto ref = gps.text(ref_tag);
  if (parts.empty() || !ref) return std::nullopt;
  const char letter = static_cast<char>(std::toupper(static_cast<unsigned char>(ref->front())));
  if (letter != letters[0] && letter != letters[1]) return std::nullopt;
  double degrees = 0.0, unit = 1.0;
  for (const double part : parts) {
    if (part < 0.0) return std::nullopt;
    degrees += part * unit;
    unit /= 60.0;
  }
  return between(letter == letters[0] ? degrees : -degrees, -most, most);
}

/// "2019:03:01", EXIF's way, as ISO 8601 has it.
std::string with_dashes(std::string text) {
  for (std::size_t i : {std::size_t{4}, std::size_t{7}})
    if (i < text.size() && text[i] == ':') text[i] = '-';
  return text;
}

std::optional<std::string> gps_time(const TiffDirectory& gps) {
  const auto date = gps.text(kGpsDate);
  const std::vector<double> clock = gps.numbers(kGpsTime, 3);
  if (!date || clock.size() != 3) return std::nullopt;
  const auto day = civil_time(with_dashes(*date) + "T00:00:00");
  if (!day || clock[0] != std::floor(clock[0]) || clock[1] != std::floor(clock[1])) return std::nullopt;
  for (const double part : clock)
    if (!(part >= 0.0 && part < 61.0)) return std::nullopt;
  CivilTime time = *day;
  time.hour = static_cast<int>(clock[0]);
  time.minute = static_cast<int>(clock[1]);
  time.second = static_cast<int>(clock[2]);
  return is_possible(time) ? std::optional<std::string>(iso_text(time) + "Z") : std::nullopt;
}

/// The zone of the clock: of the original time, or of another one that says the same (a program that changes
/// a picture changes the file's time, with its own zone).
void read_offset(const TiffDirectory& exif, const std::optional<std::string>& time_of_file,
                 const std::string& original, PictureMetadata& metadata) {
  const auto take = [&](std::optional<std::string> offset) {
    if (!metadata.utc_offset && offset && offset_minutes(*offset)) metadata.utc_offset = *offset;
  };
  take(exif.text(kOffsetOriginal));
  if (exif.text(kTimeDigitized) == original) take(exif.text(kOffsetDigitized));
  if (time_of_file == original) take(exif.text(kOffsetOfFile));
}

void read_times(const TiffDirectory& exif, const std::optional<std::string>& time_of_file,
                PictureMetadata& metadata) {
  const auto text = exif.text(kTimeOriginal);
  auto known = text ? civil_time(with_dashes(*text)) : std::nullopt;
  if (!known) return;
  CivilTime& time = *known;
  if (const auto subsecond = exif.text(kSubsecondOriginal))
    if (subsecond->size() <= 9 && subsecond->find_first_not_of("0123456789") == std::string::npos)
      time.subsecond = *subsecond;
  metadata.taken_local = iso_text(time);
  read_offset(exif, time_of_file, *text, metadata);
}

void read_exif(const TiffDirectory& exif, const std::optional<std::string>& time_of_file,
               PictureMetadata& metadata) {
  metadata.lens = exif.text(kLensModel);
  metadata.focal_length_mm = positive(exif, kFocalLength);
  metadata.focal_length_35mm_mm = between(exif.number(kFocal35mm), 1.0, 1e5);
  metadata.exposure_s = positive(exif, kExposureTime);
  metadata.f_number = positive(exif, kFNumber);
  metadata.iso = positive(exif, kSensitivity);
  // 65535 says no more than "at least as much"; the true number stands in tags that few write.
  if (metadata.iso == 65535.0) metadata.iso.reset();
  metadata.exif_width_px = pixels(exif, kExifWidth);
  metadata.exif_height_px = pixels(exif, kExifHeight);
  const double unit = exif.number(kFocalPlaneUnit).value_or(2.0);
  const double millimetres = unit == 2.0 ? 25.4 : unit == 3.0 ? 10.0 : unit == 4.0 ? 1.0 : 0.0;
  if (const auto per_unit = positive(exif, kFocalPlaneX); per_unit && millimetres > 0.0)
    metadata.focal_plane_px_per_mm = *per_unit / millimetres;
  read_times(exif, time_of_file, metadata);
}

void read_gps(const TiffDirectory& gps, PictureMetadata& metadata) {
  const auto latitude = coordinate(gps, kLatitude, kLatitudeRef, "NS", 90.0);
  const auto longitude = coordinate(gps, kLongitude, kLongitudeRef, "EW", 180.0);
  if (latitude && longitude) metadata.latitude_deg = latitude, metadata.longitude_deg = longitude;
  const auto altitude = between(gps.number(kGpsAltitude), 0.0, 1e7);
  // 0 above sea level, 1 below.
  const double below = gps.number(kAltitudeRef).value_or(0.0);
  if (altitude && (below == 0.0 || below == 1.0))
    metadata.altitude_m = below == 1.0 ? 0.0 - *altitude : *altitude;
  metadata.gps_time_utc = gps_time(gps);
}

Error no_picture(const std::string& path, const std::string& problem) {
  return unreadable(path, problem).expected("a picture");
}

}  // namespace

PictureMetadata picture_metadata_of(std::string_view bytes) {
  PictureMetadata metadata;
  if (const auto time = fits_time(bytes)) {
    metadata.header_time_utc = time->utc;
    metadata.header_time_resolution_s = time->resolution_s;
    metadata.sources.header_time = "FITS " + time->key;
    metadata.middle_after_s = time->middle_after_s;
    if (time->exposure_s) {
      metadata.exposure_s = time->exposure_s;
      metadata.sources.exposure = "FITS " + time->exposure_key;
    }
    if (!time->contradiction.empty()) metadata.contradictions.push_back(time->contradiction);
    return metadata;
  }
  const ExifBlock block = find_exif_block(bytes);
  if (const auto directory = TiffDirectory::first(block.tiff)) {
    metadata.make = directory->text(kMake);
    metadata.model = directory->text(kModel);
    const auto orientation = between(directory->number(tiff_tag::kOrientation), 1.0, 8.0);
    if (orientation && block.exif_turns) metadata.orientation = static_cast<int>(*orientation);
    if (const auto exif = directory->at_tag(kExifDirectory))
      read_exif(*exif, directory->text(kTimeOfFile), metadata);
    if (const auto gps = directory->at_tag(kGpsDirectory)) read_gps(*gps, metadata);
  }
  if (block.size_px) {
    metadata.width_px = block.size_px->first;
    metadata.height_px = block.size_px->second;
    if (metadata.orientation >= 5) std::swap(metadata.width_px, metadata.height_px);
  }
  return metadata;
}

PictureMetadata read_picture_metadata(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw no_picture(path, "there is no such file");
  if (!std::filesystem::is_regular_file(status)) throw no_picture(path, "is not a file");
  const auto size = std::filesystem::file_size(path, error);
  std::ifstream file(path, std::ios::binary);
  if (error || !file) throw no_picture(path, "the file cannot be opened");
  constexpr std::uintmax_t kHead = 32, kMax = std::uintmax_t{1} << 31, kFitsHeader = 1 << 20;
  std::string head(std::min(size, kHead), '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  if (!file) throw no_picture(path, "the file cannot be read to its end");
  const bool fits = head.rfind("SIMPLE  =", 0) == 0;
  if (!fits && (!may_have_exif(head) || size > kMax)) return {};
  std::string bytes(fits ? std::min(size, kFitsHeader) : size, '\0');
  file.seekg(0);
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file) throw no_picture(path, "the file cannot be read to its end");
  return picture_metadata_of(bytes);
}

std::optional<std::string> taken_utc(const PictureMetadata& metadata) {
  if (metadata.header_time_utc) return metadata.header_time_utc;
  if (!metadata.taken_local || !metadata.utc_offset) return std::nullopt;
  const auto time = civil_time(*metadata.taken_local);
  const auto offset = offset_minutes(*metadata.utc_offset);
  if (!time || !offset) return std::nullopt;
  return iso_text(minutes_later(*time, -*offset)) + "Z";
}

}  // namespace vegard::sim
