#include "fit/fit.h"

#include <cassert>

#include "fit/fit_observations.h"
#include "fit/parameters/free_parameters.h"
#include "sim/base/error.h"

namespace vegard::fit {

FitResult fit_photo(const sim::Scene& given, const Photo& photo, const FitOptions& options) {
  const std::vector<FreeNumber> free = free_numbers(given);
  const sim::Scene scene = with_ties(given, free);
  std::vector<Observation> observations;
  observations.push_back(observed(scene, photo, options.threads));
  return fit_observations(scene, free, observations, options);
}

FitResult fit_photos(const sim::Scene& given, const std::vector<Photo>& photos, const FitOptions& options) {
  assert(photos.size() == given.fit.photos.size() && !photos.empty());
  for (const Photo& photo : photos)
    if (photo.unknowns > 0)
      throw sim::Error(
          sim::ErrorKind::scene,
          {"the transfer curve of " + photo.file_name +
               " is unknown, and that of one photograph alone can be found",
           given.file, 0, "fit.decoding", "a decoding that is known",
           "fit one of them by itself with --decoding unknown, and give all the curve that it tells"});
  const std::vector<FreeNumber> free = free_numbers(given);
  const sim::Scene scene = with_ties(given, free);
  std::vector<Observation> observations;
  for (std::size_t i = 0; i < photos.size(); ++i) {
    const FramedScene framed = framed_scene(scene, scene.fit.photos[i]);
    observations.push_back(
        observed(with_ties(framed.scene, free, framed.frame), photos[i], options.threads, framed.frame));
  }
  return fit_observations(scene, free, observations, options);
}

}  // namespace vegard::fit
