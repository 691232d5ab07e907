#include "fit/parameters/photo_frame.h"

#include <algorithm>
#include <array>

#include "sim/scene/table/photo_scene.h"

namespace vegard::fit {
namespace {

using sim::Station;

/// Those of Station::numbers(), in their order.
std::array<sim::ParameterId, Station::kNumbers> ids_of(int sheet) {
  using sim::ParameterRole;
  const auto id = [&](ParameterRole role, int component = 0) {
    return sim::parameter_with(role, sheet, component);
  };
  return {id(ParameterRole::centre, 0), id(ParameterRole::centre, 1),  id(ParameterRole::bearing),
          id(ParameterRole::length),    id(ParameterRole::wavelength), id(ParameterRole::drift, 0),
          id(ParameterRole::drift, 1)};
}

}  // namespace

void PhotoFrame::go_home(sim::Scene& scene) const {
  if (!station.is_elsewhere()) return;
  for (std::size_t s = 0; s < scene.sheets.size(); ++s) {
    sim::Sheet at_home = sheets_at_home[s];
    const auto from = Station::numbers(at_home), to = Station::numbers(scene.sheets[s]);
    for (int i = 0; i < Station::kNumbers; ++i) *to[i] = *from[i];
  }
}

void PhotoFrame::carry(sim::Scene& scene) const {
  for (sim::Sheet& sheet : scene.sheets) station.carry(sheet);
}

void PhotoFrame::carry(const sim::Scene& at_home, const sim::Scene& there,
                       std::vector<sim::ParameterId>& numbers, std::vector<double>& slopes) const {
  if (!station.is_elsewhere() || numbers.empty()) return;
  const std::size_t moved = slopes.empty() ? numbers.size() : slopes.size() / numbers.size();
  if (slopes.empty()) {
    slopes.assign(moved * moved, 0.0);
    for (std::size_t j = 0; j < moved; ++j) slopes[j * moved + j] = 1.0;
  }
  for (std::size_t s = 0; s < there.sheets.size(); ++s) {
    const auto places = ids_of(static_cast<int>(s));
    std::array<std::vector<double>, Station::kNumbers> home;  // rows of slopes
    bool any = false;
    for (int i = 0; i < Station::kNumbers; ++i) {
      home[i].assign(moved, 0.0);
      const auto found = std::find(numbers.begin(), numbers.end(), places[i]);
      if (found == numbers.end()) continue;
      any = true;
      const auto row = slopes.begin() + (found - numbers.begin()) * static_cast<std::ptrdiff_t>(moved);
      std::copy(row, row + static_cast<std::ptrdiff_t>(moved), home[i].begin());
      slopes.erase(row, row + static_cast<std::ptrdiff_t>(moved));
      numbers.erase(found);
    }
    if (!any) continue;
    const auto turn = station.slopes(at_home.sheets[s]);
    const auto row_there = [&](int i) {
      std::vector<double> row(moved, 0.0);
      for (int k = 0; k < Station::kNumbers; ++k)
        for (std::size_t j = 0; j < moved; ++j) row[j] += turn[i * Station::kNumbers + k] * home[k][j];
      return row;
    };
    // A drift is none of the renderer's derivatives: it stands in for the centre that it leads to.
    const std::vector<double> drift[2] = {row_there(5), row_there(6)};
    for (int i = 0; i < 5; ++i) {
      std::vector<double> row = row_there(i);
      for (std::size_t j = 0; j < moved && i < 2; ++j) row[j] += there.time.start_s * drift[i][j];
      if (std::all_of(row.begin(), row.end(), [](double x) { return x == 0.0; })) continue;
      numbers.push_back(places[i]);
      slopes.insert(slopes.end(), row.begin(), row.end());
    }
  }
}

FramedScene framed_scene(const sim::Scene& scene, const sim::PhotoEntry& entry) {
  FramedScene framed;
  framed.scene = sim::scene_of_photo_at_home(scene, entry);
  framed.frame.name = entry.name;
  framed.frame.station = sim::station_of_photo(scene, framed.scene);
  framed.frame.sheets_at_home = framed.scene.sheets;
  framed.frame.carry(framed.scene);
  return framed;
}

}  // namespace vegard::fit
