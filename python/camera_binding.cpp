// Cameras: directions of pixels and pixels of directions, for whole arrays.
#include <limits>

#include "fit/ready_scene.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/view/camera/camera.h"
#include "sim/view/camera/direction_map.h"

namespace vegard::python {
namespace {

/// call(a, b, first, second) for every pair of numbers of two arrays, which makes two others of their shape.
template <class Call>
py::tuple by_pairs(const py::object& first, const py::object& second, const Call& call) {
  const auto [a, b] = broadcast(first, second);
  const auto count = static_cast<std::size_t>(a.size());
  std::vector<double> one(count), two(count);
  const double *from_a = a.data(), *from_b = b.data();
  {
    const py::gil_scoped_release others_may_run;
    for (std::size_t i = 0; i < count; ++i) call(from_a[i], from_b[i], one[i], two[i]);
  }
  const std::vector<py::ssize_t> shape = shape_of(a);
  return py::make_tuple(array_of(std::move(one), shape), array_of(std::move(two), shape));
}

py::tuple directions(const sim::Camera& camera, const py::object& x_px, const py::object& y_px) {
  const sim::CameraView<double> view = sim::camera_view(camera);
  return by_pairs(x_px, y_px, [&](double x, double y, double& azimuth_deg, double& elevation_deg) {
    double enu[3];
    azimuth_deg = elevation_deg = std::numeric_limits<double>::quiet_NaN();
    if (!sim::enu_of_pixel(view, x, y, enu)) return;
    const sim::Direction direction = sim::direction_of_enu(enu);
    azimuth_deg = direction.azimuth_deg;
    elevation_deg = direction.elevation_deg;
  });
}

py::tuple pixels(const sim::Camera& camera, const py::object& azimuth_deg, const py::object& elevation_deg) {
  const sim::CameraView<double> view = sim::camera_view(camera);
  return by_pairs(azimuth_deg, elevation_deg, [&](double azimuth, double elevation, double& x, double& y) {
    double enu[3];
    sim::enu_of_direction({azimuth, elevation}, enu);
    if (!sim::pixel_of_enu(view, enu, x, y)) x = y = std::numeric_limits<double>::quiet_NaN();
  });
}

py::tuple direction_map(const sim::Camera& camera) {
  sim::DirectionMap map;
  {
    const py::gil_scoped_release others_may_run;
    map = sim::direction_map(camera);
  }
  const std::vector<py::ssize_t> shape = {map.height, map.width};
  return py::make_tuple(array_of(std::move(map.azimuth_deg), shape),
                        array_of(std::move(map.elevation_deg), shape));
}

}  // namespace

void bind_cameras(py::module_& m, py::class_<SceneHandle>& scene) {
  py::class_<sim::Camera>(
      m, "Camera",
      "Where a picture's pixels look. x to the right, y down, the centre of the first pixel at\n"
      "(0.5, 0.5); azimuth from north to the east, 0 to 360, and elevation above the horizon, in\n"
      "degrees, as light comes to the camera: what the air has bent it by is not undone.")
      .def_readonly("width", &sim::Camera::width, "Pixels (int).")
      .def_readonly("height", &sim::Camera::height, "Pixels (int).")
      .def_property_readonly(
          "model", [](const sim::Camera& c) { return sim::word_of(c.model); },
          "The lens, 'pinhole' or 'equidistant' for example (str).")
      .def("directions", &directions, py::arg("x_px"), py::arg("y_px"),
           "(azimuth_deg, elevation_deg) of places in the picture: arrays of the shape that x_px and y_px "
           "broadcast to\n"
           "(float64), NaN outside of the lens's picture.")
      .def("pixels", &pixels, py::arg("azimuth_deg"), py::arg("elevation_deg"),
           "(x_px, y_px) of directions: arrays of the shape that both broadcast to (float64), NaN where the "
           "lens has no\n"
           "image. A place may lie outside of the picture.")
      .def("direction_map", &direction_map,
           "(azimuth_deg, elevation_deg) of all pixels' centres: two arrays (height, width), float32, NaN "
           "where a pixel\n"
           "looks nowhere. What `vegard directions` writes.")
      .def("__repr__", [](const sim::Camera& c) {
        return "<vegard.Camera " + sim::word_of(c.model) + ", " + sim::size_text(c.width, c.height) +
               " pixels>";
      });
  scene.def_property(
      "camera", [](const SceneHandle& self) { return self.scene->camera; },
      [](SceneHandle& self, const sim::Camera& camera) {
        sim::Scene changed = *self.scene;
        changed.camera = camera;
        fit::make_ready(changed);
        self.scene = std::make_shared<const sim::Scene>(std::move(changed));
      },
      "The scene's camera (Camera); one that a calibration has found may be put in its place.");
}

}  // namespace vegard::python
