#include "sim/emit/aurora/sheet_curve.h"

namespace vegard::sim {
namespace {

/// Stands for `number` of a caller that needs values only.
double the_number(const double& number) { return number; }

}  // namespace

std::pair<int, double> CurveLayout::piece_at(double s) const {
  const int last = static_cast<int>(at.size()) - 2;
  const int after = static_cast<int>(std::upper_bound(at.begin(), at.end(), s) - at.begin());
  const int piece = std::clamp(after - 1, 0, last);
  return {piece, std::clamp((s - at[piece]) / (at[piece + 1] - at[piece]), 0.0, 1.0)};
}

CurveLayout curve_layout(const Sheet& sheet) {
  CurveLayout layout;
  const int pieces = static_cast<int>(sheet.east_km.size()) - 1;
  const SheetCurve<double> curve(curve_nodes<double>(sheet, 0.0, the_number), 0, pieces - 1);
  layout.at.push_back(0.0);
  for (int k = 0; k < pieces; ++k) layout.at.push_back(layout.at.back() + curve.length_km(k));
  layout.length_km = layout.at.back();
  for (double& at : layout.at) at /= layout.length_km;
  layout.at.back() = 1.0;
  return layout;
}

std::vector<EastNorth> curve_feet(const Sheet& sheet, double instant_s, int count) {
  const CurveLayout layout = curve_layout(sheet);
  const SheetCurve<double> curve(curve_nodes<double>(sheet, instant_s, the_number), 0,
                                 static_cast<int>(sheet.east_km.size()) - 2);
  std::vector<EastNorth> feet;
  for (int i = 0; i < count; ++i) {
    const auto [piece, fraction] = layout.piece_at(count > 1 ? static_cast<double>(i) / (count - 1) : 0.5);
    const std::array<double, 2> at = curve.place(piece, fraction).at;
    feet.push_back({at[0], at[1]});
  }
  return feet;
}

Sheet evened_sheet(const Sheet& sheet) {
  if (!is_curve(sheet)) return sheet;
  constexpr int kPlaces = 1024;
  const CurveLayout layout = curve_layout(sheet);
  const int pieces = static_cast<int>(sheet.east_km.size()) - 1;
  const SheetCurve<double> curve(curve_nodes<double>(sheet, 0.0, the_number), 0, pieces - 1);
  const auto& nodes = curve.nodes();
  double widths = 0.0, fluxes = 0.0, ln_energies = 0.0;
  for (int i = 0; i < kPlaces; ++i) {
    const auto [piece, fraction] = layout.piece_at((i + 0.5) / kPlaces);
    const auto value = [&, piece = piece, fraction = fraction](const std::vector<double>& list, double even) {
      return list.empty() ? even : std::exp(curve.along(list, piece, fraction));
    };
    const double width = value(nodes.ln_width, sheet.width_km),
                 flux = width * value(nodes.ln_brightness, 1.0);
    widths += width;
    fluxes += flux;
    ln_energies += flux * std::log(value(nodes.ln_energy, sheet.energy_kev));
  }
  Sheet even = sheet;
  even.course = SheetCourse::sine;
  for (std::vector<double>* list :
       {&even.east_km, &even.north_km, &even.point_brightness, &even.point_energy_kev, &even.point_width_km})
    list->clear();
  const double brightness = sheet.point_brightness.empty() ? 1.0 : fluxes / widths;
  if (!sheet.point_width_km.empty()) even.width_km = widths / kPlaces;
  even.energy_flux_mw_m2 *= brightness;
  even.brightness_kilorayleigh *= brightness;
  even.line_kilorayleigh *= brightness;
  if (!sheet.point_energy_kev.empty()) even.energy_kev = std::exp(ln_energies / fluxes);
  even.length_km = layout.length_km;
  even.center_km = curve_feet(sheet, 0.0, 1).front();
  return even;
}

double width_laid_out_km(const Sheet& sheet, const CurveLayout& layout, double s) {
  if (sheet.point_width_km.empty()) return sheet.width_km;
  const auto [piece, fraction] = layout.piece_at(s);
  return std::exp((1.0 - fraction) * std::log(sheet.point_width_km[piece]) +
                  fraction * std::log(sheet.point_width_km[piece + 1]));
}

}  // namespace vegard::sim
