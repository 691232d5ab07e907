#include "fit/photo/averaging.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <future>
#include <utility>

#include <fmt/format.h>

#include "fit/photo/codec/jpeg_rows.h"
namespace vegard::fit {
namespace {

constexpr int kPixelsOfBand = 12;      // that each band is to keep across
constexpr int kPixelsOfImageCell = 4;  // and a cell of the coarse image
constexpr double kTouches = 1e-9;      // of a pixel
constexpr int kRowsAtOnce = 64;        // that are decoded while those before are added up

bool asks_for_pixels(const sim::Scene& scene) {
  const sim::Fit& fit = scene.fit;
  return fit.profile_along == sim::ProfileAlong::loop || fit.profile_along == sim::ProfileAlong::limb ||
         fit.weight.any_beside_profile([](const sim::StatisticFacts& facts) { return facts.needs_pixels; }) ||
         !scene.march.depth.empty();
}

using Span = BlockAverager::Span;

std::vector<Span> spans(int from, int to) {
  std::vector<Span> all(to);
  const double step = static_cast<double>(from) / to;
  for (int i = 0; i < to; ++i) {
    const double begin = i * step, end = i + 1 == to ? from : (i + 1) * step;
    Span& span = all[i];
    span.first = static_cast<int>(begin);
    span.first_share = static_cast<float>(span.first + 1 - begin);
    if (span.first_share < kTouches) {
      ++span.first;
      span.first_share = 1.0f;
    }
    span.end = static_cast<int>(std::ceil(end));
    span.last_share = static_cast<float>(end - (span.end - 1));
    if (span.last_share < kTouches) {
      --span.end;
      span.last_share = 1.0f;
    }
  }
  return all;
}

/// The sum of some neighbouring pixels of a row.
struct RowSum {
  std::array<float, 3> light{};
  std::array<bool, 3> usable{true, true, true};

  void add(const RowSum& other, float weight) {
    for (int c = 0; c < 3; ++c) {
      light[c] += weight * other.light[c];
      usable[c] = usable[c] && other.usable[c];
    }
  }
};

/// The same of a row's light as such.
RowSum sum_of(const LightRow& row, int begin, int end) {
  RowSum sum;
  for (int x = begin; x < end; ++x)
    for (int c = 0; c < 3; ++c) {
      const std::size_t i = 3 * static_cast<std::size_t>(x) + c;
      sum.light[c] += row.light[i];
      sum.usable[c] = sum.usable[c] && row.usable[i] != 0;
    }
  return sum;
}

/// And of its codes.
template <int Channels>
RowSum sum_of(const std::uint8_t* codes, const CodeTable& table, int begin, int end) {
  float light[Channels] = {};
  int most[Channels] = {};
  const std::uint8_t* const last = codes + static_cast<std::ptrdiff_t>(end) * Channels;
  for (const std::uint8_t* p = codes + static_cast<std::ptrdiff_t>(begin) * Channels; p < last; p += Channels)
    for (int c = 0; c < Channels; ++c) {
      light[c] += table.light[p[c]];
      most[c] = std::max(most[c], static_cast<int>(p[c]));
    }
  RowSum sum;
  for (int c = 0; c < 3; ++c) {
    sum.light[c] = light[Channels == 3 ? c : 0];
    sum.usable[c] = most[Channels == 3 ? c : 0] < table.white;
  }
  return sum;
}

/// EXIF 2.3, tag 274: a picture of the file's rows becomes upright.
void turn_upright(int orientation, sim::Image& light, std::vector<std::uint8_t>& all_usable) {
  if (orientation <= 1) return;
  const sim::Image stored = std::move(light);
  const std::vector<std::uint8_t> usable = std::move(all_usable);
  const bool turned = orientation >= 5;
  const int last_x = stored.width - 1, last_y = stored.height - 1;
  light = turned ? sim::Image(stored.height, stored.width, {"R", "G", "B"})
                 : sim::Image(stored.width, stored.height, {"R", "G", "B"});
  all_usable.resize(usable.size());
  const bool from_right = orientation == 2 || orientation == 3 || orientation >= 7,
             from_below = orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
  for (int y = 0; y < light.height; ++y)
    for (int x = 0; x < light.width; ++x) {
      const int along = turned ? y : x, down = turned ? x : y;
      const int from_x = from_right ? last_x - along : along, from_y = from_below ? last_y - down : down;
      for (int c = 0; c < 3; ++c) {
        light.data[light.index(x, y, c)] = stored.at(from_x, from_y, c);
        all_usable[light.index(x, y, c)] = usable[stored.index(from_x, from_y, c)];
      }
    }
}

}  // namespace

Averaging averaging_for_fit(const sim::Scene& scene) {
  const sim::Camera& camera = scene.camera;
  const sim::Fit& fit = scene.fit;
  Averaging averaging{{camera.width, camera.height}, {camera.width, camera.height}};
  if (fit.average_rows <= 0 || asks_for_pixels(scene)) return averaging;
  const double rows = fit.roi_px[3] > 0 ? fit.roi_px[3] : camera.height,
               columns = fit.roi_px[2] > 0 ? fit.roi_px[2] : camera.width;
  double block = std::floor(rows / fit.average_rows);
  block = std::min(block, std::floor(columns / (std::max(1, fit.bands) * kPixelsOfBand)));
  if (fit.weight[sim::StatisticKind::image] > 0.0)
    block = std::min(block, static_cast<double>(fit.image_cell_px / kPixelsOfImageCell));
  // A cell of the coarse image is to be a whole number of blocks.
  while (fit.weight[sim::StatisticKind::image] > 0.0 && block > 1.0 &&
         std::fmod(fit.image_cell_px, block) != 0.0)
    block -= 1.0;
  if (block < 2.0) return averaging;
  averaging.to = {static_cast<int>(std::lround(camera.width / block)),
                  static_cast<int>(std::lround(camera.height / block))};
  return averaging;
}

sim::Scene averaged_scene(const sim::Scene& scene, const Averaging& averaging) {
  if (!averaging.any()) return scene;
  const double across = static_cast<double>(averaging.to.width) / averaging.from.width,
               down = static_cast<double>(averaging.to.height) / averaging.from.height;
  sim::Scene averaged = scene;
  averaged.camera = sim::scaled_camera(scene.camera, averaging.to);
  averaged.march.smooth_px *= across;
  sim::Fit& fit = averaged.fit;
  const auto& roi = scene.fit.roi_px;
  if (roi != std::array<int, 4>{}) {
    // The blocks that lie inside.
    constexpr double kTouch = 1e-6;
    const auto first = [&](int at, double scale) { return static_cast<int>(std::ceil(at * scale - kTouch)); };
    const auto end = [&](int at, double scale) { return static_cast<int>(at * scale + kTouch); };
    fit.roi_px = {first(roi[0], across), first(roi[1], down), 0, 0};
    fit.roi_px[2] = std::max(1, end(roi[0] + roi[2], across) - fit.roi_px[0]);
    fit.roi_px[3] = std::max(1, end(roi[1] + roi[3], down) - fit.roi_px[1]);
  }
  fit.image_cell_px = std::max(1, static_cast<int>(std::lround(scene.fit.image_cell_px * across)));
  return averaged;
}

sim::Scene with_pixels_of(const sim::Scene& scene, sim::Scene best) {
  best.camera.width = scene.camera.width;
  best.camera.height = scene.camera.height;
  best.camera.pixel_width_px = scene.camera.pixel_width_px;
  best.camera.pixel_height_px = scene.camera.pixel_height_px;
  best.march.smooth_px = scene.march.smooth_px;
  best.fit.roi_px = scene.fit.roi_px;
  best.fit.image_cell_px = scene.fit.image_cell_px;
  return best;
}

std::string averaging_words(const sim::Camera& camera) {
  if (camera.pixel_width_px == 1.0 && camera.pixel_height_px == 1.0) return {};
  return fmt::format("averaged over blocks of {:.3g} x {:.3g} pixels", camera.pixel_width_px,
                     camera.pixel_height_px);
}

std::array<int, 4> region_in_file(const sim::Camera& camera, const Region& region) {
  const auto across = [&](int x) { return static_cast<int>(std::lround(x * camera.pixel_width_px)); };
  const auto down = [&](int y) { return static_cast<int>(std::lround(y * camera.pixel_height_px)); };
  return {across(region.x), down(region.y), across(region.x + region.width) - across(region.x),
          down(region.y + region.height) - down(region.y)};
}

BlockAverager::BlockAverager(const Averaging& averaging)
    : averaging_(averaging),
      across_(spans(averaging.from.width, averaging.to.width)),
      down_(spans(averaging.from.height, averaging.to.height)),
      light_(averaging.to.width, averaging.to.height, {"R", "G", "B"}),
      usable_(light_.data.size(), 1),
      of_row_(3 * static_cast<std::size_t>(averaging.to.width)),
      row_(of_row_),
      sums_(of_row_, 0.0f),
      next_sums_(of_row_, 0.0f) {}

template <class SumOf>
void BlockAverager::add_row(const SumOf& sum_of) {
  assert(y_ < averaging_.from.height);
  spoilt_.clear();
  for (std::size_t x = 0; x < across_.size(); ++x) {
    const Span& columns = across_[x];
    // Whole pixels, and before and behind them what a border cuts.
    const bool first_whole = columns.first_share == 1.0f, last_whole = columns.last_share == 1.0f;
    const int begin = columns.first + (first_whole ? 0 : 1),
              end = std::max(begin, columns.end - (last_whole ? 0 : 1));
    RowSum sum = sum_of(begin, end);
    if (!first_whole) sum.add(sum_of(columns.first, columns.first + 1), columns.first_share);
    if (!last_whole) sum.add(sum_of(columns.end - 1, columns.end), columns.last_share);
    for (int c = 0; c < 3; ++c) {
      row_[3 * x + c] = sum.light[c];
      if (!sum.usable[c]) spoilt_.push_back(3 * x + c);
    }
  }
  // A row lies in one block, or on the border of two.
  const Span& here = down_[to_y_];
  put(to_y_, y_ == here.first ? here.first_share : y_ + 1 == here.end ? here.last_share : 1.0f, sums_);
  const bool ends = y_ + 1 == here.end;
  if (ends && to_y_ + 1 < averaging_.to.height && down_[to_y_ + 1].first == y_)
    put(to_y_ + 1, down_[to_y_ + 1].first_share, next_sums_);
  if (ends) finish_blocks();
  ++y_;
}

void BlockAverager::put(int to_y, float share, std::vector<float>& sums) {
  for (std::size_t i = 0; i < of_row_; ++i) sums[i] += share * row_[i];
  for (const std::size_t i : spoilt_) usable_[of_row_ * static_cast<std::size_t>(to_y) + i] = 0;
}

void BlockAverager::finish_blocks() {
  const auto area = static_cast<float>(static_cast<double>(averaging_.from.width) / averaging_.to.width *
                                       (static_cast<double>(averaging_.from.height) / averaging_.to.height));
  float* const to = light_.data.data() + of_row_ * static_cast<std::size_t>(to_y_);
  std::uint8_t* const usable = usable_.data() + of_row_ * static_cast<std::size_t>(to_y_);
  for (std::size_t i = 0; i < of_row_; ++i) {
    to[i] = sums_[i] / area;
    if (std::isfinite(to[i])) continue;  // of floats that no photograph has
    to[i] = 0.0f;
    usable[i] = 0;
  }
  sums_.swap(next_sums_);
  std::fill(next_sums_.begin(), next_sums_.end(), 0.0f);
  ++to_y_;
}

void BlockAverager::add(const LightRow& row) {
  add_row([&](int begin, int end) { return sum_of(row, begin, end); });
}

void BlockAverager::add(const std::uint8_t* codes, int channels, const CodeTable& table) {
  if (channels == 3)
    add_row([&](int begin, int end) { return sum_of<3>(codes, table, begin, end); });
  else
    add_row([&](int begin, int end) { return sum_of<1>(codes, table, begin, end); });
}

void BlockAverager::take(sim::Image& light, std::vector<std::uint8_t>& usable) {
  assert(y_ == averaging_.from.height);
  light = std::move(light_);
  usable = std::move(usable_);
}

void average_jpeg(JpegRows& jpeg, const Averaging& averaging, int orientation, const CodeTable& table,
                  sim::Image& light, std::vector<std::uint8_t>& usable) {
  Averaging stored = averaging;
  if (orientation >= 5) {
    std::swap(stored.from.width, stored.from.height);
    std::swap(stored.to.width, stored.to.height);
  }
  assert(jpeg.width() == stored.from.width && jpeg.height() == stored.from.height);
  const int channels = jpeg.channels();
  const std::size_t of_row = static_cast<std::size_t>(stored.from.width) * channels;
  std::array<std::vector<std::uint8_t>, 2> buffers;
  for (std::vector<std::uint8_t>& buffer : buffers) buffer.resize(of_row * kRowsAtOnce);
  BlockAverager averager(stored);
  std::future<void> adding;
  for (int y = 0, turn = 0; y < stored.from.height; turn = 1 - turn) {
    const std::uint8_t* const codes = buffers[turn].data();
    const int rows = jpeg.next_rows(kRowsAtOnce, buffers[turn].data());
    if (adding.valid()) adding.get();
    adding = std::async(std::launch::async, [&averager, &table, codes, rows, of_row, channels] {
      for (int r = 0; r < rows; ++r) averager.add(codes + r * of_row, channels, table);
    });
    y += rows;
  }
  adding.get();
  averager.take(light, usable);
  turn_upright(orientation, light, usable);
}

}  // namespace vegard::fit
