#include "sim/scene/table/parameter_declarations.h"

#include <iterator>

#include "sim/scene/table/rows/rows.h"

namespace vegard::sim {
namespace {

std::vector<Declaration> declare() {
  std::vector<Declaration> all;
  for (const auto rows :
       {place_rows, sheet_rows, footprint_rows, nebula_rows, node_rows, volume_rows, sun_rows,
        chromosphere_rows, loop_rows, corona_rows, bundle_rows, ejection_rows, march_rows, light_rows,
        sensor_rows, sky_rows, night_sky_rows, time_rows, fit_rows}) {
    std::vector<Declaration> group = rows();
    std::move(group.begin(), group.end(), std::back_inserter(all));
  }
  return all;
}

template <class Element>
RepeatedTable repeated(const std::string& table, std::vector<Element> Scene::*in) {
  return {table, [=](const Scene& scene) { return (scene.*in).size(); },
          [=](const Scene& scene, int element) -> const std::string& { return (scene.*in).at(element).name; },
          [=](Scene& scene) { (scene.*in).emplace_back(); }};
}

}  // namespace

const std::vector<RepeatedTable>& repeated_tables() {
  static const std::vector<RepeatedTable> all = {
      repeated(sheet_table, &Scene::sheets), repeated("footprint", &Scene::footprints),
      repeated("nebula", &Scene::nebulae),   repeated("node", &Scene::nodes),
      repeated("volume", &Scene::volumes),   repeated("chromosphere", &Scene::chromospheres),
      repeated("loop", &Scene::loops),       repeated("corona", &Scene::coronae),
      repeated("bundle", &Scene::bundles),   repeated("ejection", &Scene::ejections)};
  return all;
}

const RepeatedTable* repeated_table(const std::string& table) {
  for (const RepeatedTable& each : repeated_tables())
    if (each.table == table) return &each;
  return nullptr;
}

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
