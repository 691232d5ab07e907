#include "fit/report/report_pictures.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "fit/photo/codec/opencv_codecs.h"
#include "fit/photo/grey_light.h"
#include "fit/report/table/report_bins.h"
#include "sim/base/shown_text.h"
#include "sim/view/sensor/tone_curve.h"

namespace vegard::fit {
namespace {

constexpr int kMaxWidth = 720;
constexpr double kMisfitEnd = 4.0;  ///< standard deviations at the ends of the misfit's colours

/// As three channels of float in OpenCV's order, no wider than a report's picture.
cv::Mat shrunk(const sim::Image& image) {
  cv::Mat picture(image.height, image.width, CV_32FC3);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c) picture.at<cv::Vec3f>(y, x)[2 - c] = image.at(x, y, c);
  if (image.width <= kMaxWidth) return picture;
  const int height = std::max(1, static_cast<int>(std::lround(1.0 * image.height * kMaxWidth / image.width)));
  cv::Mat small;
  cv::resize(picture, small, cv::Size(kMaxWidth, height), 0, 0, cv::INTER_AREA);
  return small;
}

template <typename Code>
cv::Mat to_bytes(const cv::Mat& picture, const Code& code) {
  cv::Mat bytes(picture.size(), CV_8UC3);
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x)
      for (int c = 0; c < 3; ++c)
        bytes.at<cv::Vec3b>(y, x)[c] = static_cast<unsigned char>(
            std::lround(255.0 * std::clamp<double>(code(picture.at<cv::Vec3f>(y, x)[c]), 0.0, 1.0)));
  return bytes;
}

std::string png_uri(const cv::Mat& bytes) {
  // The densest, 9, would be a sixth smaller, and take as long as the fit.
  constexpr int kLevel = 4;
  return "data:image/png;base64," + sim::base64(encoded_png(bytes, kLevel));
}

/// The value below which this share of them lies; 0 for none.
double quantile_of_copy(std::vector<float> values, double share) {
  if (values.empty()) return 0.0;
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

std::vector<float> sizes_inside(const sim::Image& image, const Region& region) {
  std::vector<float> sizes;
  for (int y = region.y; y < region.y + region.height; ++y)
    for (int x = region.x; x < region.x + region.width; ++x)
      for (int c = 0; c < 3; ++c)
        if (std::isfinite(image.at(x, y, c))) sizes.push_back(std::abs(image.at(x, y, c)));
  return sizes;
}

/// The same of a grid's bins, which may be a small part of the region.
std::vector<float> sizes_in_bins(const sim::Image& image, const BinGrid& grid) {
  std::vector<float> sizes;
  for (const BinGrid::Run& run : grid.runs)
    for (int x = run.begin; x < run.end; ++x)
      for (int c = 0; c < 3; ++c)
        if (std::isfinite(image.at(x, run.y, c))) sizes.push_back(std::abs(image.at(x, run.y, c)));
  return sizes;
}

/// 1 for a picture that fills its range as photographs do; a file of floats has no range, and a very dark
/// picture would show nothing.
double brightness_for(const Photo& photo) {
  constexpr double kPictureDark = 0.1, kShown = 0.6;
  const double bright =
      quantile_of_copy(sizes_inside(photo.linear, {0, 0, photo.linear.width, photo.linear.height}), 0.995);
  if (!(bright > 0.0) || (!photo.floating && bright > kPictureDark)) return 1.0;
  return kShown / bright;
}

/// What no channel of was used, as after a mask.
sim::Image with_unused_dimmed(const Photo& photo) {
  constexpr float kDim = 0.25f;
  sim::Image image = photo.linear;
  for (std::size_t i = 0; i + 2 < image.data.size() && i + 2 < photo.usable.size(); i += 3)
    if (!photo.usable[i] && !photo.usable[i + 1] && !photo.usable[i + 2] && !photo.mask_name.empty())
      for (std::size_t c = 0; c < 3; ++c) image.data[i + c] *= kDim;
  return image;
}

/// What the report shows of a picture: all of it, or, where the region is a small part, the region with as
/// much again around it.
Region shown_part(const Region& region, int width, int height) {
  constexpr double kSmallPart = 0.4;
  if (1.0 * region.width * region.height > kSmallPart * width * height) return {0, 0, width, height};
  const int left = std::max(0, region.x - region.width / 2), top = std::max(0, region.y - region.height / 2);
  const int right = std::min(width, region.x + region.width + region.width / 2);
  const int bottom = std::min(height, region.y + region.height + region.height / 2);
  return {left, top, right - left, bottom - top};
}

sim::Image cropped(const sim::Image& image, const Region& part) {
  sim::Image result(part.width, part.height, image.channel_names);
  for (int y = 0; y < part.height; ++y)
    for (int x = 0; x < part.width; ++x)
      for (int c = 0; c < image.channels(); ++c) result.at(x, y, c) = image.at(part.x + x, part.y + y, c);
  return result;
}

/// Outside the region nothing was fitted, and a sky continued beyond it means nothing: 0 there.
sim::Image only_inside(sim::Image image, const Region& region) {
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (x < region.x || x >= region.x + region.width || y < region.y || y >= region.y + region.height)
        for (int c = 0; c < image.channels(); ++c) image.at(x, y, c) = 0.0f;
  return image;
}

/// A line that is seen on dark and on bright ground.
void mark(cv::Mat& picture, cv::Rect box, double opacity) {
  box &= cv::Rect(0, 0, picture.cols, picture.rows);
  if (box.empty()) return;
  cv::Mat part = picture(box);
  cv::Mat(part.mul(cv::Scalar::all(1.0), 1.0 - opacity) + cv::Scalar(90, 220, 255) * opacity).copyTo(part);
}

void draw_region(cv::Mat& picture, const Profile& data, const Region& part, double scale) {
  const Region region{data.region.x - part.x, data.region.y - part.y, data.region.width, data.region.height};
  const auto place = [&](int px) { return static_cast<int>(std::lround(px * scale)); };
  const int left = place(region.x), right = std::min(place(region.x + region.width), picture.cols) - 1;
  const int top = place(region.y), bottom = std::min(place(region.y + region.height), picture.rows) - 1;
  for (int band = 1; band < data.bands; ++band)
    mark(picture, {place(band_begin(region, data.bands, band)), top, 1, bottom - top + 1}, 0.28);
  for (const cv::Rect& edge :
       {cv::Rect(left, top, right - left + 1, 2), cv::Rect(left, bottom - 1, right - left + 1, 2),
        cv::Rect(left, top + 2, 2, bottom - top - 3), cv::Rect(right - 1, top + 2, 2, bottom - top - 3)})
    mark(picture, edge, 0.85);
}

/// A band's number in its middle, on a dark ground of its own.
void write_number(cv::Mat& picture, const cv::Mat& band, int which, double scale) {
  double x = 0.0, y = 0.0, count = 0.0;
  for (int j = 0; j < band.rows; ++j)
    for (int i = 0; i < band.cols; ++i)
      if (band.at<int>(j, i) == which) {
        x += i + 0.5;
        y += j + 0.5;
        count += 1.0;
      }
  if (count == 0.0) return;
  const std::string number = std::to_string(which);
  constexpr int kPictureFont = cv::FONT_HERSHEY_SIMPLEX;
  constexpr double kSize = 0.5;
  int below = 0;
  const cv::Size size = cv::getTextSize(number, kPictureFont, kSize, 1, &below);
  const auto inside = [](double place, int length, int room) {
    return std::clamp(static_cast<int>(std::lround(place - 0.5 * length)), 1, std::max(1, room - length - 1));
  };
  const int left = inside(scale * x / count, size.width, picture.cols),
            top = inside(scale * y / count, size.height, picture.rows);
  const cv::Point corner(left, top + size.height);
  cv::putText(picture, number, corner, kPictureFont, kSize, cv::Scalar(0, 0, 0), 4, cv::LINE_AA);
  cv::putText(picture, number, corner, kPictureFont, kSize, cv::Scalar(90, 220, 255), 1, cv::LINE_AA);
}

/// Borders of bands of any form, where neighbouring pixels of the picture are not in the same; and the first
/// band's number and the last one's, so that one knows from where they are counted.
void draw_bands(cv::Mat& picture, const BinGrid& grid, const Region& part, double scale) {
  constexpr int kNone = -1;
  cv::Mat band(part.height, part.width, CV_32S, cv::Scalar(kNone));
  for (std::size_t bin = 0; bin < grid.bins(); ++bin)
    for (std::size_t r = grid.first_run[bin]; r < grid.first_run[bin + 1]; ++r)
      for (int x = grid.runs[r].begin; x < grid.runs[r].end; ++x)
        band.at<int>(grid.runs[r].y - part.y, x - part.x) = grid.band[bin];
  const auto band_at = [&](int x, int y) {
    const int from_x = static_cast<int>((x + 0.5) / scale), from_y = static_cast<int>((y + 0.5) / scale);
    return from_x < part.width && from_y < part.height ? band.at<int>(from_y, from_x) : kNone;
  };
  for (int y = 0; y + 1 < picture.rows; ++y)
    for (int x = 0; x + 1 < picture.cols; ++x) {
      const int here = band_at(x, y), right = band_at(x + 1, y), below = band_at(x, y + 1);
      if (here == right && here == below) continue;
      mark(picture, {x, y, 1, 1}, here == kNone || right == kNone || below == kNone ? 0.85 : 0.45);
    }
  write_number(picture, band, 0, scale);
  if (grid.groups > 1) write_number(picture, band, grid.groups - 1, scale);
}

/// White at 0, red above (more light in the photograph), blue below; after ColorBrewer's RdBu, which the
/// colour-blind can tell apart.
cv::Vec3b misfit_colour(double sigmas) {
  if (!std::isfinite(sigmas)) return {225, 225, 225};
  static const double kRed[3] = {178, 24, 43}, kBlue[3] = {33, 102, 172};
  const double t = std::min(1.0, std::abs(sigmas) / kMisfitEnd);
  cv::Vec3b colour;
  for (int c = 0; c < 3; ++c)
    colour[2 - c] =
        static_cast<unsigned char>(std::lround(255.0 + t * ((sigmas > 0 ? kRed : kBlue)[c] - 255.0)));
  return colour;
}

std::string misfit_uri(const FittedPhoto& fitted) {
  constexpr int kHeight = 240, kGap = 12;
  const bool grey = is_grey(fitted.best);  // one panel over the whole width
  const int panels = grey ? 1 : 3, width = grey ? 3 * 232 + 2 * kGap : 232;
  const Profile& data = fitted.data;
  if (data.rows == 0 || data.bands == 0 || fitted.model.size() != data.mean.size() ||
      fitted.sigma.size() != data.mean.size())
    return {};
  cv::Mat picture(kHeight, panels * width + (panels - 1) * kGap, CV_8UC3, cv::Scalar::all(255));
  for (int panel = 0; panel < panels; ++panel) {
    const int c = grey ? kGreyChannel : panel;
    cv::Mat cells(data.rows, data.bands, CV_32F);
    for (int row = 0; row < data.rows; ++row)
      for (int band = 0; band < data.bands; ++band) {
        const std::size_t i = data.index(band, row, c);
        cells.at<float>(row, band) =
            fitted.sigma[i] > 0.0 ? static_cast<float>((data.mean[i] - fitted.model[i]) / fitted.sigma[i])
                                  : NAN;
      }
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < width; ++x)
        picture.at<cv::Vec3b>(y, panel * (width + kGap) + x) =
            misfit_colour(cells.at<float>(y * data.rows / kHeight, x * data.bands / width));
  }
  return png_uri(picture);
}

}  // namespace

ReportPictures report_pictures(const FittedPhoto& fitted, const Photo& photo, const ModelPicture& model) {
  ReportPictures pictures;
  pictures.brightness = brightness_for(photo);
  const auto for_the_eye = [&](float light) {
    return sim::srgb_encode(std::clamp(pictures.brightness * light, 0.0, 1.0));
  };
  const Region& region = fitted.data.region;
  const Region part = shown_part(region, photo.linear.width, photo.linear.height);
  const auto shrunk_part = [&](const sim::Image& image) { return shrunk(cropped(image, part)); };
  cv::Mat shown = to_bytes(shrunk_part(with_unused_dimmed(photo)), for_the_eye);
  const double scale = static_cast<double>(shown.cols) / part.width;
  if (has_named_axes(fitted.data))
    draw_bands(shown, *fitted.data.grid, part, scale);
  else
    draw_region(shown, fitted.data, part, scale);
  pictures.photo = png_uri(shown);
  pictures.model = png_uri(to_bytes(shrunk_part(only_inside(model.rgb, region)), for_the_eye));

  const double size =
      quantile_of_copy(has_named_axes(fitted.data) ? sizes_in_bins(model.residual, *fitted.data.grid)
                                                   : sizes_inside(model.residual, region),
                       0.99);
  // One significant digit: a scale that one can read.
  const double unit = size > 0.0 ? std::pow(10.0, std::floor(std::log10(size))) : 1.0;
  pictures.residual_scale = size > 0.0 ? std::ceil(size / unit) * unit : 1.0;
  pictures.residual = png_uri(to_bytes(shrunk_part(only_inside(model.residual, region)), [&](float light) {
    return 0.5 + 0.5 * light / pictures.residual_scale;
  }));
  pictures.misfit = misfit_uri(fitted);
  return pictures;
}

}  // namespace vegard::fit
