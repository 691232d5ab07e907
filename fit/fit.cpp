#include "fit/fit.h"

#include <cassert>

#include "fit/fit_observations.h"
#include "fit/parameters/free_parameters.h"

namespace vegard::fit {

FitResult fit_photo(const sim::Scene& given, const Photo& photo, const FitOptions& options) {
  const std::vector<FreeNumber> free = free_numbers(given);
  const sim::Scene scene = with_ties(given, free);
  std::vector<Observation> observations;
  observations.push_back(observed(scene, photo, options.threads));
  add_radars(scene, observations);
  return fit_observations(scene, free, observations, options);
}

FitResult fit_photos(const sim::Scene& given, const std::vector<Photo>& photos, const FitOptions& options) {
  assert(photos.size() == given.fit.photos.size() && !photos.empty());
  const std::vector<FreeNumber> free = free_numbers(given);
  const sim::Scene scene = with_ties(given, free);
  std::vector<const Photo*> all;
  for (const Photo& photo : photos) all.push_back(&photo);
  return fit_observations(scene, free, observations_of(scene, free, all, options.threads), options);
}

}  // namespace vegard::fit
