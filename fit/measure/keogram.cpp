#include "fit/measure/keogram.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "fit/measure/profile.h"
#include "sim/base/error.h"
#include "sim/base/file/csv_table.h"
#include "sim/base/file/number_text.h"
#include "sim/base/image.h"
#include "sim/base/utc_time.h"

namespace vegard::fit {
namespace {

const char* time_words(PictureTimes::Kind kind) {
  switch (kind) {
    case PictureTimes::Kind::utc:
      return "time: ISO 8601, UTC";
    case PictureTimes::Kind::clock:
      return "time: seconds";
    case PictureTimes::Kind::number:
      break;
  }
  return "time: the picture's number, from 0; when it was taken is not known";
}

/// Key and words of all that is said beside the numbers.
using Say = std::function<void(const std::string& key, const std::string& words)>;
void describe(const Keogram& keogram, const Say& say) {
  const KeogramLine& line = keogram.line;
  const Region& region = line.grid->region;
  say("pictures", std::to_string(keogram.columns.size()));
  say("size_px", sim::size_text(keogram.picture_width_px, keogram.picture_height_px));
  say("decoding", keogram.decoding);
  if (!keogram.mask_name.empty()) {
    say("mask", keogram.mask_name);
    say("mask_sha256", keogram.mask_sha256);
  }
  say("roi_px", fmt::format("[{}, {}, {}, {}]", region.x, region.y, region.width, region.height));
  if (line.of_directions) {
    say("directions", keogram.camera);
    say("azimuth_deg", fmt::format("{}", line.azimuth_deg));
    say("width_deg", fmt::format("{}", line.width));
    say("step_deg", fmt::format("{}", line.step));
  }
  say("times_from", keogram.time_source);
}

}  // namespace

std::string time_text(const Keogram& keogram, double time) {
  return keogram.time_kind == PictureTimes::Kind::utc ? sim::utc_text(time) : fmt::format("{}", time);
}

void add_picture(const Photo& photo, double time, Keogram& keogram) {
  if (keogram.columns.empty()) {
    keogram.picture_width_px = photo.linear.width;
    keogram.picture_height_px = photo.linear.height;
    keogram.decoding = photo.decoding;
    keogram.mask_name = photo.mask_name;
    keogram.mask_sha256 = photo.mask_sha256;
    keogram.floating = photo.floating;
    keogram.srgb = photo.srgb;
  }
  const std::string& first = keogram.columns.empty() ? photo.file_name : keogram.columns.front().file_name;
  if (photo.linear.width != keogram.picture_width_px || photo.linear.height != keogram.picture_height_px)
    throw sim::unreadable(
        photo.file_name,
        "the picture has " + sim::size_text(photo.linear.width, photo.linear.height) + " pixels")
        .expected(sim::size_text(keogram.picture_width_px, keogram.picture_height_px) + ", as " + first);
  if (photo.decoding != keogram.decoding)
    throw sim::unreadable(photo.file_name, "its light is " + photo.decoding)
        .expected(keogram.decoding + ", as that of " + first)
        .hint("pictures of one kind make a keogram");
  if (!keogram.columns.empty() && !(time > keogram.columns.back().time))
    throw sim::Error(sim::ErrorKind::usage, "it has the time " + time_text(keogram, time) + ", which " +
                                                keogram.columns.back().file_name + " has")
        .file(photo.file_name)
        .expected("a time of its own for each picture")
        .hint("--times FILE.csv says when each was taken");
  const Profile profile = extract_profile(photo, keogram.line.grid);
  keogram.columns.push_back(
      {time, photo.file_name, photo.sha256, profile.mean, profile.standard_error, profile.count});
}

std::string keogram_csv(const Keogram& keogram) {
  const KeogramLine& line = keogram.line;
  std::string text = sim::csv_comment("keogram: mean linear light along a line of each picture");
  describe(keogram, [&](const std::string& key, const std::string& words) {
    text += sim::csv_comment(key + ": " + words);
  });
  for (const KeogramColumn& column : keogram.columns)
    text += sim::csv_comment("picture: " + time_text(keogram, column.time) + " " + column.sha256 + " " +
                             column.file_name);
  text += sim::csv_comment(time_words(keogram.time_kind));
  text += sim::csv_comment(
      line.of_directions
          ? "elevation_deg: from the horizon at azimuth_deg over the zenith to the other one, 0 to 180"
          : "row_px: row of the picture, counted from 0 at the top");
  text += sim::csv_comment(keogram.floating
                               ? "r, g, b: linear light in the files' own units"
                               : "r, g, b: linear light, the files' largest value = 1; clipped pixels are "
                                 "left out");
  text +=
      sim::csv_comment("sigma_*: standard error of the mean, from the differences of neighbouring pixels");
  text += sim::csv_comment("n_*: pixels used");
  text += line.of_directions ? "time,elevation_deg" : "time,row_px";
  text += ",r,g,b,sigma_r,sigma_g,sigma_b,n_r,n_g,n_b\n";
  for (const KeogramColumn& column : keogram.columns)
    for (int p = 0; p < keogram.positions(); ++p) {
      text += time_text(keogram, column.time) + "," + sim::csv_number(line.position[p]);
      for (int c = 0; c < 3; ++c) text += "," + sim::csv_number(column.mean[3 * p + c]);
      for (int c = 0; c < 3; ++c) text += "," + sim::csv_number(column.standard_error[3 * p + c]);
      for (int c = 0; c < 3; ++c) text += "," + std::to_string(column.count[3 * p + c]);
      text += '\n';
    }
  return text;
}

sim::Image keogram_image(const Keogram& keogram) {
  sim::Image image(static_cast<int>(keogram.columns.size()), keogram.positions(),
                   {"R", "G", "B", "sigma.R", "sigma.G", "sigma.B"});
  for (int x = 0; x < image.width; ++x)
    for (int y = 0; y < image.height; ++y)
      for (int c = 0; c < 3; ++c) {
        image.at(x, y, c) = static_cast<float>(keogram.columns[x].mean[3 * y + c]);
        image.at(x, y, 3 + c) = static_cast<float>(keogram.columns[x].standard_error[3 * y + c]);
      }
  return image;
}

sim::ImageAttributes keogram_attributes(const Keogram& keogram) {
  sim::ImageAttributes attributes;
  describe(keogram,
           [&](const std::string& key, const std::string& words) { attributes["keogram_" + key] = words; });
  std::string times, positions;
  for (const KeogramColumn& column : keogram.columns)
    times += (times.empty() ? "" : ",") + time_text(keogram, column.time);
  for (const double position : keogram.line.position)
    positions += (positions.empty() ? "" : ",") + fmt::format("{}", position);
  attributes["keogram_time"] = times;
  attributes[keogram.line.of_directions ? "keogram_elevation_deg" : "keogram_row_px"] = positions;
  attributes["units"] =
      "R, G, B are mean linear light along a line of each picture, a column a picture; sigma.* "
      "their standard errors";
  return attributes;
}

}  // namespace vegard::fit
