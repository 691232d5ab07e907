#include "fit/photo/averaged_jpeg.h"

#include <array>
#include <cassert>
#include <cstddef>
#include <future>
#include <utility>

namespace vegard::fit {
namespace {

constexpr int kRowsAtOnce = 64;

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
