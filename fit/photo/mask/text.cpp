#include "fit/photo/mask/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "fit/photo/mask/plane.h"
#include "sim/base/number/quantile.h"

namespace vegard::fit {
namespace {

constexpr int kTextLongestSide_px = 1500;
constexpr int kStroke_px = 7;
constexpr int kLowest_px = 5, kHighest_px = 60;
constexpr double kSharpness = 0.4, kTextGap = 1.2, kColour = 0.15, kContrasts = 0.3, kOnBaseline = 2.0 / 3.0,
                 kFilled = 0.7;
constexpr int kBorder_px = 2;

struct Letter {
  cv::Rect box;
  float contrast;
  double filled;                ///< share of its box that is ink
  std::array<float, 3> colour;  ///< of its brightest strokes
  int bottom() const { return box.y + box.height; }
  int right() const { return box.x + box.width; }
};

cv::Mat mat_of(const Plane& plane) {
  return cv::Mat(plane.height, plane.width, CV_32F, const_cast<float*>(plane.value.data()));
}

/// The largest difference of a pixel of the letter to one beside it.
float steepest(const Plane& shown, const cv::Mat& labels, int label, const cv::Rect& box) {
  float most = 0.0f;
  for (int y = std::max(1, box.y); y < std::min(box.y + box.height, shown.height - 1); ++y)
    for (int x = std::max(1, box.x); x < std::min(box.x + box.width, shown.width - 1); ++x) {
      if (labels.at<int>(y, x) != label) continue;
      const float least =
          std::min({shown.at(x - 1, y), shown.at(x + 1, y), shown.at(x, y - 1), shown.at(x, y + 1)});
      most = std::max(most, shown.at(x, y) - least);
    }
  return most;
}

std::vector<Letter> letters_of(const std::array<Plane, 3>& colours, const Plane& shown, double contrast) {
  cv::Mat opened, strokes;
  const cv::Mat square = cv::Mat::ones(kStroke_px, kStroke_px, CV_8U);
  cv::morphologyEx(mat_of(shown), opened, cv::MORPH_OPEN, square, {-1, -1}, 1, cv::BORDER_REPLICATE);
  cv::subtract(mat_of(shown), opened, strokes);
  cv::Mat labels, boxes, centres;
  const int count = cv::connectedComponentsWithStats(strokes > contrast, labels, boxes, centres, 8, CV_32S);
  std::vector<Letter> letters;
  for (int label = 1; label < count; ++label) {
    const int* box = boxes.ptr<int>(label);
    Letter letter;
    letter.box = {box[cv::CC_STAT_LEFT], box[cv::CC_STAT_TOP], box[cv::CC_STAT_WIDTH],
                  box[cv::CC_STAT_HEIGHT]};
    if (letter.box.height < kLowest_px || letter.box.height > kHighest_px ||
        letter.box.width > 8 * letter.box.height)
      continue;
    letter.filled = static_cast<double>(box[cv::CC_STAT_AREA]) / letter.box.area();
    std::vector<float> stands;
    for (int y = letter.box.y; y < letter.bottom(); ++y)
      for (int x = letter.box.x; x < letter.right(); ++x)
        if (labels.at<int>(y, x) == label) stands.push_back(strokes.at<float>(y, x));
    letter.contrast = sim::quantile(stands, 0.8);
    if (steepest(shown, labels, label, letter.box) < kSharpness * letter.contrast) continue;
    std::array<double, 3> sum{};
    int pixels = 0;
    for (int y = letter.box.y; y < letter.bottom(); ++y)
      for (int x = letter.box.x; x < letter.right(); ++x)
        if (labels.at<int>(y, x) == label && strokes.at<float>(y, x) >= letter.contrast) {
          for (int c = 0; c < 3; ++c) sum[c] += colours[c].at(x, y);
          ++pixels;
        }
    for (int c = 0; c < 3; ++c) letter.colour[c] = static_cast<float>(sum[c] / pixels);
    letters.push_back(letter);
  }
  std::stable_sort(letters.begin(), letters.end(), [](const Letter& a, const Letter& b) {
    return a.box.x != b.box.x ? a.box.x < b.box.x : a.box.y < b.box.y;
  });
  return letters;
}

bool alike(const Letter& a, const Letter& b) {
  const int low = std::min(a.box.height, b.box.height), high = std::max(a.box.height, b.box.height);
  const int overlap = std::min(a.bottom(), b.bottom()) - std::max(a.box.y, b.box.y);
  if (high > 2 * low || 2 * overlap < low) return false;
  for (int c = 0; c < 3; ++c)
    if (std::abs(a.colour[c] - b.colour[c]) > kColour) return false;
  return std::min(a.contrast, b.contrast) >= (1.0 - kContrasts) * std::max(a.contrast, b.contrast);
}

bool is_line(const std::vector<Letter>& line, int fewest) {
  if (static_cast<int>(line.size()) < fewest) return false;
  const auto strokes =
      std::count_if(line.begin(), line.end(), [](const Letter& letter) { return letter.filled < kFilled; });
  if (2 * static_cast<std::size_t>(strokes) < line.size()) return false;
  std::vector<float> bottoms, heights;
  for (const Letter& letter : line) {
    bottoms.push_back(static_cast<float>(letter.bottom()));
    heights.push_back(static_cast<float>(letter.box.height));
  }
  const float tolerance = std::max(1.0f, 0.1f * sim::median(heights)), baseline = sim::median(bottoms);
  const auto on = std::count_if(bottoms.begin(), bottoms.end(),
                                [&](float bottom) { return std::abs(bottom - baseline) <= tolerance; });
  return static_cast<double>(on) >= kOnBaseline * static_cast<double>(line.size());
}

TextLine boxed(const std::vector<Letter>& line, int factor) {
  cv::Rect box = line.front().box;
  for (const Letter& letter : line) box |= letter.box;
  return {factor * (box.x - kBorder_px), factor * (box.y - kBorder_px), factor * (box.width + 2 * kBorder_px),
          factor * (box.height + 2 * kBorder_px), static_cast<int>(line.size())};
}

}  // namespace

std::vector<TextLine> find_text(const Photo& photo, const TextSettings& settings) {
  const int longest = std::max(photo.linear.width, photo.linear.height);
  const int factor = (longest + kTextLongestSide_px - 1) / kTextLongestSide_px;
  std::array<Plane, 3> colours;
  for (int c = 0; c < 3; ++c) colours[c] = shown_brightness(binned(channel_light(photo, c), factor));
  const Plane shown = shown_brightness(binned(mean_light(photo), factor));
  if (shown.width < kStroke_px || shown.height < kStroke_px) return {};
  const std::vector<Letter> letters = letters_of(colours, shown, settings.contrast);

  std::vector<TextLine> lines;
  std::vector<char> taken(letters.size(), 0);
  for (std::size_t first = 0; first < letters.size(); ++first) {
    if (taken[first]) continue;
    std::vector<std::size_t> chain = {first};
    for (std::size_t next = first + 1; next < letters.size(); ++next) {
      const Letter& last = letters[chain.back()];
      const double reach = last.right() + kTextGap * std::max(last.box.height, letters[first].box.height);
      if (letters[next].box.x > reach) break;
      if (!taken[next] && letters[next].right() > last.right() && alike(last, letters[next]))
        chain.push_back(next);
    }
    std::vector<Letter> line;
    for (const std::size_t i : chain) line.push_back(letters[i]);
    if (!is_line(line, settings.letters)) continue;
    for (const std::size_t i : chain) taken[i] = 1;
    lines.push_back(boxed(line, factor));
  }
  return lines;
}

PixelSet boxes(const std::vector<TextLine>& lines, int width, int height) {
  PixelSet set(width, height);
  for (const TextLine& line : lines)
    for (int y = std::max(0, line.y_px); y < std::min(height, line.y_px + line.height_px); ++y)
      for (int x = std::max(0, line.x_px); x < std::min(width, line.x_px + line.width_px); ++x)
        set.at(x, y) = 1;
  return set;
}

}  // namespace vegard::fit
