// Averages large photographs over blocks of pixels while they are read: a fit compares profiles of some
// hundred rows; finer pixels cost time and add no information.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "fit/photo/region.h"
#include "sim/base/image.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit {

class JpegRows;

/// The sizes of an upright photograph before and after averaging. All blocks have the same size, which need
/// not be a whole number of pixels: a pixel on the border of two blocks is divided between them by area.
struct Averaging {
  sim::PictureSize from, to;
  bool any() const { return to.width > 0 && (to.width != from.width || to.height != from.height); }
};

/// Returns the averaging that suits a fit of the scene, for a photograph of its camera's size: it leaves
/// fit.average_rows to about twice as many rows in the region of interest, with square blocks. Nothing is
/// averaged if the fit needs the pixels themselves (the Sun's profiles, texture, granulation, a picture of
/// depth), or if bands or the coarse image's cells would become too narrow.
Averaging averaging_for_fit(const sim::Scene& scene);

/// Returns the scene with a camera of the averaged photograph's size: the region, guides and all other
/// numbers in pixels are converted. Free parameters of the lens remain in the original pixels.
sim::Scene averaged_scene(const sim::Scene& scene, const Averaging& averaging);

/// Converts `best`, a fit's result in averaged pixels, back to the pixels of `scene`, from which its averaged
/// scene was made.
sim::Scene with_pixels_of(const sim::Scene& scene, sim::Scene best);

/// Describes the averaging of a scene's camera: "averaged over blocks of 8 x 8 pixels"; empty without
/// averaging.
std::string averaging_words(const sim::Camera& camera);

/// Converts a region of the averaged picture to the file's pixels: x, y, width, height.
std::array<int, 4> region_in_file(const sim::Camera& camera, const Region& region);

/// Linear light of a row's pixels, three channels each, and which of these values are usable.
struct LightRow {
  std::vector<float> light;
  std::vector<std::uint8_t> usable;
};

/// The light of each code of 8 bits, and the lowest code that is clipped.
struct CodeTable {
  std::vector<float> light;
  int white = 255;
};

/// Averages the rows of a photograph, which are added from top to bottom. An unusable pixel makes its whole
/// block unusable: the mean of a partly clipped block would be too low.
class BlockAverager {
 public:
  explicit BlockAverager(const Averaging& averaging);

  /// Adds the next row, of averaging.from.width pixels: its light, or its codes of 1 or 3 channels.
  void add(const LightRow& row);
  void add(const std::uint8_t* codes, int channels, const CodeTable& table);

  /// Moves out the averaged picture; to be called after the last row.
  void take(sim::Image& light, std::vector<std::uint8_t>& usable);

  /// The pixels that a block covers along one axis, and the shares of the first and the last that lie in it.
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
  std::vector<float> row_, sums_, next_sums_;  ///< sums of a row, of its blocks, of the blocks below them
  std::vector<std::size_t> spoilt_;            ///< unusable values of the row
  int y_ = 0, to_y_ = 0;
};

/// Averages all rows of a JPEG, of which none has been read yet, and turns the result upright by EXIF's
/// orientation (1 to 8): one thread decodes rows while another sums the previous ones. `averaging` has the
/// sizes of the upright picture. Throws as JpegRows does.
void average_jpeg(JpegRows& jpeg, const Averaging& averaging, int orientation, const CodeTable& table,
                  sim::Image& light, std::vector<std::uint8_t>& usable);

}  // namespace vegard::fit
