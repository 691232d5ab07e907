// [[volume]]: light from OpenVDB files.
#include "sim/scene/parameter_rules.h"
#include "sim/scene/rows/row.h"
#include "sim/scene/rows/rows.h"

namespace vegard::sim {
namespace {

template <class Value>
Row row(const char* key, Value Volume::*value) {
  return Row("volume", key, &Scene::volumes, value);
}

}  // namespace

std::vector<Declaration> volume_rows() {
  constexpr auto linear = ParameterScale::linear;
  constexpr auto logarithmic = ParameterScale::logarithmic;
  // clang-format off
  return {
      row("name", &Volume::name).rule(element_name_complaint).means("by which paths call the volume"),
      row("file", &Volume::file).means("OpenVDB file beside the scene's, with grids such as emission_5577"),
      row("shift_km", &Volume::shift_km).of({"east", "north", "up"}).in("km").within(-1e5, 1e5).may_be_free(linear)
          .means("by how much it is moved"),
      row("gain", &Volume::gain).within(0, 1e9).may_be_free(logarithmic).means("times its light"),
      row("extinction_per_km", &Volume::extinction_per_km).in("km⁻¹").within(0, 1e6).may_be_free(linear)
          .means("extinction of density 1 of its grid \"density\"; 0: nothing is absorbed"),
      row("step_voxels", &Volume::step_voxels).within(0.05, 8).means("step of the march, in edges of a voxel"),
  };
  // clang-format on
}

}  // namespace vegard::sim
