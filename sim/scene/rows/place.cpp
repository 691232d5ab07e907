// Where the observer stands and looks: [body], [site], [field], [camera].
#include "sim/scene/lines/bodies.h"
#include "sim/scene/rows/parameter_rules.h"
#include "sim/scene/rows/row.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {
namespace {

void bring_along(Scene& scene, int) { adopt_body(scene); }

/// A row of the field of one model.
Row<Field> of_field(FieldModel model, const char* word, Row<Field> row) {
  return row.inert_if([=](const Field& field) -> std::optional<Complaint> {
    if (field.model == model) return std::nullopt;
    const char* is = field.model == FieldModel::uniform  ? "the same everywhere"
                     : field.model == FieldModel::dipole ? "a dipole's"
                                                         : "the reference field";
    return inert(std::string("the field is ") + is, std::string("set field.model to \"") + word + "\"");
  });
}
Row<Field> of_uniform(const Row<Field>& row) { return of_field(FieldModel::uniform, "uniform", row); }
Row<Field> of_dipole(const Row<Field>& row) { return of_field(FieldModel::dipole, "dipole", row); }

const char* const kClock = "it belongs to the clock that the keys go by";
const char* const kBody = "it belongs to the body, which stays the same one";
const char* const kAffectsLight = "a parameter that the light depends on";

bool is_panorama(const Camera& camera) {
  return camera.model == LensModel::equirectangular || camera.model == LensModel::cube;
}
bool is_pinhole(const Camera& camera) { return camera.model == LensModel::pinhole; }
bool is_no_pinhole(const Camera& camera) { return !is_pinhole(camera); }

/// A row of the scale of some lenses, which others have by another key.
Row<Camera> of_scale(Row<Camera> row, bool (*is_other)(const Camera&), const char* hint) {
  return row
      .inert_if(is_panorama, {"the camera is a panorama ({model}), so {key} has no effect", kAffectsLight,
                              "a panorama sees all around; its scale is camera.width"})
      .inert_if(is_other, {"the lens is {model}, so {key} has no effect", kAffectsLight, hint});
}

/// A row of a radial term of the distortion.
Row<Camera> radial(const char* key, double Camera::*value) {
  return Row("camera", key, &Scene::camera, value)
      .inert_if(
          [](const Camera& camera) { return !is_pinhole(camera) && camera.model != LensModel::polynomial; },
          "the lens is {model}", "set camera.model to \"polynomial\"");
}

}  // namespace

std::vector<Declaration> place_rows() {
  // clang-format off
  return {
      Row("seed", &Scene::seed).from(0).means("seed of all random numbers"),

      Row("body", "name", &Scene::body, &Body::name).one_of(body_names()).then(bring_along)
          .means("sets what the scene leaves out of [body], [field], [[line]] and emission.lines (docs/bodies.md)"),
      Row("body", "radius_km", &Scene::body, &Body::radius_km).stands_still(kBody).in("km").within(6000, 100000)
          .means("of the sphere at altitude 0"),
      Row("body", "gravity_m_s2", &Scene::body, &Body::gravity_m_s2).stands_still(kBody).in("m s⁻²").within(0.1, 100)
          .means("gravity there, for layers without a scale height"),
      Row("body", "dipole_moment_t_m3", &Scene::body, &Body::dipole_moment_t_m3).stands_still(kBody).in("T m³").within(-1e21, 1e21)
          .means("negative: southward at the equator, which reverses folds and spirals"),
      Row("body", "air_temperature_k", &Scene::body, &Body::air_temperature_k).stands_still(kBody).in("K").within(10, 5000)
          .means("of the air where the aurora shines"),
      Row("body", "air_mass_dalton", &Scene::body, &Body::air_mass_dalton).stands_still(kBody).in("Da").within(1, 100)
          .means("mean mass of the air's particles there"),

      Row("site", "latitude_deg", &Scene::site, &Site::latitude_deg).in("deg").within(-90, 90)
          .means("geographic latitude"),
      Row("site", "longitude_deg", &Scene::site, &Site::longitude_deg).in("deg").within(-180, 360)
          .means("geographic longitude, to the east"),
      Row("site", "altitude_m", &Scene::site, &Site::altitude_m).in("m").within(-500, 1e9)
          .means("altitude of the observer"),
      Row("site", "time_utc", &Scene::site, &Site::time_utc).rule(time_complaint)
          .means("UTC of time.start_s = 0, ISO 8601 (\"2019-09-01T05:00:00Z\"); empty: unknown"),

      Row("field", "model", &Scene::field, &Field::model).one_of<FieldModel>({{"uniform", FieldModel::uniform}, {"dipole", FieldModel::dipole}, {"igrf", FieldModel::igrf}})
          .means("the same field everywhere; or at each foot a tilted dipole, or IGRF-14 at site.time_utc"),
      of_uniform(Row("field", "inclination_deg", &Scene::field, &Field::inclination_deg)).as(ParameterRole::inclination).in("deg").within(-90, 90)
          .rule(inclination_complaint).may_be_free(ParameterScale::linear)
          .means("downwards in the north; at least 20 from the horizontal"),
      of_uniform(Row("field", "declination_deg", &Scene::field, &Field::declination_deg)).as(ParameterRole::declination).in("deg").within(-180, 180).may_be_free(ParameterScale::linear)
          .means("declination, from north to the east"),
      of_dipole(Row("field", "pole_latitude_deg", &Scene::field, &Field::pole_latitude_deg)).in("deg").within(45, 90)
          .means("latitude of the dipole's northern pole (default: 2020)"),
      of_dipole(Row("field", "pole_longitude_deg", &Scene::field, &Field::pole_longitude_deg)).in("deg").within(-180, 360)
          .means("its longitude, to the east"),

      Row("camera", "model", &Scene::camera, &Camera::model)
          .one_of<LensModel>({{"pinhole", LensModel::pinhole}, {"equidistant", LensModel::equidistant}, {"equisolid", LensModel::equisolid}, {"stereographic", LensModel::stereographic}, {"orthographic", LensModel::orthographic}, {"polynomial", LensModel::polynomial}, {"equirectangular", LensModel::equirectangular}, {"cube", LensModel::cube}})
          .means("lens"),
      Row("camera", "cube_layout", &Scene::camera, &Camera::cube_layout)
          .one_of<CubeLayout>({{"cross", CubeLayout::cross}, {"strip", CubeLayout::strip}, {"grid", CubeLayout::grid}})
          .means("faces: 4×3, 6×1 or 3×2"),
      Row("camera", "width", &Scene::camera, &Camera::width).in("px").within(1, 65535).means("width of the image"),
      Row("camera", "height", &Scene::camera, &Camera::height).in("px").within(1, 65535).means("height of the image"),
      of_scale(Row("camera", "hfov_deg", &Scene::camera, &Camera::hfov_deg), is_no_pinhole, "this lens has camera.focal_px").called("field of view").as(ParameterRole::field_of_view).in("deg").within(0.1, 170).may_be_free(ParameterScale::linear)
          .means("horizontal field of view of a pinhole, without distortion"),
      of_scale(Row("camera", "focal_px", &Scene::camera, &Camera::focal_px), is_pinhole, "a pinhole has camera.hfov_deg").as(ParameterRole::focal_length).in("px").within(1, 1e6).may_be_free(ParameterScale::linear)
          .means("of other lenses: pixels per radian on the axis"),
      Row("camera", "azimuth_deg", &Scene::camera, &Camera::azimuth_deg).as(ParameterRole::camera_azimuth).in("deg").within(-720, 720).may_be_free(ParameterScale::angle)
          .means("azimuth of the lens axis"),
      Row("camera", "elevation_deg", &Scene::camera, &Camera::elevation_deg).as(ParameterRole::camera_elevation).in("deg").within(-90, 90).may_be_free(ParameterScale::linear)
          .means("elevation of the lens axis"),
      Row("camera", "roll_deg", &Scene::camera, &Camera::roll_deg).as(ParameterRole::camera_roll).in("deg").within(-180, 180).may_be_free(ParameterScale::linear)
          .means("clockwise rotation of the scene in the picture"),
      Row("camera", "principal_x_px", &Scene::camera, &Camera::principal_x_px).as(ParameterRole::principal_x).in("px").within(-65535, 65535).may_be_free(ParameterScale::linear)
          .means("lens axis, to the right of the middle"),
      Row("camera", "principal_y_px", &Scene::camera, &Camera::principal_y_px).as(ParameterRole::principal_y).in("px").within(-65535, 65535).may_be_free(ParameterScale::linear)
          .means("the same: below the middle"),
      Row("camera", "aspect", &Scene::camera, &Camera::aspect).as(ParameterRole::lens_aspect).within(0.2, 5).may_be_free(ParameterScale::linear)
          .means("scale down the picture over scale across it"),
      Row("camera", "mirrored", &Scene::camera, &Camera::mirrored).means("left and right are exchanged"),
      radial("k1", &Camera::k1).as(ParameterRole::lens_k1).within(-10, 10).may_be_free(ParameterScale::linear)
          .means("radial term of r² (pinhole, Brown's distortion) or θ² (polynomial)"),
      radial("k2", &Camera::k2).as(ParameterRole::lens_k2).within(-10, 10).may_be_free(ParameterScale::linear)
          .means("radial term of r⁴ or θ⁴"),
      radial("k3", &Camera::k3).as(ParameterRole::lens_k3).within(-10, 10).may_be_free(ParameterScale::linear)
          .means("radial term of r⁶ or θ⁶"),
      Row("camera", "p1", &Scene::camera, &Camera::p1).as(ParameterRole::lens_p1).within(-1, 1).may_be_free(ParameterScale::linear)
          .means("decentring, as OpenCV's p1"),
      Row("camera", "p2", &Scene::camera, &Camera::p2).as(ParameterRole::lens_p2).within(-1, 1).may_be_free(ParameterScale::linear)
          .means("decentring, as OpenCV's p2"),
  };
  // clang-format on
}

std::vector<Declaration> time_rows() {
  // clang-format off
  return {
      Row("time", "start_s", &Scene::time, &Time::start_s).stands_still(kClock).in("s").within(-1e7, 1e7)
          .means("time of the picture or first frame on the scene's clock"),
      Row("time", "exposure_s", &Scene::time, &Time::exposure_s).stands_still(kClock).in("s").within(0, 1e5)
          .means("of the picture"),
      Row("time", "instants", &Scene::time, &Time::instants).within(1, 1024)
          .means("even instants that are averaged, the first at the start"),
      Row("time", "frames_per_second", &Scene::time, &Time::frames_per_second).stands_still(kClock).in("s⁻¹").within(0.001, 1000)
          .means("of an animation"),
      Row("time", "frames", &Scene::time, &Time::frames).within(1, 1000000).means("of an animation"),
      Row("time", "lapse", &Scene::time, &Time::lapse).stands_still(kClock).within(1e-6, 1e7)
          .means("seconds of the scene to one of an animation; 900: time lapse"),

      Row("substorm", "quiet", &Scene::substorm, &Substorm::quiet).within(0, 1)
          .means("brightness of all aurora before and after; 1: no substorm"),
      Row("substorm", "grown", &Scene::substorm, &Substorm::grown).within(0, 1)
          .means("at the end of growth"),
      Row("substorm", "onset_s", &Scene::substorm, &Substorm::onset_s).in("s").within(-1e7, 1e7)
          .means("growth ends, expansion begins"),
      Row("substorm", "growth_s", &Scene::substorm, &Substorm::growth_s).in("s").within(1, 1e6)
          .means("up to 2 hours"),
      Row("substorm", "expansion_s", &Scene::substorm, &Substorm::expansion_s).in("s").within(1, 1e6)
          .means("about 20 minutes"),
      Row("substorm", "recovery_s", &Scene::substorm, &Substorm::recovery_s).in("s").within(1, 1e6)
          .means("half an hour to 2 hours"),
  };
  // clang-format on
}

}  // namespace vegard::sim
