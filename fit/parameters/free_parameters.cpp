#include "fit/parameters/free_parameters.h"

#include <algorithm>
#include <cmath>

#include "sim/base/error.h"
#include "sim/scene/emitters/emitter_kinds.h"
#include "sim/scene/freedom/ties.h"
#include "sim/scene/table/free_entry_keys.h"
#include "sim/scene/table/parameter_id.h"
#include "sim/scene/table/photo_scene.h"

namespace vegard::fit {
namespace {

constexpr double kInside = 1e-6;   // of the range, kept from a limit
constexpr double kAtLimit = 1e-3;  // of the range, counts as being at it

bool finite(double x) { return std::isfinite(x); }

constexpr double kNextToNothing = 1e-9;  // of the largest value

constexpr double kSearchReach = 30.0, kLogarithmicReach = 1e3;

/// Light, sizes and depths of volumes may be next to anything: on the scale of all that the table allows, 0
/// to 1e9, a usual value would lie at the limit. Without limits of the user's they are looked for within a
/// factor of the start.
void keep_in_reach(const sim::FreeParameter& entry, const sim::ParameterPath& path, FreeNumber& number) {
  if (sim::scale_of(entry, path.row) == sim::ParameterScale::logarithmic) {
    if (!entry.min && path.row->min <= 0.0)
      number.min = std::min(number.min, number.start / kLogarithmicReach);
  } else if (!entry.max && number.min == 0.0) {
    number.max = std::min(number.max, kSearchReach * number.start);
  }
}

FreeNumber number_of(const sim::Scene& scene, const sim::FreeParameter& entry,
                     const sim::ParameterPath& path) {
  FreeNumber number;
  number.id = path.id;
  number.path = path.text;
  number.photo = entry.photo;
  number.name = entry.name;
  if (path.row != nullptr) {
    number.start = entry.start.value_or(*sim::real_value(scene, path));
    number.min = entry.min.value_or(path.row->min);
    number.max = entry.max.value_or(path.row->max);
  } else {
    number.start = entry.start.value();
    number.min = entry.min.value();
    number.max = entry.max.value();
  }
  number.prior = entry.prior;
  if (entry.scale != sim::FreeScale::of_table) number.scale = sim::scale_of(entry, path.row);
  // A logarithmic parameter whose table begins at 0 is unbounded below, in effect.
  if (sim::scale_of(entry, path.row) == sim::ParameterScale::logarithmic && number.min <= 0.0)
    number.min = kNextToNothing * number.max;
  if (is_of_volume(number) && number.start > 0.0) keep_in_reach(entry, path, number);
  return number;
}

void mark_those_in_expressions(const sim::Scene& scene, std::vector<FreeNumber>& numbers) {
  if (scene.fit.tied.empty()) return;
  std::vector<std::string> photos = {""};
  for (const sim::PhotoEntry& photo : scene.fit.photos) photos.push_back(photo.name);
  for (const std::string& photo : photos)
    for (const sim::Tie& tie : sim::ties_of(scene, photo))
      for (const sim::Tie::Input& input : tie.inputs)
        for (FreeNumber& number : numbers) {
          const sim::ParameterId& used = input.path.id;
          const bool is_used =
              !used.any()
                  ? number.name == input.name
                  : number.id == used || std::any_of(number.also.begin(), number.also.end(),
                                                     [&](const FreePlace& p) { return p.id == used; });
          number.in_expressions = number.in_expressions || is_used;
        }
}

/// The number of this name so far, or null.
FreeNumber* named(std::vector<FreeNumber>& numbers, const std::string& name) {
  const auto found = std::find_if(numbers.begin(), numbers.end(), [&](const FreeNumber& number) {
    return !name.empty() && number.name == name;
  });
  return found == numbers.end() ? nullptr : &*found;
}

}  // namespace

const std::string& FreeNumber::unit() const {
  static const std::string none;
  return has_path() ? id.row->unit : none;
}

const std::string& FreeNumber::meaning() const {
  static const std::string of_expressions = "a number that expressions use";
  return has_path() ? id.row->meaning : of_expressions;
}

std::string FreeNumber::label() const {
  const std::string& text = has_path() ? path : name;
  return photo.empty() ? text : text + " of " + photo;
}

bool FreeNumber::logarithmic() const {
  const sim::ParameterScale in_force = scale        ? *scale
                                       : has_path() ? id.row->scale
                                                    : sim::ParameterScale::linear;
  return in_force == sim::ParameterScale::logarithmic && min > 0.0;
}

double FreeNumber::coordinate(double value) const {
  if (finite(min) && finite(max)) {
    const double share =
        logarithmic() ? std::log(value / min) / std::log(max / min) : (value - min) / (max - min);
    const double inside = std::clamp(finite(share) ? share : 0.0, kInside, 1.0 - kInside);
    return std::log(inside / (1.0 - inside));
  }
  return logarithmic() ? std::log(std::max(value, min * (1.0 + kInside)) / min) : value;
}

double FreeNumber::value(double coordinate) const {
  if (finite(min) && finite(max)) {
    const double share = 1.0 / (1.0 + std::exp(-coordinate));
    // Kept from a limit but for the rounding.
    return std::clamp(logarithmic() ? min * std::exp(share * std::log(max / min)) : min + share * (max - min),
                      min, max);
  }
  return logarithmic() ? min * std::exp(coordinate) : coordinate;
}

double FreeNumber::slope(double coordinate) const {
  if (finite(min) && finite(max)) {
    const double share = 1.0 / (1.0 + std::exp(-coordinate));
    const double d_share = share * (1.0 - share);
    return logarithmic() ? value(coordinate) * std::log(max / min) * d_share : (max - min) * d_share;
  }
  return logarithmic() ? value(coordinate) : 1.0;
}

bool FreeNumber::at_limit(double value) const {
  const auto place = [&](double x) { return logarithmic() ? std::log(x) : x; };
  const double range = finite(min) && finite(max) ? place(max) - place(min) : 1.0;
  return (finite(min) && place(value) - place(min) < kAtLimit * range) ||
         (finite(max) && place(max) - place(value) < kAtLimit * range);
}

namespace {

/// The prior stands at the wavelength, or at the amplitude if only that is free.
void add_ratio_priors(const sim::Scene& scene, std::vector<FreeNumber>& numbers) {
  if (scene.fit.ratio_spread <= 0.0) return;
  for (int s = 0; s < static_cast<int>(scene.sheets.size()); ++s) {
    const sim::Sheet& sheet = scene.sheets[static_cast<std::size_t>(s)];
    if (sheet.course != sim::SheetCourse::sine) continue;
    const sim::ParameterId wavelength = sim::parameter_with(sim::ParameterRole::wavelength, s),
                           amplitude = sim::parameter_with(sim::ParameterRole::amplitude, s);
    const auto find = [&](const sim::ParameterId& id) {
      return std::find_if(numbers.begin(), numbers.end(), [&](const FreeNumber& n) { return n.id == id; });
    };
    const auto wavelength_number = find(wavelength), amplitude_number = find(amplitude);
    RatioPrior prior;
    prior.spread = scene.fit.ratio_spread;
    if (wavelength_number != numbers.end()) {
      const bool both = amplitude_number != numbers.end();
      prior.rest = -std::log(2.0) - (both ? 0.0 : std::log(sheet.thickness_km));
      if (both) prior.other = amplitude;
      wavelength_number->ratio_prior = prior;
    } else if (amplitude_number != numbers.end()) {
      prior.sign = -1.0;
      prior.rest = std::log(0.5 * sheet.wavelength_km);
      amplitude_number->ratio_prior = prior;
    }
  }
}

}  // namespace

bool is_of_volume(const FreeNumber& number) {
  return number.has_path() && sim::kind_of_table(number.id.row->table) != nullptr;
}

std::vector<FreeNumber> free_numbers(const sim::Scene& scene) {
  std::vector<FreeNumber> numbers;
  for (const sim::FreeParameter& entry : scene.fit.free) {
    if (entry.path.empty()) {
      numbers.push_back(number_of(scene, entry, {}));
      continue;
    }
    const sim::PhotoEntry* photo = sim::find_photo(scene, entry.photo);
    const sim::Scene own = photo == nullptr ? scene : sim::scene_of_photo_in_site_frame(scene, *photo);
    for (const sim::ParameterPath& path : sim::resolve(own, entry.path)) {
      if (FreeNumber* first = named(numbers, entry.name)) {
        first->also.push_back({path.id, entry.photo});
        first->min = std::max(first->min, path.row->min);
        first->max = std::min(first->max, path.row->max);
      } else {
        numbers.push_back(number_of(own, entry, path));
      }
    }
  }
  if (numbers.empty())
    throw sim::Error(sim::ErrorKind::scene, "nothing is free")
        .file(scene.file)
        .key("fit.free")
        .expected("at least one path, such as \"sheet.main.energy_kev\"")
        .hint("'vegard params' lists what can be free");
  mark_those_in_expressions(scene, numbers);
  add_ratio_priors(scene, numbers);
  return numbers;
}

std::vector<double> start_values(const std::vector<FreeNumber>& free) {
  std::vector<double> start;
  for (const FreeNumber& n : free) start.push_back(n.within_limits(n.start));
  return start;
}

void start_from(const std::vector<FreeNumber>& free, const std::vector<double>& values, sim::Scene& scene) {
  for (sim::FreeParameter& entry : scene.fit.free) {
    if (entry.path.empty()) {
      for (std::size_t j = 0; j < free.size(); ++j)
        if (!free[j].has_path() && free[j].name == entry.name) entry.start = values[j];
      continue;
    }
    if (entry.photo.empty()) {
      entry.start.reset();
      continue;
    }
    const std::vector<sim::ParameterPath> paths = sim::resolve(scene, entry.path);
    for (std::size_t j = 0; j < free.size() && paths.size() == 1; ++j)
      if (free[j].photo == entry.photo && free[j].id == paths.front().id) entry.start = values[j];
  }
}

double wrap_period(const FreeNumber& number) {
  // An expression is not periodic in the angle: half of a full turn is half a turn.
  if (!number.is_angle() || number.in_expressions) return 0.0;
  return number.unit() == "rad" ? 2.0 * std::acos(-1.0) : 360.0;
}

double wrapped_angle(const FreeNumber& number, double value) {
  const double turn = wrap_period(number);
  if (turn == 0.0 || number.min > number.id.row->min || number.max < number.id.row->max) return value;
  return value - turn * std::floor(value / turn);
}

double wrapped_difference(const FreeNumber& number, double a, double b) {
  const double turn = wrap_period(number);
  return turn > 0.0 ? std::abs(std::remainder(a - b, turn)) : std::abs(a - b);
}

}  // namespace vegard::fit
