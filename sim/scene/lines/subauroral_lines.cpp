#include "sim/scene/lines/emission_lines.h"

namespace vegard::sim {
namespace {

constexpr double kSteveNm = 610.0, kSteveFirstNm = 400.0, kSteveLastNm = 800.0, kSteveStepNm = 10.0;

constexpr const char* kSteveSource =
    "as many photons per wavelength everywhere (ESTIMATED, to a half): spectra of STEVE are a continuum over "
    "all 400 to 800 nm of the spectrograph, without lines of its own (Gillies et al. 2019, "
    "doi:10.1029/2019GL083272; Liang et al. 2019, doi:10.1029/2019GL085639); every 10 nm";

std::vector<LineComponent> steve_continuum() {
  std::vector<LineComponent> bands;
  for (double nm = kSteveFirstNm; nm <= kSteveLastNm; nm += kSteveStepNm) bands.push_back({nm, 1.0});
  for (LineComponent& band : bands) band.share = 1.0 / static_cast<double>(bands.size());
  return bands;
}

}  // namespace

std::vector<EmissionLine> subauroral_lines() {
  return {{kSteveNm, "*", "continuum of STEVE, 400 to 800 nm", 0.0, "", 0.0, "", "", steve_continuum(),
           kSteveSource}};
}

bool is_subauroral(const EmissionLine& line) { return line.wavelength_nm == kSteveNm; }

}  // namespace vegard::sim
