// Pictures of scenes.
#include <pybind11/stl.h>

#include "fit/photo/composite_pictures.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/long_work.h"
#include "sim/base/memory_limit.h"
#include "sim/render/needed_memory.h"
#include "sim/render/render.h"
#include "sim/scene/structs/line_of.h"

namespace vegard::python {
namespace {

struct Picture {
  std::shared_ptr<const sim::Scene> scene;
  std::shared_ptr<const sim::Rendering> rendering;

  py::object array(sim::Image sim::Rendering::*which) const {
    return image_array(rendering, (*rendering).*which);
  }
};

py::object render(const SceneHandle& self, int threads, bool sheet_layers, const py::object& progress,
                  const py::object& stop) {
  require_threads(threads);
  const std::shared_ptr<const sim::Scene> scene = self.scene;
  LongWork long_work(progress, stop);
  auto rendering = result_of<sim::Rendering>(long_work, [&] {
    return sim::placing_errors(*scene, [&] {
      sim::RenderOptions options;
      constexpr double kDisplayBytes_px = 12.0;  // of display(): three floats
      options.threads = sim::threads_to_render(*scene, threads, {sheet_layers, kDisplayBytes_px},
                                               {sim::usable_memory_bytes(), false, "render"});
      const sim::CompositePictures pictures = fit::read_composite_pictures(*scene);
      options.progress = [&](double share) { long_work.tell({"rendering", share, 0, 0.0}); };
      options.stop = long_work.stop();
      options.pictures = &pictures;
      options.sheet_layers = sheet_layers;
      return sim::render(*scene, options);
    });
  });
  if (rendering.rgb.empty()) return py::none();
  return py::cast(Picture{scene, std::make_shared<const sim::Rendering>(std::move(rendering))});
}

py::array_t<float> display(const Picture& self) {
  sim::Image picture;
  {
    const py::gil_scoped_release others_may_run;
    picture = sim::display_picture(*self.scene, *self.rendering);
  }
  return image_array(std::move(picture));
}

py::dict sheets(const Picture& self) {
  py::dict layers;
  for (const sim::SheetLayer& layer : self.rendering->sheets)
    layers[py::str(layer.name)] = py::make_tuple(image_array(self.rendering, layer.rayleigh),
                                                 image_array(self.rendering, layer.aurora));
  return layers;
}

}  // namespace

void bind_pictures(py::module_& m, py::class_<SceneHandle>& scene) {
  py::class_<Picture> picture(m, "Picture",
                              "A rendered scene. Arrays are float32 of shape (height, width, channels), rows "
                              "from the top, and views of the\n"
                              "simulator's own buffers: read-only, and none is copied.");
  picture
      .def_property_readonly(
          "rayleigh", [](const Picture& p) { return p.array(&sim::Rendering::rayleigh); },
          "(height, width, lines): light of each emission line in rayleighs, blurred, as it reaches "
          "the camera.")
      .def_property_readonly(
          "lines", [](const Picture& p) { return p.scene->emission.lines; },
          "Wavelengths of the lines in nm, in the order of rayleigh's last axis (list of float).")
      .def_property_readonly(
          "rgb", [](const Picture& p) { return p.array(&sim::Rendering::rgb); },
          "(height, width, 3): linear light of the whole picture in the sensor's units, signed "
          "where a colour is out of gamut.")
      .def_property_readonly(
          "aurora", [](const Picture& p) { return p.array(&sim::Rendering::aurora); },
          "(height, width, 3): that of the aurora alone.")
      .def(
          "display", &display,
          "(height, width, 3): what a display shows, 0 to 1, encoded by the scene's tone curve; a new array.")
      .def_property_readonly(
          "sheets", &sheets,
          "Of a picture with sheet_layers: (rayleigh, aurora) of each sheet alone, by name (dict); "
          "else empty.")
      .def_property_readonly(
          "deflection_points", [](const Picture& p) { return p.rendering->deflection_points; },
          "How many points of beams have shone (int).");
  // What the picture is made of beside them.
  const std::pair<const char*, sim::Image sim::Rendering::*> parts[] = {
      {"night_sky", &sim::Rendering::night_sky}, {"background", &sim::Rendering::background},
      {"stars", &sim::Rendering::stars},         {"foreground", &sim::Rendering::foreground},
      {"ground", &sim::Rendering::ground},       {"volume", &sim::Rendering::volume},
      {"hidden", &sim::Rendering::hidden},       {"literal", &sim::Rendering::literal}};
  for (const auto& [name, part] : parts)
    picture.def_property_readonly(
        name, [part = part](const Picture& p) { return p.array(part); },
        "(height, width, 3 or 4): a part of the picture, linear light, with its coverage as a fourth channel "
        "where it\n"
        "covers; None where the scene has none.");

  scene.def(
      "render", &render, py::kw_only(), py::arg("threads") = 0, py::arg("sheet_layers") = false,
      py::arg("progress") = py::none(), py::arg("stop") = py::none(),
      "Renders the scene (Picture): the numbers that `vegard render` writes, for every number of threads.\n\n"
      "threads: 0 for all cores\n"
      "sheet_layers: each sheet by itself as well, for twice the work\n"
      "progress: called with a Progress now and then\n"
      "stop: a threading.Event; once it is set, None is returned. Ctrl-C raises KeyboardInterrupt.");
}

}  // namespace vegard::python
