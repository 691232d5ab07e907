#include "sim/render/render_memory.h"

#include <algorithm>
#include <utility>

#include "sim/emit/aurora/motion.h"
#include "sim/scene/emitters/emitter_kinds.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/view/sky/night_sky.h"
#include "sim/view/sky/stars.h"

namespace vegard::sim {
namespace {

/// The tables that affect how a picture is composed of its lights, but not the light of emitters.
const std::set<std::string> kLights = {"sky",       "air",   "airglow", "twilight", "light_pollution",
                                       "composite", "stars", "moon",    "ground",   "fit"};

std::set<std::string> lights_and(std::set<std::string> others) {
  others.insert(kLights.begin(), kLights.end());
  return others;
}

bool same_film(const FilmGeometry& a, const FilmGeometry& b) {
  return a.x0_px == b.x0_px && a.y0_px == b.y0_px && a.cell_width_px == b.cell_width_px &&
         a.cell_height_px == b.cell_height_px && a.columns == b.columns && a.rows == b.rows &&
         a.turn_columns == b.turn_columns;
}

/// These, and the tables of all that is marched.
std::set<std::string> volumes_and(std::set<std::string> tables) {
  tables.insert("march");
  for (const EmitterKind& kind : emitter_kinds()) {
    if (kind.repeated.empty()) tables.insert(kind.table);
    for (const RepeatedTable& repeated : kind.repeated) tables.insert(repeated.table);
  }
  return tables;
}

}  // namespace

template <class T>
bool RenderMemory::is_good(const Kept<T>& kept, const Scene& scene,
                           const std::set<std::string>& but_for) const {
  return kept.made_for && kept.threads == threads_ && same_values(*kept.made_for, scene, but_for);
}

void RenderMemory::look_at(const Scene& scene, int threads) {
  scene_ = &scene;
  threads_ = threads;
}

std::shared_ptr<const Volumes> RenderMemory::volumes() {
  // Under the physical blur an exposer has its own.
  if (!has_volumes(*scene_) || scene_->blur.model == BlurModel::physical) return nullptr;
  std::set<std::string> others = lights_and({"camera", "blur", "film"});
  if (!has_emitters_of_sheets(*scene_)) others.insert("sheet");
  if (!has_moving_emitters(*scene_)) others.insert("time");
  // A picture of depth is of the camera's size.
  const auto same_size = [&](const Camera& camera) {
    return camera.width == scene_->camera.width && camera.height == scene_->camera.height;
  };
  if (!is_good(volumes_, *scene_, others) || !same_size(volumes_.made_for->camera))
    volumes_ = {*scene_, threads_, std::make_shared<Volumes>(*scene_, threads_, true)};
  return volumes_.value;
}

Exposer& RenderMemory::exposer(const FilmGeometry& film) {
  const std::shared_ptr<const Volumes> light = volumes();
  // How widely the atoms' light is spread, and so on which films, is a matter of the camera.
  const std::set<std::string> others =
      scene_->blur.model == BlurModel::physical ? lights_and({"sensor"}) : lights_and({"camera", "sensor"});
  if (!is_good(exposer_, *scene_, others) || !same_film(film, film_of_exposer_) ||
      light != volumes_of_exposer_) {
    exposer_ = {*scene_, threads_, make_exposer(*scene_, film, threads_, 0.0, BeamSampling{}, light)};
    film_of_exposer_ = film;
    volumes_of_exposer_ = light;
  }
  return *exposer_.value;
}

const Image& RenderMemory::stars(const std::atomic<bool>* stop) {
  if (!is_good(stars_, *scene_, volumes_and({"sheet", "sky", "composite", "ground", "fit"}))) {
    stars_ = {};
    Image light = star_light(*scene_, instants_s(scene_->time), stop, threads_);
    stars_.value = std::move(light);
    stars_.threads = threads_;
    if (stop == nullptr || !stop->load()) stars_.made_for = *scene_;  // else stars are missing
  }
  return stars_.value;
}

const Image& RenderMemory::night_sky() {
  // Only the exposure matters of the scene's time, unless the sky moves.
  std::set<std::string> others = volumes_and({"sheet", "composite", "ground", "fit"});
  const bool moved = night_sky_.made_for && night_sky_moves(*night_sky_.made_for);
  if (!moved && !night_sky_moves(*scene_)) others.insert({"stars", "moon", "time"});
  const auto same_exposure = [&](const Time& time) {
    return time.exposure_s == scene_->time.exposure_s && time.instants == scene_->time.instants;
  };
  if (!is_good(night_sky_, *scene_, others) || !same_exposure(night_sky_.made_for->time))
    night_sky_ = {*scene_, threads_, night_sky_light(*scene_, threads_)};
  return night_sky_.value;
}

const GroundIllumination& RenderMemory::on_ground(
    const Scene& as_given, const std::atomic<bool>* stop,
    const std::function<GroundIllumination()>& light_on_ground) {
  if (!is_good(ground_, as_given, {"camera", "composite", "ground", "fit"})) {
    ground_ = {{}, threads_, light_on_ground()};
    if (stop == nullptr || !stop->load()) ground_.made_for = as_given;  // else it is dark
  }
  return ground_.value;
}

}  // namespace vegard::sim
