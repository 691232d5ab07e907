#include "fit/report/table/free_profiles_csv.h"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "sim/base/file/csv_text.h"
#include "sim/base/version.h"
#include "sim/scene/lines/emission_lines.h"

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
  std::vector<double> lines;  // of all sheets, in the order of their first mention
  for (const FreeProfile& profile : result.profiles)
    if (std::find(lines.begin(), lines.end(), profile.wavelength_nm) == lines.end())
      lines.push_back(profile.wavelength_nm);
  std::string text = head(result) + "sheet,altitude_km";
  for (const double line_nm : lines) {
    const std::string line = sim::line_name(line_nm);
    text += ",rate_" + line + ",lower_" + line + ",upper_" + line;
  }
  text += "\n";
  for (std::size_t first = 0; first < result.profiles.size();) {
    std::size_t end = first;
    while (end < result.profiles.size() && result.profiles[end].sheet == result.profiles[first].sheet) ++end;
    // A line may not be free in this sheet, or be dark where another is not.
    std::map<double, std::vector<std::string>> rows;  // [altitude][line]
    for (std::size_t p = first; p < end; ++p) {
      const FreeProfile& profile = result.profiles[p];
      const auto column = std::find(lines.begin(), lines.end(), profile.wavelength_nm) - lines.begin();
      for (std::size_t i = 0; i < profile.altitude_km.size(); ++i) {
        std::vector<std::string>& cells =
            rows.try_emplace(profile.altitude_km[i], lines.size(), ",,,").first->second;
        cells[column] = "," + csv_number(profile.rate[i]) + "," + csv_number(profile.lower[i]) + "," +
                        csv_number(profile.upper[i]);
      }
    }
    for (const auto& [altitude_km, cells] : rows) {
      text += csv_cell(result.profiles[first].sheet) + "," + csv_number(altitude_km);
      for (const std::string& cell : cells) text += cell;
      text += "\n";
    }
    first = end;
  }
  return text;
}

}  // namespace vegard::fit
