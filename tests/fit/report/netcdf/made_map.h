// The directory of a map, as vegard map writes it, of a few round numbers.
#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "sim/base/picture/fits_io.h"

namespace vegard::tests {

/// A map's directory with a flux of 4 mW m-2 and 2 keV in all of 40 x 40 cells, NaN in the first column.
inline std::string made_map(const std::string& directory, const std::string& time,
                            const std::string& flux = "absolute", const std::string& spectrum = "") {
  std::filesystem::create_directories(directory);
  sim::Image image(40, 40, {"Q", "E0", "Qe", "Ee", "s"});
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x) {
      const float values[] = {x == 0 ? std::nanf("") : 4.0f, 2.0f, 0.1f, 0.2f, 7.0f};
      for (int c = 0; c < 5; ++c) image.at(x, y, c) = values[c];
    }
  std::vector<sim::FitsKeyword> keywords = {
      {"CTYPE1", "EAST", ""},   {"CUNIT1", "km", ""},    {"CRPIX1", 1.0, ""},     {"CRVAL1", -40.0, ""},
      {"CDELT1", 2.0, ""},      {"CTYPE2", "NORTH", ""}, {"CUNIT2", "km", ""},    {"CRPIX2", 1.0, ""},
      {"CRVAL2", 100.0, ""},    {"CDELT2", 2.0, ""},     {"HEIGHTKM", 110.0, ""}, {"SITELAT", 65.1, ""},
      {"SITELONG", -147.4, ""}, {"FLUXCAL", flux, ""}};
  if (!time.empty()) keywords.push_back({"DATE-OBS", time, ""});
  if (!spectrum.empty()) keywords.push_back({"SPECTRUM", spectrum, ""});
  sim::write_fits(directory + "/precipitation.fits", image, keywords, true);
  std::ofstream(directory + "/map.json")
      << R"({"kind": "vegard map", "version": "1", "verdict_line": "good", "verdicts": [{"quantity": "energy",
 "verdict": "good", "value": "2 keV", "reason": "known"}], "chi2_per_value": 1.5, "photos": []})";
  std::ofstream(directory + "/curtains.csv")
      << "curtain,point,east_km,north_km,distance_km,azimuth_deg,lower_border_km,energy_flux_mw_m2,energy_"
         "kev,"
         "width_km,lateral_error_km,distance_error_km,lower_border_error_km,energy_flux_error_mw_m2,"
         "energy_error_kev,width_error_km,border_in_view\n1,1,0,150,150,0,101,4,2,3,0.1,0.2,0.3,0.4,0.5,0.6,"
         "1\n"
         "1,2,5,150,150,2,102,4,2,3,0.1,0.2,0.3,0.4,0.5,0.6,1\n2,1,9,160,160,3,103,4,2,3,0.1,,0.3,0.4,0.5,0."
         "6,1\n";
  return directory;
}

}  // namespace vegard::tests
