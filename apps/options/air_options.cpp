#include "apps/options/air_options.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "apps/options/file_names.h"
#include "sim/base/file/input_file.h"
#include "sim/base/text.h"
#include "sim/light/air/msis_air.h"

namespace vegard::apps {
namespace {

std::string names_of_air() { return sim::joined(sim::air_names()); }

}  // namespace

Option add_air_option(const Command& command, std::string& atmosphere, const std::string& words) {
  return command
      .option(
          "--atmosphere", atmosphere,
          "A name: " + names_of_air() +
              " (vegard atmosphere --list); or a table of columns altitude_km, T_K, nN2, nO2, nO in km, K "
              "and cm^-3" +
              words)
      .type_name("NAME|FILE.csv")
      .shows_default();
}

std::string air_file(const std::string& atmosphere) {
  const std::vector<std::string> names = sim::air_names();
  return std::find(names.begin(), names.end(), atmosphere) != names.end() ? std::string() : atmosphere;
}

sim::AirTable air_of_choice(const std::string& atmosphere) {
  if (const std::optional<sim::AirTable> air = sim::named_air(atmosphere)) return *air;
  return sim::read_air_table(
      sim::input_bytes(atmosphere, "one of " + names_of_air() +
                                       ", or a table of the columns altitude_km, T_K, nN2, nO2 and nO"),
      atmosphere);
}

std::string words_of_air(const std::string& atmosphere) {
  for (const sim::NamedConditions& named : sim::named_conditions())
    if (named.name == atmosphere)
      return named.name + " (NRLMSISE-00, " + sim::condition_words(named.conditions) + ")";
  return air_file(atmosphere).empty() ? "U.S. Standard Atmosphere 1976" : file_name_of(atmosphere);
}

}  // namespace vegard::apps
