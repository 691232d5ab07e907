#include "sim/light/tables/emission_tables.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "sim/base/error.h"
#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/rows/value_words.h"
#include "sim/scene/structs/line_of.h"
#include "sim/scene/table/emission_folder.h"

namespace vegard::sim {
namespace {

constexpr double kMinEnergyKev = 0.1, kMaxEnergyKev = 19.9;  // what a sheet's electrons may have, nearly

CsvTable table_in(const TableFolder& folder, const char* file) {
  return read_csv_table(folder.files.at(file), folder.place + "/" + file);
}

/// Returns the table after checking that height profiles can use it.
EmissionTable checked(const CsvTable& csv, const std::string& energy_column) {
  EmissionTable table(csv, energy_column);
  const std::size_t last = csv.rows() - 1;
  const std::vector<double>&altitudes = table.altitudes_km(), &energies = table.energies_kev();
  if (altitudes.front() > kTablesBottomKm)
    throw csv.bad_row(0, "the altitudes begin at " + short_real_text(altitudes.front()) + " km")
        .expected("from 80 km or below");
  if (altitudes.back() < kTablesTopKm)
    throw csv.bad_row(last, "the altitudes end at " + short_real_text(altitudes.back()) + " km")
        .expected("up to 640 km or above");
  if (energies.front() > kMinEnergyKev)
    throw csv.bad_row(0, "the energies begin at " + short_real_text(energies.front()) + " keV")
        .expected("from " + short_real_text(kMinEnergyKev) + " keV or below");
  if (energies.back() < kMaxEnergyKev)
    throw csv.bad_row(last, "the energies end at " + short_real_text(energies.back()) + " keV")
        .expected("up to " + short_real_text(kMaxEnergyKev) + " keV or above");
  for (const EmissionLine& line : emission_lines())
    if (is_auroral(line)) csv.column(column_of(line, table).name);  // or throws
  return table;
}

/// Returns the columns of the lines, each once.
std::vector<std::string> columns_of_lines(const EmissionTable& table) {
  std::map<std::string, bool> names;
  for (const EmissionLine& line : emission_lines())
    if (is_auroral(line)) names[column_of(line, table).name] = true;
  std::vector<std::string> columns;
  for (const auto& [name, is_there] : names) columns.push_back(name);
  return columns;
}

const EmissionTables& tables_of(const std::shared_ptr<const TableFolder>& folder) {
  static std::mutex mutex;
  // With the folder, so that no other comes to have its address.
  static std::map<std::shared_ptr<const TableFolder>, std::unique_ptr<const EmissionTables>> read;
  const std::lock_guard<std::mutex> lock(mutex);
  std::unique_ptr<const EmissionTables>& tables = read[folder];
  if (!tables) tables = std::make_unique<const EmissionTables>(folder);
  return *tables;
}

const std::string kOxygenPath = "emission.oxygen_factor";

Error oxygen_error(const Scene& scene, int line, const std::string& problem) {
  return Error(ErrorKind::scene, problem).file(scene.file).line(line).key(kOxygenPath);
}

/// Throws Error(scene) for more coefficients of modes than the tables have, and reads the modes of a folder.
void check_modes(const Scene& scene) {
  const bool are_given = !scene.emission.modes.empty();
  if (!are_given && are_built_in_tables(scene.emission.tables)) return;
  const int known = emission_tables(scene).modes().count();
  if (!are_given || static_cast<int>(scene.emission.modes.size()) <= known) return;
  const std::string key = "emission.modes";
  throw Error(ErrorKind::scene, "the emission tables have " + std::to_string(known) + " modes, and " +
                                    std::to_string(scene.emission.modes.size()) + " coefficients are given")
      .file(scene.file)
      .line(line_of(scene, key))
      .key(key)
      .expected(known > 0 ? std::to_string(known) + " at most" : "none, or tables with modes.csv")
      .hint("vegard tables --ensemble writes the modes");
}

}  // namespace

template <class Table>
LineColumn column_of(const EmissionLine& line, const Table& table) {
  const std::string own = "ver_" + line_name(line.wavelength_nm);
  if (table.has(own)) return {own, 1.0};
  return {line.table_column, line.ratio};
}
template LineColumn column_of(const EmissionLine&, const EmissionTable&);
template LineColumn column_of(const EmissionLine&, const MonoEnergeticTable&);

EmissionTables::EmissionTables(std::shared_ptr<const TableFolder> folder)
    : folder_(std::move(folder)),
      maxwellian_(checked(table_in(*folder_, kMaxwellianFile), "E0_keV")),
      flux_factors_(columns_of_lines(maxwellian_), table_in(*folder_, kColumnsFile),
                    table_in(*folder_, kFluxesFile)),
      air_(tables_air(table_in(*folder_, kTablesAirFile), maxwellian_.altitudes_km())) {
  const std::vector<double>& known = flux_factors_.energies_kev();
  if (known.front() <= kMinEnergyKev && known.back() >= kMaxEnergyKev) return;
  const CsvTable csv = table_in(*folder_, kFluxesFile);
  throw csv
      .bad_row(csv.rows() - 1, "the energies at Q_erg 1 go from " + short_real_text(known.front()) + " to " +
                                   short_real_text(known.back()) + " keV")
      .expected("from " + short_real_text(kMinEnergyKev) + " to " + short_real_text(kMaxEnergyKev) +
                " keV or farther");
}

bool EmissionTables::has_mono_file() const { return folder_->files.count(kMonoFile) > 0; }

std::unique_ptr<MonoEnergeticTable> EmissionTables::read_mono() const {
  if (!has_mono_file()) return std::make_unique<MonoEnergeticTable>(maxwellian_, air_);
  const CsvTable csv = table_in(*folder_, kMonoFile);
  EmissionTable mono = checked(csv, "E_keV");
  if (mono.oxygen_factors() != maxwellian_.oxygen_factors())
    throw csv.bad_row(0, "other oxygen factors than " + std::string(kMaxwellianFile) + " has")
        .expected("the same");
  return std::make_unique<MonoEnergeticTable>(std::move(mono));
}

const LightModes& EmissionTables::modes() const {
  std::call_once(modes_read_, [&] {
    if (folder_->files.count(kModesFile) > 0) modes_ = LightModes(table_in(*folder_, kModesFile));
  });
  return modes_;
}

const MonoEnergeticTable& EmissionTables::mono() const {
  std::call_once(mono_made_, [&] { mono_ = read_mono(); });
  return *mono_;
}

const EmissionTables& emission_tables(const std::string& built_in) {
  return tables_of(built_in_tables(built_in));
}

const EmissionTables& emission_tables(const Scene& scene) {
  const std::string& name = scene.emission.tables;
  return scene.emission.folder && !are_built_in_tables(name) ? tables_of(scene.emission.folder)
                                                             : emission_tables(name);
}

EmissionSource emission_source(const Scene& scene) {
  return {emission_tables(scene), scene.emission.oxygen_factor, scene.emission.modes};
}

void add_to_mode(Scene& scene, int mode, double more) {
  std::vector<double>& coefficients = scene.emission.modes;
  const auto k = static_cast<std::size_t>(mode);
  coefficients.resize(std::max(coefficients.size(), k + 1), 0.0);
  coefficients[k] += more;
}

void check_emission_tables(const Scene& scene) {
  check_modes(scene);
  bool is_free = false;
  for (const FreeParameter& free : scene.fit.free) is_free = is_free || free.path == kOxygenPath;
  const double factor = scene.emission.oxygen_factor;
  // Those that come with the program are tested with it, and read when light is first asked for.
  if (factor == 1.0 && !is_free && are_built_in_tables(scene.emission.tables)) return;
  const EmissionTables& tables = emission_tables(scene);
  if (tables.has_mono_file() && !are_built_in_tables(scene.emission.tables)) tables.mono();  // or throws
  const std::vector<double>& factors = tables.maxwellian().oxygen_factors();
  const int line = line_of(scene, kOxygenPath);
  if (factors.size() == 1) {
    if (factor == 1.0 && !is_free) return;
    throw oxygen_error(scene, line, "the emission tables are for one amount of atomic oxygen")
        .expected(is_free ? "no " + kOxygenPath + " in fit.free" : "1")
        .hint("tables of several factors have a column oxygen_factor");
  }
  const auto check = [&](double value, int of_line) {
    if (value < factors.front() || value > factors.back())
      throw oxygen_error(scene, of_line, short_real_text(value) + " is outside of the emission tables")
          .expected("from " + short_real_text(factors.front()) + " to " + short_real_text(factors.back()));
  };
  check(factor, line);
  for (const FreeParameter& free : scene.fit.free)
    if (free.path == kOxygenPath)
      for (const std::optional<double>& value : {free.start, free.min, free.max})
        if (value) check(*value, free.line);
}

void limit_free_oxygen(Scene& scene) {
  for (FreeParameter& free : scene.fit.free) {
    if (free.path != kOxygenPath) continue;
    const std::vector<double>& factors = emission_tables(scene).maxwellian().oxygen_factors();
    if (!free.min) free.min = std::max(factors.front(), kMinOxygenFactor);
    if (!free.max) free.max = std::min(factors.back(), kMaxOxygenFactor);
  }
}

std::vector<StoppingAir> tables_air(const CsvTable& table, const std::vector<double>& altitudes_km) {
  const auto &altitude = table.column("altitude_km"), &temperature = table.column("T_K");
  const auto &o = table.column("nO"), &o2 = table.column("nO2"), &n2 = table.column("nN2");
  constexpr double kAny = std::numeric_limits<double>::max();
  table.require_within("T_K", 1.0, kAny);
  for (const char* gas : {"nO", "nO2", "nN2"}) table.require_within(gas, 0.0, kAny);
  std::vector<StoppingAir> air;
  for (std::size_t r = 0; r < table.rows(); ++r) {
    if (r >= altitudes_km.size() || altitude[r] != altitudes_km[r])
      throw table.bad_row(r, short_real_text(altitude[r]) + " km is no altitude of the emission tables here")
          .expected(r < altitudes_km.size() ? short_real_text(altitudes_km[r]) + " km" : "no more rows")
          .hint("the air has the altitudes of the emission tables, in their order");
    if (!(o[r] + o2[r] + n2[r] > 0.0))
      throw table.bad_row(r, "there is no air").expected("a density above 0");
    air.push_back(stopping_air(altitude[r], temperature[r], n2[r], o2[r], o[r]));
  }
  if (air.size() < altitudes_km.size())
    throw table.bad_row(table.rows() - 1, "ends at " + short_real_text(altitude.back()) + " km")
        .expected("rows up to " + short_real_text(altitudes_km.back()) + " km, as the emission tables have");
  return air;
}

}  // namespace vegard::sim
