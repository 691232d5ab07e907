#include "fit/report/columns/column_map_files.h"

#include <array>

#include <fmt/format.h>

#include "sim/base/file/netcdf_dataset.h"
#include "sim/base/number/constants.h"
#include "sim/base/picture/fits_io.h"
#include "sim/base/version.h"

namespace vegard::fit {
namespace {

struct MapPlane {
  const char* name;
  const char* long_name;
  const char* unit;
  const std::vector<float> ColumnMaps::*values;
};
constexpr std::array<MapPlane, 8> kPlanes = {
    {{"energy_flux", "energy flux of the electrons", "mW m-2", &ColumnMaps::flux_mw_m2},
     {"energy", "characteristic energy E0 of the electrons", "keV", &ColumnMaps::energy_kev},
     {"energy_flux_error", "relative standard error of energy_flux", "1", &ColumnMaps::relative_flux_error},
     {"ln_energy_error", "standard error of the logarithm of energy", "1", &ColumnMaps::ln_energy_error},
     {"oxygen_factor", "factor of atomic oxygen", "1", &ColumnMaps::oxygen_factor},
     {"ln_oxygen_error", "standard error of the logarithm of oxygen_factor", "1",
      &ColumnMaps::ln_oxygen_error},
     {"other_energy", "energy of a second solution", "keV", &ColumnMaps::other_energy_kev},
     {"chi2", "chi2 of the brightnesses", "1", &ColumnMaps::chi2}}};

constexpr std::array<ColumnVerdict, 7> kQualities = {
    ColumnVerdict::well_constrained, ColumnVerdict::loosely_constrained, ColumnVerdict::one_sided,
    ColumnVerdict::two_solutions,    ColumnVerdict::contradiction,       ColumnVerdict::no_light,
    ColumnVerdict::not_measured};

std::string quality_words() {
  std::string words;
  for (const ColumnVerdict verdict : kQualities)
    words += fmt::format("{}{} {}", words.empty() ? "" : ", ", static_cast<int>(verdict),
                         column_verdict_name(verdict));
  return words;
}

}  // namespace

std::string encode_column_maps(const ColumnMaps& maps, const InversionFacts& facts, const std::string& name) {
  std::vector<std::string> names;
  for (const MapPlane& plane : kPlanes) names.emplace_back(plane.name);
  names.emplace_back("quality");
  sim::Image image(static_cast<int>(maps.width), static_cast<int>(maps.height), names);
  const std::size_t channels = names.size(), pixels = maps.width * maps.height;
  for (std::size_t i = 0; i < pixels; ++i) {
    for (std::size_t p = 0; p < kPlanes.size(); ++p)
      image.data[i * channels + p] = (maps.*kPlanes[p].values)[i];
    image.data[i * channels + kPlanes.size()] = maps.quality[i];
  }
  std::vector<sim::FitsKeyword> keywords;
  for (std::size_t p = 0; p < kPlanes.size(); ++p)
    keywords.push_back(
        {fmt::format("PLANE{}", p + 1), fmt::format("{}, {}", kPlanes[p].long_name, kPlanes[p].unit), ""});
  keywords.push_back({fmt::format("PLANE{}", channels), "quality: " + quality_words(), ""});
  keywords.push_back({"SPECTRUM", facts.spectrum, "of the electrons"});
  keywords.push_back({"TABLES", facts.tables, "emission tables"});
  keywords.push_back({"MODELERR", facts.model_error, "error of the tables, share of a line"});
  keywords.push_back({"ORIGIN", "vegard " + sim::version(), ""});
  return sim::encode_fits(image, keywords, name);
}

void write_column_maps_netcdf(const ColumnMaps& maps, const InversionFacts& facts, const std::string& path,
                              const std::string& shown_name) {
  sim::NetcdfDataset dataset(
      "energy and energy flux of electrons by line brightnesses",
      "vegard " + sim::version() + ", electrons: " + facts.spectrum + ", emission tables: " + facts.tables);
  dataset.attribute("model_error", fmt::format("{:g}", facts.model_error));
  dataset.attribute("comment", "rows from the top of the line maps down");
  dataset.dimension("y", maps.height);
  dataset.dimension("x", maps.width);
  for (const MapPlane& p : kPlanes) {
    const std::vector<float>& of = maps.*p.values;
    dataset.real(p.name, p.long_name, p.unit, {"y", "x"}, std::vector<double>(of.begin(), of.end()));
  }
  std::vector<std::string> words;
  for (const ColumnVerdict verdict : kQualities) words.emplace_back(column_verdict_name(verdict));
  dataset.flags("quality", "quality of a pixel", words, {"y", "x"},
                std::vector<int>(maps.quality.begin(), maps.quality.end()));
  dataset.write(path, shown_name);
}

std::string column_maps_text(const ColumnMaps& maps) {
  std::array<std::size_t, kQualities.size()> counts{};
  for (const std::uint8_t quality : maps.quality) ++counts[quality];
  std::string text = fmt::format("{} x {} pixels\n", maps.width, maps.height);
  for (const ColumnVerdict verdict : kQualities)
    text +=
        fmt::format("  {:>9}  {}\n", counts[static_cast<std::size_t>(verdict)], column_verdict_name(verdict));
  return text;
}

}  // namespace vegard::fit
