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

void PhotoFrame::to_site_frame(sim::Scene& scene) const {
  if (!station.is_elsewhere()) return;
  for (std::size_t s = 0; s < scene.sheets.size(); ++s) {
    sim::Sheet at_home = sheets_at_home[s];
    const auto from = Station::numbers(at_home), to = Station::numbers(scene.sheets[s]);
    for (int i = 0; i < Station::kNumbers; ++i) *to[i] = *from[i];
    scene.sheets[s].east_km = at_home.east_km;
    scene.sheets[s].north_km = at_home.north_km;
  }
}

void PhotoFrame::carry(sim::Scene& scene) const {
  for (sim::Sheet& sheet : scene.sheets) station.carry(sheet);
}

/// The points of a sheet's curve. `take` and `give` move rows of slopes.
template <class Take, class Give>
void PhotoFrame::carry_curve(int s, const sim::Sheet& at_home, double instant_s, std::size_t moved,
                             const Take& take, const Give& give) const {
  using Row = std::vector<double>;
  const std::size_t points = at_home.east_km.size();
  const auto id = [&](int axis, std::size_t point) {
    return sim::parameter_with(axis == 0 ? sim::ParameterRole::curve_east : sim::ParameterRole::curve_north,
                               s, static_cast<int>(point));
  };
  bool any = false;
  std::vector<std::array<Row, 2>> home(points);
  std::array<Row, 2> mean = {Row(moved, 0.0), Row(moved, 0.0)};
  for (std::size_t i = 0; i < points; ++i)
    for (int axis = 0; axis < 2; ++axis) {
      home[i][axis] = take(id(axis, i), any);
      for (std::size_t j = 0; j < moved; ++j) mean[axis][j] += home[i][axis][j] / static_cast<double>(points);
    }
  if (!any) return;
  // The drift goes by the mean of the points, and has carried all of them along by then.
  const std::array<double, 4> drift = station.drift_slopes(at_home);
  for (std::size_t i = 0; i < points; ++i) {
    const std::array<double, 4> turn =
        station.slopes(sim::EastNorth{at_home.east_km[i], at_home.north_km[i]});
    for (int axis = 0; axis < 2; ++axis) {
      Row row(moved, 0.0);
      for (std::size_t j = 0; j < moved; ++j)
        for (int k = 0; k < 2; ++k)
          row[j] += turn[2 * axis + k] * home[i][k][j] + instant_s * drift[2 * axis + k] * mean[k][j];
      give(id(axis, i), row);
    }
  }
}

void PhotoFrame::carry(const sim::Scene& at_home, const sim::Scene& there,
                       std::vector<sim::ParameterId>& numbers, std::vector<double>& slopes) const {
  if (!station.is_elsewhere() || numbers.empty()) return;
  const std::size_t moved = slopes.empty() ? numbers.size() : slopes.size() / numbers.size();
  if (slopes.empty()) {
    slopes.assign(moved * moved, 0.0);
    for (std::size_t j = 0; j < moved; ++j) slopes[j * moved + j] = 1.0;
  }
  /// Takes a number out of the list; its row of slopes, zeros if it is not in it.
  const auto take = [&](const sim::ParameterId& id, bool& any) {
    std::vector<double> row(moved, 0.0);
    const auto found = std::find(numbers.begin(), numbers.end(), id);
    if (found == numbers.end()) return row;
    any = true;
    const auto at = slopes.begin() + (found - numbers.begin()) * static_cast<std::ptrdiff_t>(moved);
    std::copy(at, at + static_cast<std::ptrdiff_t>(moved), row.begin());
    slopes.erase(at, at + static_cast<std::ptrdiff_t>(moved));
    numbers.erase(found);
    return row;
  };
  const auto give = [&](const sim::ParameterId& id, const std::vector<double>& row) {
    if (std::all_of(row.begin(), row.end(), [](double x) { return x == 0.0; })) return;
    numbers.push_back(id);
    slopes.insert(slopes.end(), row.begin(), row.end());
  };
  for (std::size_t s = 0; s < there.sheets.size(); ++s) {
    const sim::Sheet& sheet = at_home.sheets[s];
    if (sheet.course == sim::SheetCourse::curve) {
      carry_curve(static_cast<int>(s), sheet, there.time.start_s, moved, take, give);
      continue;
    }
    const auto places = ids_of(static_cast<int>(s));
    std::array<std::vector<double>, Station::kNumbers> home;  // rows of slopes
    bool any = false;
    for (int i = 0; i < Station::kNumbers; ++i) {
      home[i] = take(places[i], any);
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
      give(places[i], row);
    }
  }
}

FramedScene framed_scene(const sim::Scene& scene, const sim::PhotoEntry& entry) {
  FramedScene framed;
  framed.scene = sim::scene_of_photo_in_site_frame(scene, entry);
  framed.frame.name = entry.name;
  framed.frame.station = sim::station_of_photo(scene, framed.scene);
  framed.frame.sheets_at_home = framed.scene.sheets;
  framed.frame.carry(framed.scene);
  if (framed.frame.station.is_elsewhere()) sim::let_emitters_stay(scene.site, framed.scene);
  return framed;
}

}  // namespace vegard::fit
