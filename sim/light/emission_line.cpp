#include "sim/light/emission_line.h"

#include <cmath>

namespace vegard::sim {

const std::vector<EmissionLine>& emission_lines() {
  static const std::vector<EmissionLine> lines = {
      {337.1, "N2", "second positive (0,0)", 4e-8, "ver_3371"},
      {427.8, "N2+", "first negative (0,1)", 6e-8, "ver_4278"},
      {520.0, "N", "(2D)-(4S)", 94000.0, "ver_5200"},
      {557.7, "O", "(1S)-(1D)", 0.7, "ver_5577"},
      {630.0, "O", "(1D)-(3P)", 110.0, "ver_6300"},
      {777.4, "O", "(5P)-(5S)", 3e-8, "ver_7774"},
      {844.6, "O", "(3P)-(3S)", 3e-8, "ver_8446"},
  };
  return lines;
}

const EmissionLine* find_emission_line(double wavelength_nm) {
  for (const EmissionLine& line : emission_lines())
    if (std::abs(line.wavelength_nm - wavelength_nm) < 0.05) return &line;
  return nullptr;
}

}  // namespace vegard::sim
