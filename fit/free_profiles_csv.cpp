#include "fit/free_profiles_csv.h"

#include <cmath>

#include "fit/csv_text.h"
#include "sim/base/version.h"
#include "sim/scene/emission_lines.h"

namespace vegard::fit {
namespace {

std::string head(const FitResult& result) {
  std::string text = csv_comment("height profiles as fitted, free of any electrons");
  text += csv_comment("vegard: " + sim::version());
  for (const InputFile& input : result.inputs)
    text += csv_comment(input.role + ": " + input.name + " (sha256 " + input.sha256 + ")");
  text +=
      csv_comment("rate_*: volume emission rate by wavelength in angstrom, photons cm-3 s-1 per mW m-2 of");
  text += csv_comment(
      "energy_flux_mw_m2; where gains were solved for, only its course and the lines' ratios mean");
  text += csv_comment("anything, and the column of 557.7 nm is that of the start");
  text += csv_comment("lower_*, upper_*: of the 68 % interval at each altitude, given what was not free");
  return text;
}

}  // namespace

std::string free_profiles_csv(const FitResult& result) {
  std::string text = head(result);
  for (std::size_t first = 0; first < result.profiles.size();) {
    std::size_t end = first;
    while (end < result.profiles.size() && result.profiles[end].sheet == result.profiles[first].sheet) ++end;
    if (first == 0) {
      text += "sheet,altitude_km";
      for (std::size_t p = first; p < end; ++p) {
        const std::string line = sim::line_name(result.profiles[p].wavelength_nm);
        text += ",rate_" + line + ",lower_" + line + ",upper_" + line;
      }
      text += "\n";
    }
    for (std::size_t i = 0; i < result.profiles[first].altitude_km.size(); ++i) {
      text +=
          csv_cell(result.profiles[first].sheet) + "," + csv_number(result.profiles[first].altitude_km[i]);
      for (std::size_t p = first; p < end; ++p)
        text += "," + csv_number(result.profiles[p].rate[i]) + "," + csv_number(result.profiles[p].lower[i]) +
                "," + csv_number(result.profiles[p].upper[i]);
      text += "\n";
    }
    first = end;
  }
  return text;
}

}  // namespace vegard::fit
