// What a picture's file says of how it was taken: EXIF 2.32 (CIPA DC-008), sections 4.6.4 to 4.6.6; of a FITS
// image, when (sim/base/picture/fits_time.h); and what the imagers of the aurora say of theirs
// (fit/photo/frames).
//
// Nothing is made up, and nothing that cannot be is passed on: a latitude of 95, an exposure below zero and a
// focal length of 0 ("unknown" in the standard) are left out.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace vegard::sim {

/// Which words say it, for whoever reads what was made of them.
struct PictureSources {
  std::string header_time;  ///< "FITS DATE-OBS"
  std::string latitude = "EXIF GPSLatitude", longitude = "EXIF GPSLongitude", altitude = "EXIF GPSAltitude";
  std::string exposure = "EXIF ExposureTime";
};

struct PictureMetadata {
  std::optional<std::string> make, model, lens;
  std::optional<double> focal_length_mm;
  std::optional<double> focal_length_35mm_mm;   ///< that gives the same angle on 35 mm film
  std::optional<double> focal_plane_px_per_mm;  ///< across the stored width: pixels of the sensor's picture
  std::optional<double> exposure_s, f_number, iso;

  /// "2019-03-01T00:16:30.922622", by the camera's own clock: of no known zone without utc_offset.
  std::optional<std::string> taken_local;
  std::optional<std::string> utc_offset;    ///< of that clock, "-07:00" or "Z"
  std::optional<std::string> gps_time_utc;  ///< "2019-03-01T07:16:01Z", of the last position, not the picture

  /// Of FITS and of imagers, whose clocks are kept in UTC.
  std::optional<std::string> header_time_utc;

  std::optional<double> latitude_deg, longitude_deg;  ///< north and east positive
  std::optional<double> altitude_m;                   ///< above sea level

  std::optional<std::string> imager, site,
      mode;  ///< as imagers' operators call them: "themis19", "gill", "full"
  PictureSources sources;
  std::string contradiction;  ///< of what the file says of itself, in a sentence without a full stop

  int orientation = 1;                     ///< EXIF's 1 to 8, of the stored picture
  std::optional<int> width_px, height_px;  ///< of the upright picture, from its container
  std::optional<int> exif_width_px,
      exif_height_px;  ///< as EXIF says, of the stored picture when it was taken
};

/// Of a file's bytes, whole or cut short; empty where nothing is known. Never throws.
PictureMetadata picture_metadata_of(std::string_view bytes);

/// JPEG, PNG (eXIf), TIFF, HEIC, raw files built like a TIFF, or Fujifilm's, and FITS; of any other file
/// nothing is known. Throws Error(unreadable_input) if there is no such file or it cannot be read.
PictureMetadata read_picture_metadata(const std::string& path);

/// The time in UTC, ISO 8601: "2019-03-01T07:16:30.922622Z" from taken_local and its offset, or that of the
/// header; nothing without.
std::optional<std::string> taken_utc(const PictureMetadata& metadata);

}  // namespace vegard::sim
