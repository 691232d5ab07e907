// A photograph as linear light, with what is known of how it was decoded.
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

/// One of the files that a photograph is put together from (fit/photo/filter_stack.h).
struct PhotoPart {
  std::string file_name, sha256;
  double wavelength_nm = 0.0;
};

struct Photo {
  sim::Image linear;  ///< channels R, G, B; linear light, the file's largest value = 1
  std::vector<std::uint8_t>
      usable;  ///< per pixel and channel, as in linear.data: 1 = not clipped, not masked
  /// The file's size, upright, where `linear` is smaller, averaged over blocks (fit/photo/averaging.h).
  sim::PictureSize averaged_from;
  std::string decoding;  ///< which decoding was used and why: "sRGB (8-bit JPEG, assumed)"
  bool srgb = true;      ///< that decoding: a display's curve (sRGB, if `tone` does not say which), or none
  std::shared_ptr<const sim::ToneCurve> tone;  ///< any other curve, a scene's sensor's too, in its place
  int unknowns = 0;       ///< the curve is unknown, taken as sRGB, and so many numbers of it are to be found
  int bits = 8;           ///< per channel in the file
  bool floating = false;  ///< the file holds floats: no largest value, no quantisation
  double step = 0.0;      ///< between two codes, white = 1; 0: 1 / (2^bits - 1)
  /// Standard deviations, in codes of R, G and B, of what compression has put upon neighbouring pixels alike
  /// (fit/photo/codec/image_file.h); averaging over pixels does not lessen it.
  std::array<double, 3> block_error{};
  std::string file_name;                     ///< without its folder; of one frame among several "a.pgm.gz#12"
  std::string sha256;                        ///< of the file's bytes, or of those of that frame
  std::map<std::string, std::string> words;  ///< that came with it: FITS keywords, EXR attributes
  /// Of one file per filter: what each of the three channels is; a wavelength of 0 where there is no file.
  std::vector<PhotoPart> filters;
  std::string mask_name;  ///< of the mask applied, without its folder; empty if none
  std::string mask_sha256;
};

/// Reads a photograph, a file or one frame of it (fit/photo/frames/frame_name.h), of any format, known by its
/// contents (docs/file_formats.md, "Photographs"): JPEG, PNG, TIFF, PGM, PPM, EXR, FITS, camera raw, HEIC. It
/// is turned upright once. Grey becomes three equal channels, alpha is dropped. automatic means sRGB for
/// JPEG, PNG, integer TIFF, HEIC and PGM or PPM of 8 bits, linear light for all others. A number at the
/// file's white in a channel is clipped there and not usable; in float files only what is not finite (stored
/// as 0) is unusable. Throws sim::Error(unreadable_input) for a file that is missing, truncated, of zero
/// size, no image at all, or larger than sim/base/picture/pixel_limit.h allows, which is seen in its header
/// (OpenCV hands back a full picture for a truncated JPEG: fit/photo/codec/image_file.h looks first).
///
/// Decoding::sensor needs the `scene`: integers of display files go through its tone curve (all others are
/// linear light), the light is divided by the vignetting, and what a full pixel has had a part in is not
/// usable either. Decoding::unknown is for integers: floats are refused.
///
/// A photograph of the size averaging.from is averaged while it is read, unless its curve is unknown.
Photo read_photo(const std::string& file, const Decoding& decoding, const sim::Scene* scene = nullptr,
                 const Averaging& averaging = {});

/// The same of one that was read already, as of a series of them.
Photo read_photo_of(const PictureBytes& picture, const Decoding& decoding, const sim::Scene* scene = nullptr,
                    const Averaging& averaging = {});

/// The same of bytes in memory, which `file` is the name of.
Photo read_photo_bytes(std::string_view bytes, const std::string& file, const Decoding& decoding,
                       const sim::Scene* scene = nullptr, const Averaging& averaging = {});

/// Upright, before any averaging.
sim::PictureSize size_of_file(const Photo& photo);

/// True for floats that no display curve was undone of: they may hold the light of colours out of gamut,
/// signed. All else had it clipped when it was written, and a model is to be clipped likewise.
bool keeps_negative_light(const Photo& photo);

/// One step of the file's code, of 1 for white; 0 for float files.
double file_step(const Photo& photo);

/// The width in linear light of one step of the file's code at this linear value; 0 for float files. Of a
/// vignetted picture, that in its middle.
double code_step(const Photo& photo, double linear);

/// A mask: white (above half of the largest code, mean of the channels) = use. Must have the file's size
/// after orientation and leave at least one pixel, of an averaged photograph a whole block. Throws
/// sim::Error(unreadable_input).
void apply_mask(Photo& photo, const std::string& mask_file);

}  // namespace vegard::fit
