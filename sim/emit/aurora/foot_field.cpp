#include "sim/emit/aurora/foot_field.h"

#include <array>
#include <cstddef>
#include <mutex>
#include <string>

#include "sim/light/field/igrf.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {
namespace {

/// A patch and what it was made for.
struct KeptField {
  std::string time_utc;
  double latitude_deg = 0.0, longitude_deg = 0.0;
  std::shared_ptr<const FieldPatch> patch;
};

}  // namespace

std::shared_ptr<const FieldPatch> reference_field(const Scene& scene, const Site& site) {
  // A fit asks thousands of times for the fields of its few stations.
  static std::mutex mutex;
  static std::array<KeptField, 8> kept;
  static std::size_t next = 0;
  const std::lock_guard<std::mutex> lock(mutex);
  for (const KeptField& of : kept)
    if (of.patch && of.time_utc == scene.site.time_utc && of.latitude_deg == site.latitude_deg &&
        of.longitude_deg == site.longitude_deg)
      return of.patch;
  KeptField& place = kept[next++ % kept.size()];
  place = {};
  place = {scene.site.time_utc, site.latitude_deg, site.longitude_deg,
           plane_field(Igrf(igrf_year(scene)), site)};
  return place.patch;
}

bool falls_along_field(const Scene& scene) {
  switch (scene.field.model) {
    case FieldModel::dipole:
      return (dipole_axis(scene.field, scene.site).in_enu[2] >= 0.0) ==
             (scene.body.dipole_moment_t_m3 >= 0.0);
    case FieldModel::igrf: {
      double field[3];
      field_of_patch(reference_field(scene, scene.site)->numbers<double>(), 0.0, 0.0, field);
      return field[2] <= 0.0;
    }
    case FieldModel::uniform:
      break;
  }
  return scene.field.inclination_deg >= 0.0;
}

FootField::FootField(const Scene& scene) : model_(scene.field.model) {
  if (model_ == FieldModel::dipole) dipole_ = dipole_axis(scene.field, scene.site, scene.body.radius_km);
  if (model_ == FieldModel::igrf) patch_ = reference_field(scene, scene.site);
}

}  // namespace vegard::sim
