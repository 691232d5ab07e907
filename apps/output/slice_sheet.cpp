#include "apps/output/slice_sheet.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "apps/options/refusals.h"
#include "sim/view/colour/colour_table.h"

namespace vegard::apps {
namespace {

constexpr int kPanel_px = 300;  // of the sheet's own measure; the file has two pixels to each
constexpr int kMax_px = 2 * kPanel_px;

/// Where voxels lie along the grid's own axes, which need not be those of its frame.
class Places {
 public:
  explicit Places(const sim::SparseGrid& grid) : voxel_(grid.voxel) {
    for (int a = 0; a < 3; ++a) {
      for (int c = 0; c < 3; ++c) {
        corner_[a] += grid.axes[a][c] * grid.origin[c];
        upright_ = upright_ && grid.axes[a][c] == (a == c ? 1.0 : 0.0);
      }
    }
  }
  double edge(int axis, double voxel) const { return corner_[axis] + voxel_ * voxel; }
  double middle(int axis, int voxel) const { return edge(axis, voxel + 0.5); }
  int voxel_at(int axis, double place) const {
    return static_cast<int>(std::clamp(std::floor((place - corner_[axis]) / voxel_), -2e9, 2e9));
  }
  /// Of a turned grid i, j and k.
  const char* name(int axis) const {
    constexpr const char *kUpright[3] = {"x", "y", "z"}, *kTurned[3] = {"i", "j", "k"};
    return upright_ ? kUpright[axis] : kTurned[axis];
  }

 private:
  double voxel_, corner_[3] = {0.0, 0.0, 0.0};
  bool upright_ = true;
};

class Sheet {
 public:
  Sheet(const sim::SparseGrid& grid, const sim::VoxelBox& box, const SheetOptions& options)
      : grid_(grid),
        box_(box),
        options_(options),
        places_(grid),
        colours_(sim::ColourTable::named(options.gold ? "171" : "none")),
        bin_(sim::bin_for(box, kMax_px)) {}

  fit::Plot plot() {
    fit::Plot plot;
    plot.columns = 3;
    plot.panel_width_px = plot.panel_height_px = kPanel_px;
    std::vector<sim::GridPlane> largest;
    for (int axis = 0; axis < 3; ++axis)
      largest.push_back(sim::largest_along(grid_, options_.channel, box_, axis, bin_));
    for (const float number : largest.back().value) most_ = std::max(most_, static_cast<double>(number));
    for (int axis = 0; axis < 3; ++axis)
      plot.panels.push_back(panel(largest[axis], fmt::format("largest along {}", places_.name(axis))));
    if (options_.along >= 0)
      add_row(plot);
    else
      add_middle(plot);
    plot.title = options_.title;
    plot.note = note();
    return plot;
  }

 private:
  std::string note() const {
    const sim::GridChannel& channel = grid_.channels[options_.channel];
    std::string text = fmt::format("{}: white is {:.4g}{}{}", channel.name, most_,
                                   channel.unit.empty() ? "" : " ", channel.unit);
    if (options_.decades > 0.0)
      text += fmt::format(", black {:g} decades below, by its logarithm", options_.decades);
    else if (options_.gamma != 1.0)
      text += fmt::format(", gamma {:g}", options_.gamma);
    text += fmt::format("; {} × {} × {} voxels of {:g} {}", box_.size(0), box_.size(1), box_.size(2),
                        grid_.voxel, options_.length);
    if (bin_ > 1) text += fmt::format(", {} to a pixel", bin_);
    return text;
  }

  fit::Panel panel_of_slice(int axis, int layer) const {
    return panel(sim::slice_at(grid_, options_.channel, box_, axis, layer, bin_),
                 fmt::format("slice at {} = {:.6g}", places_.name(axis), places_.middle(axis, layer)));
  }

  void add_middle(fit::Plot& plot) const {
    for (int axis = 0; axis < 3; ++axis) {
      int layer = (box_.low[axis] + box_.high[axis]) / 2;
      if (options_.at) {
        layer = places_.voxel_at(axis, (*options_.at)[axis]);
        if (layer < box_.low[axis] || layer >= box_.high[axis])
          throw usage_error(
              "--at",
              fmt::format("{} = {:g} is beside the grid's light", places_.name(axis), (*options_.at)[axis]),
              fmt::format("from {:.6g} to {:.6g}", places_.edge(axis, box_.low[axis]),
                          places_.edge(axis, box_.high[axis])));
      }
      plot.panels.push_back(panel_of_slice(axis, layer));
    }
  }

  /// In the middles of `count` equal parts of the box.
  void add_row(fit::Plot& plot) const {
    const int axis = options_.along;
    for (int n = 0; n < options_.count; ++n)
      plot.panels.push_back(panel_of_slice(
          axis, box_.low[axis] + static_cast<int>((n + 0.5) / options_.count * box_.size(axis))));
  }

  double grey(float number) const {
    const double share = number > 0.0f && most_ > 0.0 ? number / most_ : 0.0;
    if (share == 0.0) return 0.0;
    if (options_.decades > 0.0) return std::max(0.0, 1.0 + std::log10(share) / options_.decades);
    return std::pow(share, 1.0 / options_.gamma);
  }

  fit::Axis axis_of(int axis, double middle, double half) const {
    fit::Axis out;
    out.label = fmt::format("{} ({})", places_.name(axis), options_.length);
    out.min = middle - half;
    out.max = middle + half;
    return out;
  }

  fit::Panel panel(const sim::GridPlane& plane, const std::string& title) const {
    fit::Panel panel;
    panel.title = title;
    fit::Raster& raster = panel.raster;
    raster.width = plane.width;
    raster.height = plane.height;
    for (const float number : plane.value)
      for (const double channel : colours_.at(grey(number)))
        raster.rgb.push_back(static_cast<std::uint8_t>(std::lround(255.0 * channel)));
    const double pixel = grid_.voxel * plane.bin;
    raster.left = places_.edge(plane.across, box_.low[plane.across]);
    raster.right = raster.left + pixel * plane.width;
    raster.bottom = places_.edge(plane.up, box_.low[plane.up]);
    raster.top = raster.bottom + pixel * plane.height;
    // Both axes to one scale, and all panels to the same.
    const double half =
        0.5 * pixel * std::max({box_.size(0), box_.size(1), box_.size(2)}) / plane.bin + 0.5 * pixel;
    panel.x = axis_of(plane.across, 0.5 * (raster.left + raster.right), half);
    panel.y = axis_of(plane.up, 0.5 * (raster.bottom + raster.top), half);
    return panel;
  }

  const sim::SparseGrid& grid_;
  const sim::VoxelBox& box_;
  const SheetOptions& options_;
  Places places_;
  sim::ColourTable colours_;
  int bin_;
  double most_ = 0.0;
};

}  // namespace

fit::Plot slice_sheet(const sim::SparseGrid& grid, const sim::VoxelBox& box, const SheetOptions& options) {
  return Sheet(grid, box, options).plot();
}

}  // namespace vegard::apps
