#include "sim/render/render_memory.h"

#include <algorithm>
#include <initializer_list>
#include <set>

#include "sim/emit/aurora/motion.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/view/sky/night_sky.h"
#include "sim/view/sky/stars.h"

namespace vegard::sim {
namespace {

using Tables = std::map<std::string, std::string>;

/// A scene's text by the heads of its tables, "[camera]"; of repeated tables all in one.
Tables tables_of(const std::string& text) {
  Tables tables;
  std::string* table = &tables[""];
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
    if (text[at] == '[') table = &tables[text.substr(at, end - at - 1)];
    table->append(text, at, end - at);
    at = end;
  }
  return tables;
}

/// Everything but these tables.
std::string key_without(const Tables& tables, const std::set<std::string>& left_out) {
  std::string key;
  for (const auto& [name, text] : tables)
    if (left_out.count(name) == 0) key += text;
  return key;
}

/// That a picture's light is put together from what shines, and has no part in that.
const std::set<std::string> kLights = {
    "[sky]", "[air]", "[airglow]", "[twilight]", "[light_pollution]", "[composite]", "[stars]", "[fit]"};

std::set<std::string> lights_and(std::set<std::string> others) {
  others.insert(kLights.begin(), kLights.end());
  return others;
}

/// Numbers by their bits.
std::string bits_of(std::initializer_list<double> numbers) {
  std::string text;
  for (const double number : numbers) text.append(reinterpret_cast<const char*>(&number), sizeof number);
  return text;
}

/// Those, and the tables of all that is marched.
std::set<std::string> volumes_and(std::set<std::string> tables) {
  tables.insert({"[[footprint]]", "[[nebula]]", "[[node]]", "[[volume]]", "[march]", "[sun]",
                 "[[chromosphere]]", "[[loop]]", "[[corona]]", "[[bundle]]", "[[ejection]]"});
  return tables;
}

}  // namespace

void RenderMemory::look_at(const Scene& scene, int threads) {
  scene_ = &scene;
  threads_ = threads;
  tables_ = tables_of(write_scene(scene));
  // Tables that the scene names as files, and the folder that it names all of its files from.
  tables_["files"] = scene.file;
  for (const auto& [path, text] : scene.tables) tables_["files"] += path + text;
  tables_["files"] += std::to_string(threads);
}

std::shared_ptr<const Volumes> RenderMemory::volumes() {
  if (!has_volumes(*scene_)) return nullptr;
  std::set<std::string> others = lights_and({"[camera]", "[blur]", "[film]"});
  const auto& footprints = scene_->footprints;
  if (std::none_of(footprints.begin(), footprints.end(),
                   [](const Footprint& footprint) { return footprint.source == FootprintSource::sheets; })) {
    others.insert({"[[sheet]]", "[substorm]"});
    // Ejections move.
    if (!scene_->sun.shown || scene_->ejections.empty()) others.insert("[time]");
  }
  // A picture of depth is of the camera's size.
  const std::string key =
      key_without(tables_, others) +
      bits_of({static_cast<double>(scene_->camera.width), static_cast<double>(scene_->camera.height)});
  if (volumes_.value == nullptr || volumes_.key != key)
    volumes_ = {key, std::make_shared<Volumes>(*scene_, threads_, true)};
  return volumes_.value;
}

Exposer& RenderMemory::exposer(const FilmGeometry& film) {
  const std::string key = key_without(tables_, lights_and({"[camera]", "[sensor]"})) +
                          bits_of({film.x0_px, film.y0_px, film.cell_width_px, film.cell_height_px,
                                   static_cast<double>(film.columns), static_cast<double>(film.rows)});
  const std::shared_ptr<const Volumes> light = volumes();
  if (exposer_.value == nullptr || exposer_.key != key || light != volumes_of_exposer_) {
    exposer_ = {key, std::make_unique<Exposer>(*scene_, film, threads_, 0.0, 0, light)};
    volumes_of_exposer_ = light;
  }
  return *exposer_.value;
}

const Image& RenderMemory::stars(const std::atomic<bool>* stop) {
  const std::string key = key_without(tables_, volumes_and({"[[sheet]]", "[sky]", "[composite]", "[fit]"}));
  if (stars_.value.empty() || stars_.key != key) {
    stars_ = {};
    Image light = star_light(*scene_, instants_s(scene_->time), stop);
    if (stop == nullptr || !stop->load()) stars_.key = key;  // else stars are missing
    stars_.value = std::move(light);
  }
  return stars_.value;
}

const Image& RenderMemory::night_sky() {
  // Of the time the sensor's exposure alone.
  const std::string key =
      key_without(tables_, volumes_and({"[[sheet]]", "[composite]", "[fit]", "[stars]", "[time]"})) +
      bits_of({scene_->time.exposure_s, static_cast<double>(scene_->time.instants)});
  if (night_sky_.value.empty() || night_sky_.key != key)
    night_sky_ = {key, night_sky_light(*scene_, threads_)};
  return night_sky_.value;
}

}  // namespace vegard::sim
