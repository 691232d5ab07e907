#include "fit/report/calibration_plots.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "fit/photo/codec/opencv_codecs.h"
#include "sim/base/number/constants.h"

namespace vegard::fit {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// 1, 2 or 5 times a power of ten, not above.
double round_factor(double factor) {
  const double power = std::pow(10.0, std::floor(std::log10(factor)));
  const double first = factor / power;
  return power * (first >= 5.0 ? 5.0 : first >= 2.0 ? 2.0 : 1.0);
}

struct Ink {
  Colour used = distinct_colour(0), left_out = distinct_colour(3);
};

Panel arrows(const Calibration& calibration, double factor) {
  Panel panel;
  panel.title = "observed minus computed";
  panel.x.label = "x (px)";
  panel.x.min = 0.0;
  panel.x.max = calibration.frame.width_px;
  panel.y.label = "y (px)";
  panel.y.min = 0.0;
  panel.y.max = calibration.frame.height_px;
  panel.y.reversed = true;
  const Ink ink;
  for (const bool used : {true, false}) {
    Series lines, dots;
    lines.colour = dots.colour = used ? ink.used : ink.left_out;
    lines.label = used ? "used" : "left out";
    lines.width_px = 1.8;
    dots.mark = Mark::points;
    dots.width_px = 4.0;
    for (std::size_t i = 0; i < calibration.stars.size(); ++i) {
      const StarResidual& one = calibration.residuals[i];
      if (one.used != used || !std::isfinite(one.dx_px)) continue;
      const double x = calibration.stars[i].x_px, y = calibration.stars[i].y_px;
      dots.x.push_back(x);
      dots.y.push_back(y);
      lines.x.insert(lines.x.end(), {x, x + factor * one.dx_px, kNone});
      lines.y.insert(lines.y.end(), {y, y + factor * one.dy_px, kNone});
    }
    if (dots.x.empty()) continue;
    panel.series.push_back(lines);
    panel.series.push_back(dots);
  }
  return panel;
}

Panel by_radius(const Calibration& calibration) {
  Panel panel;
  panel.title = "by distance from the lens's centre";
  panel.x.label = "distance (px)";
  panel.y.label = "residual (px)";
  Series along, across;
  along.label = "along the radius";
  across.label = "across it";
  along.colour = distinct_colour(1);
  across.colour = distinct_colour(2);
  along.mark = across.mark = Mark::points;
  along.width_px = across.width_px = 5.0;
  for (std::size_t i = 0; i < calibration.stars.size(); ++i) {
    const StarResidual& one = calibration.residuals[i];
    if (!one.used || !(one.from_centre_px > 0.0)) continue;
    const double x =
        (calibration.stars[i].x_px - calibration.camera.numbers[centre_x_number]) / one.from_centre_px;
    const double y =
        (calibration.stars[i].y_px - calibration.camera.numbers[centre_y_number]) / one.from_centre_px;
    for (Series* series : {&along, &across}) series->x.push_back(one.from_centre_px);
    along.y.push_back(one.dx_px * x + one.dy_px * y);
    across.y.push_back(one.dy_px * x - one.dx_px * y);
  }
  Series zero;
  zero.colour = {120, 120, 120};
  zero.mark = Mark::dashed_line;
  zero.width_px = 1.0;
  if (!along.x.empty()) zero.x = {0.0, *std::max_element(along.x.begin(), along.x.end())};
  zero.y.assign(zero.x.size(), 0.0);
  panel.series = {zero, along, across};
  return panel;
}

constexpr int kOverlayShift = 4;  // fractional bits of OpenCV's coordinates
constexpr int kOverlayMaxPixels = 4000;

double srgb(double linear) {
  linear = std::clamp(linear, 0.0, 1.0);
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

/// Twice as large, where that is not too much.
cv::Mat display(const Photo& photo, int& scale) {
  const sim::Image& image = photo.linear;
  cv::Mat picture(image.height, image.width, CV_8UC3);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c)
        picture.at<cv::Vec3b>(y, x)[c] = static_cast<unsigned char>(
            std::lround(255.0 * srgb(image.at(x, y, std::min(2 - c, image.channels() - 1)))));
  scale = std::max(image.width, image.height) * 2 <= kOverlayMaxPixels ? 2 : 1;
  cv::Mat large;
  cv::resize(picture, large, {}, scale, scale, cv::INTER_NEAREST);
  return large;
}

class Overlay {
 public:
  Overlay(const SkyCamera& camera, cv::Mat& picture, int scale)
      : camera_(camera), lens_(true_lens(camera)), picture_(picture), scale_(scale) {}

  void circle_of_elevation(double elevation_deg, const cv::Scalar& colour) {
    const double e = elevation_deg * sim::kRadiansPerDegree;
    bool open = false;
    cv::Point before;
    for (int step = 0; step <= 720; ++step) {
      const double a = 0.5 * step * sim::kRadiansPerDegree;
      double x = 0.0, y = 0.0;
      const bool seen = place({std::sin(a) * std::cos(e), std::cos(a) * std::cos(e), std::sin(e)}, x, y) &&
                        std::abs(x) < 1e4 && std::abs(y) < 1e4;
      const cv::Point here = seen ? point(x, y) : cv::Point();
      // A jump is a line that left the picture at one side.
      if (open && seen && cv::norm(here - before) < (200 << kOverlayShift))
        cv::line(picture_, before, here, colour, 1, cv::LINE_AA, kOverlayShift);
      open = seen;
      before = here;
    }
  }

  void star(const StarSighting& star, bool used) {
    const cv::Scalar colour = used ? cv::Scalar(120, 255, 255) : cv::Scalar(60, 60, 255);
    const cv::Point seen = point(star.x_px, star.y_px);
    const int arm = 3 << kOverlayShift;
    cv::line(picture_, seen - cv::Point(arm, 0), seen + cv::Point(arm, 0), colour, 1, cv::LINE_AA,
             kOverlayShift);
    cv::line(picture_, seen - cv::Point(0, arm), seen + cv::Point(0, arm), colour, 1, cv::LINE_AA,
             kOverlayShift);
    double x = 0.0, y = 0.0;
    if (place(star.enu, x, y))
      cv::circle(picture_, point(x, y), 9 << kOverlayShift, colour, 1, cv::LINE_AA, kOverlayShift);
    cv::putText(picture_, ascii(star.name), whole(star.x_px, star.y_px) + cv::Point(12, 4),
                cv::FONT_HERSHEY_SIMPLEX, 0.36, colour, 1, cv::LINE_AA);
  }

  void cardinal(double azimuth_deg, const char* letter) {
    const double a = azimuth_deg * sim::kRadiansPerDegree;
    double x = 0.0, y = 0.0;
    if (!place({std::sin(a), std::cos(a), 0.0}, x, y) || std::abs(x) > 1e4 || std::abs(y) > 1e4) return;
    cv::putText(picture_, letter, whole(x, y) - cv::Point(6, -6), cv::FONT_HERSHEY_SIMPLEX, 0.6,
                {120, 200, 120}, 2, cv::LINE_AA);
  }

 private:
  bool place(const std::array<double, 3>& enu, double& x, double& y) const {
    const Eigen::Vector3d v = camera_.camera_from_enu * Eigen::Vector3d(enu[0], enu[1], enu[2]);
    const double in_camera[3] = {v[0], v[1], v[2]};
    return sim::project(lens_, in_camera, x, y);
  }

  /// OpenCV has the centre of the first pixel at 0.
  cv::Point point(double x, double y) const {
    return {static_cast<int>(std::lround((x * scale_ - 0.5) * (1 << kOverlayShift))),
            static_cast<int>(std::lround((y * scale_ - 0.5) * (1 << kOverlayShift)))};
  }
  cv::Point whole(double x, double y) const {
    return {static_cast<int>(std::lround(x * scale_)), static_cast<int>(std::lround(y * scale_))};
  }
  static std::string ascii(const std::string& words) {
    std::string out;
    for (const char c : words) out += static_cast<unsigned char>(c) < 0x80 ? c : '?';
    return out;
  }

  const SkyCamera& camera_;
  sim::Lens<double> lens_;
  cv::Mat& picture_;
  int scale_;
};

}  // namespace

Plot residual_plot(const Calibration& calibration) {
  const double extent = std::max(calibration.frame.width_px, calibration.frame.height_px);
  const double factor = round_factor(0.06 * extent / std::max(calibration.rms_px, 1e-6));
  Plot plot;
  const bool stars = calibration.evidence == CalibrationEvidence::stars;
  plot.title =
      (stars ? "Stars, observed minus computed, " : "Maps minus camera, ") + words_of(calibration.form);
  char note[200];
  if (stars)
    std::snprintf(note, sizeof note,
                  "%d of %d stars, rms %.3f px, each by a fit without it %.3f px; arrows %g times too long",
                  calibration.used(), static_cast<int>(calibration.stars.size()), calibration.rms_px,
                  calibration.without_rms_px, factor);
  else
    std::snprintf(note, sizeof note, "%d of %d points, rms %.3g px; arrows %g times too long",
                  calibration.used(), static_cast<int>(calibration.stars.size()), calibration.rms_px, factor);
  plot.note = note;
  plot.panels = {arrows(calibration, factor), by_radius(calibration)};
  plot.panel_height_px = 360;
  return plot;
}

std::string star_overlay(const Calibration& calibration, const Photo& photo) {
  int scale = 1;
  cv::Mat picture = display(photo, scale);
  Overlay overlay(calibration.camera, picture, scale);
  for (const double elevation_deg : {0.0, 30.0, 60.0})
    overlay.circle_of_elevation(elevation_deg, {120, 160, 90});
  overlay.cardinal(0.0, "N");
  overlay.cardinal(90.0, "E");
  overlay.cardinal(180.0, "S");
  overlay.cardinal(270.0, "W");
  for (std::size_t i = 0; i < calibration.stars.size(); ++i)
    overlay.star(calibration.stars[i], calibration.residuals[i].used);
  return encoded_png(picture);
}

std::string star_overlay(const StarRecognition& recognition, const Photo& photo) {
  int scale = 1;
  cv::Mat picture = display(photo, scale);
  Overlay overlay(recognition.best.camera, picture, scale);
  for (const double declination_deg : {-60.0, -30.0, 0.0, 30.0, 60.0})
    overlay.circle_of_elevation(declination_deg, {160, 120, 90});
  for (const StarSighting& star : recognition.stars()) overlay.star(star, true);
  return encoded_png(picture);
}

}  // namespace vegard::fit
