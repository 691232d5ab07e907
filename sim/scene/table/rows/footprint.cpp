// [[footprint]]: aurora by its footprint.
#include "sim/scene/table/parameter_rules.h"
#include "sim/scene/table/rows/row.h"
#include "sim/scene/table/rows/rows.h"

namespace vegard::sim {
namespace {

template <class Value>
Row row(const char* key, Value Footprint::*value) {
  return Row("footprint", key, &Scene::footprints, value);
}

std::string name_by_spline_point(const Scene&, int, int index) { return std::to_string(index); }

}  // namespace

std::vector<Declaration> footprint_rows() {
  using F = Footprint;
  // clang-format off
  return {
      row("name", &F::name).rule(element_name_complaint).means("by which paths call the footprint"),
      row("shape", &F::shape).one_of({"box", "shell"})
          .means("a box about a point of the observer's tangent plane, or a shell around the whole Earth"),
      row("model", &F::model).one_of({"volume", "curtain"})
          .means("light with a thickness, or upright walls without one along the splines, a cheap preview"),
      row("source", &F::source).one_of({"spline", "image", "cube", "sheets", "noise"})
          .means("where the footprint comes from: a curve through points, a picture, six pictures of a cube's faces, the scene's sheets (which are then not drawn as beams), or fractal noise in a box"),
      row("fall", &F::fall).one_of({"field", "vertical"})
          .means("along the scene's field, or straight down; a shell's light always falls straight down"),
      row("center_km", &F::center_km).of({"east", "north"}).in("km").within(-3000, 3000).may_be_free(ParameterScale::linear)
          .means("middle of a box, of the feet at 110 km altitude"),
      row("size_km", &F::size_km).of({"east", "north"}).in("km").within(1, 6000)
          .means("extent of a box"),
      row("cell_km", &F::cell_km).in("km").within(0.01, 100).means("edge of a cell of a box's footprint"),
      row("face_cells", &F::face_cells).within(16, 8192)
          .means("cells along an edge of each of the six cube faces of a shell's footprint"),
      row("east_km", &F::east_km).of({"<n>"}).named_by(name_by_spline_point).in("km").within(-6000, 6000).may_be_free(ParameterScale::linear)
          .means("points of a box's spline, from the box's middle to the east"),
      row("north_km", &F::north_km).of({"<n>"}).named_by(name_by_spline_point).in("km").within(-6000, 6000).may_be_free(ParameterScale::linear)
          .means("the same to the north"),
      row("latitude_deg", &F::latitude_deg).of({"<n>"}).named_by(name_by_spline_point).in("deg").within(-90, 90)
          .means("points of a shell's spline: geographic latitude"),
      row("longitude_deg", &F::longitude_deg).of({"<n>"}).named_by(name_by_spline_point).in("deg").within(-360, 720)
          .means("the same: longitude, east positive"),
      row("closed", &F::closed).means("the spline's last point is followed by its first"),
      row("width_km", &F::width_km).in("km").within(0.01, 1000).may_be_free(ParameterScale::logarithmic)
          .means("standard deviation of the Gaussian across the spline"),
      row("image", &F::image)
          .means("picture of the footprint beside the scene's file: north up over a box; equirectangular around the Earth; of a cube \"NAME_{face}.png\" with the faces px, nx, py, ny, pz, nz (docs/volumes.md says which way up); values are taken as they stand"),
      row("image_gamma", &F::image_gamma).within(0.1, 10).means("the energy flux goes as the picture's value to this power"),
      row("energy_image", &F::energy_image).means("picture of the electrons' energy, of the same extent; empty: the same everywhere"),
      row("energy_ratio", &F::energy_ratio).within(0.01, 100)
          .means("energy where energy_image is white, over energy_kev, which is where it is black; between them the logarithm is even"),
      row("point_energy", &F::point_energy).of({"<n>"}).named_by(name_by_spline_point).within(0.05, 20).may_be_free(ParameterScale::logarithmic)
          .means("energy at the spline's points, over energy_kev; empty: 1 everywhere"),
      row("point_flux", &F::point_flux).of({"<n>"}).named_by(name_by_spline_point).within(0, 1000).may_be_free(ParameterScale::linear)
          .means("energy flux at the spline's points, over energy_flux_mw_m2; empty: 1 everywhere"),
      row("noise_scale_km", &F::noise_scale_km).in("km").within(1, 5000).means("largest waves of a noise footprint"),
      row("noise_octaves", &F::noise_octaves).within(1, 10).means("its octaves"),
      row("noise_coverage", &F::noise_coverage).within(0, 1).means("roughly the share of the box that shines"),
      row("flow_turns", &F::flow_turns).within(0, 10)
          .means("how far a plane incompressible flow has wound the footprint up, in turns of its fastest part; 0: not at all"),
      row("flow_scale_km", &F::flow_scale_km).in("km").within(1, 2000).means("of the ripples that the flow starts from"),
      row("flow_ripple", &F::flow_ripple).within(0, 10).means("their strength, over that of the footprint's own shear"),
      row("light", &F::light).one_of({"lines", "colours"})
          .means("the emission lines of the electrons, or two colours between two altitudes in the place of theirs"),
      row("low_colour", &F::low_colour).of({"r", "g", "b"}).within(0, 1).means("colour at low_km, linear, of the sensor's primaries"),
      row("high_colour", &F::high_colour).of({"r", "g", "b"}).within(0, 1).means("colour at high_km"),
      row("low_km", &F::low_km).in("km").within(80, 640).means("altitude of low_colour and below"),
      row("high_km", &F::high_km).in("km").within(80, 640).means("altitude of high_colour and above"),
      row("energy_kev", &F::energy_kev).in("keV").within(0.1, 20).may_be_free(ParameterScale::logarithmic)
          .means("characteristic energy of the electrons, as a sheet's"),
      row("energy_flux_mw_m2", &F::energy_flux_mw_m2).in("mW m⁻²").within(0, 10000).may_be_free(ParameterScale::logarithmic)
          .means("energy flux Q at the spline, or where the picture is white"),
      row("profile", &F::profile).one_of({"maxwellian", "mono", "gaussian", "form"})
          .means("light against altitude: of a spectrum of electrons, or a form"),
      row("energy_spread", &F::energy_spread).within(0.01, 1).means("of the profile \"gaussian\", as a sheet's"),
      row("peak_km", &F::peak_km).in("km").within(81, 600).means("of the profile \"form\": altitude of its peak"),
      row("lower_km", &F::lower_km).in("km").within(0.5, 100).means("below the peak a form's light has fallen to a tenth"),
      row("upper_km", &F::upper_km).in("km").within(0.5, 500).means("above the peak a form's light has fallen to a tenth"),
      row("top_km", &F::top_km).in("km").within(100, 640).means("above which there is no light"),
  };
  // clang-format on
}

}  // namespace vegard::sim
