#include "apps/commands/mask_parts.h"

#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "apps/options/refusals.h"
#include "fit/photo/mask/circle.h"
#include "fit/photo/mask/polygon.h"
#include "fit/photo/mask/text.h"

namespace vegard::apps {
namespace {

/// The numbers of "360,237,226", `count` of them. Throws Error(usage) about the option `key`.
std::vector<double> pixel_numbers(const std::string& word, std::size_t count, const std::string& key) {
  std::vector<double> numbers;
  const char* at = word.data();
  const char* const end = word.data() + word.size();
  bool readable = true, more = true;
  while (readable && more) {
    double number = 0.0;
    const auto [stop, error] = std::from_chars(at, end, number);
    readable = error == std::errc{} && std::isfinite(number);
    more = readable && stop != end && *stop == ',';
    at = more ? stop + 1 : stop;
    numbers.push_back(number);
  }
  if (!readable || at != end || numbers.size() != count)
    throw usage_error(key, "'" + word + "' cannot be read",
                      std::to_string(count) + " numbers in pixels with commas between them");
  return numbers;
}

/// Words "x,y". Throws as above.
std::vector<fit::PicturePoint> picture_points(const std::vector<std::string>& words, const std::string& key) {
  std::vector<fit::PicturePoint> points;
  for (const std::string& word : words) {
    const std::vector<double> numbers = pixel_numbers(word, 2, key);
    points.push_back({numbers[0], numbers[1]});
  }
  return points;
}

/// Adds to the parts and notes of one photograph.
class Finder {
 public:
  Finder(const fit::Photo& photo, const MaskRequest& request)
      : photo_(photo), request_(request), width_(photo.linear.width), height_(photo.linear.height) {}

  MaskParts found() {
    drawn();
    polygons();
    if (!request_.circle.empty()) circle();
    if (!request_.horizon.empty()) horizon();
    if (request_.text) text();
    if (request_.saturated)
      part("saturated", "red", {255, 0, 0}, fit::saturated_pixels(photo_, request_.saturation));
    if (request_.hot)
      part("hot or dead", "white", {255, 255, 255}, fit::hot_pixels(photo_, request_.hot_pixels));
    if (request_.stars) stars();
    return std::move(result_);
  }

 private:
  struct Tint {
    unsigned char red, green, blue;
  };

  void part(const std::string& name, const std::string& colour, const Tint& tint, fit::PixelSet out) {
    result_.parts.push_back({name, colour, {tint.red, tint.green, tint.blue}, std::move(out)});
  }
  void note(const std::string& words) { result_.notes.push_back(words); }

  void drawn() {
    if (request_.drawn.empty()) return;
    fit::PixelSet out(width_, height_);
    for (const std::string& file : request_.drawn) fit::add(out, fit::drawn_out(photo_, file));
    part("drawn", "grey", {128, 128, 128}, std::move(out));
  }

  void polygons() {
    if (request_.polygons.empty()) return;
    fit::PixelSet out(width_, height_);
    for (const std::vector<std::string>& words : request_.polygons) {
      if (words.size() < 3)
        throw usage_error("--polygon", "it has " + std::to_string(words.size()) + " corners",
                          "at least three, x,y each");
      fit::add(out, fit::polygon_inside(picture_points(words, "--polygon"), width_, height_));
    }
    part("polygon", "orange", {255, 140, 0}, std::move(out));
  }

  void circle() {
    fit::Circle circle;
    if (request_.circle == "auto") {
      const std::optional<fit::CircleFound> found = fit::find_circle(photo_);
      if (!found)
        throw usage_error("--circle", "no circle is found in " + photo_.file_name,
                          "a fisheye's picture in a dark frame", "give it by hand: --circle X,Y,RADIUS");
      circle = found->circle;
      note(fmt::format(
          "circle: centre {:.1f}, {:.1f}, radius {:.1f} px; {:.0f} % of the rays agree, rms {:.2f} px",
          circle.x_px, circle.y_px, circle.radius_px, 100.0 * found->agreeing, found->rms_px));
    } else {
      const std::vector<double> numbers = pixel_numbers(request_.circle, 3, "--circle");
      circle = {numbers[0], numbers[1], numbers[2]};
      if (!(circle.radius_px > 0.0)) throw usage_error("--circle", "a circle without a radius", "above 0");
    }
    part("circle", "blue", {40, 80, 255},
         fit::outside_of(circle, width_, height_, request_.circle_margin_px));
  }

  void horizon() {
    if (request_.horizon.size() == 1 && request_.horizon[0] == "auto") {
      const std::optional<fit::HorizonFound> found = fit::find_horizon(photo_);
      if (!found)
        throw usage_error("--horizon", "no skyline is found in " + photo_.file_name,
                          "a dark ground below a brighter sky", "give it by hand: --horizon X,Y X,Y ...");
      result_.horizon = found->horizon;
      note(fmt::format("horizon: contrast {:.2f} in the middle, seen in {:.0f} % of the columns",
                       found->contrast, 100.0 * found->seen));
    } else {
      result_.horizon =
          fit::drawn_horizon(picture_points(request_.horizon, "--horizon"), width_, "--horizon");
    }
    part("horizon", "brown", {150, 75, 0}, fit::below(*result_.horizon, height_, request_.horizon_margin_px));
  }

  void text() {
    const std::vector<fit::TextLine> lines = fit::find_text(photo_);
    for (const fit::TextLine& line : lines)
      note(fmt::format("text: {} letters in the box {},{},{},{} (x, y, width, height)", line.letters,
                       line.x_px, line.y_px, line.width_px, line.height_px));
    if (lines.empty()) note("text: none");
    part("text", "magenta", {255, 0, 255}, fit::boxes(lines, width_, height_));
  }

  void stars() {
    fit::StarsFound found = fit::find_stars(photo_, request_.star);
    note(fmt::format("stars: {}, at most {} px wide", found.stars.size(), found.size_px));
    part("stars", "yellow", {255, 230, 0}, std::move(found.covered));
  }

  const fit::Photo& photo_;
  const MaskRequest& request_;
  const int width_, height_;
  MaskParts result_;
};

}  // namespace

bool MaskRequest::empty() const {
  return drawn.empty() && polygons.empty() && circle.empty() && horizon.empty() && !text && !saturated &&
         !hot && !stars;
}

MaskParts mask_parts(const fit::Photo& photo, const MaskRequest& request) {
  return Finder(photo, request).found();
}

}  // namespace vegard::apps
