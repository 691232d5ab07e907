// The magnetic field at the feet of beams, for every field model of a scene.
//
// A field line is straight along a beam and has the direction that the field has at its foot
// (docs/physics.md).
#pragma once

#include <memory>

#include "sim/base/number/constants.h"
#include "sim/base/number/dual.h"
#include "sim/emit/aurora/beam.h"
#include "sim/light/field/field_patch.h"
#include "sim/light/sample.h"

namespace vegard::sim {

struct Scene;

/// Returns the reference field around a site at the scene's time. Throws Error(scene) as igrf_year() does.
/// The most recent results are cached.
std::shared_ptr<const FieldPatch> reference_field(const Scene& scene, const Site& site);

/// True if electrons fall along the field at the scene's site, that is in the northern magnetic hemisphere;
/// otherwise they fall against it.
bool falls_along_field(const Scene& scene);

/// A field whose direction differs from foot to foot; empty for a uniform field.
class FootField {
 public:
  FootField() = default;
  explicit FootField(const Scene& scene);

  bool varies() const { return model_ != FieldModel::uniform; }

  /// Returns the frame of fall at the point of the tangent plane (east, north) at kFootAltitudeKm: along B
  /// where B points into the Earth, against it elsewhere; the first axis across is horizontal. The foot must
  /// be closer to the observer than the Earth's radius. Not for an empty FootField.
  template <class T>
  FallFrame<T> at(const T& east_km, const T& north_km) const {
    if (model_ == FieldModel::dipole) return dipole_fall_frame(dipole_, east_km, north_km);
    constexpr double radius = kEarthRadiusKm + kFootAltitudeKm;
    const T height = square_root(radius * radius - east_km * east_km - north_km * north_km);
    const T place[3] = {east_km * (1.0 / radius), north_km * (1.0 / radius), height * (1.0 / radius)};
    T field[3];
    field_of_patch(patch_->numbers<double>(), east_km * patch_->per_place, north_km * patch_->per_place,
                   field);
    FallFrame<T> f;
    fall_in_field(field, place, f.along);
    find_across(f);
    return f;
  }

 private:
  FieldModel model_ = FieldModel::uniform;
  DipoleAxis dipole_{};
  std::shared_ptr<const FieldPatch> patch_;
};

}  // namespace vegard::sim
