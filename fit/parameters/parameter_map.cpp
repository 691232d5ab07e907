#include "fit/parameters/parameter_map.h"
#include "sim/scene/table/parameter_id.h"

#include <algorithm>
#include <cmath>

namespace vegard::fit {
namespace {

bool belongs(const std::string& place_photo, const std::string& photo) {
  return place_photo.empty() || place_photo == photo;
}

}  // namespace

ParameterMap::ParameterMap(const sim::Scene& scene, const std::vector<FreeNumber>& free,
                           const std::string& photo)
    : ParameterMap(scene, free, PhotoFrame{photo, {}, {}}) {}

ParameterMap::ParameterMap(const sim::Scene& scene, const std::vector<FreeNumber>& free,
                           const PhotoFrame& frame)
    : free_(free), frame_(frame) {
  const std::string& photo = frame.name;
  for (std::size_t j = 0; j < free.size(); ++j) {
    const int number = static_cast<int>(j);
    if (free[j].has_path() && belongs(free[j].photo, photo)) places_.push_back({free[j].id, number});
    for (const FreePlace& place : free[j].also)
      if (belongs(place.photo, photo)) places_.push_back({place.id, number});
  }
  if (!photo.empty()) {
    // Some of its lines may be missing.
    const auto is_missing = [&](const Place& place) { return sim::number_at(scene, place.id) == nullptr; };
    places_.erase(std::remove_if(places_.begin(), places_.end(), is_missing), places_.end());
  }
  for (const sim::Tie& tie : sim::ties_of(scene, photo)) {
    Following following{tie, {}, std::vector<bool>(free.size(), false)};
    for (const sim::Tie::Input& wanted : tie.inputs) {
      Input input{wanted.path.id, -1, -1};
      for (std::size_t j = 0; j < free.size(); ++j)
        if (!input.id.any() && free[j].name == wanted.name) input.number = static_cast<int>(j);
      for (const Place& place : places_)
        if (input.id.any() && place.id == input.id) input.number = place.number;
      for (std::size_t t = 0; t < following_.size(); ++t)
        if (input.id.any() && following_[t].tie.path.id == input.id) input.tie = static_cast<int>(t);
      if (input.number >= 0) following.uses[input.number] = true;
      for (std::size_t j = 0; input.tie >= 0 && j < free.size(); ++j)
        if (following_[input.tie].uses[j]) following.uses[j] = true;
      following.inputs.push_back(input);
    }
    following_.push_back(std::move(following));
  }
}

bool ParameterMap::is_plain() const {
  if (!following_.empty() || places_.size() != free_.size()) return false;
  for (std::size_t j = 0; j < places_.size(); ++j)
    if (places_[j].number != static_cast<int>(j)) return false;
  return true;
}

std::vector<double> ParameterMap::input_values(const Following& following, const std::vector<double>& values,
                                               const sim::Scene& scene) const {
  std::vector<double> inputs;
  for (const Input& input : following.inputs)
    inputs.push_back(input.number >= 0 ? values[input.number] : *sim::number_at(scene, input.id));
  return inputs;
}

bool ParameterMap::put(const std::vector<double>& values, sim::Scene& scene) const {
  frame_.to_site_frame(scene);
  const bool within_limits = put_in_site_frame(values, scene);
  frame_.carry(scene);
  return within_limits;
}

bool ParameterMap::put_in_site_frame(const std::vector<double>& values, sim::Scene& scene) const {
  for (const Place& place : places_) *sim::number_at(scene, place.id) = values[place.number];
  bool within_limits = true;
  for (const Following& f : following_) {
    double& number = *sim::number_at(scene, f.tie.path.id);
    const double value = f.tie.expression.value(input_values(f, values, scene));
    within_limits = within_limits && sim::is_within_limits(f.tie.path, value);
    // Without any value it stays as it is.
    if (!std::isnan(value)) number = std::clamp(value, f.tie.path.row->min, f.tie.path.row->max);
  }
  return within_limits;
}

std::vector<std::vector<double>> ParameterMap::tie_slopes(const std::vector<double>& values,
                                                          const sim::Scene& scene) const {
  std::vector<std::vector<double>> all;
  for (const Following& f : following_) {
    std::vector<double> by_free(free_.size(), 0.0);
    const std::vector<double> inputs = input_values(f, values, scene);
    // Held at a limit, it does not move.
    if (sim::is_within_limits(f.tie.path, f.tie.expression.value(inputs))) {
      const std::vector<double> by_input = f.tie.expression.slopes(inputs);
      for (std::size_t i = 0; i < f.inputs.size(); ++i) {
        const Input& input = f.inputs[i];
        if (input.number >= 0) by_free[input.number] += by_input[i];
        for (std::size_t j = 0; input.tie >= 0 && j < by_free.size(); ++j)
          by_free[j] += by_input[i] * all[input.tie][j];
      }
    }
    all.push_back(std::move(by_free));
  }
  return all;
}

ParameterMap::Motion ParameterMap::motion(const std::vector<double>& values, const std::vector<int>& moved,
                                          const sim::Scene& scene) const {
  if (!frame_.station.is_elsewhere()) return motion_in_site_frame(values, moved, scene);
  sim::Scene at_home = scene;
  frame_.to_site_frame(at_home);
  put_in_site_frame(values, at_home);
  Motion motion = motion_in_site_frame(values, moved, at_home);
  frame_.carry(at_home, scene, motion.numbers, motion.slopes);
  return motion;
}

ParameterMap::Motion ParameterMap::motion_in_site_frame(const std::vector<double>& values,
                                                        const std::vector<int>& moved,
                                                        const sim::Scene& at_home) const {
  Motion motion;
  motion.moved = moved.size();
  std::vector<int> number_of_row;  // the free number that a row is, by its index in `moved`; -1: a tie
  std::vector<std::size_t> tie_of_row;
  for (std::size_t k = 0; k < moved.size(); ++k)
    for (const Place& place : places_)
      if (place.number == moved[k]) {
        motion.numbers.push_back(place.id);
        number_of_row.push_back(static_cast<int>(k));
        tie_of_row.push_back(0);
      }
  bool is_identity = number_of_row.size() == moved.size();
  for (std::size_t k = 0; k < number_of_row.size() && is_identity; ++k)
    is_identity = number_of_row[k] == static_cast<int>(k);
  for (std::size_t t = 0; t < following_.size(); ++t) {
    const auto uses = [&](int j) { return static_cast<bool>(following_[t].uses[j]); };
    if (std::none_of(moved.begin(), moved.end(), uses)) continue;
    motion.numbers.push_back(following_[t].tie.path.id);
    number_of_row.push_back(-1);
    tie_of_row.push_back(t);
    is_identity = false;
  }
  if (is_identity) return motion;
  const std::vector<std::vector<double>> of_ties = tie_slopes(values, at_home);
  motion.slopes.assign(motion.numbers.size() * moved.size(), 0.0);
  for (std::size_t row = 0; row < motion.numbers.size(); ++row)
    for (std::size_t k = 0; k < moved.size(); ++k) {
      double& slope = motion.slopes[row * moved.size() + k];
      slope = number_of_row[row] < 0 ? of_ties[tie_of_row[row]][moved[k]]
                                     : (number_of_row[row] == static_cast<int>(k) ? 1.0 : 0.0);
    }
  return motion;
}

std::vector<ParameterMap::Dependent> ParameterMap::dependents(const std::vector<double>& values,
                                                              const sim::Scene& scene) const {
  std::vector<Dependent> all;
  for (const Place& place : places_) {
    const FreeNumber& number = free_[place.number];
    if (number.id == place.id) continue;
    Dependent same{place.id, number.label(), std::vector<double>(free_.size(), 0.0)};
    same.slopes[place.number] = 1.0;
    all.push_back(std::move(same));
  }
  const std::vector<std::vector<double>> of_ties = tie_slopes(values, scene);
  for (std::size_t t = 0; t < following_.size(); ++t)
    all.push_back({following_[t].tie.path.id, following_[t].tie.expression.text(), of_ties[t]});
  return all;
}

}  // namespace vegard::fit
