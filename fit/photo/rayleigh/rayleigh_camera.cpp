#include "fit/photo/rayleigh/rayleigh_camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "sim/base/error.h"
#include "sim/base/file/csv_table.h"
#include "sim/base/file/input_file.h"
#include "sim/base/text.h"
#include "sim/scene/rows/complaint.h"
#include "sim/scene/table/checked_table.h"
#include "sim/view/sky/star_photometry.h"

namespace vegard::fit {
namespace {

using sim::CheckedTable;
using sim::scene_error;

constexpr double kMaxCounts = 1e9, kMinNm = 300.0, kMaxNm = 1200.0;
/// The range in which the spectra of stars are known (sim/view/sky/star_photometry.h).
constexpr double kMinStarNm = 400.0, kMaxStarNm = 900.0;
constexpr const char* kFactorKey = "rayleigh_per_count_s";
constexpr const char* kFactorErrorKey = "rayleigh_per_count_s_error";

/// A file's name as the camera's file has it, seen from where we are.
std::string beside(const std::string& camera_file, const std::string& name) {
  const std::filesystem::path path(name);
  return path.is_absolute() ? name : (std::filesystem::path(camera_file).parent_path() / path).string();
}

std::optional<double> given_number(CheckedTable& table, const std::string& key, double least, double most) {
  if (!table.has(key)) return std::nullopt;
  double value = 0.0;
  table.number(key, least, most, value);
  return value;
}

/// A number above 0.
void positive_number(CheckedTable& table, const std::string& key, double most, double& value) {
  if (!table.has(key)) return;
  table.number(key, 0.0, most, value);
  if (!(value > 0.0)) throw scene_error({"it is 0", "a number above 0", ""}, table.at(key));
}

/// Reads the keys that may be in the file's head for all filters, and in a filter's table for this one.
void read_sensor(CheckedTable& table, RayleighFilter& filter) {
  if (table.has("dark") && table.has("dark_counts"))
    throw scene_error({"there are two dark levels", "'dark', a picture, or 'dark_counts', a number", ""},
                      table.at("dark"));
  if (table.has("dark")) {
    filter.dark_file = beside(table.file(), table.text("dark", "the file of a dark picture, in quotes"));
  } else if (table.has("dark_counts")) {
    filter.dark_file.clear();
    table.number("dark_counts", -kMaxCounts, kMaxCounts, filter.dark_counts);
  }
  table.number("dark_error_counts", 0.0, kMaxCounts, filter.dark_error_counts);
  if (table.has("flat"))
    filter.flat_file = beside(table.file(), table.text("flat", "the file of a flat field, in quotes"));
  table.number("flat_error", 0.0, 1.0, filter.flat_error);
  if (table.has("gain_e_per_count")) {
    double gain = 0.0;
    positive_number(table, "gain_e_per_count", 1e6, gain);
    filter.gain_e_per_count = gain;
  }
  table.number("read_noise_counts", 0.0, kMaxCounts, filter.read_noise_counts);
  if (table.has("exposure_s")) {
    double exposure_s = 0.0;
    positive_number(table, "exposure_s", 1e5, exposure_s);
    filter.exposure_s = exposure_s;
  }
  const std::string channel = table.text("channel", "\"red\", \"green\" or \"blue\"");
  if (!channel.empty()) {
    if (channel != "red" && channel != "green" && channel != "blue")
      throw scene_error({"'" + channel + "' is no channel", "\"red\", \"green\" or \"blue\"", ""},
                        table.at("channel"));
    filter.channel = channel;
  }
}

/// The curve of a filter, wavelength_nm and transmission.
void read_transmission(CheckedTable& table, FilterBand& band) {
  const std::string file =
      beside(table.file(), table.text("transmission", "a CSV of wavelength_nm and transmission, in quotes"));
  for (const char* other : {"centre_nm", "width_nm"})
    if (table.has(other))
      throw scene_error(
          {"the filter has a curve already", "'transmission', or 'centre_nm' and 'width_nm'", ""},
          table.at(other));
  constexpr std::size_t kMaxCurveBytes = std::size_t{1} << 24;
  const sim::CsvTable curve =
      sim::read_csv_table(sim::input_bytes(file, "a filter's curve (CSV)", kMaxCurveBytes), file);
  curve.require_increasing("wavelength_nm");
  curve.require_within("wavelength_nm", kMinStarNm, kMaxStarNm);
  band.table_nm = curve.column("wavelength_nm");
  band.transmission = curve.column("transmission");
  curve.require_within("transmission", 0.0, kMaxCounts);
  if (band.table_nm.size() < 2)
    throw curve.bad_row(0, "this is the only row of a filter's curve")
        .expected("two or more rows with increasing wavelengths");
}

void read_band(CheckedTable& table, FilterBand& band) {
  if (!table.has("line_nm"))
    throw scene_error({"'line_nm' is missing", "the wavelength of the line whose rayleighs are meant", ""},
                      table.at("line_nm"));
  table.number("line_nm", kMinNm, kMaxNm, band.line_nm);
  band.centre_nm = band.line_nm;
  if (table.has("transmission")) {
    read_transmission(table, band);
  } else {
    table.number("centre_nm", kMinNm, kMaxNm, band.centre_nm);
    positive_number(table, "width_nm", 100.0, band.width_nm);
  }
  table.number("width_error", 0.0, 1.0, band.width_error);
  const bool has_band = band.width_nm > 0.0 || !band.table_nm.empty();
  if (has_band && !(transmission_at(band, band.line_nm) > 0.0))
    throw scene_error({fmt::format("the filter lets nothing through at {:g} nm", band.line_nm),
                       "a band with the line in it", ""},
                      table.at("line_nm"));
  if (!band.table_nm.empty() || band.width_nm == 0.0) return;
  if (band.centre_nm - 0.5 * band.width_nm < kMinStarNm || band.centre_nm + 0.5 * band.width_nm > kMaxStarNm)
    throw scene_error(
        {"the light of stars is not known in all of the band",
         fmt::format("a band within {:g} to {:g} nm", kMinStarNm, kMaxStarNm), "leave 'width_nm' out"},
        table.at("width_nm"));
}

void read_factor(CheckedTable& table, RayleighFilter& filter) {
  const std::optional<double> value = given_number(table, kFactorKey, 0.0, kMaxCounts);
  const std::optional<double> error = given_number(table, kFactorErrorKey, 0.0, kMaxCounts);
  if (value && !(*value > 0.0)) throw scene_error({"it is 0", "a number above 0", ""}, table.at(kFactorKey));
  if (error && !value)
    throw scene_error({"an error without its number", std::string("'") + kFactorKey + "' as well", ""},
                      table.at(kFactorErrorKey));
  if (value) filter.factor = RayleighFactor{*value, error.value_or(0.0)};
}

RayleighCamera camera_of(const toml::table& document, const std::string& file) {
  RayleighCamera camera;
  camera.file = file;
  CheckedTable root(document, file, "", 1);
  camera.name = root.text("name");
  RayleighFilter common;
  read_sensor(root, common);
  root.each("filter", [&](CheckedTable& table) {
    RayleighFilter filter = common;
    filter.line = table.line();
    const std::string expected = "a name for the filter, such as \"green\"";
    filter.name = table.text("name", expected);
    if (filter.name.empty()) throw scene_error({"'name' is missing", expected, ""}, table.at("name"));
    for (const RayleighFilter& other : camera.filters)
      if (other.name == filter.name)
        throw scene_error({"two filters are called '" + filter.name + "'", "a name of its own for each", ""},
                          table.at("name"));
    read_sensor(table, filter);
    read_band(table, filter.band);
    read_factor(table, filter);
    camera.filters.push_back(filter);
  });
  root.refuse_unknown();
  if (camera.filters.empty())
    throw scene_error({"there is no filter", "[[filter]]", ""}, {file, 1, "filter"});
  return camera;
}

std::vector<std::string> lines_of_text(const std::string& text) {
  std::vector<std::string> lines(1);
  for (const char c : text) {
    lines.back() += c;
    if (c == '\n') lines.emplace_back();
  }
  if (lines.back().empty()) lines.pop_back();
  return lines;
}

/// The integrals over the band of what `of` gives: one times the transmission, and of the transmission alone.
template <class Spectrum>
double integral_over_band(const FilterBand& band, const Spectrum& per_nm) {
  const double first = band.table_nm.empty() ? band.centre_nm - 0.5 * band.width_nm : band.table_nm.front();
  const double last = band.table_nm.empty() ? band.centre_nm + 0.5 * band.width_nm : band.table_nm.back();
  constexpr double kStep_nm = 0.1;
  constexpr int kMaxSteps = 5000;
  const int steps = std::clamp(static_cast<int>(std::ceil((last - first) / kStep_nm)), 20, kMaxSteps);
  const double step = (last - first) / steps;
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double nm = first + (i + 0.5) * step;
    sum += per_nm(nm) * transmission_at(band, nm) * step;
  }
  return sum;
}

}  // namespace

RayleighCamera parse_rayleigh_camera(const std::string& text, const std::string& file) {
  return camera_of(sim::checked_toml(text, file), file);
}

std::string rayleigh_camera_text(const std::string& file) {
  return sim::input_bytes(file, "a camera's counts (TOML)", sim::kMaxTomlBytes);
}

RayleighCamera read_rayleigh_camera(const std::string& file) {
  return parse_rayleigh_camera(rayleigh_camera_text(file), file);
}

const RayleighFilter& filter_called(const RayleighCamera& camera, const std::string& name) {
  if (name.empty() && camera.filters.size() == 1) return camera.filters.front();
  std::vector<std::string> names;
  for (const RayleighFilter& filter : camera.filters) {
    if (filter.name == name) return filter;
    names.push_back(filter.name);
  }
  throw sim::Error(sim::ErrorKind::usage,
                   name.empty() ? "it has several filters" : "it has no filter '" + name + "'")
      .file(camera.file)
      .key("--filter")
      .expected(sim::joined(names))
      .hint(name.empty() ? "" : sim::nearest_hint(name, names));
}

std::string with_factor(const std::string& text, const std::string& file, const std::string& filter,
                        const RayleighFactor& factor) {
  const toml::table document = sim::checked_toml(text, file);
  const RayleighCamera before = camera_of(document, file);
  const RayleighFilter& wanted = filter_called(before, filter);
  const auto index = static_cast<std::size_t>(&wanted - before.filters.data());
  const toml::table& table = *document.get("filter")->as_array()->get(index)->as_table();
  std::vector<std::string> lines = lines_of_text(text);
  // Old numbers are removed; the new ones follow the filter's line_nm.
  const auto line_of_key = [&](const char* key) {
    const toml::node* node = table.get(key);
    return node != nullptr ? static_cast<std::size_t>(sim::line_of(*node)) : std::size_t{0};
  };
  const std::size_t after = line_of_key("line_nm");
  for (const char* key : {kFactorKey, kFactorErrorKey})
    if (const std::size_t line = line_of_key(key); line > 0 && line <= lines.size() && line != after)
      lines[line - 1].clear();
  std::string written;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    written += lines[i];
    if (i + 1 != after) continue;
    if (!written.empty() && written.back() != '\n') written += '\n';
    written +=
        fmt::format("{} = {:.6g}\n{} = {:.3g}\n", kFactorKey, factor.value, kFactorErrorKey, factor.error);
  }
  // It is written if it reads as it was meant.
  const auto is_written = [&] {
    try {
      const RayleighCamera now = parse_rayleigh_camera(written, file);
      const auto& found = filter_called(now, wanted.name).factor;
      return now.filters.size() == before.filters.size() && found &&
             std::abs(found->value / factor.value - 1.0) < 1e-5;
    } catch (const sim::Error&) {
      return false;
    }
  };
  if (!is_written())
    throw scene_error(
        {"the filter '" + wanted.name + "' has no room for its factor", "a key a line in [[filter]]", ""},
        {file, wanted.line, kFactorKey});
  return written;
}

double transmission_at(const FilterBand& band, double wavelength_nm) {
  if (band.table_nm.empty())
    return std::abs(wavelength_nm - band.centre_nm) <= 0.5 * band.width_nm ? 1.0 : 0.0;
  const auto after = std::upper_bound(band.table_nm.begin(), band.table_nm.end(), wavelength_nm);
  if (after == band.table_nm.begin()) return 0.0;
  if (after == band.table_nm.end())
    return wavelength_nm == band.table_nm.back() ? band.transmission.back() : 0.0;
  const auto i = static_cast<std::size_t>(after - band.table_nm.begin());
  const double share = (wavelength_nm - band.table_nm[i - 1]) / (band.table_nm[i] - band.table_nm[i - 1]);
  return (1.0 - share) * band.transmission[i - 1] + share * band.transmission[i];
}

double star_photons_in_band(const FilterBand& band, double magnitude, double colour_index) {
  const double through = integral_over_band(
      band, [&](double nm) { return sim::star_photons_cm2_s_nm(magnitude, colour_index, nm); });
  return through / transmission_at(band, band.line_nm);
}

double middle_of_band_nm(const FilterBand& band) {
  return integral_over_band(band, [](double nm) { return nm; }) /
         integral_over_band(band, [](double) { return 1.0; });
}

}  // namespace vegard::fit
