// [[volume]]: light from files of voxels.
#include "sim/scene/table/parameter_rules.h"
#include "sim/scene/table/rows/line_component.h"
#include "sim/scene/table/rows/row.h"
#include "sim/scene/table/rows/rows.h"

namespace vegard::sim {
namespace {

template <class Value>
Row row(const char* key, Value Volume::*value) {
  return Row("volume", key, &Scene::volumes, value);
}

}  // namespace

std::vector<Declaration> volume_rows() {
  // clang-format off
  return {
      row("name", &Volume::name).rule(element_name_complaint).means("by which paths call the volume"),
      row("file", &Volume::file).means("file beside the scene's: OpenVDB, with grids such as emission_5577 or density, or the densities of a pbrt volumegrid (`.pbrt`, `.volumegrid`, `.txt`)"),
      row("frame", &Volume::frame).one_of({"site", "sun"})
          .means("where the file is at home: on the ground, in km; or on the Sun, in units of sun.unit_km"),
      row("shift_km", &Volume::shift_km).of({"east", "north", "up"}).in("km").within(-1e5, 1e5).may_be_free(ParameterScale::linear)
          .means("by how much it is moved; on the Sun along the x, y and z of its frame"),
      row("gain", &Volume::gain).within(0, 1e9).may_be_free(ParameterScale::logarithmic).means("times its light"),
      row("extinction_per_km", &Volume::extinction_per_km).in("km⁻¹").within(0, 1e6).may_be_free(ParameterScale::linear)
          .means("extinction of density 1 of its grid \"density\"; 0: nothing is absorbed"),
      row("density_rayleigh", &Volume::density_rayleigh).of({"<line>"}).named_by(name_by_line).in("R").within(0, 1e12).may_be_free(ParameterScale::linear)
          .means("light of density 1 of its grid \"density\", per emission line, to a km of path (a unit of the Sun's frame), in place of the file's emission grids; empty: none"),
      row("step_voxels", &Volume::step_voxels).within(0.05, 8).means("step of the march, in edges of a voxel"),
  };
  // clang-format on
}

}  // namespace vegard::sim
