// Cache of what successive pictures have in common: when a preview turns its camera or changes one number,
// the rest need not be computed again.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "sim/base/image.h"
#include "sim/render/film.h"
#include "sim/render/lit_ground.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/camera/camera.h"

namespace vegard::sim {

/// The caller passes one object to render() for each of a series of scenes. Each part is kept as long as no
/// table of the scene that it may depend on changes at all, so the picture is the same as without the cache.
/// Files are read once: later changes in them have no effect. Two threads must not use one object at once.
class RenderMemory {
 public:
  /// Sets the scene that the other functions refer to; it must live until the next look_at() or last call.
  void look_at(const Scene& scene, int threads);

  /// Returns an Exposer for this film, with the scene's beams laid out and its volumes ready to be marched.
  Exposer& exposer(const FilmGeometry& film);

  /// Return what star_light() at the scene's own instants and night_sky_light() return.
  const Image& stars(const std::atomic<bool>* stop);
  const Image& night_sky();

  /// Returns the light on the ground of `as_given`: the scene before with_enough_beams() changed it for its
  /// picture, since this light does not depend on the camera. Calls `light_on_ground` if no value is kept.
  const GroundIllumination& on_ground(const Scene& as_given, const std::atomic<bool>* stop,
                                      const std::function<GroundIllumination()>& light_on_ground);

 private:
  /// A part of the cache and the scene that it was made for. It is valid for every scene with the same values
  /// in all tables that it depends on.
  template <class T>
  struct Kept {
    std::optional<Scene> made_for;
    int threads = 0;
    T value{};
  };
  template <class T>
  bool is_good(const Kept<T>& kept, const Scene& scene, const std::set<std::string>& but_for) const;

  std::shared_ptr<const Volumes> volumes();

  const Scene* scene_ = nullptr;
  int threads_ = 0;
  Kept<std::shared_ptr<const Volumes>> volumes_;
  Kept<std::unique_ptr<Exposer>> exposer_;
  FilmGeometry film_of_exposer_;
  std::shared_ptr<const Volumes> volumes_of_exposer_;
  Kept<Image> stars_, night_sky_;
  Kept<GroundIllumination> ground_;
};

}  // namespace vegard::sim
