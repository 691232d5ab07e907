// Emission tables with made-up modes of their uncertainty.
#pragma once

#include <algorithm>
#include <memory>
#include <string>

#include "sim/scene/table/emission_folder.h"

namespace vegard::tests {

/// Tables with two modes: more light low down, and more red light.
inline std::shared_ptr<const sim::TableFolder> tables_with_modes() {
  sim::TableFolder folder = *sim::built_in_tables("vegard");
  folder.place = "made";
  std::string text = "mode,E0_keV,altitude_km,ver_4278,ver_5577,ver_6300\n";
  for (const int mode : {1, 2})
    for (const double energy : {0.1, 20.0})
      for (const double altitude : {80.0, 130.0, 640.0}) {
        const double lower = mode == 1 ? 0.2 * (130.0 - std::min(altitude, 130.0)) / 50.0 : 0.0;
        text += std::to_string(mode) + "," + std::to_string(energy) + "," + std::to_string(altitude);
        for (const bool is_red : {false, false, true})
          text += "," + std::to_string(mode == 1 ? lower : is_red ? 0.1 : 0.0);
        text += "\n";
      }
  folder.files[sim::kModesFile] = text;
  return std::make_shared<const sim::TableFolder>(folder);
}

}  // namespace vegard::tests
