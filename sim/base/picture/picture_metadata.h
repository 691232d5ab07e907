// Metadata of a picture's file: EXIF 2.32 (CIPA DC-008), sections 4.6.4 to 4.6.6; the time of a FITS image
// (sim/base/picture/fits_time.h); and the metadata of auroral imagers (fit/photo/frames).
//
// Missing values are not replaced by guesses, and impossible values are left out: a latitude of 95, a
// negative exposure, a focal length of 0 ("unknown" in the standard).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vegard::sim {

/// The sources of values, for messages and reports.
struct PictureSources {
  std::string header_time;  ///< "FITS DATE-OBS"
  std::string clock = "the camera's clock";  ///< what taken_local is
  std::string latitude = "EXIF GPSLatitude", longitude = "EXIF GPSLongitude", altitude = "EXIF GPSAltitude";
  std::string exposure = "EXIF ExposureTime";
};

struct PictureMetadata {
  std::optional<std::string> make, model, lens;
  std::optional<double> focal_length_mm;
  std::optional<double> focal_length_35mm_mm;  ///< equivalent focal length for 35 mm film
  std::optional<double>
      focal_plane_px_per_mm;  ///< across the stored width, in pixels of the sensor's picture
  std::optional<double> exposure_s, f_number, iso;

  /// "2019-03-01T00:16:30.922622", by the camera's clock, whose time zone is unknown without utc_offset.
  std::optional<std::string> taken_local;
  std::optional<std::string> utc_offset;    ///< of that clock, "-07:00" or "Z"
  std::optional<std::string> gps_time_utc;  ///< "2019-03-01T07:16:01Z", of the last position, not the picture

  /// From FITS files and auroral imagers, whose clocks are in UTC.
  std::optional<std::string> header_time_utc;
  double header_time_resolution_s = 0.0;  ///< unit of its last digit in the file; 0: as it has it here

  /// From the beginning of the exposure to its middle, where this is not half of exposure_s.
  std::optional<double> middle_after_s;

  std::optional<double> latitude_deg, longitude_deg;  ///< north and east positive
  std::optional<double> altitude_m;                   ///< above sea level

  std::optional<std::string> imager, site,
      mode;  ///< names by the operators of imagers: "themis19", "gill", "full"
  PictureSources sources;
  /// Between values in the file, or with its name: sentences without a full stop.
  std::vector<std::string> contradictions;

  int orientation = 1;                     ///< EXIF's 1 to 8, of the stored picture
  std::optional<int> width_px, height_px;  ///< of the upright picture, from its container
  std::optional<int> exif_width_px,
      exif_height_px;  ///< by EXIF, of the stored picture when it was taken
};

/// Returns the metadata in a file's bytes, complete or truncated; empty if nothing is known. Never throws.
PictureMetadata picture_metadata_of(std::string_view bytes);

/// Reads the metadata of a JPEG, PNG (eXIf), TIFF, HEIC, FITS or raw file (like TIFF, or of Fujifilm); empty
/// for any other file. Throws Error(unreadable_input) if there is no such file or it cannot be read.
PictureMetadata read_picture_metadata(const std::string& path);

/// Returns the time in UTC, ISO 8601, "2019-03-01T07:16:30.922622Z", from taken_local and utc_offset, or from
/// header_time_utc; nothing if it is unknown.
std::optional<std::string> taken_utc(const PictureMetadata& metadata);

}  // namespace vegard::sim
