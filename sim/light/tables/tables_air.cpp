#include "sim/light/tables/tables_air.h"

#include <cstddef>
#include <limits>

#include "sim/scene/rows/value_words.h"

namespace vegard::sim {

std::vector<StoppingAir> tables_air(const CsvTable& table, const std::vector<double>& altitudes_km) {
  const auto &altitude = table.column("altitude_km"), &temperature = table.column("T_K");
  const auto &o = table.column("nO"), &o2 = table.column("nO2"), &n2 = table.column("nN2");
  constexpr double kAny = std::numeric_limits<double>::max();
  table.require_within("T_K", 1.0, kAny);
  for (const char* gas : {"nO", "nO2", "nN2"}) table.require_within(gas, 0.0, kAny);
  std::vector<StoppingAir> air;
  for (std::size_t r = 0; r < table.rows(); ++r) {
    if (r >= altitudes_km.size() || altitude[r] != altitudes_km[r])
      table.refuse(r, short_real_text(altitude[r]) + " km is no altitude of the emission tables here",
                   r < altitudes_km.size() ? short_real_text(altitudes_km[r]) + " km" : "no more rows",
                   "the air has the altitudes of the emission tables, in their order");
    if (!(o[r] + o2[r] + n2[r] > 0.0)) table.refuse(r, "there is no air", "a density above 0");
    air.push_back(stopping_air(altitude[r], temperature[r], n2[r], o2[r], o[r]));
  }
  if (air.size() < altitudes_km.size())
    table.refuse(table.rows() - 1, "ends at " + short_real_text(altitude.back()) + " km",
                 "rows up to " + short_real_text(altitudes_km.back()) + " km, as the emission tables have");
  return air;
}

}  // namespace vegard::sim
