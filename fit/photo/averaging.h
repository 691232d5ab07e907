// Large photographs, averaged over blocks of pixels while they are read: a fit compares profiles of some
// hundred rows, and what stands finer than that costs time and says nothing more.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "fit/photo/region.h"
#include "sim/base/image.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/camera/scaled_camera.h"

namespace vegard::fit {

class JpegRows;

/// From the size of a photograph, upright, to a smaller one. The blocks are all alike; where a size is no
/// multiple of the other, pixels on their borders belong to each by the share that lies in it.
struct Averaging {
  sim::PictureSize from, to;
  bool any() const { return to.width > 0 && (to.width != from.width || to.height != from.height); }
};

/// What a fit of the scene needs of a photograph of its camera's size: about fit.average_rows rows in the
/// region of interest, or up to twice as many, with blocks as wide as they are high. Nothing is averaged
/// where pixels themselves are compared or asked for: the Sun's profiles, texture, granulation, a picture of
/// depth; nor where bands or the coarse image's cells would become too narrow.
Averaging averaging_for_fit(const sim::Scene& scene);

/// The scene whose camera has pixels of the size to which a photograph was averaged: the region, guides and
/// whatever else is in pixels with it. Free numbers of the lens stay in the pixels of before.
sim::Scene averaged_scene(const sim::Scene& scene, const Averaging& averaging);

/// `best`, of an averaged scene, with the pixels of `scene` again, which that one was made of.
sim::Scene with_pixels_of(const sim::Scene& scene, sim::Scene best);

/// Of such a scene's camera: "averaged over blocks of 8 x 8 pixels"; empty where nothing is averaged.
std::string averaging_words(const sim::Camera& camera);

/// x, y, width and height of a region of the averaged picture in the file's pixels.
std::array<int, 4> region_in_file(const sim::Camera& camera, const Region& region);

/// Linear light of a row's pixels, three channels each, and what of it can be used.
struct LightRow {
  std::vector<float> light;
  std::vector<std::uint8_t> usable;
};

/// What codes of 8 bits mean: their light, and from which code on one cannot be used.
struct CodeTable {
  std::vector<float> light;
  int white = 255;
};

/// Averages the rows of a photograph, which come one after the other. What cannot be used spoils its whole
/// block: a block that is clipped in part has a mean that is too low.
class BlockAverager {
 public:
  explicit BlockAverager(const Averaging& averaging);

  /// The next row, of averaging.from.width pixels: its light, or its codes of 1 or 3 channels.
  void add(const LightRow& row);
  void add(const std::uint8_t* codes, int channels, const CodeTable& table);

  /// After the last row.
  void take(sim::Image& light, std::vector<std::uint8_t>& usable);

  /// The pixels that a block covers along one axis, and which share of the first and of the last lies in it.
  struct Span {
    int first = 0, end = 0;
    float first_share = 1.0f, last_share = 1.0f;
  };

 private:
  template <class SumOf>
  void add_row(const SumOf& sum_of);
  void put(int to_y, float share, std::vector<float>& sums);
  void finish_blocks();

  const Averaging averaging_;
  const std::vector<Span> across_, down_;
  sim::Image light_;
  std::vector<std::uint8_t> usable_;
  const std::size_t of_row_;
  std::vector<float> row_, sums_, next_sums_;  ///< of a row, of its blocks, of those below that it cuts
  std::vector<std::size_t> spoilt_;            ///< of the row
  int y_ = 0, to_y_ = 0;
};

/// Averages all rows of a JPEG at its beginning and turns the result upright, by EXIF's orientation (1 to 8):
/// one thread decodes some rows while another adds up those before. The averaging is that of the upright
/// picture. Throws as JpegRows does.
void average_jpeg(JpegRows& jpeg, const Averaging& averaging, int orientation, const CodeTable& table,
                  sim::Image& light, std::vector<std::uint8_t>& usable);

}  // namespace vegard::fit
