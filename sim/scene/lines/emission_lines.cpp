#include "sim/scene/lines/emission_lines.h"

#include <algorithm>
#include <cmath>

namespace vegard::sim {
namespace {

/// The first positive bands of N2 between 570 and 900 nm that have a thousandth of their light or more: the
/// populations of B3Pi measured in aurora (Gattinger and Vallance Jones 1974, Can. J. Phys. 52, 2343) times
/// the Einstein coefficients of Vallance Jones 1974, "Aurora" (v' = 0 to 12). Wavelengths of the same book.
/// How each upper level branches is checked against overlaps of Morse potentials; the populations are not.
std::vector<LineComponent> first_positive_bands() {
  return {
      {590.6, 0.0020},  // (9,5)
      {595.9, 0.0034},  // (8,4)
      {601.4, 0.0045},  // (7,3)
      {607.0, 0.0045},  // (6,2)
      {612.7, 0.0034},  // (5,1)
      {618.7, 0.0015},  // (4,0)
      {639.8, 0.0033},  // (9,6)
      {646.9, 0.0086},  // (8,5)
      {654.5, 0.0170},  // (7,4)
      {662.4, 0.0266},  // (6,3)
      {670.5, 0.0355},  // (5,2)
      {679.0, 0.0344},  // (4,1)
      {687.5, 0.0172},  // (3,0)
      {716.5, 0.0043},  // (7,5)
      {727.4, 0.0164},  // (6,4)
      {738.7, 0.0463},  // (5,3)
      {750.5, 0.0953},  // (4,2)
      {761.3, 0.0015},  // (9,8)
      {762.6, 0.1241},  // (3,1)
      {775.2, 0.0037},  // (8,7)
      {775.4, 0.1046},  // (2,0)
      {789.7, 0.0060},  // (7,6)
      {804.8, 0.0059},  // (6,5)
      {820.6, 0.0020},  // (5,4)
      {837.0, 0.0018},  // (4,3)
      {854.2, 0.0348},  // (3,2)
      {872.3, 0.1453},  // (2,1)
      {891.2, 0.2434},  // (1,0)
      {898.3, 0.0027},  // (6,6)
  };
}

constexpr const char* kRedSource =
    "A-coefficients of Storey and Zeippen 2000: 2.997 to 1; measured 2.997 ± 0.016 (Sharpee and Slanger "
    "2006, J. Phys. Chem. A 110, 6707), older figures 3.1";
constexpr const char* kVioletSource =
    "A-coefficients of the common upper level, 1.10e7 to 3.35e6 s⁻¹ (Vallance Jones 1974, \"Aurora\"); for "
    "air in the dark: scattered sunlight changes it";
constexpr const char* kBandsSource =
    "populations of the upper state measured in aurora (Gattinger and Vallance Jones 1974, Can. J. Phys. 52, "
    "2343) times the Einstein coefficients of Vallance Jones 1974, \"Aurora\"";
constexpr const char* kFirstPositiveSource =
    "6.0 photons per photon of the second positive system (114 R to 19 R, modelled for photoelectrons in N2, "
    "Bhardwaj and Jain 2012, arXiv:1202.2276), of which 337.1 nm has 0.267, and 0.605 of them between 570 "
    "and 900 nm; good to a third at best, and half as much again in aurora with a red lower border (Evans "
    "and Vallance Jones 1965, type-B)";

}  // namespace

/// Lifetimes of O(1D) and O(1S): one over the sum of the Einstein coefficients of all their light, as
/// data/electrons/reactions.csv has them (a test compares); Baranoski et al. 2000, section 2.1, have 110 s
/// and 0.7 s, and 427.8 nm below 1 ms. The N2 bands and the allowed lines of O are prompt (microseconds at
/// most; the level B3Pi, v' = 3, lives 1/sum(A) = 6.5 microseconds by Vallance Jones 1974); 520.0 nm, N(2D),
/// 26 hours.
std::vector<EmissionLine> auroral_lines() {
  constexpr double kOxygen1dS = 1.0 / (6.48e-3 + 2.10e-3), kOxygen1sS = 1.0 / (1.26 + 0.134);
  return {
      {337.1, "N2", "second positive (0,0)", 4e-8, "ver_3371", 1.0, "", "N2 second positive (1,1) 333.8", {}},
      {391.4,
       "N2+",
       "first negative (0,0)",
       6e-8,
       "ver_4278",
       3.28,
       kVioletSource,
       "N2+ first negative (1,1) 388.4, N2 second positive (2,5) 394.2 and (3,6) 389.4",
       {}},
      {427.8,
       "N2+",
       "first negative (0,1)",
       6e-8,
       "ver_4278",
       1.0,
       "",
       "N2+ first negative (1,2) 423.7, N2 second positive (1,5) 426.8, N2 Vegard-Kaplan (4,15)",
       {}},
      {520.0, "N", "(2D)-(4S)", 94000.0, "ver_5200", 1.0, "", "N2+ first negative (0,3) 522.8", {}},
      {557.7, "O", "(1S)-(1D)", kOxygen1sS, "ver_5577", 1.0, "", "", {}},
      {630.0,
       "O",
       "(1D)-(3P)",
       kOxygen1dS,
       "ver_6300",
       1.0,
       "",
       "N2 first positive (10,7) 632.3 and (11,8) 625.3",
       {}},
      {636.4,
       "O",
       "(1D)-(3P)",
       kOxygen1dS,
       "ver_6300",
       1.0 / 2.997,
       kRedSource,
       "N2 first positive (9,6) 639.8",
       {}},
      {670.5, "N2", "first positive, 29 bands of 590 to 898 nm, (5,2) 670.5 among them", 6.5e-6, "ver_3371",
       13.6, kFirstPositiveSource, "N2+ Meinel (3,0) 687.4, (4,1) 706.4, (2,0) 785.3 and more",
       first_positive_bands(), kBandsSource},
      {777.4,
       "O",
       "(5P)-(5S)",
       3e-8,
       "ver_7774",
       1.0,
       "",
       "N2 first positive (2,0) 775.4: 30 to 50 % of what a filter of a few nm passes (Oyama et al. 2018, "
       "doi:10.1186/s40623-018-0936-z)",
       {}},
      {844.6,
       "O",
       "(3P)-(3S)",
       3e-8,
       "ver_8446",
       1.0,
       "",
       "N2 first positive (4,3) 837.0 and (3,2) 854.2",
       {}},
  };
}

bool is_auroral(const EmissionLine& line) { return line.is_own || line.table_column[0] != '\0'; }

namespace {

std::vector<EmissionLine> all_lines() {
  std::vector<EmissionLine> lines = auroral_lines();
  for (const EmissionLine& line : nebular_lines()) lines.push_back(line);
  for (const EmissionLine& line : solar_lines()) lines.push_back(line);
  for (const EmissionLine& line : subauroral_lines()) lines.push_back(line);
  std::sort(lines.begin(), lines.end(),
            [](const EmissionLine& a, const EmissionLine& b) { return a.wavelength_nm < b.wavelength_nm; });
  for (EmissionLine& line : lines)
    if (line.components.empty()) line.components = {{line.wavelength_nm, 1.0}};
  return lines;
}

std::vector<double> wavelengths() {
  std::vector<double> lines;
  for (const EmissionLine& line : emission_lines()) lines.push_back(line.wavelength_nm);
  return lines;
}

}  // namespace

const std::vector<EmissionLine>& emission_lines() {
  static const std::vector<EmissionLine> lines = all_lines();
  return lines;
}

const EmissionLine* find_emission_line(double wavelength_nm) {
  for (const EmissionLine& line : emission_lines())
    if (std::abs(line.wavelength_nm - wavelength_nm) < kSameLineNm) return &line;
  return nullptr;
}

const std::vector<double>& known_emission_lines_nm() {
  static const std::vector<double> lines = wavelengths();
  return lines;
}

std::vector<LineComponent> line_components(double wavelength_nm) {
  const EmissionLine* line = find_emission_line(wavelength_nm);
  return line == nullptr ? std::vector<LineComponent>{{wavelength_nm, 1.0}} : line->components;
}

int line_index(const std::vector<double>& lines_nm, double line_nm) {
  const EmissionLine* line = find_emission_line(line_nm);
  for (std::size_t l = 0; l < lines_nm.size(); ++l)
    if (line != nullptr ? find_emission_line(lines_nm[l]) == line
                        : std::abs(lines_nm[l] - line_nm) < kSameLineNm)
      return static_cast<int>(l);
  return -1;
}

int line_in_angstrom(double line_nm) { return static_cast<int>(std::lround(line_nm * 10.0)); }

std::string line_name(double line_nm) { return std::to_string(line_in_angstrom(line_nm)); }

}  // namespace vegard::sim
