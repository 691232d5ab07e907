#include "fit/free_parameters.h"

#include <algorithm>
#include <cmath>

#include "sim/base/error.h"
#include "sim/scene/photo_scene.h"

namespace vegard::fit {
namespace {

constexpr double kInside = 1e-6;   // of the range, kept from a limit
constexpr double kAtLimit = 1e-3;  // of the range, counts as being at it

bool finite(double x) { return std::isfinite(x); }

constexpr double kNextToNothing = 1e-9;  // of the largest value

}  // namespace

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
    return logarithmic() ? min * std::exp(share * std::log(max / min)) : min + share * (max - min);
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

std::vector<FreeNumber> free_numbers(const sim::Scene& scene) {
  std::vector<FreeNumber> numbers;
  for (const sim::FreeParameter& entry : scene.fit.free) {
    const sim::PhotoEntry* photo = sim::find_photo(scene, entry.photo);
    const sim::Scene own = photo == nullptr ? scene : sim::scene_of_photo_at_home(scene, *photo);
    for (const sim::ParameterPath& path : sim::resolve(own, entry.path)) {
      FreeNumber number;
      number.path = path;
      number.photo = entry.photo;
      number.start = entry.start.value_or(*sim::real_value(own, path));
      number.min = entry.min.value_or(path.row->min);
      number.max = entry.max.value_or(path.row->max);
      number.prior = entry.prior;
      // A logarithmic parameter whose table begins at 0 is unbounded below, in effect.
      if (path.row->scale == sim::ParameterScale::logarithmic && number.min <= 0.0)
        number.min = kNextToNothing * number.max;
      numbers.push_back(number);
    }
  }
  if (numbers.empty())
    throw sim::Error(sim::ErrorKind::scene, {"nothing is free", scene.file, 0, "fit.free",
                                             "at least one path, such as \"sheet.main.energy_kev\"",
                                             "'vegard params' lists what can be free"});
  return numbers;
}

void put_values(sim::Scene& scene, const std::vector<FreeNumber>& free, const std::vector<double>& values) {
  for (std::size_t i = 0; i < free.size(); ++i) *sim::real_value(scene, free[i].path) = values[i];
}

std::vector<const double*> addresses(const sim::Scene& scene, const std::vector<FreeNumber>& free) {
  std::vector<const double*> result;
  for (const FreeNumber& number : free) result.push_back(sim::real_value(scene, number.path));
  return result;
}

}  // namespace vegard::fit
