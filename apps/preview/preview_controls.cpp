#include "apps/preview/preview_controls.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "sim/base/error.h"
#include "sim/scene/emitters/emitter_kinds.h"
#include "sim/view/camera/camera.h"

namespace vegard::apps {
namespace {

/// 1, 2 or 5 times a power of ten, the nearest below.
double round_number(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  const double share = value / power;
  return (share < 2.0 ? 1.0 : share < 5.0 ? 2.0 : 5.0) * power;
}

int place_in_order(const sim::ParameterPath& path) {
  const std::string& table = path.row->table;
  if (table == "camera") return sim::EmitterKind::kLastInPreview - 2;
  if (table == sim::sheet_table) return sim::EmitterKind::kLastInPreview - 1;
  const sim::EmitterKind* kind = sim::kind_of_table(table);
  return kind != nullptr && kind->table == table ? kind->place_in_preview : sim::EmitterKind::kLastInPreview;
}

std::vector<sim::ParameterPath> real_paths(const sim::Scene& scene) {
  std::vector<sim::ParameterPath> paths;
  for (const sim::ParameterPath& path : sim::all_paths(scene))
    if (path.row->kind == sim::ParameterKind::real && path.row->table != "fit") paths.push_back(path);
  std::stable_sort(paths.begin(), paths.end(),
                   [](const auto& a, const auto& b) { return place_in_order(a) < place_in_order(b); });
  return paths;
}

/// A window's letters know no others than ASCII.
std::string ascii(const std::string& text) {
  static const std::map<std::string, std::string> known = {{"⁻", "^-"}, {"²", "2"},   {"³", "3"},
                                                           {"¹", "1"},  {"°", "deg"}, {"µ", "u"}};
  std::string plain;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t length = 1;
    while (i + length < text.size() && (static_cast<unsigned char>(text[i + length]) & 0xC0) == 0x80)
      ++length;
    const std::string letter = text.substr(i, length);
    const auto found = known.find(letter);
    plain += found != known.end() ? found->second : length == 1 ? letter : "?";
    i += length;
  }
  return plain;
}

}  // namespace

double natural_step(const sim::ParameterRow& row, double value) {
  if (row.scale == sim::ParameterScale::logarithmic) return 0.05;
  if (row.scale == sim::ParameterScale::angle) return row.unit == "rad" ? 0.02 : 1.0;
  if (value != 0.0) return round_number(0.05 * std::abs(value));
  const double range = row.max - row.min;
  return round_number(std::isfinite(range) && range > 0.0 ? 1e-3 * range : 0.01);
}

PreviewControls::PreviewControls(const sim::Scene& scene)
    : scene_(scene), given_(scene), paths_(real_paths(scene)) {
  for (const sim::ParameterPath& path : paths_)
    steps_.push_back(natural_step(*path.row, *sim::real_value(scene_, path)));
}

void PreviewControls::choose_next(int by) {
  const auto count = static_cast<long>(paths_.size());
  chosen_ = static_cast<std::size_t>(((static_cast<long>(chosen_) + by) % count + count) % count);
}

void PreviewControls::change_chosen(int steps) {
  const sim::ParameterRow& row = *chosen().row;
  const double value = *sim::real_value(scene_, chosen()), step = steps_[chosen_];
  if (row.scale == sim::ParameterScale::logarithmic) {
    // From nothing no share leads away.
    const double from = value != 0.0 ? value : steps > 0 ? 1e-3 : 0.0;
    set(chosen(), from * std::pow(1.0 + step, steps));
  } else {
    const double moved = value + steps * step;
    // What rounding leaves of a zero is none.
    set(chosen(), std::abs(moved) < 1e-9 * step ? 0.0 : moved);
  }
}

void PreviewControls::change_step(double factor) { steps_[chosen_] *= factor; }

void PreviewControls::set(const sim::ParameterPath& path, double value) {
  double& number = *sim::real_value(scene_, path);
  const double before = number;
  number = std::clamp(value, path.row->min, path.row->max);
  try {
    sim::validate(scene_);
  } catch (const sim::Error&) {
    number = before;
  }
}

void PreviewControls::set_camera(double* number, const std::string& path, double value) {
  const sim::ParameterPath row = sim::resolve(scene_, path).front();
  *number = std::clamp(value, row.row->min, row.row->max);
}

void PreviewControls::pan(double right_px, double down_px) {
  sim::Camera& camera = scene_.camera;
  const double px_per_degree = sim::pixels_per_degree(camera);
  // Near the zenith a step aside is a long way in azimuth; not more than tenfold.
  const double level = std::max(0.1, std::cos(camera.elevation_deg * sim::kRadiansPerDegree));
  const double side = camera.mirrored ? -1.0 : 1.0;
  const double azimuth = camera.azimuth_deg - side * right_px / px_per_degree / level;
  set_camera(&camera.azimuth_deg, "camera.azimuth_deg", std::remainder(azimuth - 180.0, 360.0) + 180.0);
  set_camera(&camera.elevation_deg, "camera.elevation_deg",
             std::clamp(camera.elevation_deg + down_px / px_per_degree, -90.0, 90.0));
}

void PreviewControls::zoom(double steps) {
  sim::Camera& camera = scene_.camera;
  const double closer = std::pow(1.05, steps);
  if (camera.model == sim::LensModel::pinhole) {
    const double half = std::tan(0.5 * camera.hfov_deg * sim::kRadiansPerDegree) / closer;
    set_camera(&camera.hfov_deg, "camera.hfov_deg", 2.0 * std::atan(half) / sim::kRadiansPerDegree);
  } else {
    set_camera(&camera.focal_px, "camera.focal_px", camera.focal_px * closer);
  }
}

void PreviewControls::reset() { scene_ = given_; }

void PreviewControls::run_time(double seconds) {
  set_camera(&scene_.time.start_s, "time.start_s", scene_.time.start_s + seconds);
}

std::string PreviewControls::words() const {
  const sim::ParameterRow& row = *chosen().row;
  const bool is_factor = row.scale == sim::ParameterScale::logarithmic;
  const double step = steps_[chosen_];
  return ascii(fmt::format("{} = {:.6g}{}{}  ({} {:.6g})", chosen().text, *sim::real_value(scene_, chosen()),
                           row.unit.empty() ? "" : " ", row.unit, is_factor ? "x" : "+-",
                           is_factor ? 1.0 + step : step));
}

}  // namespace vegard::apps
