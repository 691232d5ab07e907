// The pictures of a map: its photograph, model and residual, and the ground with flux, energy and curtains.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "fit/map/curtains/curtains.h"
#include "fit/map/map_result.h"
#include "fit/map/raster_grid.h"
#include "fit/report/plot/plot.h"

namespace vegard::fit {

/// The light of the photograph that is shown white.
double white_of(const MappedPhoto& photo);

Panel photograph_panel(const MappedPhoto& photo, double white);
Panel model_panel(const MappedPhoto& photo, double white);
/// (photograph - model) / error; grey is 0.
Panel residual_panel(const MappedPhoto& photo);

/// A map's raster, for panels of the ground.
class ShownMap {
 public:
  /// The result must outlive it. With a magnetic grid, that of the dipole is drawn beside the geographic.
  explicit ShownMap(const MapResult& result, bool magnetic_grid = false);

  /// The flux of all but the brightest lit places, which is shown brightest.
  double white() const;
  /// Of ln E0 at lit places.
  std::pair<double, double> ln_energy_range() const;
  Panel flux_panel(const std::string& title, double white) const;
  /// Energies of places that are bright enough beside `white`.
  Panel energy_panel(const std::string& title, double white, double ln_low, double ln_high) const;
  /// Of a panel of this width.
  int height_px(int width_px) const;

 private:
  template <class Rgb>
  Panel panel_of(const std::string& title, const Rgb& rgb_of_place) const;
  std::vector<double> lit(bool energies) const;

  const MapResult& result_;
  bool magnetic_grid_;
  RasterGrid raster_;
  RasterFlux flux_;
  std::vector<std::uint8_t> in_view_;
};

/// Draws the curtains into a panel of the ground.
void add_courses(const std::vector<Curtain>& curtains, const std::string& label, Panel& panel);

}  // namespace vegard::fit
