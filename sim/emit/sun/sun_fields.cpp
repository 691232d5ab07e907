#include "sim/emit/sun/sun_fields.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sim/emit/sun/line_light.h"
#include "sim/emit/sun/sun_frame.h"
#include "sim/light/emitter.h"

namespace vegard::sim {
namespace {

double square_of(const double place[3]) {
  return place[0] * place[0] + place[1] * place[1] + place[2] * place[2];
}

}  // namespace

ShellField::ShellField(const Sun& sun, double inner, double outer, const std::vector<double>& light,
                       int lines)
    : unit_cm_(sun.unit_km * kCmPerKm),
      inner_(inner),
      outer_(outer),
      rate_(static_cast<std::size_t>(lines), 0.0) {
  for (std::size_t l = 0; l < light.size(); ++l) rate_[l] = photons_per_volume(light[l], unit_cm_);
}

Box3 ShellField::bounds() const { return {{-outer_, -outer_, -outer_}, {outer_, outer_, outer_}}; }

bool ShellField::is_dark(const Box3& box) const {
  double nearest[3], farthest[3];
  for (int axis = 0; axis < 3; ++axis) {
    nearest[axis] = std::max({box.low[axis], -box.high[axis], 0.0});
    farthest[axis] = std::max(std::abs(box.low[axis]), std::abs(box.high[axis]));
  }
  return square_of(nearest) > outer_ * outer_ || square_of(farthest) < inner_ * inner_;
}

void ShellField::sample(std::size_t count, const double* const point[3], float* const emission[],
                        float* density) const {
  for (std::size_t i = 0; i < count; ++i) {
    const double place[3] = {point[0][i], point[1][i], point[2][i]};
    const double square = square_of(place);
    Here at{0.0, 0.0};
    if (square >= inner_ * inner_ && square <= outer_ * outer_) at = here(place);
    density[i] = static_cast<float>(at.density);
    for (std::size_t l = 0; l < rate_.size(); ++l) emission[l][i] = static_cast<float>(at.light * rate_[l]);
  }
}

ChromosphereField::ChromosphereField(const Scene& scene, int index, const Image* biasmap)
    : ChromosphereField(scene, scene.chromospheres[static_cast<std::size_t>(index)], index, biasmap) {}

ChromosphereField::ChromosphereField(const Scene& scene, const Chromosphere& c, int index,
                                     const Image* biasmap)
    : ShellField(scene.sun, std::max(c.innerradius, scene.sun.radius), c.outerradius,
                 line_light(scene, c.rayleigh, 0.0, plain_number),
                 static_cast<int>(scene.emission.lines.size())),
      density_(scene, index, biasmap, plain_number),
      absorbs_(c.extinction > 0.0) {}

ShellField::Here ChromosphereField::here(const double place[3]) const {
  const double density = density_.at(place);
  return {density, absorbs_ ? density : 0.0};
}

CoronaField::CoronaField(const Scene& scene, const Corona& corona)
    : ShellField(scene.sun, scene.sun.radius, scene.sun.radius * corona.reach,
                 line_light(scene, corona.rayleigh, corona.temperature_mk, plain_number),
                 static_cast<int>(scene.emission.lines.size())),
      source_(scene, corona, plain_number) {
  SunFrame<double>(scene.sun, plain_number).observer(observer_);
}

ShellField::Here CoronaField::here(const double place[3]) const {
  const double square = square_of(place);
  double to_observer[3], along = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    to_observer[axis] = observer_[axis] - place[axis];
    along += to_observer[axis] * place[axis];
  }
  const double away = square_of(to_observer) * square;
  const double square_cosine = away > 0.0 ? along * along / away : 0.0;
  return {source_.light(square, place[2] * place[2] / square, std::max(1.0 - square_cosine, 0.0)), 0.0};
}

}  // namespace vegard::sim
