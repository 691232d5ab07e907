// What pictures that follow each other have in common: a preview turns its camera, or changes one number, and
// all else need not be worked out again.
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

/// Given to render() with one scene after the other. Each part is kept for as long as no table of the scene
/// that it may depend on changes by a single digit, so that the picture is that of a render() without it.
/// Files are read once: what changes in them later is not seen. Not for use by two threads at once.
class RenderMemory {
 public:
  /// Of which scene the others are asked next; it must live as long.
  void look_at(const Scene& scene, int threads);

  /// The scene's beams laid out, and its volumes ready to be marched, on this film.
  Exposer& exposer(const FilmGeometry& film);

  /// As star_light() at the scene's own instants, and night_sky_light().
  const Image& stars(const std::atomic<bool>* stop);
  const Image& night_sky();

  /// What falls on the ground of that scene as it was given, before it got beams for its own picture: no
  /// camera has a part in it. `light_on_ground` tells it where it is not known yet.
  const GroundIllumination& on_ground(const Scene& as_given, const std::atomic<bool>* stop,
                                      const std::function<GroundIllumination()>& light_on_ground);

 private:
  /// A part, and the scene that it was made for: good for every other that has the same values, but for those
  /// of tables that have no part in it.
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
