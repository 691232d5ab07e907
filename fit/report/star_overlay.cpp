#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "fit/report/calibration_plots.h"
#include "sim/base/number/constants.h"

namespace vegard::fit {
namespace {

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
  std::vector<unsigned char> bytes;
  cv::imencode(".png", picture, bytes);
  return {bytes.begin(), bytes.end()};
}

}  // namespace vegard::fit
