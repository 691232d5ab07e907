#include "sim/light/field/field_patch.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>

#include "sim/base/number/constants.h"
#include "sim/scene/structs/site_axes.h"

namespace vegard::sim {
namespace {

constexpr int kNodes = 18;  // along each side: more than the degree, so that little of higher ones folds back
constexpr double kUnitNt = 50000.0;

using Components = std::array<double, 3>;

/// Fits a patch to a field, which is called with places from -reach to reach.
FieldPatch fitted(double reach, const std::function<Components(double, double)>& field) {
  const auto chebyshev = [](int degree, int node) { return std::cos(kPi * degree * (node + 0.5) / kNodes); };
  std::array<std::array<Components, kNodes>, kNodes> at;
  for (int i = 0; i < kNodes; ++i)
    for (int j = 0; j < kNodes; ++j)
      at[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] =
          field(reach * chebyshev(1, i), reach * chebyshev(1, j));
  FieldPatch patch;
  patch.per_place = 1.0 / reach;
  std::size_t term = 0;
  for (int a = 0; a <= kFieldDegree; ++a)
    for (int b = 0; b <= kFieldDegree; ++b, ++term) {
      Components sum{};
      for (int i = 0; i < kNodes; ++i)
        for (int j = 0; j < kNodes; ++j)
          for (std::size_t k = 0; k < 3; ++k)
            sum[k] += at[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)][k] * chebyshev(a, i) *
                      chebyshev(b, j);
      const double weight =
          (a == 0 ? 1.0 : 2.0) * (b == 0 ? 1.0 : 2.0) / (static_cast<double>(kNodes) * kNodes * kUnitNt);
      for (std::size_t k = 0; k < 3; ++k) patch.coefficient[k * kFieldTerms + term] = sum[k] * weight;
    }
  std::transform(patch.coefficient.begin(), patch.coefficient.end(), patch.rounded.begin(),
                 [](double c) { return static_cast<float>(c); });
  return patch;
}

/// Inverts evened().
double uneven(double even) {
  double u = std::tan(even);
  for (int round = 0; round < 30; ++round) {
    constexpr double kStep = 1e-6;
    const double slope = (evened(u + kStep) - evened(u - kStep)) / (2.0 * kStep);
    u -= (evened(u) - even) / slope;
  }
  return u;
}

/// Returns the field at the foot in a direction of the Earth's axes, in those axes.
Components in_earth_axes(const Igrf& igrf, const Components& direction) {
  Site place;
  place.latitude_deg = std::atan2(direction[2], std::hypot(direction[0], direction[1])) / kRadiansPerDegree;
  place.longitude_deg = std::atan2(direction[1], direction[0]) / kRadiansPerDegree;
  const FieldVector field = igrf.at(place.latitude_deg, place.longitude_deg, kFootAltitudeKm);
  const SiteAxes axes = axes_at(place);
  Components sum{};
  for (std::size_t i = 0; i < 3; ++i)
    sum[i] =
        field.east_nt * axes.axis[0][i] + field.north_nt * axes.axis[1][i] - field.down_nt * axes.axis[2][i];
  return sum;
}

}  // namespace

std::shared_ptr<const FieldPatch> plane_field(const Igrf& igrf, const Site& site) {
  const SiteAxes axes = axes_at(site);
  constexpr double kRadius = kEarthRadiusKm + kFootAltitudeKm;
  return std::make_shared<const FieldPatch>(fitted(kFieldReachKm, [&](double east, double north) {
    const Components enu = {east, north, std::sqrt(kRadius * kRadius - east * east - north * north)};
    Components direction{}, local{};
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t i = 0; i < 3; ++i) direction[a] += enu[i] * axes.axis[i][a];
    const Components field = in_earth_axes(igrf, direction);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t a = 0; a < 3; ++a) local[i] += field[a] * axes.axis[i][a];
    return local;
  }));
}

std::shared_ptr<const std::array<FieldPatch, 6>> face_fields(const Igrf& igrf, double turned_deg) {
  const double c = std::cos(turned_deg * kRadiansPerDegree), s = std::sin(turned_deg * kRadiansPerDegree);
  auto faces = std::make_shared<std::array<FieldPatch, 6>>();
  for (std::size_t face = 0; face < faces->size(); ++face)
    (*faces)[face] = fitted(evened(kFieldReachOfFace), [&](double even_u, double even_v) {
      const double u = uneven(even_u), v = uneven(even_v);
      const std::size_t a = face / 2;
      Components on{};
      on[a] = face % 2 == 0 ? 1.0 : -1.0;
      on[(a + 1) % 3] = u;
      on[(a + 2) % 3] = v;
      const Components field = in_earth_axes(igrf, {c * on[0] - s * on[1], s * on[0] + c * on[1], on[2]});
      return Components{c * field[0] + s * field[1], c * field[1] - s * field[0], field[2]};
    });
  return faces;
}

}  // namespace vegard::sim
