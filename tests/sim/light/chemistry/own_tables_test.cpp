// The tables of data/emission are what this program makes: a change of the physics or of its data that moves
// their light by 2 % and is not followed by `vegard tables` is noticed here, at two Maxwellian energies and
// one oxygen factor.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "sim/light/chemistry/line_sources.h"
#include "sim/light/chemistry/table_maker.h"
#include "sim/light/tables/emission_tables.h"
#include "sim/scene/table/emission_folder.h"

namespace vegard::sim::own_tables_test {
namespace {

// At altitudes where a line has a tenth of its peak or more. Two things differ from the making: energies end
// where this spectrum does, and the air is read from the folder's own file, whose rows are farther apart than
// what it was made of.
TEST(OwnTables, AreWhatTheProgramMakes) {
  const TableFolder& folder = *built_in_tables("vegard");
  const AirTable air = read_air_table(folder.files.at(kTablesAirFile), kTablesAirFile);
  const TableRequest request;
  for (const double energy : {0.50119, 5.0119}) {
    IncidentSpectrum spectrum;
    spectrum.energy_kev = energy;
    const Degradation all = degradation(energy_grid(1e3 * highest_energy_kev(spectrum), request.refinement));
    const AuroralRun run = auroral_run(all, field_air(air, request.dip_deg, request.refinement),
                                       incident_flux(spectrum, all.grid, 1.0), PitchAngles::isotropic,
                                       Reactions::standard(), request.seconds);
    const std::vector<double>& places = run.column.altitude_km;
    for (const SourcedLine& line : run.light.lines) {
      const std::vector<double> photons = line.photons_cm3_s();
      const double most = *std::max_element(photons.begin(), photons.end());
      const EmissionTable& table = emission_tables("vegard").maxwellian();
      const std::vector<Emission1d> tabulated = table.at_energy(line.column, energy);
      for (std::size_t a = 0; a < tabulated.size(); ++a) {
        const double altitude = table.altitudes_km()[a];
        const auto after = std::upper_bound(places.begin(), places.end() - 1, altitude);
        const auto high = static_cast<std::size_t>(after - places.begin()), low = high - 1;
        const double way = (altitude - places[low]) / (places[high] - places[low]);
        const double here = photons[low] + way * (photons[high] - photons[low]);
        if (here < 0.1 * most) continue;
        EXPECT_NEAR(tabulated[a].rate / here, 1.0, 0.02) << line.column << " at " << altitude << " km";
      }
    }
  }
}

TEST(OwnTables, KnowTheirOxygen) {
  EXPECT_EQ(emission_tables("vegard").maxwellian().oxygen_factors(), (std::vector<double>{0.5, 1.0, 2.0}));
  EXPECT_TRUE(emission_tables("vegard").maxwellian().has("ver_6705"));
}

}  // namespace
}  // namespace vegard::sim::own_tables_test
