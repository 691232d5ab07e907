#include "fit/map/map_numbers.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "fit/parameters/free_parameters.h"
#include "sim/base/error.h"
#include "sim/base/file/number_text.h"
#include "sim/base/text.h"
#include "sim/light/tables/emission_tables.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/scene/table/photo_scene.h"

namespace vegard::fit {
namespace {

constexpr double kSameValue = 1e-6;  // relative: what a scene's text may round

bool concerns_map(const std::string& path) {
  constexpr std::array<const char*, 4> kTables = {"camera.", "air.", "field.", "blur."};
  return std::any_of(kTables.begin(), kTables.end(),
                     [&](const char* table) { return sim::starts_with(path, table); });
}

/// What the scene, or the photograph, has for it.
double value_in(const sim::Scene& scene, const FreeNumber& number) {
  const sim::PhotoEntry* entry = number.photo.empty() ? nullptr : sim::find_photo(scene, number.photo);
  const sim::Scene seen = entry != nullptr ? sim::scene_of_photo(scene, *entry) : scene;
  return *sim::real_value(seen, sim::resolve(seen, number.path).front());
}

}  // namespace

std::vector<MapNumber> map_numbers(const sim::Scene& scene) {
  std::vector<MapNumber> numbers;
  if (scene.fit.free.empty()) return numbers;
  for (const FreeNumber& free : free_numbers(scene)) {
    if (!free.has_path() || !concerns_map(free.path)) continue;
    if (!free.prior || free.prior->law != sim::PriorLaw::normal || !free.also.empty())
      throw sim::Error(sim::ErrorKind::scene,
                       "a map takes " + free.label() + " as known, with an error that it has no prior for")
          .file(scene.file)
          .key("fit.free")
          .expected("prior = { mean = ..., sigma = ... }, of this number alone")
          .hint("vegard calibrate gives the errors of a camera's numbers; or leave it out of fit.free");
    if (free.path.compare(0, 6, "field.") == 0 && !free.photo.empty())
      throw sim::Error(sim::ErrorKind::scene, free.label() + " is of one photograph, and a map has one field")
          .file(scene.file)
          .key("fit.free")
          .expected("field." + free.path.substr(6) + " of all photographs");
    MapNumber n;
    n.label = free.label();
    n.unit = free.unit();
    n.path = free.path;
    n.photo = free.photo;
    n.value = value_in(scene, free);
    n.error = free.prior->sigma;
    if (std::abs(free.prior->mean - n.value) > kSameValue * std::max(1.0, std::abs(n.value)))
      throw sim::Error(sim::ErrorKind::scene, "the prior of " + free.label() + " is about " +
                                                  sim::short_number(free.prior->mean, 8) +
                                                  ", and the map is made with " +
                                                  sim::short_number(n.value, 8))
          .file(scene.file)
          .key("fit.free")
          .expected("one value in both places");
    n.min = free.min;
    n.max = free.max;
    numbers.push_back(n);
  }
  return numbers;
}

std::vector<MapNumber> mode_numbers(const sim::Scene& scene) {
  std::vector<MapNumber> numbers;
  if (scene.emission.uncertainty == sim::TablesUncertainty::none) return numbers;
  const int count = sim::emission_tables(scene).modes().count();
  for (int k = 0; k < count; ++k) {
    MapNumber n;
    n.label = "mode " + std::to_string(k + 1) + " of the emission tables";
    n.mode = k;
    n.value = static_cast<std::size_t>(k) < scene.emission.modes.size() ? scene.emission.modes[k] : 0.0;
    n.error = 1.0;
    numbers.push_back(n);
  }
  return numbers;
}

sim::Scene scene_with(sim::Scene scene, const std::vector<MapNumber>& numbers,
                      const std::vector<double>& values) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const MapNumber& n = numbers[i];
    if (n.mode >= 0) {
      const auto mode = static_cast<std::size_t>(n.mode);
      if (scene.emission.modes.size() <= mode) scene.emission.modes.resize(mode + 1, 0.0);
      scene.emission.modes[mode] = values[i];
      continue;
    }
    const std::string text = sim::short_number(std::clamp(values[i], n.min, n.max), 17);
    if (n.photo.empty()) {
      sim::set_from_text(scene, n.path, text);
      continue;
    }
    for (sim::PhotoEntry& entry : scene.fit.photos)
      if (entry.name == n.photo) entry.set.emplace_back(n.path, text);
  }
  return scene;
}

}  // namespace vegard::fit
