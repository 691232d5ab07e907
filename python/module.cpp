// vegard._vegard: the libraries for Python, which vegard/__init__.py hands on.
#include "python/bindings.h"
#include "sim/base/processor.h"
#include "sim/base/version.h"

PYBIND11_MODULE(_vegard, m) {
  using namespace vegard::python;
  m.doc() = "vegard's libraries; import vegard instead.";
  m.attr("__version__") = vegard::sim::version();
  bind_errors(m);
  vegard::sim::check_processor();
  bind_long_work(m);
  py::class_<SceneHandle> scene = bind_scene(m);
  bind_cameras(m, scene);
  bind_pictures(m, scene);
  bind_photographs(m, scene);
  bind_fits(m, scene);
  bind_maps(m, scene);
  bind_stars(m);
  bind_measurements(m);
}
