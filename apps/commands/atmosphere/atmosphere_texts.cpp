#include "apps/commands/atmosphere/atmosphere_texts.h"

#include <cstddef>

#include <fmt/format.h>

#include "apps/options/json_answer.h"

#include "sim/base/file/csv_text.h"

namespace vegard::apps {

AirColumn air_column(const sim::AirConditions& conditions, double bottom_km, double top_km) {
  const sim::MsisModel model = sim::sound_msis_model(conditions);
  AirColumn column;
  column.conditions = conditions;
  column.altitude_km = sim::air_altitudes(bottom_km, top_km);
  for (const double altitude : column.altitude_km) column.air.push_back(model.at(altitude));
  return column;
}

std::string air_csv(const AirColumn& column) {
  std::string text = sim::csv_comment("air: NRLMSISE-00 (Picone et al. 2002)") +
                     sim::csv_comment("conditions: " + sim::condition_words(column.conditions)) +
                     sim::csv_comment("units: km, K, cm^-3; mass_g_cm3 without nO_anomalous");
  text += "altitude_km,T_K,nN2,nO2,nO,nHe,nAr,nH,nN4S,nO_anomalous,mass_g_cm3\n";
  for (std::size_t r = 0; r < column.altitude_km.size(); ++r) {
    const sim::MsisAir& air = column.air[r];
    text += fmt::format("{},{:.3f}", sim::csv_number(column.altitude_km[r]), air.temperature_k);
    for (const double density : air.density_cm3) text += fmt::format(",{:.6e}", density);
    text += fmt::format(",{:.6e},{:.6e}\n", air.hot_o_cm3, air.mass_g_cm3);
  }
  return text;
}

std::string air_text(const AirColumn& column) {
  const auto ratio = [&](std::size_t r) {
    return column.air[r].of(sim::MsisGas::o) / column.air[r].of(sim::MsisGas::n2);
  };
  std::size_t coldest = 0, last = column.air.size() - 1;
  for (std::size_t r = 0; r < column.air.size(); ++r)
    if (column.air[r].temperature_k < column.air[coldest].temperature_k) coldest = r;
  std::string text = fmt::format("air: NRLMSISE-00, {}\n", sim::condition_words(column.conditions));
  text += fmt::format("temperature: least {:.1f} K at {:g} km, {:.1f} K at {:g} km\n",
                      column.air[coldest].temperature_k, column.altitude_km[coldest],
                      column.air[last].temperature_k, column.altitude_km[last]);
  text +=
      fmt::format("mass density: {:.3e} g cm^-3 at {:g} km, {:.3e} at {:g} km\n", column.air[0].mass_g_cm3,
                  column.altitude_km[0], column.air[last].mass_g_cm3, column.altitude_km[last]);
  for (std::size_t r = 1; r < column.air.size(); ++r)
    if (ratio(r - 1) < 1.0 && ratio(r) >= 1.0)
      return text + fmt::format("O overtakes N2 between {:g} and {:g} km\n", column.altitude_km[r - 1],
                                column.altitude_km[r]);
  return text + fmt::format("O to N2: {:.3g} at {:g} km\n", ratio(last), column.altitude_km[last]);
}

std::string air_json(const AirColumn& column) {
  const auto level = [&](std::size_t r) {
    const sim::MsisAir& air = column.air[r];
    return Json{{"altitude_km", column.altitude_km[r]}, {"temperature_k", air.temperature_k},
                {"n2_cm3", air.of(sim::MsisGas::n2)},   {"o2_cm3", air.of(sim::MsisGas::o2)},
                {"o_cm3", air.of(sim::MsisGas::o)},     {"mass_g_cm3", air.mass_g_cm3}};
  };
  std::size_t coldest = 0;
  for (std::size_t r = 0; r < column.air.size(); ++r)
    if (column.air[r].temperature_k < column.air[coldest].temperature_k) coldest = r;
  return Json{{"model", "NRLMSISE-00"},
              {"conditions", sim::condition_words(column.conditions)},
              {"bottom", level(0)},
              {"coldest", level(coldest)},
              {"top", level(column.air.size() - 1)}}
      .dump();
}

std::string named_conditions_json() {
  Json conditions = Json::object();
  for (const sim::NamedConditions& named : sim::named_conditions())
    conditions[named.name] = sim::condition_words(named.conditions);
  return Json{{"conditions", conditions}}.dump();
}

std::string named_conditions_text() {
  std::string text;
  for (const sim::NamedConditions& named : sim::named_conditions())
    text += fmt::format("{:<14} {}\n", named.name, sim::condition_words(named.conditions));
  return text;
}

}  // namespace vegard::apps
