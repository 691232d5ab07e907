#include "fit/measure/profile.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <string>

#include "fit/measure/profile_bins.h"
#include "fit/photo/grey_light.h"
#include "sim/base/error.h"
#include "sim/base/number/constants.h"
#include "sim/view/film/blur.h"
#include "sim/view/sensor/sensor.h"

namespace vegard::fit {
namespace {

/// A sum of squares and what its expectation is in units of the variance.
struct Scatter {
  double squares = 0.0;
  double freedom = 0.0;
  void add(const Scatter& other) {
    squares += other.squares;
    freedom += other.freedom;
  }
};

/// What one bin measures in one channel.
struct BinSum {
  int count = 0;
  double mean = sim::kNaN;
  Scatter neighbours;  ///< of differences of neighbours about their mean
  Scatter values;      ///< of the values about their mean: for bands too narrow or too torn for the other
};

BinSum sum_bin(const Photo& photo, const BinGrid& grid, std::size_t bin, int channel) {
  BinSum sums;
  double sum = 0.0, squares = 0.0, difference_sum = 0.0;
  int pairs = 0, runs = 0;
  // Squares are taken about the first value: no digits are lost to a bright mean.
  double first = 0.0;
  for (std::size_t r = grid.first_run[bin]; r < grid.first_run[bin + 1]; ++r) {
    const BinGrid::Run& run = grid.runs[r];
    double previous = 0.0;
    bool previous_usable = false, run_counted = false;
    std::size_t i = photo.linear.index(run.begin, run.y, channel);
    for (int x = run.begin; x < run.end; ++x, i += 3) {
      if (!photo.usable[i]) {
        previous_usable = false;
        continue;
      }
      const double value = photo.linear.data[i];
      if (sums.count == 0) first = value;
      ++sums.count;
      sum += value - first;
      squares += (value - first) * (value - first);
      if (previous_usable) {
        const double difference = value - previous;
        difference_sum += difference;
        sums.neighbours.squares += difference * difference;
        ++pairs;
        if (!run_counted) ++runs;
        run_counted = true;
      } else {
        run_counted = false;
      }
      previous = value;
      previous_usable = true;
    }
  }
  if (sums.count > 0) sums.mean = first + sum / sums.count;
  if (sums.count > 1) {
    sums.values.squares = std::max(0.0, squares - sum * sum / sums.count);
    sums.values.freedom = sums.count - 1;
  }
  if (pairs > 0) {
    // For independent noise of variance v a squared difference is 2 v on average; the sum of a run of
    // differences is its last value less its first, 2 v on average when squared, which the mean difference
    // takes with it.
    sums.neighbours.squares =
        std::max(0.0, sums.neighbours.squares - difference_sum * difference_sum / pairs);
    sums.neighbours.freedom = 2.0 * (pairs - static_cast<double>(runs) / pairs);
  }
  return sums;
}

/// The bins of one group and channel into the profile.
void fill(const Photo& photo, int group, int channel, Profile& profile) {
  const BinGrid& grid = *profile.grid;
  std::vector<BinSum> bins(grid.positions);
  for (int p = 0; p < grid.positions; ++p) bins[p] = sum_bin(photo, grid, grid.bin(group, p), channel);
  for (int p = 0; p < grid.positions; ++p) {
    const std::size_t i = profile.index(group, p, channel);
    profile.count[i] = bins[p].count;
    profile.mean[i] = bins[p].mean;
    if (bins[p].count == 0) continue;
    Scatter neighbours, values;
    const int last = std::min(grid.positions - 1, p + grid.pooled);
    for (int k = std::max(0, p - grid.pooled); k <= last; ++k) {
      neighbours.add(bins[k].neighbours);
      values.add(bins[k].values);
    }
    // A single pixel shows nothing of noise, but its neighbours do.
    const Scatter& noise = neighbours.freedom > 0.0 ? neighbours : values;
    if (!(noise.freedom > 0.0)) continue;
    const double step = code_step(photo, bins[p].mean);
    const double variance = std::max(noise.squares / noise.freedom, step * step / 12.0);
    profile.standard_error[i] = std::sqrt(variance / bins[p].count);
  }
}

}  // namespace

Profile extract_profile(const Photo& photo, const Region& region, int bands) {
  return extract_profile(photo, std::make_shared<const BinGrid>(column_bins(region, bands)));
}

Profile extract_profile(const Photo& photo, const std::shared_ptr<const BinGrid>& grid) {
  assert(photo.linear.channels() == 3 && photo.usable.size() == photo.linear.data.size());
  Profile profile;
  profile.region = grid->region;
  profile.bands = grid->groups;
  profile.rows = grid->positions;
  profile.grid = grid;
  const std::size_t size = grid->bins() * 3;
  profile.mean.assign(size, sim::kNaN);
  profile.standard_error.assign(size, sim::kNaN);
  profile.count.assign(size, 0);
  for (int group = 0; group < grid->groups; ++group)
    for (int channel = 0; channel < 3; ++channel) fill(photo, group, channel, profile);
  return profile;
}

Chromaticity chromaticity(const Profile& profile, int band, int row) {
  const std::size_t i = profile.index(band, row, 0);
  const double* mean = &profile.mean[i];
  const double* sigma = &profile.standard_error[i];
  const double sum = mean[0] + mean[1] + mean[2];
  if (!(sum > 0.0)) return {sim::kNaN, sim::kNaN, sim::kNaN, sim::kNaN};
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

Profile smoothed(const Profile& profile, double sigma_rows) {
  const sim::BlurKernel kernel = sim::gaussian_kernel(sigma_rows);
  Profile result = profile;
  for (int b = 0; b < profile.bands; ++b)
    for (int c = 0; c < 3; ++c)
      for (int r = 0; r < profile.rows; ++r) {
        double sum = 0.0, variance = 0.0, weight = 0.0;
        int count = 0;
        for (int k = -kernel.radius(); k <= kernel.radius(); ++k) {
          if (r + k < 0 || r + k >= profile.rows) continue;
          const std::size_t i = profile.index(b, r + k, c);
          if (profile.count[i] == 0) continue;
          const double w = kernel.weights[std::abs(k)];
          sum += w * profile.mean[i];
          if (std::isfinite(profile.standard_error[i]))
            variance += std::pow(w * profile.standard_error[i], 2);
          weight += w;
          count += profile.count[i];
        }
        const std::size_t i = profile.index(b, r, c);
        result.count[i] = count;
        result.mean[i] = weight > 0.0 ? sum / weight : std::numeric_limits<double>::quiet_NaN();
        result.standard_error[i] = weight > 0.0 ? std::sqrt(variance) / weight : result.mean[i];
      }
  return result;
}

Profile smoothed_by_px(const Profile& profile, double sigma_px) {
  const double position_px = profile.grid == nullptr ? 1.0 : profile.grid->position_px;
  return sigma_px > 0.0 && position_px > 0.0 ? smoothed(profile, sigma_px / position_px) : profile;
}

namespace {

/// A grey sensor says the same in all channels: what is said once is to count once.
void keep_one_channel(Profile& profile) {
  for (std::size_t i = 0; i < profile.mean.size(); ++i) {
    if (i % 3 == kGreyChannel) continue;
    profile.count[i] = 0;
    profile.mean[i] = profile.standard_error[i] = std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace

Profile measured_profile(const sim::Scene& scene, const Photo& photo,
                         const std::shared_ptr<const BinGrid>& grid) {
  Profile profile = extract_profile(photo, grid);
  if (is_grey(scene)) keep_one_channel(profile);
  if (scene.fit.photo_noise != sim::PhotoNoise::sensor) return profile;
  const sim::Image variance = sim::light_variance(scene, photo.linear, file_step(photo));
  const sim::PictureSize file_size = size_of_file(photo);
  const double averaged = static_cast<double>(file_size.width) * file_size.height /
                          (static_cast<double>(photo.linear.width) * photo.linear.height);
  for (std::size_t bin = 0; bin < grid->bins(); ++bin)
    for (int c = 0; c < 3; ++c) {
      if (profile.count[bin * 3 + c] == 0) continue;
      double sum = 0.0;
      int count = 0;
      for (std::size_t r = grid->first_run[bin]; r < grid->first_run[bin + 1]; ++r) {
        const BinGrid::Run& run = grid->runs[r];
        for (int x = run.begin; x < run.end; ++x) {
          if (!photo.usable[photo.linear.index(x, run.y, c)]) continue;
          sum += variance.at(x, run.y, c);
          ++count;
        }
      }
      if (count > 0) profile.standard_error[bin * 3 + c] = std::sqrt(sum / averaged) / count;
    }
  return profile;
}

}  // namespace vegard::fit
