#include "fit/photo/photo_facts.h"

#include <fmt/format.h>

#include "fit/photo/codec/picture_codes.h"
#include "fit/photo/codec/picture_format.h"
#include "fit/photo/frames/picture_bytes.h"
#include "fit/photo/picture_field_of_view.h"
#include "fit/photo/taken_time.h"
#include "sim/base/error.h"
#include "sim/base/file/number_text.h"
#include "sim/base/text.h"

namespace vegard::fit {
namespace {

/// To this many places, without zeros at the end: "62.416271", "1600".
std::string plain(double value, int places) {
  return sim::without_trailing_zeros(fmt::format("{:.{}f}", value, places));
}

/// To six significant digits, the places that a camera's fractions hold.
std::string six_digits(double value) { return fmt::format("{:.6g}", value); }

void add_time(const sim::PictureMetadata& metadata, PhotoFacts& all) {
  const TakenTime taken = taken_time(metadata);
  if (!taken.utc.empty()) all.facts.push_back({"site.time_utc", "\"" + taken.utc + "\"", taken.source});
  all.notes.insert(all.notes.end(), taken.notes.begin(), taken.notes.end());
  if (metadata.taken_local && !metadata.utc_offset && taken.notes.empty())
    all.notes.push_back(metadata.sources.clock + " said " + *metadata.taken_local +
                        ", in a zone that the picture does not name");
}

void add_place(const sim::PictureMetadata& metadata, PhotoFacts& all) {
  if (metadata.latitude_deg && metadata.longitude_deg) {
    // A metre of latitude is 0.000009 degrees.
    all.facts.push_back({"site.latitude_deg", plain(*metadata.latitude_deg, 6), metadata.sources.latitude});
    all.facts.push_back(
        {"site.longitude_deg", plain(*metadata.longitude_deg, 6), metadata.sources.longitude});
  }
  if (metadata.altitude_m)
    all.facts.push_back({"site.altitude_m", plain(*metadata.altitude_m, 2), metadata.sources.altitude});
}

void add_camera(const sim::PictureMetadata& metadata, PhotoFacts& all) {
  if (metadata.width_px && metadata.height_px) {
    const std::string turned =
        metadata.orientation == 1
            ? "the picture's size"
            : "the picture's size, upright by EXIF Orientation " + std::to_string(metadata.orientation);
    all.facts.push_back({"camera.width", std::to_string(*metadata.width_px), turned});
    all.facts.push_back({"camera.height", std::to_string(*metadata.height_px), turned});
  }
  const PictureFieldOfView view = picture_field_of_view(metadata);
  if (view.hfov_deg) {
    std::string source = view.source;
    if (view.rounding_deg) source += ", whose rounding is +-" + plain(*view.rounding_deg, 2) + " deg";
    all.facts.push_back({"camera.hfov_deg", plain(*view.hfov_deg, 4), source});
  } else {
    all.notes.push_back("no field of view: " + view.why_not);
  }
}

void add_exposure(const sim::PictureMetadata& metadata, PhotoFacts& all) {
  if (metadata.f_number)
    all.facts.push_back({"sensor.f_number", six_digits(*metadata.f_number), "EXIF FNumber"});
  if (metadata.iso)
    all.facts.push_back({"sensor.iso", six_digits(*metadata.iso), "EXIF PhotographicSensitivity"});
  if (metadata.exposure_s)
    all.facts.push_back({"time.exposure_s", six_digits(*metadata.exposure_s), metadata.sources.exposure});
}

}  // namespace

PhotoFacts photo_facts(const sim::PictureMetadata& metadata) {
  PhotoFacts all;
  add_place(metadata, all);
  add_time(metadata, all);
  add_camera(metadata, all);
  add_exposure(metadata, all);
  all.notes.insert(all.notes.end(), metadata.contradictions.begin(), metadata.contradictions.end());
  return all;
}

std::string assumed_light(const std::string& photo) {
  try {
    const PictureBytes picture = read_picture_bytes(photo);
    constexpr int kBits = 8;
    const ImageFile image = inspect_image_file(picture.bytes, picture.name);
    if (image.bits <= kBits || image.floating) return {};
    const PictureCodes codes = picture_codes(picture.bytes, picture.name);
    if (!codes.is_light_assumed || codes.declared.counts()) return {};
    return fmt::format("this {} does not say what its numbers are: {} is assumed; --decoding overrides",
                       codes.kind, codes.linear ? "linear light" : "sRGB");
  } catch (const sim::Error&) {
    return {};  // whoever needs its light is told
  }
}

std::string fact_text(const PhotoFact& fact) {
  return fact.path + " = " + fact.value + " (" + fact.source + ")";
}

}  // namespace vegard::fit
