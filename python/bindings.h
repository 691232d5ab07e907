// The parts of the Python module, each bound by a function, and the code that they share.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <mutex>
#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/photo/photo.h"
#include "fit/scene_cost.h"
#include "sim/scene/structs/scene.h"

namespace vegard::python {

namespace py = pybind11;

/// A scene held by Python. It is never changed in place, but replaced: so work on it can continue in another
/// thread while the interpreter changes it.
struct SceneHandle {
  std::shared_ptr<const sim::Scene> scene;
};

struct PhotoHandle {
  std::shared_ptr<const fit::Photo> photo;
};

/// A cost with all objects that must outlive it, and a mutex, since only one thread may evaluate it at a
/// time.
struct CostHandle {
  std::shared_ptr<const sim::Scene> scene;
  std::vector<std::shared_ptr<const fit::Photo>> photos;
  std::shared_ptr<fit::SceneCost> cost;
  std::shared_ptr<std::mutex> alone;
};

/// Returns the photographs for work on a scene: `given` is a PhotoHandle, a file's name, a list of
/// PhotoHandle, or None for those of the scene's [[fit.photo]]. `for_fit`: whether files are averaged as a
/// fit reads them. Throws sim::Error, py::type_error.
std::vector<std::shared_ptr<const fit::Photo>> photographs_given(const sim::Scene& scene,
                                                                 const py::object& given, bool for_fit);

/// Returns the input files of such work. A scene without a file is represented by the text of a file that
/// would be written for it.
std::vector<fit::InputFile> inputs_of_work(const sim::Scene& scene, const std::vector<fit::Photo>& photos);

/// Throws sim::Error(usage) if an argument is not from `min` to `max`, or NaN. The limits are those of the
/// command-line option of the same name.
void require_within(const char* argument, double value, double min, double max);

/// Checks a number of threads; 0 means all cores.
void require_threads(int threads);

void bind_errors(py::module_& m);
void bind_long_work(py::module_& m);
py::class_<SceneHandle> bind_scene(py::module_& m);
void bind_cameras(py::module_& m, py::class_<SceneHandle>& scene);
void bind_pictures(py::module_& m, py::class_<SceneHandle>& scene);
void bind_photographs(py::module_& m, py::class_<SceneHandle>& scene);
void bind_fits(py::module_& m, py::class_<SceneHandle>& scene);
void bind_maps(py::module_& m, py::class_<SceneHandle>& scene);
void bind_stars(py::module_& m);
void bind_measurements(py::module_& m);

}  // namespace vegard::python
