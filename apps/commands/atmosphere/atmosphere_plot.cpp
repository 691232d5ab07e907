#include "apps/commands/atmosphere/atmosphere_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace vegard::apps {
namespace {

constexpr std::array<const char*, sim::kMsisGases> kGasNames = {"N2", "O2", "O", "He", "Ar", "H", "N"};
constexpr double kMinLog = 2.0;  // 100 cm^-3: below it nothing is of interest

fit::Panel altitude_panel(const char* title, const char* label) {
  fit::Panel panel;
  panel.title = title;
  panel.x.label = label;
  panel.y.label = "altitude (km)";
  return panel;
}

}  // namespace

fit::Plot air_plot(const AirColumn& column) {
  fit::Panel densities = altitude_panel("Densities", "log10(density in cm^-3)"),
             temperature = altitude_panel("Temperature", "temperature (K)");
  double most = kMinLog + 1.0;
  for (std::size_t g = 0; g < sim::kMsisGases; ++g) {
    fit::Series series;
    series.label = kGasNames[g];
    series.colour = fit::distinct_colour(static_cast<int>(g));
    series.y = column.altitude_km;
    for (const sim::MsisAir& air : column.air) series.x.push_back(std::log10(air.density_cm3[g]));
    most = std::max(most, *std::max_element(series.x.begin(), series.x.end()));
    densities.series.push_back(series);
  }
  densities.x.min = kMinLog;
  densities.x.max = most + 0.2;
  fit::Series kelvin;
  kelvin.y = column.altitude_km;
  for (const sim::MsisAir& air : column.air) kelvin.x.push_back(air.temperature_k);
  temperature.series.push_back(kelvin);
  temperature.x.min = 0.0;
  fit::Plot plot;
  plot.title = "Neutral air, NRLMSISE-00";
  plot.note = sim::condition_words(column.conditions);
  plot.panels = {densities, temperature};
  return plot;
}

}  // namespace vegard::apps
