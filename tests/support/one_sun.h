// A small Sun due north on the horizon, and rays to it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "gtest/gtest.h"
#include "sim/light/emitter.h"
#include "sim/scene/structs/scene.h"
#include "tests/support/free_paths.h"

namespace vegard::tests {

/// Two lines, 630.0 and 557.7 nm; radius 10, seen from 100 units away, a unit a kilometre.
inline sim::Scene one_sun() {
  sim::Scene scene;
  scene.emission.lines = {630.0, 557.7};
  scene.blur.width_deg = {0.0, 0.0};
  scene.sun.shown = true;
  scene.sun.azimuth_deg = 0.0;
  scene.sun.elevation_deg = 0.0;
  scene.sun.distance_km = 100.0;
  scene.sun.unit_km = 1.0;
  scene.sun.radius = 10.0;
  return scene;
}

/// East, north, up of rays that pass the middle of one_sun() at places to the right and up, as bundles have
/// them.
struct RaysPast {
  std::vector<double> direction[3], end_km;
  void add(double right, double up, double end = std::numeric_limits<double>::infinity()) {
    const double d[3] = {right / 100.0, std::sqrt(1.0 - (right * right + up * up) / 1e4), up / 100.0};
    for (int axis = 0; axis < 3; ++axis) direction[axis].push_back(d[axis]);
    end_km.push_back(end);
  }
};

template <class T>
struct LightPast {
  std::vector<T> rayleigh, kept;  ///< [line][ray]
  std::vector<double> entry_km, depth_km;
};

template <class T>
LightPast<T> light_past(const sim::Emitter<T>& emitter, const RaysPast& rays, double cell_rad = 0.0,
                        int lines = 2) {
  const std::size_t count = rays.end_km.size();
  std::vector<T> direction[3];
  for (int axis = 0; axis < 3; ++axis)
    for (const double d : rays.direction[axis]) direction[axis].push_back(T(d));
  LightPast<T> light;
  light.rayleigh.assign(count * lines, T(0.0));
  light.kept.assign(count * lines, T(1.0));
  light.entry_km.assign(count, std::numeric_limits<double>::infinity());
  light.depth_km = light.entry_km;
  emitter.march(
      {count, {direction[0].data(), direction[1].data(), direction[2].data()}, rays.end_km.data(), cell_rad},
      {lines, light.rayleigh.data(), light.kept.data(), light.entry_km.data(), light.depth_km.data()});
  return light;
}

/// Compares the derivatives of rayleighs and of shares kept, by every number of the given tables that may be
/// free, with central differences: root mean squares over the rays, to `tolerance` of the derivative's own.
/// `make` gives an emitter: make(scene, number) of either type. Returns the keys that any light depends on.
template <class Make>
std::vector<std::string> check_sun_derivatives(const sim::Scene& scene, const RaysPast& rays, double cell_rad,
                                               const std::vector<std::string>& tables, double step,
                                               double tolerance, const Make& make) {
  using sim::FreeDual;
  const auto plain = [&](const sim::Scene& of) {
    const LightPast<double> light =
        light_past<double>(*make(of, sim::NumberAs<double>(sim::plain_number)), rays, cell_rad);
    std::vector<double> all = light.rayleigh;
    all.insert(all.end(), light.kept.begin(), light.kept.end());
    return all;
  };
  std::vector<std::string> moved;
  const std::vector<double> here = plain(scene);
  double norm = 0.0;
  for (const double one : here) norm += one * one;
  norm = std::sqrt(norm);
  for (const FreePath& one : free_paths(scene)) {
    if (std::find(tables.begin(), tables.end(), one.path.row->table) == tables.end()) continue;
    const double* const free = sim::real_value(scene, one.path);
    const LightPast<FreeDual> light =
        light_past<FreeDual>(*make(scene, sim::NumberAs<FreeDual>([&](const double& number) {
                                     FreeDual dual(number);
                                     if (&number == free) dual.d.t[3] = 1.0;
                                     return dual;
                                   })),
                             rays, cell_rad);
    std::vector<FreeDual> dual = light.rayleigh;
    dual.insert(dual.end(), light.kept.begin(), light.kept.end());
    sim::Scene more = scene, less = scene;
    const double h = step * std::max(1.0, std::abs(*free));
    *sim::real_value(more, one.path) += h;
    *sim::real_value(less, one.path) -= h;
    const std::vector<double> high = plain(more), low = plain(less);
    double off = 0.0, size = 0.0;
    for (std::size_t i = 0; i < here.size(); ++i) {
      EXPECT_NEAR(dual[i].v, here[i], 1e-12 * std::max(1.0, std::abs(here[i])));
      const double difference = (high[i] - low[i]) / (2.0 * h);
      off += (dual[i].d.t[3] - difference) * (dual[i].d.t[3] - difference);
      size += difference * difference;
    }
    const double rounding = 1e-14 * norm / h;
    if (std::sqrt(size) > 10.0 * rounding) moved.push_back(one.path.text);
    EXPECT_LE(std::sqrt(off), tolerance * std::sqrt(size) + rounding)
        << one.path.text << ": " << std::sqrt(size);
  }
  return moved;
}

}  // namespace vegard::tests
