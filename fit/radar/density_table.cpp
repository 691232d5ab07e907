#include "fit/radar/density_table.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <set>

#include <fmt/format.h>

#include "sim/base/array/array_format.h"
#include "sim/base/error.h"
#include "sim/base/file/csv_table.h"
#include "sim/base/file/input_file.h"
#include "sim/base/number/constants.h"
#include "sim/base/text.h"

namespace vegard::fit {
namespace density_table {

constexpr double kCm3PerM3 = 1e-6;
constexpr const char* kExpected =
    "CSV with altitude_km, density_m3 and density_m3_error, or an HDF5 file of Madrigal";

/// One measurement.
struct Gate {
  double time_s = sim::kNaN, altitude_km = 0.0, density_cm3 = 0.0, sigma_cm3 = 0.0;
  int line = 0;  ///< of a text file
  double latitude_deg = sim::kNaN, longitude_deg = sim::kNaN;
};

std::vector<Gate> gates_of_csv(const std::string& text, const std::string& file) {
  const sim::CsvTable table = sim::read_csv_table(text, file);
  if (!table.has("density_m3") && !table.has("density_cm3"))
    throw sim::unreadable(file, "no column is a density in a known unit")
        .expected("a column density_m3 or density_cm3");
  const bool is_per_m3 = table.has("density_m3");
  const std::string name = is_per_m3 ? "density_m3" : "density_cm3", error_name = name + "_error";
  if (!table.has(error_name))
    throw sim::unreadable(file, "the densities have no errors")
        .expected("a column " + error_name + ", their standard deviations");
  const std::vector<double>&altitudes = table.column("altitude_km"), &densities = table.column(name),
        &errors = table.column(error_name);
  const double unit = is_per_m3 ? kCm3PerM3 : 1.0;
  const bool has_places = table.has("latitude_deg") && table.has("longitude_deg");
  std::vector<Gate> gates;
  for (std::size_t r = 0; r < table.rows(); ++r) {
    if (!(errors[r] > 0.0))
      throw table.bad_row(r, fmt::format("the error {:g} of a density is not above 0", errors[r]))
          .key(error_name)
          .expected("a standard deviation");
    gates.push_back({table.has("time_s") ? table.column("time_s")[r] : sim::kNaN, altitudes[r],
                     unit * densities[r], unit * errors[r], table.lines[r]});
    if (!has_places) continue;
    gates.back().latitude_deg = table.column("latitude_deg")[r];
    gates.back().longitude_deg = table.column("longitude_deg")[r];
  }
  return gates;
}

/// The columns of a Madrigal table by their names in small letters.
class MadrigalTable {
 public:
  explicit MadrigalTable(const std::string& file) : file_(file), arrays_(sim::open_array_file(file)) {
    for (const sim::StoredArray& array : arrays_->arrays()) {
      const std::size_t slash = array.name.rfind('/');
      if (array.dims.size() != 1 || slash == std::string::npos || array.kind == sim::ArrayKind::text)
        continue;
      if (array.name.substr(0, slash) == "Data/Table Layout")
        columns_[sim::lowered(array.name.substr(slash + 1))] = &array;
    }
    if (columns_.empty())
      throw sim::unreadable(file, "it has no table 'Data/Table Layout'").expected(kExpected);
  }

  bool has(const std::string& name) const { return columns_.count(name) > 0; }
  std::vector<double> column(const std::string& name) const {
    const auto found = columns_.find(name);
    if (found == columns_.end())
      throw sim::unreadable(file_, "the table 'Data/Table Layout' has no column " + name).expected(kExpected);
    return arrays_->read_numbers(*found->second);
  }

 private:
  std::string file_;
  std::unique_ptr<sim::ArrayFile> arrays_;
  std::map<std::string, const sim::StoredArray*> columns_;
};

std::vector<bool> rows_of_beam(const MadrigalTable& table, const std::string& file, std::size_t rows,
                               std::optional<double> beam) {
  std::vector<bool> is_kept(rows, true);
  if (!table.has("beamid")) return is_kept;
  const std::vector<double> beams = table.column("beamid");
  std::set<double> all;
  for (const double one : beams)
    if (std::isfinite(one)) all.insert(one);
  std::vector<std::string> words;
  for (const double one : all) words.push_back(fmt::format("{:g}", one));
  if (all.size() > 1 && !beam)
    throw sim::unreadable(file, fmt::format("it has {} beams", all.size()))
        .expected("one of " + sim::joined(words) + " by --beam, or beam of [[fit.radar]]");
  if (beam && all.count(*beam) == 0)
    throw sim::unreadable(file, fmt::format("it has no beam {:g}", *beam))
        .expected("one of " + sim::joined(words));
  for (std::size_t r = 0; r < rows; ++r) is_kept[r] = std::isfinite(beams[r]) && (!beam || beams[r] == *beam);
  return is_kept;
}

std::vector<Gate> gates_of_madrigal(const std::string& file, std::optional<double> beam) {
  const MadrigalTable table(file);
  const bool is_log = !table.has("ne"), has_log_error = !table.has("dne");
  if (is_log && !table.has("nel"))
    throw sim::unreadable(file, "it has no density of electrons").expected("a column ne or nel");
  if (has_log_error && !table.has("dnel"))
    throw sim::unreadable(file, "the densities have no errors").expected("a column dne or dnel");
  const std::vector<double> altitudes = table.column("gdalt"),
                            densities = table.column(is_log ? "nel" : "ne"),
                            errors = table.column(has_log_error ? "dnel" : "dne"),
                            begins = table.column("ut1_unix"), ends = table.column("ut2_unix");
  const std::vector<bool> is_kept = rows_of_beam(table, file, altitudes.size(), beam);
  const bool has_places = table.has("gdlat") && table.has("glon");
  const std::vector<double> latitudes = has_places ? table.column("gdlat") : std::vector<double>(),
                            longitudes = has_places ? table.column("glon") : std::vector<double>();
  constexpr double kLeastLogOfError = 4.0, kTen = 10.0;
  std::vector<Gate> gates;
  for (std::size_t r = 0; r < altitudes.size(); ++r) {
    const double per_m3 = is_log ? std::pow(kTen, densities[r]) : densities[r];
    const double error = !has_log_error                  ? errors[r]
                         : errors[r] >= kLeastLogOfError ? std::pow(kTen, errors[r])
                                                         : std::log(kTen) * errors[r] * per_m3;
    const double time_s = 0.5 * (begins[r] + ends[r]);
    // Gates without an echo are NaN, or have no error. Whose time is unknown belongs to no profile.
    if (!is_kept[r] || !std::isfinite(time_s) || !std::isfinite(altitudes[r]) || !std::isfinite(per_m3) ||
        !(error > 0.0) || !std::isfinite(error))
      continue;
    gates.push_back({time_s, altitudes[r], kCm3PerM3 * per_m3, kCm3PerM3 * error, 0});
    if (!has_places) continue;
    gates.back().latitude_deg = latitudes[r];
    gates.back().longitude_deg = longitudes[r];
  }
  return gates;
}

/// Altitudes that differ by less are one.
constexpr double kSameKm = 0.05;

std::size_t place_of(const std::vector<double>& altitudes, double altitude_km) {
  const auto after = std::lower_bound(altitudes.begin(), altitudes.end(), altitude_km - kSameKm);
  return static_cast<std::size_t>(after - altitudes.begin());
}

/// Throws Error(unreadable_input) for numbers that no ionosphere has and no radar measures.
void require_physical(const Gate& gate, const std::string& file) {
  constexpr double kMostPerM3 = 1e14, kLeastShare = 1e-4;
  const double density_m3 = gate.density_cm3 / kCm3PerM3, sigma_m3 = gate.sigma_cm3 / kCm3PerM3;
  if (std::abs(density_m3) <= kMostPerM3 && sigma_m3 >= kLeastShare * std::abs(density_m3)) return;
  throw sim::unreadable(file, fmt::format("a density of {:g} m^-3 with the error {:g} m^-3 at {:g} km",
                                          density_m3, sigma_m3, gate.altitude_km))
      .line(gate.line)
      .expected(
          fmt::format("at most {:g} m^-3, with an error of at least {:g} of it", kMostPerM3, kLeastShare))
      .hint("in which unit are they?");
}

DensityTable table_of(std::vector<Gate> gates, const std::string& file, double least_km, double most_km) {
  gates.erase(std::remove_if(gates.begin(), gates.end(),
                             [&](const Gate& gate) {
                               return !(gate.altitude_km >= least_km && gate.altitude_km <= most_km);
                             }),
              gates.end());
  for (const Gate& gate : gates) require_physical(gate, file);
  DensityTable table;
  table.file = file;
  std::vector<double> altitudes, times;
  for (const Gate& gate : gates) altitudes.push_back(gate.altitude_km), times.push_back(gate.time_s);
  std::sort(altitudes.begin(), altitudes.end());
  for (const double altitude : altitudes)
    if (table.altitude_km.empty() || altitude - table.altitude_km.back() > kSameKm)
      table.altitude_km.push_back(altitude);
  constexpr std::size_t kMostAltitudes = 300, kMostProfiles = 20000;
  const bool has_times = !times.empty() && std::isfinite(times.front());
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  if (!has_times) times.assign(1, sim::kNaN);
  if (table.altitude_km.size() > kMostAltitudes || times.size() > kMostProfiles)
    throw sim::unreadable(
        file, fmt::format("it has {} altitudes and {} times", table.altitude_km.size(), times.size()))
        .expected(fmt::format("at most {} altitudes, the same at all times, and {} times", kMostAltitudes,
                              kMostProfiles));
  const std::vector<double> unknown(table.altitude_km.size(), sim::kNaN);
  for (const double time : times) table.profiles.push_back({time, unknown, unknown, unknown, unknown});
  for (const Gate& gate : gates) {
    const auto at = has_times ? std::lower_bound(times.begin(), times.end(), gate.time_s) : times.begin();
    DensityProfile& profile = table.profiles[static_cast<std::size_t>(at - times.begin())];
    const std::size_t place = place_of(table.altitude_km, gate.altitude_km);
    if (std::isfinite(profile.density_cm3[place]))
      throw sim::unreadable(file, fmt::format("there are two densities at {:g} km", gate.altitude_km))
          .line(gate.line)
          .expected("one at each altitude" + std::string(has_times ? " and time" : ", or a column time_s"));
    profile.density_cm3[place] = gate.density_cm3;
    profile.sigma_cm3[place] = gate.sigma_cm3;
    profile.latitude_deg[place] = gate.latitude_deg;
    profile.longitude_deg[place] = gate.longitude_deg;
  }
  int most = 0;
  for (const DensityProfile& profile : table.profiles) most = std::max(most, profile.measured());
  if (most < kLeastAltitudes)
    throw sim::unreadable(file, fmt::format("{} has {} altitude{} from {:g} to {:g} km",
                                            has_times ? "its fullest profile" : "the profile", most,
                                            most == 1 ? "" : "s", least_km, most_km))
        .expected(fmt::format("at least {}", kLeastAltitudes));
  return table;
}

}  // namespace density_table

int DensityProfile::measured() const {
  return static_cast<int>(std::count_if(density_cm3.begin(), density_cm3.end(),
                                        [](double density) { return std::isfinite(density); }));
}

bool DensityTable::has_times() const { return std::isfinite(profiles.front().time_s); }

DensityTable density_table_of_csv(const std::string& text, const std::string& name, double least_km,
                                  double most_km) {
  return density_table::table_of(density_table::gates_of_csv(text, name), name, least_km, most_km);
}

DensityTable read_density_table(const std::string& file, double least_km, double most_km,
                                std::optional<double> beam) {
  using namespace density_table;
  if (sim::array_format_of(file) != nullptr)
    return table_of(gates_of_madrigal(file, beam), file, least_km, most_km);
  if (beam)
    throw sim::Error(sim::ErrorKind::usage, "a text table has one beam")
        .key("--beam")
        .expected("an HDF5 file of Madrigal");
  return density_table_of_csv(sim::input_bytes(file, kExpected), file, least_km, most_km);
}

}  // namespace vegard::fit
