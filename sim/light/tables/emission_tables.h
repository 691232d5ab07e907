// The emission tables of a scene: all numbers by which electrons become light.
//
// A set of them is a folder (docs/file_formats.md, "Emission tables") that emission.tables names: GLOW's,
// which come with the program, or one of the user's own. Each is read once for the whole process and shared
// between threads.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "sim/light/tables/emission_table.h"
#include "sim/light/tables/flux_law.h"
#include "sim/light/tables/mono_table.h"
#include "sim/light/tables/tables_air.h"
#include "sim/scene/lines/emission_line.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// The altitudes that tables must reach: those of height profiles (sim/light/height_profile.h).
inline constexpr double kTablesBottomKm = 80.0, kTablesTopKm = 640.0;

class EmissionTables {
 public:
  /// Throws Error(unreadable_input) with file and line for whatever is wrong: a column that a line needs is
  /// missing, rows are (emission_table.h, flux_law.h, tables_air.h), altitudes do not reach from 80 to 640 km
  /// or energies from 0.1 to 19.9 keV, or the tables have different factors of oxygen.
  explicit EmissionTables(std::shared_ptr<const TableFolder> folder);
  explicit EmissionTables(const TableFolder& folder)
      : EmissionTables(std::make_shared<const TableFolder>(folder)) {}

  const EmissionTable& maxwellian() const { return maxwellian_; }
  const FluxFactors& flux_factors() const { return flux_factors_; }
  const std::vector<StoppingAir>& air() const { return air_; }

  /// Read at the first call, and made where the folder has no ver_mono.csv. Throws as the constructor does.
  const MonoEnergeticTable& mono() const;
  bool has_mono_file() const;

  /// Of Maxwellian electrons: what all energies are limited to.
  const std::vector<double>& energies_kev() const { return maxwellian_.energies_kev(); }

 private:
  std::unique_ptr<MonoEnergeticTable> read_mono() const;

  std::shared_ptr<const TableFolder> folder_;
  EmissionTable maxwellian_;
  FluxFactors flux_factors_;
  std::vector<StoppingAir> air_;
  mutable std::once_flag mono_made_;
  mutable std::unique_ptr<MonoEnergeticTable> mono_;
};

/// Those of the program by name, such as "glow", and those of a scene. They live as long as the process.
/// Throw what EmissionTables and built_in_tables() throw.
const EmissionTables& emission_tables(const std::string& built_in);
const EmissionTables& emission_tables(const Scene& scene);

/// What every height profile begins with: tables, and the factor of atomic oxygen, inside of theirs.
struct EmissionSource {
  const EmissionTables& tables;
  double oxygen_factor = 1.0;
};
EmissionSource emission_source(const Scene& scene);

/// Where tables have a line's light: a column of its own, called by its wavelength ("ver_6705"), or that of
/// EmissionLine::table_column times its ratio. For lines of the aurora.
struct LineColumn {
  std::string name;
  double ratio = 1.0;
};
template <class Table>
LineColumn column_of(const EmissionLine& line, const Table& table);

/// Throws Error unless the scene's tables can be read and have its factor of atomic oxygen: Error(scene) at
/// emission.oxygen_factor where it, or a limit or start that fit.free has for it, is outside of theirs, or it
/// is free and they have but one.
void check_emission_tables(const Scene& scene);

/// Of a scene that has passed: an entry of fit.free for emission.oxygen_factor without limits gets those of
/// the tables.
void limit_free_oxygen(Scene& scene);

}  // namespace vegard::sim
