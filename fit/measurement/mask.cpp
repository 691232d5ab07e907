#include "fit/measurement/mask.h"

#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include "fit/photo/mask/polygon.h"
#include "fit/photo/mask/text.h"

namespace vegard::fit {
namespace {

/// Adds to the parts and notes of one photograph.
class MaskFinder {
 public:
  MaskFinder(const Photo& photo, const MaskRequest& request, const Tell& tell)
      : photo_(photo),
        request_(request),
        tell_(tell),
        width_(photo.linear.width),
        height_(photo.linear.height) {}

  Mask found() {
    result_.photo = photo_.file_name;
    result_.decoding = photo_.decoding;
    const std::string work = "masking";
    drawn();
    polygons();
    tell_.progress(work, 0.1);
    if (request_.finds_circle || request_.circle) circle();
    if (request_.finds_skyline || !request_.horizon.empty()) horizon();
    tell_.progress(work, 0.5);
    if (request_.text) text();
    tell_.progress(work, 0.7);
    if (request_.saturated)
      part("saturated", "red", {255, 0, 0}, saturated_pixels(photo_, request_.saturation));
    if (request_.hot) part("hot or dead", "white", {255, 255, 255}, hot_pixels(photo_, request_.hot_pixels));
    if (request_.stars) stars();
    result_.left_out = left_out(result_.parts, width_, height_);
    tell_.progress(work, 1.0);
    if (result_.used_px() == 0) throw nothing_left();
    return std::move(result_);
  }

 private:
  struct Tint {
    unsigned char red, green, blue;
  };

  void part(const std::string& name, const std::string& colour, const Tint& tint, PixelSet out) {
    result_.parts.push_back({name, colour, {tint.red, tint.green, tint.blue}, std::move(out)});
  }
  void note(const std::string& words) { result_.notes.push_back(words); }

  sim::Error nothing_left() const {
    std::string whose;
    for (const MaskPart& part : result_.parts)
      if (part.out.count() == part.out.in.size()) whose = part.name;
    return usage_error("mask", "it leaves no pixel of " + photo_.file_name,
                       "some of the photograph to be used",
                       whose.empty() ? "leave out one of the finders" : "look at '" + whose + "'");
  }

  void drawn() {
    if (request_.drawn.empty()) return;
    PixelSet out(width_, height_);
    for (const std::string& file : request_.drawn) add(out, drawn_out(photo_, file));
    part("drawn", "grey", {128, 128, 128}, std::move(out));
  }

  void polygons() {
    if (request_.polygons.empty()) return;
    PixelSet out(width_, height_);
    for (const std::vector<PicturePoint>& corners : request_.polygons)
      add(out, polygon_inside(corners, width_, height_));
    part("polygon", "orange", {255, 140, 0}, std::move(out));
  }

  void circle() {
    if (request_.finds_circle) {
      result_.circle = find_circle(photo_);
      if (!result_.circle)
        throw usage_error("--circle", "no circle is found in " + photo_.file_name,
                          "a fisheye's picture in a dark frame", "give it by hand: --circle X,Y,RADIUS");
      note(words_of(*result_.circle));
    }
    part("circle", "blue", {40, 80, 255},
         outside_of(result_.circle ? result_.circle->circle : *request_.circle, width_, height_,
                    request_.circle_margin_px));
  }

  void horizon() {
    if (request_.finds_skyline) {
      result_.skyline = find_horizon(photo_);
      if (!result_.skyline)
        throw usage_error("--horizon", "no skyline is found in " + photo_.file_name,
                          "a dark ground below a brighter sky", "give it by hand: --horizon X,Y X,Y ...");
      result_.horizon = result_.skyline->horizon;
      note(words_of(*result_.skyline));
    } else {
      result_.horizon = drawn_horizon(request_.horizon, width_, "--horizon");
    }
    part("horizon", "brown", {150, 75, 0}, below(*result_.horizon, height_, request_.horizon_margin_px));
  }

  void text() {
    const std::vector<TextLine> lines = find_text(photo_);
    for (const TextLine& line : lines)
      note(fmt::format("text: {} letters in the box {},{},{},{} (x, y, width, height)", line.letters,
                       line.x_px, line.y_px, line.width_px, line.height_px));
    if (lines.empty()) note("text: none");
    part("text", "magenta", {255, 0, 255}, boxes(lines, width_, height_));
  }

  void stars() {
    StarsFound found = find_stars(photo_, request_.star);
    note(fmt::format("stars: {}, at most {} px wide", found.stars.size(), found.size_px));
    part("stars", "yellow", {255, 230, 0}, std::move(found.covered));
  }

  const Photo& photo_;
  const MaskRequest& request_;
  const Tell& tell_;
  const int width_, height_;
  Mask result_;
};

/// How many pixels each part leaves out, and how many of them no part before it does.
struct PartShare {
  std::size_t left_out_px = 0, first_by_it_px = 0;
};

std::vector<PartShare> shares_of(const Mask& mask) {
  std::vector<PartShare> shares;
  PixelSet before(mask.left_out.width, mask.left_out.height);
  for (const MaskPart& part : mask.parts) {
    const std::size_t earlier = before.count();
    add(before, part.out);
    shares.push_back({part.out.count(), before.count() - earlier});
  }
  return shares;
}

}  // namespace

bool MaskRequest::empty() const {
  return drawn.empty() && polygons.empty() && !finds_circle && !circle && !finds_skyline && horizon.empty() &&
         !text && !saturated && !hot && !stars;
}

Mask make_mask(const Photo& photo, const MaskRequest& request, const Tell& tell) {
  return MaskFinder(photo, request, tell).found();
}

std::string words_of(const CircleFound& found) {
  const Circle& circle = found.circle;
  return fmt::format(
      "circle: centre {:.1f}, {:.1f}, radius {:.1f} px; {:.0f} % of the rays agree, rms {:.2f} px",
      circle.x_px, circle.y_px, circle.radius_px, 100.0 * found.agreeing, found.rms_px);
}

std::string words_of(const HorizonFound& found) {
  return fmt::format("horizon: contrast {:.2f} in the middle, seen in {:.0f} % of the columns",
                     found.contrast, 100.0 * found.seen);
}

void tell_mask(const Mask& mask, bool has_colours, const Tell& tell) {
  const auto all = static_cast<double>(mask.left_out.in.size());
  const auto tell_share = [&](const std::string& name, std::size_t pixels, const std::string& more) {
    tell(fmt::format("{:<12} {:>10} px {:>7.3f} %{}", name, pixels, 100.0 * static_cast<double>(pixels) / all,
                     more));
  };
  tell(fmt::format("{}: {} x {} pixels, decoding: {}", mask.photo, mask.left_out.width, mask.left_out.height,
                   mask.decoding));
  for (const std::string& note : mask.notes) tell(note);
  const std::vector<PartShare> shares = shares_of(mask);
  for (std::size_t i = 0; i < shares.size(); ++i)
    tell_share(mask.parts[i].name, shares[i].left_out_px,
               fmt::format("; {} px by it first", shares[i].first_by_it_px) +
                   (has_colours ? ", " + mask.parts[i].colour_name : ""));
  tell_share("left out", mask.left_out.count(), "");
  tell_share("used", mask.used_px(), "");
}

nlohmann::ordered_json mask_json(const Mask& mask) {
  nlohmann::ordered_json parts = nlohmann::ordered_json::array();
  const std::vector<PartShare> shares = shares_of(mask);
  for (std::size_t i = 0; i < shares.size(); ++i)
    parts.push_back({{"name", mask.parts[i].name},
                     {"left_out_px", shares[i].left_out_px},
                     {"first_by_it_px", shares[i].first_by_it_px}});
  return {{"photo", mask.photo},
          {"width_px", mask.left_out.width},
          {"height_px", mask.left_out.height},
          {"decoding", mask.decoding},
          {"parts", parts},
          {"left_out_px", mask.left_out.count()},
          {"used_px", mask.used_px()},
          {"notes", mask.notes}};
}

}  // namespace vegard::fit
