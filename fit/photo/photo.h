// A photograph as linear light, with a record of how it was decoded; functions to read and to mask it.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "fit/photo/averaging.h"
#include "fit/photo/decoding.h"
#include "fit/photo/frames/picture_bytes.h"
#include "sim/base/image.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/sensor/tone_curve.h"

namespace vegard::fit {

/// One of the files of which a photograph is composed (fit/photo/filter_stack.h).
struct PhotoPart {
  std::string file_name, sha256;
  double wavelength_nm = 0.0;
};

struct Photo {
  sim::Image linear;  ///< channels R, G, B; linear light, the file's largest value = 1
  std::vector<std::uint8_t>
      usable;  ///< per pixel and channel, as in linear.data: 1 = not clipped, not masked
  /// The upright file's size, if `linear` is averaged over blocks (fit/photo/averaging.h).
  sim::PictureSize averaged_from;
  std::string decoding;  ///< which decoding was used and why: "sRGB (8-bit JPEG, assumed)"
  bool srgb = true;      ///< decoded by a display's curve (`tone`, or sRGB if that is null); false: linear
  std::shared_ptr<const sim::ToneCurve>
      tone;  ///< the curve, if it is not sRGB; also that of a scene's sensor
  int unknowns =
      0;         ///< how many numbers of an unknown curve, decoded as sRGB, are to be found; 0: it is known
  int bits = 8;  ///< per channel in the file
  bool floating = false;  ///< the file holds floats: no largest value, no quantisation
  double step = 0.0;      ///< between two codes, white = 1; 0: 1 / (2^bits - 1)
  /// Standard deviations, in codes of R, G and B, of the compression error that neighbouring pixels have in
  /// common (fit/photo/codec/picture_format.h); averaging over pixels does not reduce it.
  std::array<double, 3> block_error{};
  std::string file_name;                     ///< without its folder; of one frame among several "a.pgm.gz#12"
  std::string sha256;                        ///< of the file's bytes, or of the frame's
  std::map<std::string, std::string> words;  ///< metadata of the file: FITS keywords, EXR attributes
  /// The file of each of the three channels, if there is one file per filter; wavelength 0: no file.
  std::vector<PhotoPart> filters;
  std::string mask_name;  ///< of the mask applied, without its folder; empty if none
  std::string mask_sha256;
};

/// Reads a photograph: a file or one frame of it (fit/photo/frames/frame_name.h), in one of the formats of
/// docs/file_formats.md, "Photographs" (JPEG, PNG, TIFF, PGM, PPM, EXR, FITS, camera raw, HEIC), which is
/// recognised by the contents. The picture is turned upright by its EXIF orientation. Grey becomes three
/// equal channels, alpha is dropped. Decoding::automatic means sRGB for integers of JPEG, PNG, TIFF, HEIC,
/// PGM and PPM, linear light for grey ones of more than 8 bits (assume_light()) and for all other files. A
/// channel's value at the file's white is clipped and not usable; in float files only values that are not
/// finite (stored as 0) are unusable. Throws sim::Error(unreadable_input) for a file that is missing,
/// truncated, of zero size, not an image, or larger by its header than sim/base/picture/pixel_limit.h allows
/// (OpenCV returns a full picture for a truncated JPEG: fit/photo/codec/picture_format.h checks this before).
///
/// Decoding::sensor needs the `scene`: integers of display files are decoded by its tone curve (all others
/// are linear light), the light is divided by the vignetting, and pixels to which a saturated pixel
/// contributed are not usable either. Decoding::unknown is for integers: floats are refused.
///
/// A photograph of the size averaging.from is averaged while it is read, unless its curve is unknown.
Photo read_photo(const std::string& file, const Decoding& decoding, const sim::Scene* scene = nullptr,
                 const Averaging& averaging = {});

/// Like read_photo(), for a picture whose bytes are already in memory, such as one of a series.
Photo read_photo_of(const PictureBytes& picture, const Decoding& decoding, const sim::Scene* scene = nullptr,
                    const Averaging& averaging = {});

/// Like read_photo(), for the bytes of a file in memory; `file` is its name.
Photo read_photo_bytes(std::string_view bytes, const std::string& file, const Decoding& decoding,
                       const sim::Scene* scene = nullptr, const Averaging& averaging = {});

/// Returns the size of the upright photograph before averaging.
sim::PictureSize size_of_file(const Photo& photo);

/// True for floats that were decoded without a display curve: their values may be negative, for colours out
/// of gamut. In all other files such values were clipped when the file was written, and a model must be
/// clipped in the same way.
bool keeps_negative_light(const Photo& photo);

/// Returns one step of the file's code, with white as 1; 0 for float files.
double file_step(const Photo& photo);

/// Returns the width in linear light of one step of the file's code at this linear value; 0 for float files.
/// For a vignetted picture this is the step at its centre.
double code_step(const Photo& photo, double linear);

/// Applies a mask, in which white (mean of the channels above half of the largest code) means: use the pixel.
/// The mask must have the size of the upright file and keep at least one pixel, or one whole block of an
/// averaged photograph. Throws sim::Error(unreadable_input).
void apply_mask(Photo& photo, const std::string& mask_file);

/// Returns a photograph of the caller's linear light, as if read from a file of floats. `light` has the
/// channels R, G, B, or one channel, which is copied to all three. `used`: per pixel, 0 if it is not to be
/// used; empty: all pixels are used. Values that are not finite are not usable. `name`: in place of a file's.
Photo photo_of_light(const sim::Image& light, const std::vector<std::uint8_t>& used, const std::string& name);

/// Returns for each pixel of a photograph, which must not be averaged, whether the mask keeps it, clipped or
/// not: the pixels in which to look for stars. Throws as apply_mask() does.
std::vector<char> pixels_left_by(const std::string& mask_file, const Photo& photo);

}  // namespace vegard::fit
