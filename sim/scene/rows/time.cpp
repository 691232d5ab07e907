// [time] and [substorm].
#include "sim/scene/rows/row.h"
#include "sim/scene/rows/rows.h"

namespace vegard::sim {
std::vector<Declaration> time_rows() {
  // clang-format off
  return {
      Row("time", "start_s", &Scene::time, &Time::start_s).in("s").within(-1e7, 1e7)
          .means("time of the picture or first frame on the scene's clock"),
      Row("time", "exposure_s", &Scene::time, &Time::exposure_s).in("s").within(0, 1e5)
          .means("how long the picture is exposed"),
      Row("time", "instants", &Scene::time, &Time::instants).within(1, 1024)
          .means("evenly spaced instants that are averaged, the first at the start"),
      Row("time", "frames_per_second", &Scene::time, &Time::frames_per_second).in("s⁻¹").within(0.001, 1000)
          .means("of an animation"),
      Row("time", "frames", &Scene::time, &Time::frames).within(1, 1000000).means("of an animation"),
      Row("time", "lapse", &Scene::time, &Time::lapse).within(1e-6, 1e7)
          .means("seconds of the scene's clock to a second of an animation; 900: time lapse"),

      Row("substorm", "quiet", &Scene::substorm, &Substorm::quiet).within(0, 1)
          .means("relative brightness of all aurora before and after a substorm; 1: no substorm"),
      Row("substorm", "grown", &Scene::substorm, &Substorm::grown).within(0, 1)
          .means("brightness at the end of the growth phase"),
      Row("substorm", "onset_s", &Scene::substorm, &Substorm::onset_s).in("s").within(-1e7, 1e7)
          .means("when growth ends and expansion begins"),
      Row("substorm", "growth_s", &Scene::substorm, &Substorm::growth_s).in("s").within(1, 1e6)
          .means("length of the growth phase (up to 2 hours)"),
      Row("substorm", "expansion_s", &Scene::substorm, &Substorm::expansion_s).in("s").within(1, 1e6)
          .means("length of the expansion phase (about 20 minutes)"),
      Row("substorm", "recovery_s", &Scene::substorm, &Substorm::recovery_s).in("s").within(1, 1e6)
          .means("length of the recovery phase (half an hour to 2 hours)"),
  };
  // clang-format on
}

}  // namespace vegard::sim
