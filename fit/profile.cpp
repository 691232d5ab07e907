#include "fit/profile.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <string>

#include "sim/base/error.h"

namespace vegard::fit {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr int kRowsEachSide = 7;  ///< of the pool: 15 rows of 30 pixels give the noise to 4 %

[[noreturn]] void refuse(const std::string& key, const std::string& problem, const std::string& expected) {
  sim::ErrorDetails details;
  details.key = key;
  details.problem = problem;
  details.expected = expected;
  throw sim::Error(sim::ErrorKind::scene, details);
}

/// A sum of squares and what its expectation is in units of the variance.
struct Scatter {
  double squares = 0.0;
  double freedom = 0.0;
  void add(const Scatter& other) {
    squares += other.squares;
    freedom += other.freedom;
  }
};

/// What one row of one band and channel tells.
struct RowSum {
  int count = 0;
  double mean = kNaN;
  Scatter neighbours;  ///< of differences of neighbours about their mean
  Scatter values;      ///< of the values about their mean: for bands too narrow or too torn for the other
};

RowSum sum_row(const Photo& photo, int y, int begin, int end, int channel) {
  RowSum row;
  double sum = 0.0, squares = 0.0, difference_sum = 0.0;
  int pairs = 0, runs = 0;
  // Squares are taken about the first value: no digits are lost to a bright mean.
  double first = 0.0, previous = 0.0;
  bool previous_usable = false, run_counted = false;
  std::size_t i = photo.linear.index(begin, y, channel);
  for (int x = begin; x < end; ++x, i += 3) {
    if (!photo.usable[i]) {
      previous_usable = false;
      continue;
    }
    const double value = photo.linear.data[i];
    if (row.count == 0) first = value;
    ++row.count;
    sum += value - first;
    squares += (value - first) * (value - first);
    if (previous_usable) {
      const double difference = value - previous;
      difference_sum += difference;
      row.neighbours.squares += difference * difference;
      ++pairs;
      if (!run_counted) ++runs;
      run_counted = true;
    } else {
      run_counted = false;
    }
    previous = value;
    previous_usable = true;
  }
  if (row.count > 0) row.mean = first + sum / row.count;
  if (row.count > 1) {
    row.values.squares = std::max(0.0, squares - sum * sum / row.count);
    row.values.freedom = row.count - 1;
  }
  if (pairs > 0) {
    // For independent noise of variance v a squared difference is 2 v on average; the sum of a run of
    // differences is its last value less its first, 2 v on average when squared, which the mean difference
    // takes with it.
    row.neighbours.squares = std::max(0.0, row.neighbours.squares - difference_sum * difference_sum / pairs);
    row.neighbours.freedom = 2.0 * (pairs - static_cast<double>(runs) / pairs);
  }
  return row;
}

/// The rows of one band and channel into the profile.
void fill(const Photo& photo, int band, int channel, Profile& profile) {
  const Region& region = profile.region;
  const int begin = band_begin(region, profile.bands, band),
            end = band_begin(region, profile.bands, band + 1);
  std::vector<RowSum> rows(profile.rows);
  for (int r = 0; r < profile.rows; ++r) rows[r] = sum_row(photo, region.y + r, begin, end, channel);
  for (int r = 0; r < profile.rows; ++r) {
    const std::size_t i = profile.index(band, r, channel);
    profile.count[i] = rows[r].count;
    profile.mean[i] = rows[r].mean;
    if (rows[r].count < 2) continue;
    Scatter neighbours, values;
    const int last = std::min(profile.rows - 1, r + kRowsEachSide);
    for (int k = std::max(0, r - kRowsEachSide); k <= last; ++k) {
      neighbours.add(rows[k].neighbours);
      values.add(rows[k].values);
    }
    const Scatter& noise = neighbours.freedom > 0.0 ? neighbours : values;
    const double step = code_step(photo, rows[r].mean);
    const double variance = std::max(noise.squares / noise.freedom, step * step / 12.0);
    profile.standard_error[i] = std::sqrt(variance / rows[r].count);
  }
}

}  // namespace

Region checked_region(const std::array<int, 4>& roi_px, int image_width, int image_height) {
  const auto [x, y, width, height] = roi_px;
  if (x == 0 && y == 0 && width == 0 && height == 0) return {0, 0, image_width, image_height};
  const std::string image = std::to_string(image_width) + " x " + std::to_string(image_height);
  const bool inside =
      x >= 0 && y >= 0 && width > 0 && height > 0 && x <= image_width - width && y <= image_height - height;
  if (!inside) {
    std::string text;
    for (const int number : roi_px) text += (text.empty() ? "[" : ", ") + std::to_string(number);
    refuse("fit.roi_px", "the region " + text + "] does not lie inside the image of " + image + " pixels",
           "[x, y, width, height] with x + width at most " + std::to_string(image_width) +
               " and y + height at most " + std::to_string(image_height));
  }
  return {x, y, width, height};
}

int band_begin(const Region& region, int bands, int band) {
  assert(bands > 0 && band >= 0 && band <= bands);
  return region.x + static_cast<int>(static_cast<long long>(region.width) * band / bands);
}

Profile extract_profile(const Photo& photo, const Region& region, int bands) {
  assert(photo.linear.channels() == 3 && photo.usable.size() == photo.linear.data.size());
  assert(region.x >= 0 && region.y >= 0 && region.x + region.width <= photo.linear.width &&
         region.y + region.height <= photo.linear.height);
  if (bands < 1 || bands > region.width)
    refuse("fit.bands", std::to_string(bands) + " bands do not fit into the region",
           "1 to " + std::to_string(region.width) + ", its width in pixels");
  Profile profile;
  profile.region = region;
  profile.bands = bands;
  profile.rows = region.height;
  const std::size_t size = static_cast<std::size_t>(bands) * profile.rows * 3;
  profile.mean.assign(size, kNaN);
  profile.standard_error.assign(size, kNaN);
  profile.count.assign(size, 0);
  for (int band = 0; band < bands; ++band)
    for (int channel = 0; channel < 3; ++channel) fill(photo, band, channel, profile);
  return profile;
}

Chromaticity chromaticity(const Profile& profile, int band, int row) {
  const std::size_t i = profile.index(band, row, 0);
  const double* mean = &profile.mean[i];
  const double* sigma = &profile.standard_error[i];
  const double sum = mean[0] + mean[1] + mean[2];
  if (!(sum > 0.0)) return {kNaN, kNaN, kNaN, kNaN};
  // share_c = v_c / sum: its derivative is (1 - share_c) / sum by v_c and -share_c / sum by each of the
  // others.
  auto sigma_of_share = [&](int c) {
    const double share = mean[c] / sum;
    double variance = 0.0;
    for (int k = 0; k < 3; ++k) {
      const double slope = ((k == c ? 1.0 : 0.0) - share) / sum;
      variance += slope * slope * sigma[k] * sigma[k];
    }
    return std::sqrt(variance);
  };
  return {mean[0] / sum, mean[1] / sum, sigma_of_share(0), sigma_of_share(1)};
}

}  // namespace vegard::fit
