#include "fit/report/map_panels.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "fit/report/ground_lattice.h"
#include "sim/base/number/constants.h"

namespace vegard::fit {
namespace {

constexpr Colour kCurtainInk{220, 60, 40};
constexpr double kLit = 0.05;  // of the brightest place

std::uint8_t display_code(double linear) {
  const double x = std::clamp(linear, 0.0, 1.0);
  return static_cast<std::uint8_t>(
      std::lround(255.0 * (x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055)));
}

/// From dark blue by green to yellow; t from 0 to 1.
std::array<std::uint8_t, 3> heat(double t) {
  constexpr double kStop[5][3] = {{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}};
  const double x = std::clamp(t, 0.0, 1.0) * 4.0;
  const int i = std::min(3, static_cast<int>(x));
  std::array<std::uint8_t, 3> rgb{};
  for (int c = 0; c < 3; ++c)
    rgb[c] = static_cast<std::uint8_t>(std::lround(kStop[i][c] + (x - i) * (kStop[i + 1][c] - kStop[i][c])));
  return rgb;
}

double value_at_share(std::vector<double> values, double share) {
  if (values.empty()) return 1.0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * (values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// One picture of the film's cells, whatever they hold.
template <class Rgb>
Panel film_panel(const MappedPhoto& photo, const std::string& title, const Rgb& rgb_of_cell) {
  const sim::FilmGeometry& film = photo.film;
  const int margin = static_cast<int>(-film.x0_px / film.cell_width_px);
  const int width = film.columns - 2 * margin, height = film.rows - 2 * margin;
  Panel panel;
  panel.title = title;
  panel.x.label = "pixel";
  panel.y.label = "pixel";
  panel.y.reversed = true;
  panel.x.min = 0.0;
  panel.x.max = width * film.cell_width_px;
  panel.y.min = 0.0;
  panel.y.max = height * film.cell_height_px;
  panel.raster.width = width;
  panel.raster.height = height;
  panel.raster.left = panel.raster.top = 0.0;
  panel.raster.right = *panel.x.max;
  panel.raster.bottom = *panel.y.max;
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      const auto rgb = rgb_of_cell(static_cast<std::size_t>(row + margin) * film.columns + column + margin);
      panel.raster.rgb.insert(panel.raster.rgb.end(), rgb.begin(), rgb.end());
    }
  return panel;
}

/// A panel of a photograph's light, of `value(i)`.
template <class Value>
Panel light_panel(const MappedPhoto& photo, const std::string& title, double white, const Value& value) {
  return film_panel(photo, title, [&](std::size_t cell) {
    std::array<std::uint8_t, 3> rgb{};
    const bool shown_at_all =
        photo.sigma[cell * 3] + photo.sigma[cell * 3 + 1] + photo.sigma[cell * 3 + 2] > 0.0f;
    for (std::size_t c = 0; c < 3; ++c) rgb[c] = shown_at_all ? display_code(value(cell * 3 + c) / white) : 0;
    return rgb;
  });
}

}  // namespace

double white_of(const MappedPhoto& photo) {
  std::vector<double> bright;
  for (std::size_t i = 0; i < photo.data.size(); ++i)
    if (photo.sigma[i] > 0.0f) bright.push_back(photo.data[i]);
  return std::max(1e-9, value_at_share(bright, 0.995));
}

Panel photograph_panel(const MappedPhoto& photo, double white) {
  return light_panel(photo, "photograph", white,
                     [&](std::size_t i) { return static_cast<double>(photo.data[i]); });
}

Panel model_panel(const MappedPhoto& photo, double white) {
  return light_panel(photo, "the map's light and the sky", white,
                     [&](std::size_t i) { return static_cast<double>(photo.model[i]) + photo.sky[i]; });
}

Panel residual_panel(const MappedPhoto& photo) {
  return film_panel(photo, "(photograph − model) / error, grey is 0", [&](std::size_t cell) {
    std::array<std::uint8_t, 3> rgb{};
    constexpr double kShown = 5.0;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t i = cell * 3 + c;
      const double z =
          photo.sigma[i] > 0.0f ? (photo.data[i] - photo.model[i] - photo.sky[i]) / photo.sigma[i] : 0.0;
      rgb[c] = static_cast<std::uint8_t>(std::lround(127.5 + 127.5 * std::clamp(z / kShown, -1.0, 1.0)));
    }
    return rgb;
  });
}

ShownMap::ShownMap(const MapResult& result, bool magnetic_grid)
    : result_(result),
      magnetic_grid_(magnetic_grid),
      raster_(raster_over(result)),
      flux_(raster_flux(result, raster_, result.cells)),
      in_view_(places_in_view(result, raster_)) {}

std::vector<double> ShownMap::lit(bool energies) const {
  double most = 0.0;
  std::vector<double> values;
  for (const double q : flux_.flux) most = std::max(most, q);
  for (std::size_t i = 0; i < raster_.size(); ++i)
    if (flux_.flux[i] > kLit * most)
      values.push_back(energies ? flux_.flux_ln_energy[i] / flux_.flux[i] : flux_.flux[i]);
  return values;
}

double ShownMap::white() const { return value_at_share(lit(false), 0.98); }

std::pair<double, double> ShownMap::ln_energy_range() const {
  const std::vector<double> ln = lit(true);
  const double low = value_at_share(ln, 0.02);
  return {low, std::max(value_at_share(ln, 0.98), low + 0.1)};
}

template <class Rgb>
Panel ShownMap::panel_of(const std::string& title, const Rgb& rgb_of_place) const {
  Panel panel;
  panel.title = title;
  panel.x.label = "east of the site (km)";
  panel.y.label = "north of the site (km)";
  panel.x.min = raster_.west_km;
  panel.x.max = raster_.west_km + (raster_.columns - 1) * raster_.step_km;
  panel.y.min = raster_.south_km;
  panel.y.max = raster_.south_km + (raster_.rows - 1) * raster_.step_km;
  panel.raster.width = raster_.columns;
  panel.raster.height = raster_.rows;
  panel.raster.left = *panel.x.min - 0.5 * raster_.step_km;
  panel.raster.right = *panel.x.max + 0.5 * raster_.step_km;
  panel.raster.bottom = *panel.y.min - 0.5 * raster_.step_km;
  panel.raster.top = *panel.y.max + 0.5 * raster_.step_km;
  for (int row = raster_.rows - 1; row >= 0; --row)
    for (int column = 0; column < raster_.columns; ++column) {
      const std::size_t i = static_cast<std::size_t>(row) * raster_.columns + column;
      std::array<std::uint8_t, 3> rgb = {228, 231, 235};  // no answer here
      if (in_view_[i] != 0) rgb = rgb_of_place(i);
      panel.raster.rgb.insert(panel.raster.rgb.end(), rgb.begin(), rgb.end());
    }
  add_geographic_grid(result_.scene, raster_, panel);
  if (magnetic_grid_) add_magnetic_grid(result_.scene, raster_, panel);
  return panel;
}

Panel ShownMap::flux_panel(const std::string& title, double white) const {
  return panel_of(title,
                  [&](std::size_t i) { return heat(std::sqrt(std::max(0.0, flux_.flux[i]) / white)); });
}

Panel ShownMap::energy_panel(const std::string& title, double white, double ln_low, double ln_high) const {
  return panel_of(title, [&](std::size_t i) {
    if (flux_.flux[i] < 0.03 * white) return std::array<std::uint8_t, 3>{250, 250, 250};
    return heat((flux_.flux_ln_energy[i] / flux_.flux[i] - ln_low) / (ln_high - ln_low));
  });
}

int ShownMap::height_px(int width_px) const {
  return std::clamp(static_cast<int>(width_px * static_cast<double>(raster_.rows) / raster_.columns), 160,
                    640);
}

void add_courses(const std::vector<Curtain>& curtains, const std::string& label, Panel& panel) {
  for (std::size_t c = 0; c < curtains.size(); ++c) {
    Series line;
    line.label = c == 0 ? label : "";
    line.colour = kCurtainInk;
    line.width_px = 1.2;
    for (const CurtainPoint& p : curtains[c].points) {
      line.x.push_back(p.foot_km.east);
      line.y.push_back(p.foot_km.north);
    }
    panel.series.push_back(std::move(line));
  }
}

}  // namespace vegard::fit
