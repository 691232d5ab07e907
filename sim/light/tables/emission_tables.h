// The emission tables of a scene: all numbers that relate electrons to their light.
//
// A set of tables is a folder (docs/file_formats.md, "Emission tables") that emission.tables names: GLOW's,
// which are part of vegard, or one of the user. Each folder is read once per process and shared between
// threads.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "sim/base/file/csv_table.h"
#include "sim/light/tables/emission_table.h"
#include "sim/light/tables/flux_law.h"
#include "sim/light/tables/ionisation.h"
#include "sim/light/tables/light_modes.h"
#include "sim/light/tables/mono_table.h"
#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/structs/light.h"

namespace vegard::sim {

struct Scene;

/// The altitudes that tables must cover: those of height profiles (sim/light/height_profile.h).
inline constexpr double kTablesBottomKm = 80.0, kTablesTopKm = 640.0;

class EmissionTables {
 public:
  /// Throws Error(unreadable_input) with file and line if a column that a line needs is missing, if rows are
  /// missing or invalid (emission_table.h, flux_law.h, tables_air.h), if altitudes do not cover 80 to 640 km
  /// or energies 0.1 to 19.9 keV, or if the tables have different factors of oxygen.
  explicit EmissionTables(std::shared_ptr<const TableFolder> folder);
  explicit EmissionTables(const TableFolder& folder)
      : EmissionTables(std::make_shared<const TableFolder>(folder)) {}

  const EmissionTable& maxwellian() const { return maxwellian_; }
  const FluxFactors& flux_factors() const { return flux_factors_; }
  const std::vector<StoppingAir>& air() const { return air_; }

  /// The files that the tables were read from.
  const TableFolder& folder() const { return *folder_; }

  /// The table of mono-energetic electrons: read at the first call, or computed from the others if the folder
  /// has no ver_mono.csv. Throws as the constructor does.
  const MonoEnergeticTable& mono() const;
  bool has_mono_file() const;

  /// The modes of the tables' uncertainty; none if the folder has no modes.csv. Read at the first call;
  /// throws as the constructor does.
  const LightModes& modes() const;

  /// Energies of the table for Maxwellian electrons; energies of scenes are limited to their range.
  const std::vector<double>& energies_kev() const { return maxwellian_.energies_kev(); }

 private:
  std::unique_ptr<MonoEnergeticTable> read_mono() const;

  std::shared_ptr<const TableFolder> folder_;
  EmissionTable maxwellian_;
  FluxFactors flux_factors_;
  std::vector<StoppingAir> air_;
  mutable std::once_flag mono_made_, modes_read_;
  mutable LightModes modes_;
  mutable std::unique_ptr<MonoEnergeticTable> mono_;
};

/// Return vegard's own tables by name, such as "glow", and the tables of a scene. The reference is valid
/// until the process ends. Throw what EmissionTables and built_in_tables() throw.
const EmissionTables& emission_tables(const std::string& built_in);
const EmissionTables& emission_tables(const Scene& scene);

/// The inputs of every height profile: tables, the factor of atomic oxygen, within the tables' range, and the
/// coefficients of the modes of their uncertainty (light_modes.h), 0 for those that are not there.
struct EmissionSource {
  const EmissionTables& tables;
  double oxygen_factor = 1.0;
  std::vector<double> modes = {};
};
EmissionSource emission_source(const Scene& scene);

/// Adds to the coefficient of a mode, from 0, of the scene's tables.
void add_to_mode(Scene& scene, int mode, double more);

/// The column of a table that has a line's light: the line's own column, named by its wavelength
/// ("ver_6705"), or that of EmissionLine::table_column times its ratio. For lines of the aurora.
struct LineColumn {
  std::string name;
  double ratio = 1.0;
};
template <class Table>
LineColumn column_of(const EmissionLine& line, const Table& table);

/// Throws Error unless the scene's tables can be read and suit its factor of atomic oxygen: Error(scene) at
/// emission.oxygen_factor if the factor, or a limit or start in fit.free, is outside of the tables' range, or
/// if the factor is free and the tables have only one.
void check_emission_tables(const Scene& scene);

/// Sets the missing limits of an entry of fit.free for emission.oxygen_factor to those of the tables. The
/// scene must have passed check_emission_tables().
void limit_free_oxygen(Scene& scene);

// The air for which emission tables were computed, with its properties that stop electrons.
//
// Source: the tables' own atmosphere.csv; that of data/glow is NRLMSISE-00 through GLOW (data/README.md). It
// is not the U.S. Standard Atmosphere of sim/light/atmosphere.h, which is for the excited atoms' collisions.

/// Returns the air at the altitudes of the emission tables, from the bottom up, from the columns altitude_km,
/// T_K, nO, nO2 and nN2 (cm^-3) of a table. Throws Error(unreadable_input) unless the table has the same
/// altitudes, temperatures are above 0, densities are not negative, and no row is without air.
std::vector<StoppingAir> tables_air(const CsvTable& atmosphere, const std::vector<double>& altitudes_km);

}  // namespace vegard::sim
