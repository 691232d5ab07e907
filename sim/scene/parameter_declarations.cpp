#include "sim/scene/parameter_declarations.h"

#include <iterator>

#include "sim/scene/rows/rows.h"

namespace vegard::sim {
namespace {

std::vector<Declaration> declare() {
  std::vector<Declaration> all;
  for (const auto rows :
       {place_rows, sheet_rows, light_rows, sensor_rows, sky_rows, night_sky_rows, time_rows, fit_rows}) {
    std::vector<Declaration> group = rows();
    std::move(group.begin(), group.end(), std::back_inserter(all));
  }
  return all;
}

}  // namespace

const std::vector<Declaration>& declarations() {
  static const std::vector<Declaration> all = declare();
  return all;
}

const Declaration* find_declaration(const std::string& table, const std::string& key) {
  for (const Declaration& d : declarations()) {
    if (d.table == table && d.key == key) return &d;
  }
  return nullptr;
}

}  // namespace vegard::sim
