#include "fit/map/sequence/frame_check.h"

#include <cmath>
#include <optional>
#include <utility>

#include "fit/photo/pointing/star_finder.h"
#include "sim/base/error.h"
#include "sim/base/file/number_text.h"
#include "sim/base/image.h"

namespace vegard::fit {
namespace {

constexpr double kSameExposure = 0.02;  // relative: cameras round what they write

std::string exposure_words(const sim::PictureMetadata& metadata) {
  std::string words;
  const auto add = [&](const std::optional<double>& value, const std::string& before,
                       const std::string& after) {
    if (value) words += (words.empty() ? "" : ", ") + before + sim::short_number(*value, 4) + after;
  };
  add(metadata.exposure_s, "", " s");
  add(metadata.f_number, "f/", "");
  add(metadata.iso, "ISO ", "");
  return words;
}

}  // namespace

void FrameCheck::require_same_exposure(const std::string& name, const sim::PictureMetadata& metadata) {
  const auto require = [&](const std::optional<double>& value, Known& known) {
    if (!value) return;
    if (!known.value) known = {value, name, exposure_words(metadata)};
    if (std::abs(*known.value - *value) > kSameExposure * std::abs(*known.value))
      throw sim::unreadable(name, "has another exposure (" + exposure_words(metadata) + ") than " +
                                      known.name + " (" + known.words + ")")
          .expected("frames of one exposure")
          .hint("map the frames of each exposure by themselves; --no-metadata if the files are wrong");
  };
  require(metadata.exposure_s, exposure_s_);
  require(metadata.f_number, f_number_);
  require(metadata.iso, iso_);
}

void FrameCheck::add(const Photo& frame, const sim::PictureMetadata& metadata, double time_s,
                     const std::vector<char>& sky) {
  const sim::Camera& camera = scene_.camera;
  if (frame.linear.width != camera.width || frame.linear.height != camera.height)
    throw sim::unreadable(frame.file_name,
                          "has " + sim::size_text(frame.linear.width, frame.linear.height) + " pixels")
        .expected("those of the camera, " + sim::size_text(camera.width, camera.height));
  require_same_exposure(frame.file_name, metadata);
  watch_.add({frame.file_name, time_s, find_stars(frame.linear, {}, sky)});
}

}  // namespace vegard::fit
